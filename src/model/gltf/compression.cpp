// SPDX-License-Identifier: MIT
// Geometry compression of whole files.
#include "model/gltf/compression.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <set>

#include "core/base/sort.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/editor.h"
#include "model/gltf/gather_elements.h"
#include "model/gltf/primitive_reader.h"
#include "model/gltf/references.h"
#include "model/gltf/vertex_numbers.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

// Encodes uncompressed accessors as Draco data.

namespace {

/// Quantization bits that exporters commonly use.
constexpr int kPositionBits = 14, kNormalBits = 10, kUvBits = 12;

bool isFinite(const Bytes& floats) {
    for (std::size_t i = 0; i < floats.size() / sizeof(float); ++i) {
        float value;
        std::memcpy(&value, floats.data() + i * sizeof(float), sizeof(float));
        if (!std::isfinite(value)) return false;
    }
    return true;
}

/// Returns the quantization bits of an attribute; 0: none.
int roundingOf(const DracoAttribute& attribute) {
    if (attribute.component != ComponentType::f32 || !isFinite(attribute.values)) return 0;
    switch (attribute.kind) {
        case DracoKind::position: return kPositionBits;
        case DracoKind::normal: return attribute.component_count == 3 ? kNormalBits : 0;
        case DracoKind::uv: return kUvBits;
        default: return 0;
    }
}

class Packer {
  public:
    Packer(Document& document, Editor& editor) : document_(document), editor_(editor), numbers_(document, editor) {}

    void run() {
        const std::vector<Primitive> primitives = readPrimitives(document_);
        std::map<std::string, std::vector<const Primitive*>> groups;
        std::vector<std::string> order;
        for (const Primitive& primitive : primitives) {
            if (!canPack(primitive)) continue;
            const std::string key = json(primitive)["attributes"].dump() + targetsOf(primitive).dump() +
                                    (primitive.indices ? std::to_string(*primitive.indices) : "") + '|' +
                                    modeName(primitive.mode);
            if (groups[key].empty()) order.push_back(key);
            groups[key].push_back(&primitive);
        }
        for (const std::string& key : order) pack(groups[key]);
    }

    [[nodiscard]] std::vector<std::string> warnings() const { return numbers_.warnings(); }

  private:
    Json& json(const Primitive& primitive) { return editor_.primitive(primitive.mesh, primitive.index); }
    Json targetsOf(const Primitive& primitive) {
        const Json* targets = findMember(json(primitive), "targets");
        return targets == nullptr ? Json() : *targets;
    }

    bool canPack(const Primitive& primitive) {
        if (findExtension(json(primitive), kDraco) != nullptr || !hasTriangles(primitive.mode)) return false;
        if (!primitive.find("POSITION") || primitive.triangleCount() == 0) return false;
        // Corners that form no triangle would be lost.
        if (primitive.mode == Mode::triangles && primitive.corner_count % 3 != 0) return false;
        if (primitive.indices && !hasData(document_, readAccessor(document_, *primitive.indices))) return false;
        return std::all_of(primitive.attributes.begin(), primitive.attributes.end(), [&](const auto& attribute) {
            const Accessor accessor = readAccessor(document_, attribute.second);
            return accessor.component_count >= 1 && accessor.component_count <= 4 && hasData(document_, accessor);
        });
    }

    /// Returns whether only the primitives of the group use the group's vertices.
    bool ownsVertices(const std::vector<const Primitive*>& group) {
        std::map<std::size_t, std::size_t> uses;
        for (const Primitive* primitive : group) {
            for (const auto& [name, accessor] : primitive->attributes) ++uses[accessor];
        }
        return std::all_of(uses.begin(), uses.end(),
                           [&](const auto& use) { return editor_.accessorUses(use.first) == use.second; });
    }

    /// Keeps only the vertices that corners use, and renumbers the corners. Decoders reject meshes with more points
    /// than corners, which unused vertices together with later splits could cause.
    static std::vector<std::uint32_t> chooseVertices(std::vector<std::uint32_t>& corners) {
        std::vector<std::uint32_t> chosen = corners;
        sortList(chosen.begin(), chosen.end());
        chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
        for (std::uint32_t& corner : corners) {
            corner =
                static_cast<std::uint32_t>(std::lower_bound(chosen.begin(), chosen.end(), corner) - chosen.begin());
        }
        return chosen;
    }

    void pack(const std::vector<const Primitive*>& group) {
        const Primitive& first = *group[0];
        const bool owns = ownsVertices(group);
        DracoMesh mesh;
        mesh.corners = readTriangleCorners(document_, first);
        const std::vector<std::uint32_t> chosen = chooseVertices(mesh.corners);
        mesh.point_count = chosen.size();
        std::vector<ElementData> elements;
        for (const auto& [name, index] : first.attributes) {
            const Accessor accessor = readAccessor(document_, index);
            elements.push_back(gatherElements(document_, accessor, chosen));
            if (elements.back().places) return;  // a custom attribute with mostly zeros stays sparse
            mesh.attributes.push_back({.kind = dracoKind(name),
                                       .component = accessor.component,
                                       .normalized = accessor.normalized,
                                       .component_count = accessor.component_count,
                                       .values = elements.back().bytes});
            mesh.attributes.back().rounding.bits = roundingOf(mesh.attributes.back());
        }
        Bytes data;
        const DracoLimits no_limits{mesh.corners.size(), mesh.point_count, ~std::size_t{0}};
        // If the codec fails, the primitive stays uncompressed.
        if (!encodeDraco(mesh, false, data) || !decodeDraco(data, no_limits, mesh).empty()) return;
        store(group, mesh, std::move(elements), std::move(data), chosen, owns);
        if (chosen.size() != first.vertex_count) numbers_.carry(group, {chosen, mesh.corners, first.vertex_count});
        requireExtension(document_, kDraco);
    }

    void store(const std::vector<const Primitive*>& group, DracoMesh& mesh, std::vector<ElementData> elements,
               Bytes data, const std::vector<std::uint32_t>& chosen, bool owns) {
        const Primitive& first = *group[0];
        const std::size_t indices = storeIndices(group, mesh);
        Json extension = Json::object();
        std::map<std::size_t, std::size_t> stored;  // one accessor may be used for two attributes
        for (std::size_t i = 0; i < first.attributes.size(); ++i) {
            const auto& [name, old] = first.attributes[i];
            extension["attributes"][name] = mesh.attributes[i].id;
            if (stored.count(old) == 0) {
                ElementData& values = elements[i];
                values.in_draco = true;
                values.bytes = std::move(mesh.attributes[i].values);
                renewBounds(values);
                stored[old] = editor_.store(std::move(values), owns ? std::optional(old) : std::nullopt);
            }
            for (const Primitive* primitive : group) {
                json(*primitive)["attributes"][name] = stored[old];
                editor_.moveUse(old, stored[old]);
            }
        }
        if (chosen.size() != first.vertex_count) carryTargets(group, chosen);
        extension["bufferView"] = editor_.storeBlob(std::move(data), {});
        for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
            document_.draco_roundings[{extension["bufferView"].get<std::size_t>(), mesh.attributes[i].id}] =
                mesh.attributes[i].rounding;
        }
        for (const Primitive* primitive : group) {
            json(*primitive)["indices"] = indices;
            if (primitive->mode != Mode::triangles) json(*primitive)["mode"] = static_cast<unsigned>(Mode::triangles);
            json(*primitive)["extensions"][kDraco] = extension;
        }
    }

    std::size_t storeIndices(const std::vector<const Primitive*>& group, const DracoMesh& mesh) {
        const std::optional<std::size_t> old = group[0]->indices;
        const ComponentType narrowest = old ? readAccessor(document_, *old).component : ComponentType::u16;
        ElementData data = indexElements(std::vector(mesh.corners), narrowest, mesh.point_count);
        data.in_draco = true;
        const bool alone = old && editor_.accessorUses(*old) == group.size();
        const std::size_t stored = editor_.store(std::move(data), alone ? old : std::nullopt);
        for (std::size_t i = 0; i < group.size(); ++i) editor_.moveUse(old, stored);
        return stored;
    }

    void carryTargets(const std::vector<const Primitive*>& group, const std::vector<std::uint32_t>& chosen) {
        std::map<std::size_t, std::size_t> stored, uses;
        for (const AttributeList& target : group[0]->targets) {
            for (const auto& [name, old] : target) uses[old] += group.size();
        }
        for (std::size_t t = 0; t < group[0]->targets.size(); ++t) {
            for (const auto& [name, old] : group[0]->targets[t]) {
                if (stored.count(old) == 0) {
                    // Unused vertices were dropped, and they may have defined the declared bounds.
                    ElementData data = gatherElements(document_, readAccessor(document_, old), chosen);
                    renewBounds(data);
                    const bool alone = editor_.accessorUses(old) == uses[old];
                    stored[old] = editor_.store(std::move(data), alone ? std::optional(old) : std::nullopt);
                }
                for (const Primitive* primitive : group) {
                    json(*primitive)["targets"][t][name] = stored[old];
                    editor_.moveUse(old, stored[old]);
                }
            }
        }
    }

    Document& document_;
    Editor& editor_;
    VertexNumbers numbers_;
};

}  // namespace

std::vector<std::string> packDraco(Document& document, Editor& editor) {
    Packer packer(document, editor);
    packer.run();
    return packer.warnings();
}

// Changes the compression of a file via uncompressed views.

namespace {

void unpackMeshopt(Document& document, Editor& editor) {
    for (std::size_t i = 0; i < rootArray(document, "bufferViews").size(); ++i) {
        const char* name = meshoptExtension(rootArray(document, "bufferViews")[i]);
        if (name == nullptr) continue;
        if (document.buffers[readBufferView(document, i).buffer].source == BufferSource::absent)
            failFile(ErrorCode::unsupportedFile, meshoptMissing(name == kKhrMeshopt), join("/bufferViews", i));
        editor.unpackView(i);
    }
    for (std::size_t i = 0; i < document.buffers.size(); ++i) {
        Json& buffer = document.json["buffers"][i];
        if (const char* mark = meshoptExtension(buffer)) eraseExtension(buffer, mark);
    }
    for (const char* name : {kExtMeshopt, kKhrMeshopt}) dropExtension(document, name);
}

void unpackDraco(Document& document, Editor& editor) {
    if (!document.hidden_accessors.empty()) failFile(ErrorCode::unsupportedFile, dracoMissing());
    std::set<std::size_t> indices;
    for (Json& mesh : editableRootArray(document, "meshes")) {
        for (Json& primitive : mesh["primitives"]) {
            const Json* extension = findExtension(primitive, kDraco);
            if (extension == nullptr) continue;
            editor.releaseView((*extension)["bufferView"].get<std::size_t>());
            eraseExtension(primitive, kDraco);
            if (primitive.contains("indices")) indices.insert(primitive["indices"].get<std::size_t>());
        }
    }
    std::vector<std::size_t> accessors;
    for (const auto& [accessor, elements] : document.elements) accessors.push_back(accessor);
    for (const std::size_t index : accessors) {
        const Accessor accessor = readAccessor(document, index);
        std::vector<std::uint32_t> all(accessor.count);
        std::iota(all.begin(), all.end(), 0u);
        ElementData data = gatherElements(document, accessor, all);
        data.like.reset();
        renewBounds(data);  // decoded Draco values rarely match the declared bounds exactly
        if (indices.count(index) != 0) data.target = kIndexTarget;
        document.elements.erase(index);
        editor.store(std::move(data), index);
    }
    document.draco_roundings.clear();
    dropExtension(document, kDraco);
}

/// Accessors that read a buffer view.
struct ViewUse {
    std::set<std::size_t> accessors = {};
    bool by_indices = false, by_vertices = false;
    std::size_t stride = 0;      ///< common stride of all accessors; 0 if they differ
    std::size_t byte_count = 0;  ///< size of the complete rows that the accessors read
};

class ViewUses {
  public:
    explicit ViewUses(const Document& document)
        : document_(document), uses_(rootArray(document, "bufferViews").size()) {
        for (const Primitive& primitive : readPrimitives(document)) {
            if (primitive.indices) add(*primitive.indices, true);
            for (const auto& [name, accessor] : primitive.attributes) add(accessor, false);
            for (const AttributeList& target : primitive.targets) {
                for (const auto& [name, accessor] : target) add(accessor, false);
            }
        }
        all_ = countViewUses(document);
    }

    [[nodiscard]] const ViewUse& operator[](std::size_t view) const { return uses_[view]; }

    /// Returns whether the codec supports the view: rows of one size, used either as vertices or as indices and for
    /// nothing else.
    [[nodiscard]] bool canPack(std::size_t view) const {
        const ViewUse& use = uses_[view];
        if (use.accessors.empty() || use.accessors.size() != all_[view] || use.by_indices == use.by_vertices)
            return false;
        if (use.byte_count == 0 || rootArray(document_, "bufferViews")[view].contains("extensions")) return false;
        return use.by_indices ? use.stride == 2 || use.stride == 4
                              : use.stride != 0 && use.stride % 4 == 0 && use.stride <= 256;
    }

  private:
    void add(std::size_t index, bool is_indices) {
        const Accessor accessor = readAccessor(document_, index);
        if (!accessor.view || !hasData(document_, accessor)) return;
        ViewUse& use = uses_[*accessor.view];
        const bool is_first = use.accessors.empty();
        use.accessors.insert(index);
        (is_indices ? use.by_indices : use.by_vertices) = true;
        if (is_first) use.stride = accessor.stride;
        if (use.stride != accessor.stride || accessor.component_count == 0) use.stride = 0;
        if (accessor.count == 0 || use.stride == 0) return;
        const std::size_t end = accessor.byte_offset + (accessor.count - 1) * accessor.stride + accessor.data_bytes;
        use.byte_count = std::max(use.byte_count, (end + use.stride - 1) / use.stride * use.stride);
    }

    const Document& document_;
    std::vector<ViewUse> uses_;
    std::vector<std::size_t> all_;
};

void packMeshopt(Document& document, Editor& editor) {
    const ViewUses uses(document);
    const std::size_t view_count = rootArray(document, "bufferViews").size();
    bool any = false;
    for (std::size_t i = 0; i < view_count; ++i) {
        if (!uses.canPack(i)) continue;
        editor.packView(i, uses[i].byte_count, uses[i].stride, uses[i].by_indices);
        any = true;
    }
    if (any) requireExtension(document, kExtMeshopt);
}

bool usesDraco(const Document& document) {
    for (const Json& mesh : rootArray(document, "meshes")) {
        for (const Json& primitive : readArray(mesh, "primitives", "")) {
            if (findExtension(primitive, kDraco) != nullptr) return true;
        }
    }
    return false;
}

bool usesMeshopt(const Document& document) {
    const Json& views = rootArray(document, "bufferViews");
    return std::any_of(views.begin(), views.end(), [](const Json& view) { return meshoptExtension(view) != nullptr; });
}

/// Calls the body with an editor, and finishes the edit. Returns whether the body changed the document.
template <class Body>
bool edit(Document& document, const std::string& new_file_name, Body&& body) {
    Editor editor(document, new_file_name);
    body(editor);
    if (!editor.changed()) return false;
    editor.finish();
    removeUnreferencedBuffers(document);
    return true;
}

void needLibrary(const std::string& missing) {
    if (!missing.empty())
        failFile(ErrorCode::unsupportedFile, "the output cannot be compressed as requested: " + missing);
}

}  // namespace

bool unpackGeometry(Document& document, Compression compression, const std::string& new_file_name,
                    std::vector<std::string>& warnings) {
    if (compression == Compression::keep) return false;
    if (compression == Compression::meshopt) needLibrary(meshoptMissing(false));
    if (compression == Compression::draco) needLibrary(dracoMissing());
    return edit(document, new_file_name, [&](Editor& editor) {
        if (compression != Compression::draco && usesDraco(document)) unpackDraco(document, editor);
        if (compression != Compression::meshopt && usesMeshopt(document)) unpackMeshopt(document, editor);
        if (compression != Compression::draco) return;
        for (std::string& warning : packDraco(document, editor)) warnings.push_back(std::move(warning));
    });
}

bool packGeometry(Document& document, Compression compression, const std::string& new_file_name) {
    if (compression != Compression::meshopt) return false;
    return edit(document, new_file_name, [&](Editor& editor) { packMeshopt(document, editor); });
}

}  // namespace tspace::gltf
