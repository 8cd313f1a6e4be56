// SPDX-License-Identifier: MIT
// Frames by blocks, as the kernels of this room take them. A kernel is written once (*_kernel.h), compiled for several
// CPUs, same bits from all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/dispatch.h"

namespace tspace::pack {

inline constexpr std::size_t kBlockFrames = 64;  ///< a multiple of all widths; a block stays in the first cache

/// The bytes of frames as little-endian words of 32 bits: word w of frame i is word[w][i].
struct WordBlock {
    alignas(64) std::uint32_t word[4][kBlockFrames];
};

/// As decoded: x, y, z, and after the tangent the sign.
struct FrameRows {
    alignas(64) float normal[kBlockFrames][4], tangent[kBlockFrames][4];
};

/// The functions of one format for one CPU.
struct FrameKernel {
    /// Reads and writes the first `count` frames, and may do so for all of the block.
    void (*decode)(const WordBlock& words, std::size_t count, FrameRows& rows) = nullptr;
};

TSPACE_DECLARE_KERNEL(FrameKernel frame32Kernel())
TSPACE_DECLARE_KERNEL(FrameKernel frame48Kernel())
TSPACE_DECLARE_KERNEL(FrameKernel frame64Kernel())
TSPACE_DECLARE_KERNEL(FrameKernel oct32Kernel())
TSPACE_DECLARE_KERNEL(FrameKernel qtangent64Kernel())
TSPACE_DECLARE_KERNEL(FrameKernel snorm8PairKernel())
TSPACE_DECLARE_KERNEL(FrameKernel snorm16PairKernel())
TSPACE_DECLARE_KERNEL(FrameKernel gltfSnorm8Kernel())
TSPACE_DECLARE_KERNEL(FrameKernel gltfSnorm16Kernel())

}  // namespace tspace::pack
