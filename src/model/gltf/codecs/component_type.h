// SPDX-License-Identifier: MIT
// The number formats of accessors.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace::gltf {

enum class ComponentType : std::uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// 1, 2 or 4.
std::size_t bytesOf(ComponentType type);

}  // namespace tspace::gltf
