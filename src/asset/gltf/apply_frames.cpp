// SPDX-License-Identifier: MIT
// From PoolFrames to accessors.
#include "asset/gltf/apply_frames.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "asset/file_error.h"

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

/// Elements of an accessor, gathered through `sources`: new element i is a copy of old element sources[i].
ElementData gather(const Document& document, const Accessor& accessor,
                   std::span<const std::uint32_t> sources) {
    const Bytes old = copyElements(document, accessor);
    ElementData data;
    data.component = accessor.component;
    data.type = accessor.type;
    data.normalized = accessor.normalized;
    data.count = sources.size();
    data.element_bytes = accessor.element_bytes;
    data.bytes.resize(sources.size() * accessor.element_bytes);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        std::memcpy(data.bytes.data() + i * data.element_bytes, old.data() + sources[i] * data.element_bytes,
                    data.element_bytes);
    }
    // Copies change no bound.
    const Json& object = rootArray(document, "accessors")[accessor.index];
    if (const Json* low = findMember(object, "min")) data.min = *low;
    if (const Json* high = findMember(object, "max")) data.max = *high;
    return data;
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
    data.bytes.resize(indices.size() * data.element_bytes);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        for (std::size_t byte = 0; byte < data.element_bytes; ++byte) {
            data.bytes[i * data.element_bytes + byte] = static_cast<std::uint8_t>(indices[i] >> (8 * byte));
        }
    }
    return data;
}

class Applier {
  public:
    Applier(Editor& editor, const Document& document, std::span<const Primitive> primitives, const Pool& pool,
            const PoolFrames& frames)
        : editor_(editor), document_(document), primitives_(primitives), pool_(pool), frames_(frames) {}

    /// Returns true when the document changed.
    bool run() {
        const Primitive& first = primitives_[pool_.primitives[0]];
        const bool split = frames_.wasSplit(first.vertex_count);
        if (split) {
            carryAttributes();
            for (std::size_t i = 0; i < pool_.geometries.size(); ++i)
                replaceIndices(pool_.geometries[i], frames_.indices[i]);
        }
        if (frames_.normals_generated) setAttribute("NORMAL", floatVectors(frames_.normals));
        return setTangents(split) || split || frames_.normals_generated;
    }

  private:
    /// A reference of a primitive to an accessor: target -1 for the attributes themselves.
    struct Slot {
        std::size_t primitive = 0;
        std::ptrdiff_t target = -1;
        std::string name = {};
    };

    [[nodiscard]] bool isReplaced(const std::string& name) const {
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
                if (!isReplaced(name)) slots[accessor].push_back({number, -1, name});
            }
            for (std::size_t target = 0; target < primitive.targets.size(); ++target) {
                for (const auto& [name, accessor] : primitive.targets[target]) {
                    slots[accessor].push_back({number, static_cast<std::ptrdiff_t>(target), name});
                }
            }
        }
        for (const auto& [index, users] : slots) {
            ElementData data =
                gather(document_, readAccessor(document_, index), frames_.source_vertices);
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

    void setAttribute(const char* name, ElementData&& data) {
        const Primitive& first = primitives_[pool_.primitives[0]];
        const auto old = first.find(name);
        const bool alone = old && editor_.accessorUses(*old) == pool_.primitives.size();
        const std::size_t stored = editor_.store(std::move(data), alone ? old : std::nullopt);
        for (const std::size_t number : pool_.primitives) {
            attributesOf(number, -1)[name] = stored;
            editor_.moveUse(primitives_[number].find(name), stored);
        }
    }

    /// Returns false when the tangents in the file have these very bits already.
    bool setTangents(bool split) {
        ElementData data = floatVectors(frames_.tangents);
        const auto index = primitives_[pool_.primitives[0]].find("TANGENT");
        if (index && pool_.has_tangents && !split) {
            const Accessor old = readAccessor(document_, *index);
            if (old.isFloatVec(4) && old.count == data.count) {
                if (copyElements(document_, old) == data.bytes) return false;
                if (editor_.accessorUses(*index) == pool_.primitives.size() && editor_.canOverwrite(old)) {
                    editor_.overwrite(old, data.bytes);
                    return true;
                }
            }
        }
        setAttribute("TANGENT", std::move(data));
        return true;
    }

    Editor& editor_;
    const Document& document_;
    std::span<const Primitive> primitives_;
    const Pool& pool_;
    const PoolFrames& frames_;
};

}  // namespace

void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                 const Pool& pool, const PoolFrames& frames, std::span<PrimitiveReport> reports) {
    const bool changed = Applier(editor, document, primitives, pool, frames).run();
    for (const std::size_t number : pool.primitives) {
        PrimitiveReport& report = reports[number];
        report.action = !pool.has_tangents ? PrimitiveAction::generated
                        : changed          ? PrimitiveAction::replaced
                                           : PrimitiveAction::unchanged;
        report.vertices_after = frames.source_vertices.size();
        report.normals_generated = frames.normals_generated;
    }
}

}  // namespace tspace::gltf
