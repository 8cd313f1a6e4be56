// SPDX-License-Identifier: MIT
// Component types that glTF, with or without KHR_mesh_quantization, allows for attributes.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "model/gltf/accessor.h"

namespace tspace::gltf {

struct ComponentRule {
    std::string_view attribute;  ///< name, or its beginning if it ends with an underscore
    const char* allowed;         ///< the allowed types, in words
    bool (*allows)(ComponentType type, bool is_normalized);

    [[nodiscard]] bool appliesTo(std::string_view name) const {
        return name == attribute || (attribute.ends_with('_') && name.starts_with(attribute));
    }
};

inline bool isShortUnsigned(ComponentType type) { return isUnsigned(type) && type != ComponentType::u32; }
inline bool isNotLongUnsigned(ComponentType type, bool) { return type != ComponentType::u32; }
inline bool isFraction(ComponentType type, bool is_normalized) {
    return type == ComponentType::f32 || (isShortUnsigned(type) && is_normalized);
}

inline constexpr const char* kFractions = "floats or normalized unsigned integers of 8 or 16 bits";
inline constexpr ComponentRule kComponentRules[] = {
    {"POSITION", "floats", isNotLongUnsigned},
    {"NORMAL", "floats", [](ComponentType type, bool) { return !isUnsigned(type); }},
    {"TEXCOORD_", kFractions, isNotLongUnsigned},
    {"COLOR_", kFractions, isFraction},
    {"WEIGHTS_", kFractions, isFraction},
    {"JOINTS_", "unsigned integers of 8 or 16 bits that are not normalized",
     [](ComponentType type, bool is_normalized) { return isShortUnsigned(type) && !is_normalized; }},
};

/// Returns the rule that the accessor of an attribute violates, or null. TANGENT has no rule: tangents of other types
/// are unreadable (see readPrimitives).
inline const ComponentRule* violatedRule(const Accessor& accessor, std::string_view attribute) {
    for (const ComponentRule& rule : kComponentRules) {
        if (rule.appliesTo(attribute) && !rule.allows(accessor.component, accessor.normalized)) return &rule;
    }
    return nullptr;
}

/// Returns whether normals are unsigned, which glTF does not allow. `normals`: accessor of NORMAL, if any.
inline bool areUnsigned(const Document& document, std::optional<std::size_t> normals) {
    return normals && violatedRule(readAccessor(document, *normals), "NORMAL") != nullptr;
}

}  // namespace tspace::gltf
