// SPDX-License-Identifier: MIT
// Removing TANGENT from primitives, morph targets and what Draco says of them.
#include "model/gltf/strip_tangents.h"

#include <algorithm>
#include <array>

namespace tspace::gltf {

namespace {

bool names(const AttributeList& list, const char* attribute) {
    return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return entry.first == attribute; });
}

bool hasKnownType(const Json& accessor) {
    static constexpr std::array kTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const std::string type = accessor["type"].get<std::string>();
    return std::any_of(kTypes.begin(), kTypes.end(), [&](const char* known) { return type == known; });
}

}  // namespace

bool canStripTangents(const Primitive& primitive) {
    bool has = names(primitive.attributes, "TANGENT");
    for (const AttributeList& target : primitive.targets) {
        const bool here = names(target, "TANGENT");
        if (here && target.size() == 1) return false;
        has = has || here;
    }
    return has;
}

/// Removes the name from the primitive's Draco extension: decoders must not look for a removed attribute.
void eraseAttribute(Editor& editor, const Primitive& primitive, const char* name) {
    Json& object = editor.primitive(primitive.mesh, primitive.index);
    object["attributes"].erase(name);
    if (findExtension(object, "KHR_draco_mesh_compression") == nullptr) return;
    Json& draco = object["extensions"]["KHR_draco_mesh_compression"];
    if (findMember(draco, "attributes") != nullptr && draco["attributes"].is_object()) draco["attributes"].erase(name);
}

void stripTangents(Editor& editor, std::span<const Primitive> primitives, std::span<const PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (reports[i].action != PrimitiveAction::removed) continue;
        const Primitive& primitive = primitives[i];
        if (const auto tangents = primitive.find("TANGENT")) {
            eraseAttribute(editor, primitive, "TANGENT");
            editor.release(*tangents);
        }
        for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
            if (const auto deltas = findAttribute(primitive.targets[t], "TANGENT")) {
                editor.primitive(primitive.mesh, primitive.index)["targets"][t].erase("TANGENT");
                editor.release(*deltas);
            }
        }
    }
}

void removeUnreadableTangents(Editor& editor, std::span<const Primitive> primitives, GeneratePlan& plan) {
    std::vector<bool> is_computed(primitives.size(), false);
    for (const Pool& pool : plan.pools) {
        for (const std::size_t number : pool.primitives) is_computed[number] = true;
    }
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Primitive& primitive = primitives[i];
        for (const UnreadableTangents& tangents : primitive.unreadable_tangents) {
            const bool is_base = tangents.target < 0;
            if (is_base) {
                eraseAttribute(editor, primitive, "TANGENT");
            } else {
                Json& targets = editor.primitive(primitive.mesh, primitive.index)["targets"];
                targets[static_cast<std::size_t>(tangents.target)].erase("TANGENT");
            }
            // The size of an unknown type is unknown, so its data cannot be freed.
            if (hasKnownType(editor.accessor(tangents.accessor))) editor.release(tangents.accessor);
            if (!is_base || is_computed[i]) continue;
            PrimitiveReport& report = plan.reports[i];
            report.action = PrimitiveAction::removed;
            report.reason = "its tangents could not be read, and none are computed: " + report.reason;
        }
    }
}

void noteUnreadableTangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        for (const UnreadableTangents& tangents : primitives[i].unreadable_tangents) {
            const bool is_base = tangents.target < 0;
            reports[i].notes.push_back((is_base ? "its tangents were wrong: "
                                                : "what morph target " + std::to_string(tangents.target) +
                                                      " added to its tangents was wrong: ") +
                                       tangents.why);
            if (is_base && reports[i].action == PrimitiveAction::generated)
                reports[i].action = PrimitiveAction::replaced;
        }
    }
}

}  // namespace tspace::gltf
