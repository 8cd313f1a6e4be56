// SPDX-License-Identifier: MIT
// Frames before and after packing, and their errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/pack/format_names.h"
#include "core/pack/random_frames.h"
#include "tspace/pack.h"

namespace tspace::test {

inline constexpr FrameFormat kAllFormats[] = {
    FrameFormat::frame32,     FrameFormat::frame48,    FrameFormat::frame64,
    FrameFormat::oct32,       FrameFormat::qtangent64, FrameFormat::snorm8Pair,
    FrameFormat::snorm16Pair, FrameFormat::gltfSnorm8, FrameFormat::gltfSnorm16};
/// Formats for which packing an unpacked frame restores it exactly.
inline constexpr FrameFormat kExactFormats[] = {FrameFormat::frame32, FrameFormat::frame48, FrameFormat::frame64,
                                                FrameFormat::oct32};

inline std::string nameOf(FrameFormat format) { return kFormatNames[static_cast<std::size_t>(format)]; }

/// Returns the number of frames to test: `otherwise`, unless the environment variable TSPACE_FRAMES is set.
inline long frameCount(long otherwise) {
    const char* text = std::getenv("TSPACE_FRAMES");
    return text != nullptr ? std::atol(text) : otherwise;
}

inline std::vector<std::byte> packed(FrameFormat format, const FrameList& frames) {
    std::vector<std::byte> bytes(frames.size() * frameBytes(format));
    EXPECT_TRUE(packFrames(frames.normals, frames.tangents, format, bytes));
    return bytes;
}

inline FrameList unpacked(FrameFormat format, const std::vector<std::byte>& bytes) {
    FrameList frames;
    frames.resize(bytes.size() / frameBytes(format));
    EXPECT_TRUE(unpackFrames(bytes, format, frames.normals, frames.tangents));
    return frames;
}

struct PackErrors {
    double normal_deg = 0, tangent_deg = 0;  ///< maximum error over all frames
    double normal_sum = 0, tangent_sum = 0;
    std::uint64_t wrong_signs = 0;

    void add(const FrameList& before, const FrameList& after) {
        for (std::size_t i = 0; i < before.size(); ++i) {
            const double n = angleDeg(before.normals[i], after.normals[i]);
            const double t = angleDeg(xyz(before.tangents[i]), xyz(after.tangents[i]));
            normal_deg = std::max(normal_deg, n);
            tangent_deg = std::max(tangent_deg, t);
            normal_sum += n;
            tangent_sum += t;
            if (before.tangents[i].w != after.tangents[i].w) ++wrong_signs;
        }
    }
};

inline PackErrors errorsOf(FrameFormat format, const FrameList& frames) {
    PackErrors errors;
    errors.add(frames, unpacked(format, packed(format, frames)));
    return errors;
}

inline void expectWithinBounds(FrameFormat format, const PackErrors& errors) {
    const FrameErrorBound bound = frameErrorBound(format);
    EXPECT_LE(errors.normal_deg, bound.normal_deg) << nameOf(format);
    EXPECT_LE(errors.tangent_deg, bound.tangent_deg) << nameOf(format);
    EXPECT_EQ(errors.wrong_signs, 0) << nameOf(format);
}

}  // namespace tspace::test
