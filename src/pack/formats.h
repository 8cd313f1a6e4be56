// SPDX-License-Identifier: MIT
// What is known of each format: its bytes, its bounds, its kernel.
#pragma once

#include <cstddef>

#include "pack/frame_block.h"
#include "tspace/pack.h"

namespace tspace::pack {

struct Format {
    std::size_t bytes;  ///< of a frame
    FrameErrorBound bound;
    FrameKernel (*kernel)(SimdTarget wish);
    /// Bytes of `count` frames to words; count <= kBlockFrames.
    void (*read)(const std::byte* bytes, std::size_t count, WordBlock& words);
};

/// Null for what is none of the enumerators.
const Format* formatOf(FrameFormat format);

/// unpackFrames without checks, with the instructions of this target.
void unpack(const Format& format, SimdTarget wish, const std::byte* bytes, const StridedSpan<Vec3>& normals,
            const StridedSpan<Vec4>& tangents);

}  // namespace tspace::pack
