// SPDX-License-Identifier: MIT
// Normals stored as unsigned numbers, which glTF does not allow.
#pragma once

#include <cstddef>
#include <optional>

#include "model/gltf/accessor.h"

namespace tspace::gltf {

/// Returns whether the components are unsigned. `normals`: accessor of NORMAL, if any.
inline bool areUnsigned(const Document& document, std::optional<std::size_t> normals) {
    if (!normals) return false;
    const ComponentType type = readAccessor(document, *normals).component;
    return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

}  // namespace tspace::gltf
