// SPDX-License-Identifier: MIT
// Writes computed frames into a glTF document.
#include "commands/generate/apply_frames.h"

#include <map>
#include <optional>
#include <utility>

#include "commands/generate/edit_attributes.h"
#include "model/gltf/material_needs.h"

namespace tspace::gltf {

void removeUnreadableTangents(Editor& editor, std::span<const Primitive> primitives, GeneratePlan& plan) {
    std::vector<bool> is_computed(primitives.size(), false);
    for (const PoolPlan& pool : plan.pools) {
        for (const std::size_t number : pool.primitives) is_computed[number] = true;
    }
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Primitive& primitive = primitives[i];
        for (const UnreadableTangents& tangents : primitive.unreadable_tangents) {
            removeUnreadable(editor, primitive, tangents.target, "TANGENT", tangents.accessor);
            if (tangents.target >= 0 || is_computed[i]) continue;
            PrimitiveReport& report = plan.reports[i];
            report.action = PrimitiveAction::removed;
            report.reason = "its tangents could not be read, and no new ones were computed: " + report.reason;
        }
    }
}

void noteUnreadableTangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        for (const UnreadableTangents& tangents : primitives[i].unreadable_tangents) {
            const bool is_base = tangents.target < 0;
            reports[i].notes.push_back((is_base ? "its existing tangents were invalid: "
                                                : "the existing tangent deltas of morph target " +
                                                      std::to_string(tangents.target) + " were invalid: ") +
                                       tangents.why);
            if (is_base && reports[i].action == PrimitiveAction::generated)
                reports[i].action = PrimitiveAction::replaced;
        }
    }
}

// Writes PoolElements into the accessors of a document.

namespace {

class Applier {
  public:
    Applier(Editor& editor, const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
            PoolElements& elements)
        : editor_(editor), document_(document), primitives_(primitives), pool_(pool), elements_(elements) {}

    /// Stores the frames of the pool. Returns whether the document changed.
    bool run() {
        if (pool_.keeps_tangents) return setTargets();
        bool changed = elements_.was_split;
        if (elements_.was_split) {
            carryAttributes();
            for (std::size_t i = 0; i < pool_.geometries.size(); ++i)
                replaceIndices(pool_.geometries[i], std::move(elements_.indices[i]));
        }
        if (elements_.normals_generated) changed |= setAttribute(kBase, "NORMAL", std::move(elements_.normals));
        if (elements_.tangents.count != 0) changed |= setAttribute(kBase, "TANGENT", std::move(elements_.tangents));
        if (elements_.bitangents_generated)
            changed |= setAttribute(kBase, "_BITANGENT", std::move(elements_.bitangents));
        changed |= setTargets();
        return changed;
    }

    /// Returns the number of morph targets whose tangent deltas were computed.
    [[nodiscard]] std::uint32_t computedTargets() const { return computed_targets_; }
    /// Returns the number of morph targets whose normal offsets were computed although the base normals are kept.
    [[nodiscard]] std::uint32_t newNormals() const { return new_normals_; }

  private:
    Json& attributesOf(std::size_t number, std::ptrdiff_t target) {
        const Primitive& primitive = primitives_[number];
        Json& object = editor_.primitive(primitive.mesh, primitive.index);
        return target < 0 ? object["attributes"] : object["targets"][static_cast<std::size_t>(target)];
    }

    void carryAttributes() {
        for (auto& [index, carried] : elements_.carried) {
            const bool alone = editor_.accessorUses(index) == carried.users.size();
            const std::size_t stored =
                editor_.store(std::move(carried.data), alone ? std::optional(index) : std::nullopt);
            if (!alone) keepName(index, stored);
            for (const AttributeSlot& slot : carried.users) {
                attributesOf(slot.primitive, slot.target)[slot.name] = stored;
                editor_.moveUse(index, stored);
            }
        }
    }

    /// Copies the name of a shared accessor to its copy, because the name describes the contents.
    void keepName(std::size_t from, std::size_t to) {
        const Json* name = findMember(rootArray(document_, "accessors")[from], "name");
        if (name != nullptr) editor_.accessor(to)["name"] = Json(*name);
    }

    void replaceIndices(const GeometryPlan& geometry, ElementData&& data) {
        const std::optional<std::size_t> old = primitives_[geometry.primitives[0]].indices;
        data.like = old ? *old : attributesOf(geometry.primitives[0], kBase)["POSITION"].get<std::size_t>();
        const bool alone = old && editor_.accessorUses(*old) == geometry.primitives.size();
        const std::size_t stored = editor_.store(std::move(data), alone ? old : std::nullopt);
        for (const std::size_t number : geometry.primitives) {
            Json& object = editor_.primitive(primitives_[number].mesh, primitives_[number].index);
            object["indices"] = stored;
            if (primitives_[number].mode != Mode::triangles) object["mode"] = static_cast<unsigned>(Mode::triangles);
            editor_.moveUse(primitives_[number].indices, stored);
        }
    }

    /// Sets the deltas of every target that moves the surface. If tangents are kept, only missing deltas are set.
    bool setTargets() {
        const Primitive& first = primitives_[pool_.primitives[0]];
        bool changed = false;
        for (std::size_t i = 0; i < elements_.morphs.size(); ++i) {
            if (!movesFrames(first.targets[i])) continue;
            const auto target = static_cast<std::ptrdiff_t>(i);
            const auto elementsOf = [&](const VertexOffsets& offsets) {
                return offsetElements(offsets, elements_.vertex_count);
            };
            const bool turns_normals = !pool_.morph_normals.empty() && pool_.morph_normals[i];
            if (elements_.normals_generated || turns_normals)
                changed |= setAttribute(target, "NORMAL", elementsOf(elements_.morphs[i].normals));
            new_normals_ += turns_normals ? 1U : 0U;
            if (!elements_.has_tangent_deltas) continue;
            const bool has_tangents = findAttribute(first.targets[i], "TANGENT").has_value();
            if (pool_.keeps_tangents && has_tangents && !turns_normals) continue;
            // Computed deltas fit computed tangents, but a repair keeps tangents that differ from the computed ones.
            if (pool_.repairsTangents() && elements_.differing_count != 0 && !has_tangents) continue;
            ++computed_targets_;
            changed |= setAttribute(target, "TANGENT", elementsOf(elements_.morphs[i].tangents));
        }
        return changed;
    }

    /// Sets an attribute of all primitives of the pool. Returns false if the file already has exactly these bits.
    bool setAttribute(std::ptrdiff_t target, const char* name, ElementData&& data) {
        return gltf::setAttribute(editor_, document_,
                                  {.primitives = primitives_,
                                   .numbers = pool_.primitives,
                                   .target = target,
                                   .name = name,
                                   .may_reuse = canReuse()},
                                  std::move(data));
    }

    /// Returns whether the old accessors of frames may be reused. They may not if vertices were split or tangents were
    /// missing.
    [[nodiscard]] bool canReuse() const { return pool_.has_tangents && !elements_.was_split; }

    Editor& editor_;
    const Document& document_;
    std::span<const Primitive> primitives_;
    const PoolPlan& pool_;
    PoolElements& elements_;
    std::uint32_t computed_targets_ = 0, new_normals_ = 0;
};

bool anyHasTangents(const Primitive& primitive) {
    return std::any_of(primitive.targets.begin(), primitive.targets.end(),
                       [](const AttributeList& target) { return findAttribute(target, "TANGENT").has_value(); });
}

/// Returns a note on normal offsets that were computed although the base normals are kept; empty if there are none.
std::string morphNormalsNote(const PoolPlan& pool, const PoolElements& elements, const Primitive& primitive,
                             std::uint32_t count) {
    if (count == 0) return {};
    std::string note =
        std::to_string(count) + (count == 1 ? " morph target got" : " morph targets got") + " computed normal deltas";
    const bool left = !elements.has_tangent_deltas || (pool.repairsTangents() && elements.differing_count != 0);
    if (left && anyHasTangents(primitive)) note += "; existing tangent deltas were kept and may not fit them";
    return note;
}

/// Updates vertex indices in extensions after a split.
void carryNumbers(std::span<const Primitive> primitives, const PoolPlan& pool, const PoolElements& elements,
                  VertexNumbers& numbers) {
    for (std::size_t i = 0; i < elements.corners.size(); ++i) {
        std::vector<const Primitive*> list;
        for (const std::size_t number : pool.geometries[i].primitives) list.push_back(&primitives[number]);
        numbers.carry(list, {elements.sources, elements.corners[i], list.front()->vertex_count});
    }
}

std::string keptNote(const PoolElements& elements, const Primitive& primitive) {
    if (!elements.has_tangent_deltas) {
        if (!lacksDeltas(primitive)) return {};
        return "; its morph targets lack tangent deltas, and none were added, because its tangents differ from the "
               "computed tangents (" +
               std::to_string(elements.differing_count) + " corners differ)";
    }
    if (!lacksDeltas(primitive)) return {};
    return "; tangent deltas were added to its morph targets that had none";
}

}  // namespace

void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                 PoolElements&& elements, VertexNumbers& numbers, std::span<PrimitiveReport> reports) {
    Applier applier(editor, document, primitives, pool, elements);
    const bool changed = applier.run();
    carryNumbers(primitives, pool, elements, numbers);
    for (const std::size_t number : pool.primitives) {
        PrimitiveReport& report = reports[number];
        report.morph_deltas_computed = applier.computedTargets();
        report.morph_normals_computed = applier.newNormals();
        std::string note = morphNormalsNote(pool, elements, primitives[number], applier.newNormals());
        if (!note.empty()) report.notes.push_back(std::move(note));
        if (pool.keeps_tangents) {
            report.reason += keptNote(elements, primitives[number]);
            continue;
        }
        report.normals_replaced = pool.overwrites_normals;
        if (pool.makes_tangents) {
            report.action = !pool.has_tangents ? PrimitiveAction::generated
                            : changed          ? PrimitiveAction::replaced
                                               : PrimitiveAction::unchanged;
        }
        for (std::string& wrong : report.notes) {
            if (!pool.repairsTangents() || wrong.rfind(kWrongNote, 0) != 0) continue;
            wrong += "; repaired at " + std::to_string(report.mended_vertex_count) + " of " +
                     std::to_string(report.vertices_before) + " vertices";
        }
        report.vertices_after = elements.vertex_count;
        report.normals_generated = elements.normals_generated;
        report.bitangents_generated = elements.bitangents_generated;
    }
}

}  // namespace tspace::gltf
