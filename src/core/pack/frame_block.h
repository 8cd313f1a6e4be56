// SPDX-License-Identifier: MIT
// Blocks of frames, for the kernels of this folder. A kernel is written once (*_kernel.h), and compiled for several
// CPUs, with equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::pack {

inline constexpr std::size_t kBlockFrames = 64;  ///< a multiple of all SIMD widths; a block fits into the L1 cache

/// Block of packed frames as little-endian 32-bit words: word w of frame i is word[w][i].
struct WordBlock {
    alignas(64) std::uint32_t word[4][kBlockFrames];
};

/// Block of frames to encode, by component: N and T are unit and orthogonal within 5e-7, also in unused entries;
/// `mirrored` is 1 if the sign is -1, otherwise 0.
struct FrameBlock {
    alignas(64) float normal[3][kBlockFrames], tangent[3][kBlockFrames];
    alignas(64) std::uint32_t mirrored[kBlockFrames];
};

/// Output of decoding: three numbers per normal, followed by one more after the last normal; four numbers per tangent,
/// the fourth of which is the sign.
struct FrameRows {
    float *normals, *tangents;
};

/// Functions of one format, compiled for one CPU. They process the first `count` frames, or all frames of the block.
struct FrameKernel {
    void (*encode)(const FrameBlock& frames, std::size_t count, WordBlock& words) = nullptr;
    void (*decode)(const WordBlock& words, std::size_t count, const FrameRows& rows) = nullptr;
};

/// Tolerance within which frames count as unit (squared lengths within twice this value) and orthogonal. They are
/// encoded unchanged, so that unpacked frames are reproduced exactly.
inline constexpr double kValidTolerance = 5e-7;
TSPACE_DECLARE_KERNEL(std::uint64_t validFrames(const FrameBlock& frames, std::size_t count))

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
