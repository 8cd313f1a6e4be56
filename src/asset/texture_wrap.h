// SPDX-License-Identifier: MIT
// What a texture shows at UVs outside of 0 to 1.
#pragma once

namespace tspace {

enum class TextureWrap { repeat, mirror, clamp };

}  // namespace tspace
