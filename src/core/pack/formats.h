// SPDX-License-Identifier: MIT
// Table of formats: sizes, error bounds, kernels.
#pragma once

#include <cstddef>

#include "core/pack/frame_block.h"
#include "tspace/pack.h"

namespace tspace::pack {

struct Format {
    std::size_t bytes;  ///< bytes per frame
    FrameErrorBound bound;
    FrameKernel (*kernel)(SimdTarget requested);
    /// Functions that convert `count` frames, at most kBlockFrames, from bytes to words, and back.
    void (*read)(const std::byte* bytes, std::size_t count, WordBlock& words);
    void (*write)(const WordBlock& words, std::size_t count, std::byte* bytes);
};

/// Returns the format; null if `format` is not an enumerator.
const Format* formatOf(FrameFormat format);

/// Functions that perform packFrames and unpackFrames without checks, for a given SIMD target.
PackReport pack(const Format& format, SimdTarget requested, const StridedSpan<const Vec3>& normals,
                const StridedSpan<const Vec4>& tangents, std::byte* bytes);
void unpack(const Format& format, SimdTarget requested, const std::byte* bytes, const StridedSpan<Vec3>& normals,
            const StridedSpan<Vec4>& tangents);

}  // namespace tspace::pack
