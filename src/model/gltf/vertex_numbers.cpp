// SPDX-License-Identifier: MIT
// Renumbers vertices in extensions.
#include "model/gltf/vertex_numbers.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/base/numbers.h"
#include "model/gltf/gather_elements.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

constexpr const char* kOutline = "CESIUM_primitive_outline";
constexpr const char* kFeatures = "EXT_mesh_features";
/// Extensions of primitives and meshes that contain no vertex indices, or that other code handles.
constexpr std::array kNamesNoVertices = {kOutline,
                                         kFeatures,
                                         "KHR_draco_mesh_compression",
                                         "KHR_materials_variants",
                                         "KHR_mesh_quantization",
                                         "KHR_xmp",
                                         "KHR_xmp_json_ld",
                                         "EXT_meshopt_compression",
                                         "KHR_meshopt_compression",
                                         "EXT_structural_metadata",
                                         "EXT_instance_features"};
/// Scene extension that declares the number of vertices.
constexpr const char* kCounts = "FB_geometry_metadata";

const Json& meshOf(const Document& document, const Primitive& primitive) {
    return rootArray(document, "meshes")[primitive.mesh];
}

const Json& jsonOf(const Document& document, const Primitive& primitive) {
    return meshOf(document, primitive)["primitives"][primitive.index];
}

/// Calls visit with the name of each extension of the primitive and of its mesh.
template <class Visit>
void visitExtensions(const Document& document, const Primitive& primitive, Visit&& visit) {
    for (const Json* object : {&jsonOf(document, primitive), &meshOf(document, primitive)}) {
        const Json* extensions = findMember(*object, "extensions");
        if (extensions == nullptr || !extensions->is_object()) continue;
        for (const auto& [name, value] : extensions->items()) visit(name);
    }
}

bool isHarmless(const std::string& name) {
    return std::find(kNamesNoVertices.begin(), kNamesNoVertices.end(), name) != kNamesNoVertices.end();
}

bool hasCounts(const Document& document) {
    const Json& scenes = rootArray(document, "scenes");
    return std::any_of(scenes.begin(), scenes.end(),
                       [](const Json& scene) { return findExtension(scene, kCounts) != nullptr; });
}

std::optional<std::size_t> outlineOf(const Document& document, const Json& primitive) {
    const Json* outline = findExtension(primitive, kOutline);
    if (outline == nullptr) return {};
    return readIndex(*outline, "indices", "", rootArray(document, "accessors").size(), "accessor");
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// Renumbers outline edges. If the triangles on both sides of an edge now have separate vertices, the list gets both
/// edges. An edge without a triangle is kept if its vertices still exist.
std::vector<std::uint32_t> carriedEdges(std::span<const std::uint32_t> edges, const NewVertices& vertices) {
    std::unordered_map<std::uint64_t, std::vector<Edge>> found;
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2) found[keyOf(edges[i], edges[i + 1])];
    for (std::size_t c = 0; c < vertices.corners.size(); ++c) {
        const std::uint32_t from = vertices.corners[c], to = vertices.corners[c - c % 3 + (c + 1) % 3];
        const auto entry = found.find(keyOf(vertices.sources[from], vertices.sources[to]));
        if (entry == found.end()) continue;
        const Edge edge = std::minmax(from, to);
        std::vector<Edge>& list = entry->second;
        if (std::find(list.begin(), list.end(), edge) == list.end()) list.push_back(edge);
    }
    std::unordered_map<std::uint32_t, std::uint32_t> first_of;  // index of the first new vertex for each old one
    for (std::uint32_t i = 0; i < vertices.sources.size(); ++i) first_of.try_emplace(vertices.sources[i], i);
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
        for (const Edge& edge : found[keyOf(edges[i], edges[i + 1])]) {
            // The new edge keeps the direction of the edge in the file.
            const bool turned = vertices.sources[edge.first] != edges[i];
            result.push_back(turned ? edge.second : edge.first);
            result.push_back(turned ? edge.first : edge.second);
        }
        const auto from = first_of.find(edges[i]), to = first_of.find(edges[i + 1]);
        if (!found[keyOf(edges[i], edges[i + 1])].empty() || from == first_of.end() || to == first_of.end()) continue;
        result.push_back(from->second);
        result.push_back(to->second);
    }
    return result;
}

/// Returns the lowest n for which no primitive has an attribute "_FEATURE_ID_n".
std::size_t freeFeatureId(const Document& document, std::span<const Primitive* const> primitives) {
    for (std::size_t n = 0;; ++n) {
        const std::string name = "_FEATURE_ID_" + std::to_string(n);
        const bool is_free = std::none_of(primitives.begin(), primitives.end(), [&](const Primitive* primitive) {
            return jsonOf(document, *primitive)["attributes"].contains(name);
        });
        if (is_free) return n;
    }
}

/// Returns the old vertex indices as an attribute for EXT_mesh_features: shorts, or floats for indices beyond 16 bits.
ElementData numbersOf(const NewVertices& vertices) {
    constexpr std::size_t kMaxShort = 65536, kMaxFloat = std::size_t{1} << 24;
    if (vertices.old_count > kMaxFloat)
        failFile(ErrorCode::unsupportedFile, "the primitive has too many feature IDs for a vertex attribute");
    const bool is_short = vertices.old_count <= kMaxShort;
    ElementData data{.component = is_short ? ComponentType::u16 : ComponentType::f32,
                     .count = vertices.sources.size(),
                     .element_bytes = is_short ? std::size_t{2} : std::size_t{4}};
    const auto append = [&](auto number) {
        std::uint8_t bytes[sizeof number];
        storeLittleEndian(number, bytes);
        data.bytes.insert(data.bytes.end(), bytes, bytes + sizeof number);
    };
    for (const std::uint32_t source : vertices.sources) {
        if (is_short) append(static_cast<std::uint16_t>(source));
        if (!is_short) append(static_cast<float>(source));
    }
    return data;
}

/// Returns whether the feature IDs of a primitive are implicit: without an attribute or a texture, the ID is the vertex
/// index.
bool isImplicit(const Json& feature_id) {
    return feature_id.is_object() && !feature_id.contains("attribute") && !feature_id.contains("texture");
}

}  // namespace

bool mayReferenceVertices(const Document& document, const Primitive& primitive) {
    bool may = hasCounts(document);
    visitExtensions(document, primitive, [&](const std::string& name) {
        may = may || name == kOutline || name == kFeatures || !isHarmless(name);
    });
    return may;
}

void VertexNumbers::carry(std::span<const Primitive* const> primitives, const NewVertices& vertices) {
    // An invalid extension is left unchanged, like an unknown one.
    if (tryFile([&] { carryOutline(primitives, vertices); })) left_[kOutline] += primitives.size();
    if (tryFile([&] { carryFeatureIds(primitives, vertices); })) left_[kFeatures] += primitives.size();
    for (const Primitive* primitive : primitives) noteOthers(*primitive);
}

Json* VertexNumbers::extensionOf(const Primitive& primitive, const char* name) {
    return findExtension(jsonOf(document_, primitive), name) == nullptr
               ? nullptr
               : &editor_.primitive(primitive.mesh, primitive.index)["extensions"][name];
}

std::size_t VertexNumbers::outlineUses(std::size_t accessor) const {
    std::size_t uses = editor_.accessorUses(accessor);
    for (const Json& mesh : rootArray(document_, "meshes")) {
        for (const Json& primitive : readArray(mesh, "primitives", ""))
            uses += outlineOf(document_, primitive) == accessor;
    }
    return uses;
}

void VertexNumbers::carryOutline(std::span<const Primitive* const> primitives, const NewVertices& vertices) {
    std::map<std::size_t, std::vector<const Primitive*>> users;
    for (const Primitive* primitive : primitives) {
        if (const auto accessor = outlineOf(document_, jsonOf(document_, *primitive)))
            users[*accessor].push_back(primitive);
    }
    for (const auto& [accessor, list] : users) {
        const Accessor old = readAccessor(document_, accessor);
        const std::vector<std::uint32_t> edges = decodeIndices(document_, old, vertices.old_count, old.place());
        std::vector<std::uint32_t> carried = carriedEdges(edges, vertices);
        if (carried == edges) continue;
        ElementData data = indexElements(std::move(carried), old.component, vertices.sources.size());
        data.like = accessor;
        if (old.view && !rootArray(document_, "bufferViews")[*old.view].contains("target")) data.target = kNoTarget;
        const bool alone = outlineUses(accessor) == list.size();
        const std::size_t stored = editor_.store(std::move(data), alone ? std::optional(accessor) : std::nullopt);
        for (const Primitive* primitive : list) (*extensionOf(*primitive, kOutline))["indices"] = stored;
    }
}

void VertexNumbers::carryFeatureIds(std::span<const Primitive* const> primitives, const NewVertices& vertices) {
    std::optional<std::size_t> name, stored;
    for (const Primitive* primitive : primitives) {
        Json* features = extensionOf(*primitive, kFeatures);
        if (features == nullptr || !readArray(*features, "featureIds", primitive->place(), false).is_array()) continue;
        for (Json& feature_id : (*features)["featureIds"]) {
            if (!isImplicit(feature_id)) continue;
            Json& attributes = editor_.primitive(primitive->mesh, primitive->index)["attributes"];
            if (!name) name = freeFeatureId(document_, primitives);
            if (!stored) {
                ElementData data = numbersOf(vertices);
                data.like = attributes["POSITION"].get<std::size_t>();
                stored = editor_.store(std::move(data), {});
            }
            const std::string attribute = "_FEATURE_ID_" + std::to_string(*name);
            if (!attributes.contains(attribute)) {
                attributes[attribute] = *stored;
                editor_.moveUse({}, *stored);
            }
            feature_id["attribute"] = *name;
        }
    }
}

void VertexNumbers::noteOthers(const Primitive& primitive) {
    visitExtensions(document_, primitive, [&](const std::string& name) {
        if (!isHarmless(name)) ++left_[name];
    });
    if (hasCounts(document_)) ++left_[kCounts];
}

std::vector<std::string> VertexNumbers::warnings() const {
    std::vector<std::string> list;
    for (const auto& [name, count] : left_) {
        const std::string renumbered = "the vertices of " +
                                       (count == 1 ? "1 primitive" : std::to_string(count) + " primitives") +
                                       " were renumbered, ";
        list.push_back(renumbered + (name == kCounts ? "but the counts in " + name + " were not updated"
                                                     : "and the extension " + name +
                                                           ", which may contain vertex indices, was not updated"));
    }
    return list;
}

}  // namespace tspace::gltf
