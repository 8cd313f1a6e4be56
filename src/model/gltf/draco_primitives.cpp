// SPDX-License-Identifier: MIT
// Draco extensions of primitives: JSON, limits, decoding, and encoding.
#include "model/gltf/draco_primitives.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>

#include "model/gltf/accessor.h"
#include "model/gltf/packed_layout.h"
#include "model/gltf/references.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

/// Maximum memory for decoding without a user's limit. Draco has no minimum size per vertex (a flat grid takes almost
/// nothing), so the limit is arbitrary: a file of any size may decode to 4 MiB, a large file to 256 times its size.
constexpr std::uint64_t kFreeBytes = std::uint64_t{4} << 20;
constexpr std::uint64_t kRatio = 256;
/// Estimated temporary memory of the library per point, as a multiple of the size of the values.
constexpr std::uint64_t kWorkFactor = 4;

constexpr std::size_t kTriangles = 4;

/// Primitive with the extension, as declared in its JSON.
struct Packed {
    std::size_t mesh = 0, index = 0;
    std::size_t view = 0;
    std::size_t mode = kTriangles;
    std::optional<std::size_t> indices = {};
    /// Name, accessor and Draco id of the attributes in the extension.
    struct Attribute {
        std::string name = {};
        std::size_t accessor = 0;
        std::uint32_t id = 0;
    };
    std::vector<Attribute> attributes = {};

    [[nodiscard]] std::string primitivePlace() const {
        return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(index);
    }
    [[nodiscard]] std::string place() const { return primitivePlace() + "/extensions/" + kDraco; }
};

Packed readPacked(const Document& document, const Json& primitive, std::size_t mesh, std::size_t index) {
    Packed packed;
    packed.mesh = mesh;
    packed.index = index;
    const std::string place = packed.place();
    const Json& extension = *findExtension(primitive, kDraco);
    const std::size_t accessor_count = rootArray(document, "accessors").size();
    packed.view =
        requireIndex(extension, "bufferView", place, rootArray(document, "bufferViews").size(), "buffer view");
    packed.mode = readSize(primitive, "mode", packed.primitivePlace(), kTriangles);
    if (packed.mode < kTriangles)
        failFile(ErrorCode::invalidFile, "the Draco extension can only be used for triangles, not for points or lines",
                 join(packed.primitivePlace(), "mode"));
    packed.indices = readIndex(primitive, "indices", packed.primitivePlace(), accessor_count, "accessor");
    const Json& ids = requireObject(extension, "attributes", place);
    const Json& attributes = requireObject(primitive, "attributes", packed.primitivePlace());
    for (const auto& [name, id] : ids.items()) {
        const auto accessor =
            readIndex(attributes, name.c_str(), packed.primitivePlace() + "/attributes", accessor_count, "accessor");
        if (!accessor) continue;
        const std::uint64_t number = readWhole(ids, name.c_str(), place + "/attributes");
        if (number > 0xffffffffu)
            failFile(ErrorCode::invalidFile, "the Draco id is out of range", join(place + "/attributes", name));
        packed.attributes.push_back({name, *accessor, static_cast<std::uint32_t>(number)});
    }
    return packed;
}

std::vector<Packed> findPacked(const Document& document) {
    std::vector<Packed> all;
    const Json& meshes = rootArray(document, "meshes");
    for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
        const Json& primitives = readArray(meshes[mesh], "primitives", join("/meshes", mesh));
        for (std::size_t index = 0; index < primitives.size(); ++index) {
            if (findExtension(primitives[index], kDraco) != nullptr)
                all.push_back(readPacked(document, primitives[index], mesh, index));
        }
    }
    return all;
}

Json& primitiveJson(Document& document, const Packed& packed) {
    return document.json["meshes"][packed.mesh]["primitives"][packed.index];
}

/// Source of an accessor's data in a Draco primitive: a view, and the ID of an attribute in it or the indices.
struct Source {
    std::size_t view = 0;
    std::int64_t id = -1;
    bool operator==(const Source&) const = default;
};

class Decoder {
  public:
    explicit Decoder(Document& document) : document_(document) {}

    void run() {
        std::vector<Packed> all = findPacked(document_);
        countOtherUses(all);
        std::uint64_t stored = 0;
        for (const Buffer& buffer : document_.buffers) stored += buffer.bytes.size();
        budget_ = kFreeBytes + kRatio * stored;
        for (Packed& packed : all) {
            if (hasPlainData(packed)) continue;
            if (dracoMissing().empty()) {
                decode(packed);
            } else {
                hide(packed);
            }
        }
    }

  private:
    [[nodiscard]] bool hasPlainData(const Packed& packed) const {
        const auto is_plain = [&](std::size_t accessor) { return readAccessor(document_, accessor).view.has_value(); };
        return (!packed.indices || is_plain(*packed.indices)) &&
               std::all_of(packed.attributes.begin(), packed.attributes.end(),
                           [&](const Packed::Attribute& attribute) { return is_plain(attribute.accessor); });
    }

    void hide(const Packed& packed) {
        if (packed.indices) document_.hidden_accessors.insert(*packed.indices);
        for (const Packed::Attribute& attribute : packed.attributes)
            document_.hidden_accessors.insert(attribute.accessor);
    }

    /// Counts references to accessors from outside Draco primitives.
    void countOtherUses(const std::vector<Packed>& all) {
        other_uses_ = countAccessorUses(document_);
        for (const Packed& packed : all) {
            if (packed.indices) --other_uses_[*packed.indices];
            for (const Packed::Attribute& attribute : packed.attributes) --other_uses_[attribute.accessor];
        }
    }

    /// Returns the accessor that represents `source` in this primitive: `accessor` itself, or a copy if `accessor`
    /// represents other data elsewhere.
    std::size_t own(std::size_t accessor, const Source& source) {
        const auto [entry, is_new] = sources_.try_emplace(accessor, source);
        const bool has_others = accessor < other_uses_.size() && other_uses_[accessor] > 0;
        if (entry->second == source && !has_others) return accessor;
        const auto [copy, is_first] =
            copies_.try_emplace({accessor, source.view, source.id}, rootArray(document_, "accessors").size());
        if (is_first) {
            Json& accessors = editableRootArray(document_, "accessors");
            accessors.push_back(Json(accessors[accessor]));
        }
        return copy->second;
    }

    void decode(Packed& packed) {
        Json& json = primitiveJson(document_, packed);
        for (Packed::Attribute& attribute : packed.attributes) {
            const std::size_t owned = own(attribute.accessor, {packed.view, attribute.id});
            if (owned != attribute.accessor) json["attributes"][attribute.name] = attribute.accessor = owned;
        }
        if (packed.indices) {
            const std::size_t owned = own(*packed.indices, {packed.view, -1});
            if (owned != *packed.indices) json["indices"] = owned;
            packed.indices = owned;
        }
        const bool is_known =
            packed.indices && document_.elements.count(*packed.indices) != 0 &&
            std::all_of(packed.attributes.begin(), packed.attributes.end(),
                        [&](const auto& attribute) { return document_.elements.count(attribute.accessor) != 0; });
        if (!is_known) takeElements(packed, decodeBlob(packed));
        if (packed.mode != kTriangles) json["mode"] = kTriangles;
    }

    /// Checks the declared size of accessors before values are decoded. With a memory limit of the user, it must fit
    /// into that limit; otherwise it is subtracted from the budget for Draco data.
    void takeFromBudget(std::uint64_t bytes, const std::string& place) {
        if (document_.memory->isFromUser()) {
            document_.memory->require(bytes * kWorkFactor, place);
            return;
        }
        if (bytes > budget_) {
            failFile(ErrorCode::invalidFile,
                     "the accessors of the Draco primitive declare " + std::to_string(bytes) +
                         " bytes, which exceeds the limit for a file of this size; use --memory-limit to raise it",
                     place);
        }
        budget_ -= bytes;
    }

    DracoMesh decodeBlob(const Packed& packed) {
        DracoMesh mesh;
        DracoLimits limits;
        std::uint64_t bytes = 0;
        for (const Packed::Attribute& attribute : packed.attributes) {
            const Accessor accessor = readAccessor(document_, attribute.accessor);
            mesh.attributes.push_back(
                {.id = attribute.id, .component = accessor.component, .component_count = accessor.component_count});
            limits.point_count = std::max<std::uint64_t>(limits.point_count, accessor.count);
            bytes += std::uint64_t{accessor.count} * accessor.element_bytes;
        }
        limits.corner_count = limits.point_count * 3 * 3;
        if (packed.indices) {
            const std::uint64_t count = readAccessor(document_, *packed.indices).count;
            limits.corner_count = packed.mode == kTriangles ? count : count * 3;
        }
        bytes += limits.corner_count * sizeof(std::uint32_t);
        takeFromBudget(bytes, packed.place());
        limits.bytes = bytes * kWorkFactor;
        const BufferView view = readBufferView(document_, packed.view);
        if (document_.buffers[view.buffer].source == BufferSource::absent)
            failFile(ErrorCode::invalidFile, "the buffer of the Draco data has no data", packed.place());
        const auto data = document_.buffers[view.buffer].bytes.range(view.begin, view.byte_count);
        if (const std::string fault = decodeDraco(data, limits, mesh); !fault.empty())
            failFile(ErrorCode::invalidFile, fault, packed.place());
        return mesh;
    }

    void takeElements(Packed& packed, DracoMesh mesh) {
        // Decoded bytes count as bytes of the file, so the budget grows with them; DracoLimits bounds them.
        std::size_t bytes = mesh.corners.size() * sizeof(std::uint32_t);
        for (const DracoAttribute& attribute : mesh.attributes) bytes += attribute.values.size();
        document_.memory->allow(bytes);
        document_.memory->take(bytes, packed.place());
        for (std::size_t i = 0; i < packed.attributes.size(); ++i) {
            const std::size_t accessor = packed.attributes[i].accessor;
            document_.elements[accessor] = std::move(mesh.attributes[i].values);
            document_.json["accessors"][accessor]["count"] = mesh.point_count;
            document_.draco_roundings[{packed.view, packed.attributes[i].id}] = std::move(mesh.attributes[i].rounding);
        }
        if (!packed.indices) {
            Json& accessors = editableRootArray(document_, "accessors");
            packed.indices = accessors.size();
            accessors.push_back(
                {{"componentType", static_cast<std::uint32_t>(ComponentType::u32)}, {"count", 0}, {"type", "SCALAR"}});
            primitiveJson(document_, packed)["indices"] = *packed.indices;
        }
        const Accessor indices = readAccessor(document_, *packed.indices);
        const std::size_t width = bytesOf(indices.component);
        if (indices.component_count != 1 || indices.component == ComponentType::f32)
            failFile(ErrorCode::invalidFile, "indices must be unsigned scalars", indices.place());
        if (width < 4 && mesh.point_count > std::size_t{1} << (8 * width))
            failFile(ErrorCode::invalidFile,
                     "the Draco data has too many points for indices of " + std::to_string(width) + " bytes",
                     packed.place());
        Bytes elements(mesh.corners.size() * width);
        for (std::size_t i = 0; i < mesh.corners.size(); ++i)
            std::memcpy(elements.data() + i * width, &mesh.corners[i], width);  // little-endian, like the file
        document_.elements[*packed.indices] = std::move(elements);
        document_.json["accessors"][*packed.indices]["count"] = mesh.corners.size();
    }

    Document& document_;
    std::uint64_t budget_ = 0;
    std::vector<std::size_t> other_uses_;
    std::map<std::size_t, Source> sources_;
    std::map<std::tuple<std::size_t, std::size_t, std::int64_t>, std::size_t> copies_;
};

class Encoder {
  public:
    Encoder(Document& document, const std::set<std::size_t>& changed, const std::vector<std::size_t>& view_uses,
            const StoreBlob& store)
        : document_(document), changed_(changed), view_uses_(view_uses), store_(store) {}

    void run() {
        // Primitives with the same attributes and indices share their data.
        std::map<std::string, std::vector<Packed>> groups;
        for (Packed& packed : findPacked(document_)) {
            if (!isChanged(packed)) continue;
            const Json& json = primitiveJson(document_, packed);
            groups[json["attributes"].dump() + (packed.indices ? std::to_string(*packed.indices) : "")].push_back(
                std::move(packed));
        }
        for (const auto& [key, group] : groups) encodeGroup(group);
    }

  private:
    [[nodiscard]] bool isChanged(const Packed& packed) const {
        const Json& json = document_.json["meshes"][packed.mesh]["primitives"][packed.index];
        if (packed.indices && changed_.count(*packed.indices) != 0) return true;
        const Json& attributes = json["attributes"];
        return std::any_of(attributes.begin(), attributes.end(),
                           [&](const Json& accessor) { return changed_.count(accessor.get<std::size_t>()) != 0; });
    }

    void encodeGroup(const std::vector<Packed>& group) {
        const Packed& first = group[0];
        if (!dracoMissing().empty()) {
            // Uncompressed data must exist, because the edit was possible; the compressed copy is outdated.
            for (const Packed& packed : group) eraseExtension(primitiveJson(document_, packed), kDraco);
            return;
        }
        DracoMesh mesh;
        std::vector<std::string> names;
        for (const auto& [name, value] : primitiveJson(document_, first)["attributes"].items()) {
            const auto accessor = value.get<std::size_t>();
            if (!belongs(first, name, accessor)) continue;
            names.push_back(name);
            mesh.attributes.push_back(attributeOf(first, name, readAccessor(document_, accessor)));
            mesh.point_count = readAccessor(document_, accessor).count;
        }
        if (!first.indices) failFile(ErrorCode::invalidFile, "a Draco primitive has no indices", first.place());
        mesh.corners = decodeIndices(document_, readAccessor(document_, *first.indices), mesh.point_count,
                                     join(first.primitivePlace(), "indices"));
        Bytes data;
        if (!encodeDraco(mesh, true, data))
            failFile(ErrorCode::unsupportedFile, "Draco cannot encode the primitive", first.place());
        const bool alone = view_uses_[first.view] == group.size();
        const std::size_t view = store_(std::move(data), alone ? std::optional(first.view) : std::nullopt);
        Json ids = Json::object();
        for (std::size_t i = 0; i < names.size(); ++i) ids[names[i]] = mesh.attributes[i].id;
        for (const Packed& packed : group) {
            Json& extension = primitiveJson(document_, packed)["extensions"][kDraco];
            extension["bufferView"] = view;
            extension["attributes"] = ids;
        }
    }

    /// Returns whether an attribute is encoded: attributes without a view (which exist only in Draco data), attributes
    /// that the old data contained, and frames.
    [[nodiscard]] bool belongs(const Packed& packed, const std::string& name, std::size_t accessor) const {
        return document_.elements.count(accessor) != 0 || name == "TANGENT" || name == "NORMAL" ||
               name == "_BITANGENT" || isPackedAttribute(name) || oldId(packed, name);
    }

    static std::optional<std::uint32_t> oldId(const Packed& packed, const std::string& name) {
        for (const Packed::Attribute& attribute : packed.attributes) {
            if (attribute.name == name) return attribute.id;
        }
        return {};
    }

    [[nodiscard]] DracoAttribute attributeOf(const Packed& packed, const std::string& name,
                                             const Accessor& accessor) const {
        DracoAttribute attribute;
        attribute.kind = dracoKind(name);
        attribute.component = accessor.component;
        attribute.normalized = accessor.normalized;
        attribute.component_count = accessor.component_count;
        attribute.values = copyElements(document_, accessor);
        if (const auto id = oldId(packed, name)) {
            const auto rounding = document_.draco_roundings.find({packed.view, *id});
            if (rounding != document_.draco_roundings.end()) attribute.rounding = rounding->second;
        }
        return attribute;
    }

    Document& document_;
    const std::set<std::size_t>& changed_;
    const std::vector<std::size_t>& view_uses_;
    const StoreBlob& store_;
};

}  // namespace

DracoKind dracoKind(const std::string& name) {
    if (name == "POSITION") return DracoKind::position;
    if (name == "NORMAL") return DracoKind::normal;
    if (name.rfind("COLOR_", 0) == 0) return DracoKind::color;
    if (name.rfind("TEXCOORD_", 0) == 0) return DracoKind::uv;
    return DracoKind::other;
}

void decodeDracoPrimitives(Document& document) { Decoder(document).run(); }

void encodeDracoPrimitives(Document& document, const std::set<std::size_t>& changed,
                           const std::vector<std::size_t>& view_uses, const StoreBlob& store) {
    Encoder(document, changed, view_uses, store).run();
}

}  // namespace tspace::gltf
