// SPDX-License-Identifier: MIT
// Frames by blocks, as the kernels of this room take them. A kernel is written once (*_kernel.h), compiled for several
// CPUs, same bits from all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::pack {

inline constexpr std::size_t kBlockFrames = 64;  ///< a multiple of all widths; a block stays in the first cache

/// The bytes of frames as little-endian words of 32 bits: word w of frame i is word[w][i].
struct WordBlock {
    alignas(64) std::uint32_t word[4][kBlockFrames];
};

/// Frames to encode, component by component: N and T unit and orthogonal within 5e-7, also beyond those that count;
/// `mirrored` is 1 where the sign is -1, else 0.
struct FrameBlock {
    alignas(64) float normal[3][kBlockFrames], tangent[3][kBlockFrames];
    alignas(64) std::uint32_t mirrored[kBlockFrames];
};

/// Output of decoding: three numbers for each normal, and one more after the last; four for each tangent, the fourth of
/// which is the sign.
struct FrameRows {
    float *normals, *tangents;
};

/// The functions of one format for one CPU. They read and write the first `count` frames, and may do so for all of the
/// block.
struct FrameKernel {
    void (*encode)(const FrameBlock& frames, std::size_t count, WordBlock& words) = nullptr;
    void (*decode)(const WordBlock& words, std::size_t count, const FrameRows& rows) = nullptr;
};

/// Frames this close to unit (their squares to twice as much) and orthogonal are encoded as they are, so that unpacked
/// frames are found again exactly.
inline constexpr double kSoundTolerance = 5e-7;
TSPACE_DECLARE_KERNEL(std::uint64_t soundFrames(const FrameBlock& frames, std::size_t count))

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
