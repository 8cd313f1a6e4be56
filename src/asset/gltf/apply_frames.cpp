// SPDX-License-Identifier: MIT
// From PoolFrames to accessors.
#include "asset/gltf/apply_frames.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "asset/file_error.h"
#include "asset/gltf/gather_elements.h"
#include "asset/gltf/sparse_elements.h"
#include "generate/unit_lattice.h"

namespace tspace::gltf {

namespace {

template <class Vec>
ElementData floatVectors(const std::vector<Vec>& values) {
    ElementData data;
    data.type = "VEC" + std::to_string(sizeof(Vec) / sizeof(float));
    data.count = values.size();
    data.element_bytes = sizeof(Vec);
    data.bytes.resize(values.size() * sizeof(Vec));
    if (!values.empty()) std::memcpy(data.bytes.data(), values.data(), data.bytes.size());
    return data;
}

template <class Vec>
ElementData unitVectors(const std::vector<Vec>& values, VectorFormat format) {
    if (format == VectorFormat::float32) return floatVectors(values);
    constexpr std::size_t components = sizeof(Vec) / sizeof(float);
    ElementData data;
    data.component = format == VectorFormat::snorm8 ? ComponentType::i8 : ComponentType::i16;
    data.type = "VEC" + std::to_string(components);
    data.normalized = true;
    data.count = values.size();
    data.element_bytes = components * bytesOf(data.component);
    const std::vector<std::uint8_t> packed = packUnits(std::span<const Vec>(values), format);
    data.bytes.assign(packed.begin(), packed.end());
    return data;
}

bool hasFormatOf(const Accessor& accessor, const ElementData& data) {
    return accessor.component == data.component && accessor.type == data.type &&
           accessor.normalized == data.normalized && accessor.count == data.count;
}

ElementData offsetVectors(const VertexOffsets& offsets, std::size_t vertex_count) {
    std::vector<Vec3> dense(vertex_count);
    for (std::size_t i = 0; i < offsets.vertices.size(); ++i) dense[offsets.vertices[i]] = offsets.offsets[i];
    return floatVectors(dense);
}

template <class Index>
Bytes narrow(const std::vector<std::uint32_t>& indices) {
    Bytes bytes(indices.size() * sizeof(Index));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto index = static_cast<Index>(indices[i]);
        std::memcpy(bytes.data() + i * sizeof index, &index, sizeof index);
    }
    return bytes;
}

/// u8 and u16 keep their width while every vertex fits below the primitive restart value.
ElementData indexData(const std::vector<std::uint32_t>& indices, ComponentType narrowest,
                      std::size_t vertex_count) {
    ElementData data;
    data.target = kIndexTarget;
    data.component = narrowest;
    if (data.component == ComponentType::u8 && vertex_count > 255) data.component = ComponentType::u16;
    if (data.component == ComponentType::u16 && vertex_count > 65535) data.component = ComponentType::u32;
    data.count = indices.size();
    data.element_bytes = bytesOf(data.component);
    data.bytes = data.element_bytes == 1   ? narrow<std::uint8_t>(indices)
                 : data.element_bytes == 2 ? narrow<std::uint16_t>(indices)
                                           : narrow<std::uint32_t>(indices);
    return data;
}

class Applier {
  public:
    Applier(Editor& editor, const Document& document, std::span<const Primitive> primitives, const Pool& pool,
            const PoolFrames& frames, VectorFormat format)
        : editor_(editor), document_(document), primitives_(primitives), pool_(pool), frames_(frames), format_(format) {}

    /// Returns true when the document changed.
    bool run() {
        if (pool_.keeps_tangents) return setTargets();
        const Primitive& first = primitives_[pool_.primitives[0]];
        const bool split = frames_.wasSplit(first.vertex_count);
        if (split) {
            carryAttributes();
            for (std::size_t i = 0; i < pool_.geometries.size(); ++i)
                replaceIndices(pool_.geometries[i], frames_.indices[i]);
        }
        bool changed = split;
        if (frames_.normals_generated) changed |= setAttribute(kBase, "NORMAL", unitVectors(frames_.normals, format_));
        changed |= setAttribute(kBase, "TANGENT", unitVectors(frames_.tangents, format_));
        if (!frames_.bitangents.empty())
            changed |= setAttribute(kBase, "_BITANGENT", unitVectors(frames_.bitangents, format_));
        changed |= setTargets();
        return changed;
    }

    /// Targets whose deltas were computed.
    [[nodiscard]] std::uint32_t computedTargets() const { return computed_targets_; }

  private:
    static constexpr std::ptrdiff_t kBase = -1;  ///< in place of a target: the attributes themselves

    /// A reference of a primitive to an accessor.
    struct Slot {
        std::size_t primitive = 0;
        std::ptrdiff_t target = kBase;
        std::string name = {};
    };

    [[nodiscard]] bool isReplaced(const std::string& name, std::ptrdiff_t target) const {
        if (name == "_BITANGENT") return target == kBase && !frames_.bitangents.empty();
        return name == "TANGENT" || (name == "NORMAL" && frames_.normals_generated);
    }

    Json& attributesOf(std::size_t number, std::ptrdiff_t target) {
        const Primitive& primitive = primitives_[number];
        Json& object = editor_.primitive(primitive.mesh, primitive.index);
        return target < 0 ? object["attributes"] : object["targets"][static_cast<std::size_t>(target)];
    }

    /// Every attribute and morph target by accessor, so that what was shared stays shared.
    void carryAttributes() {
        std::map<std::size_t, std::vector<Slot>> slots;
        for (const std::size_t number : pool_.primitives) {
            const Primitive& primitive = primitives_[number];
            for (const auto& [name, accessor] : primitive.attributes) {
                if (!isReplaced(name, kBase)) slots[accessor].push_back({number, kBase, name});
            }
            for (std::size_t target = 0; target < primitive.targets.size(); ++target) {
                for (const auto& [name, accessor] : primitive.targets[target]) {
                    const auto place = static_cast<std::ptrdiff_t>(target);
                    if (isReplaced(name, place) && movesFrames(primitive.targets[target])) continue;
                    slots[accessor].push_back({number, place, name});
                }
            }
        }
        for (const auto& [index, users] : slots) {
            ElementData data =
                gatherElements(document_, readAccessor(document_, index), frames_.source_vertices);
            const bool alone = editor_.accessorUses(index) == users.size();
            const std::size_t stored = editor_.store(std::move(data), alone ? std::optional(index) : std::nullopt);
            if (!alone) keepName(index, stored);
            for (const Slot& slot : users) {
                attributesOf(slot.primitive, slot.target)[slot.name] = stored;
                editor_.moveUse(index, stored);
            }
        }
    }

    /// A copy of a shared accessor is still the same thing to a person.
    void keepName(std::size_t from, std::size_t to) {
        const Json* name = findMember(rootArray(document_, "accessors")[from], "name");
        if (name != nullptr) editor_.accessor(to)["name"] = Json(*name);
    }

    void replaceIndices(const PoolGeometry& geometry, const std::vector<std::uint32_t>& indices) {
        const Primitive& first = primitives_[geometry.primitives[0]];
        ComponentType narrowest = ComponentType::u16;
        bool has_bounds = false;
        if (first.indices) {
            narrowest = readAccessor(document_, *first.indices).component;
            const Json& old = rootArray(document_, "accessors")[*first.indices];
            has_bounds = old.contains("min") || old.contains("max");
        }
        ElementData data = indexData(indices, narrowest, frames_.source_vertices.size());
        if (has_bounds) {
            const auto [low, high] = std::minmax_element(indices.begin(), indices.end());
            data.min = Json::array({*low});
            data.max = Json::array({*high});
        }
        data.like = first.indices ? *first.indices : attributesOf(geometry.primitives[0], kBase)["POSITION"].get<std::size_t>();
        const bool alone =
            first.indices && editor_.accessorUses(*first.indices) == geometry.primitives.size();
        const std::size_t stored = editor_.store(std::move(data), alone ? first.indices : std::nullopt);
        for (const std::size_t number : geometry.primitives) {
            Json& object = editor_.primitive(primitives_[number].mesh, primitives_[number].index);
            object["indices"] = stored;
            if (primitives_[number].mode != Mode::triangles)
                object["mode"] = static_cast<unsigned>(Mode::triangles);
            editor_.moveUse(primitives_[number].indices, stored);
        }
    }

    [[nodiscard]] const AttributeList& attributesOf(const Primitive& primitive, std::ptrdiff_t target) const {
        return target == kBase ? primitive.attributes : primitive.targets[static_cast<std::size_t>(target)];
    }

    /// Deltas of every target that moves the surface; where tangents are kept only those that are missing.
    bool setTargets() {
        const Primitive& first = primitives_[pool_.primitives[0]];
        bool changed = false;
        for (std::size_t i = 0; i < frames_.morphs.size(); ++i) {
            if (!movesFrames(first.targets[i])) continue;
            if (pool_.keeps_tangents && findAttribute(first.targets[i], "TANGENT")) continue;
            ++computed_targets_;
            const auto target = static_cast<std::ptrdiff_t>(i);
            const std::size_t count = frames_.source_vertices.size();
            if (frames_.normals_generated) {
                changed |= setAttribute(target, "NORMAL", offsetVectors(frames_.morphs[i].normals, count));
            }
            changed |= setAttribute(target, "TANGENT", offsetVectors(frames_.morphs[i].tangents, count));
        }
        return changed;
    }

    /// For all primitives of the pool. Returns false when the file has these very bits already.
    bool setAttribute(std::ptrdiff_t target, const char* name, ElementData&& data) {
        const auto old = findAttribute(attributesOf(primitives_[pool_.primitives[0]], target), name);
        const bool alone = old && editor_.accessorUses(*old) == pool_.primitives.size();
        std::optional<Accessor> current;
        if (old && mayStay()) {
            current = readAccessor(document_, *old);
            if (!hasFormatOf(*current, data)) current.reset();
        }
        if (current && copyElements(document_, *current) == data.bytes) return false;
        if (data.normalized) editor_.require("KHR_mesh_quantization");
        if (target != kBase) makeSparseWhereSmaller(data);
        // Of a target, as what moves its vertices: Draco holds no targets.
        const Json& attributes = attributesOf(pool_.primitives[0], target);
        data.like = (target == kBase ? attributes["POSITION"] : attributes.front()).get<std::size_t>();
        if (current && alone && !data.places && editor_.canOverwrite(*current)) {
            editor_.overwrite(*current, data.bytes);
            return true;
        }
        const std::size_t stored = editor_.store(std::move(data), alone ? old : std::nullopt);
        for (const std::size_t number : pool_.primitives) {
            attributesOf(number, target)[name] = stored;
            editor_.moveUse(findAttribute(attributesOf(primitives_[number], target), name), stored);
        }
        return true;
    }

    /// Whether old accessors of frames may stay: not those of tangents without normals, nor what was split.
    [[nodiscard]] bool mayStay() const {
        return pool_.has_tangents && !frames_.wasSplit(primitives_[pool_.primitives[0]].vertex_count);
    }

    Editor& editor_;
    const Document& document_;
    std::span<const Primitive> primitives_;
    const Pool& pool_;
    const PoolFrames& frames_;
    const VectorFormat format_;
    std::uint32_t computed_targets_ = 0;
};

std::string keptNote(const PoolFrames& frames) {
    if (frames.morphs.empty()) {
        return "; its morph targets lack tangent deltas and get none, because its tangents are not those that would be "
               "computed (" +
               std::to_string(frames.differing_count) + " corners differ)";
    }
    return "; tangent deltas were added to its morph targets that had none";
}

}  // namespace

void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                 const Pool& pool, const PoolFrames& frames, VectorFormat format,
                 std::span<PrimitiveReport> reports) {
    Applier applier(editor, document, primitives, pool, frames, format);
    const bool changed = applier.run();
    for (const std::size_t number : pool.primitives) {
        PrimitiveReport& report = reports[number];
        report.morph_deltas_computed = applier.computedTargets();
        if (pool.keeps_tangents) {
            report.reason += keptNote(frames);
            continue;
        }
        report.action = !pool.has_tangents ? PrimitiveAction::generated
                        : changed          ? PrimitiveAction::replaced
                                           : PrimitiveAction::unchanged;
        report.vertices_after = frames.source_vertices.size();
        report.normals_generated = frames.normals_generated;
        report.bitangents_generated = !frames.bitangents.empty();
    }
}

}  // namespace tspace::gltf
