// SPDX-License-Identifier: MIT
// Removing TANGENT from primitives, morph targets and what Draco says of them.
#include "asset/gltf/strip_tangents.h"

#include <algorithm>

namespace tspace::gltf {

namespace {

bool names(const AttributeList& list, const char* attribute) {
    return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return entry.first == attribute; });
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

/// Whoever decodes the primitive must not look for an attribute that it no longer has.
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

}  // namespace tspace::gltf
