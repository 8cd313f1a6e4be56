// SPDX-License-Identifier: MIT
// What a texture shows at UVs outside of 0 to 1.
#pragma once

#include <cstdint>

namespace tspace {

enum class TextureWrap : std::uint32_t { repeat = 0, mirror = 1, clamp = 2 };

}  // namespace tspace
