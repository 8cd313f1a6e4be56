// SPDX-License-Identifier: MIT
// Common interface of frame encodings: tspace's formats and others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/pack/random_frames.h"

namespace tspace::bench {

inline constexpr std::size_t kBatch = 16384;  ///< number of frames per batch, which fits into the cache

struct Code {
    std::string name, function;  ///< function: the GLSL decoder
    std::size_t bytes = 0;
    /// encode and decode process kBatch frames; decode returns the frames that were encoded last.
    std::function<void(const test::FrameList&)> encode;
    std::function<void(test::FrameList&)> decode;
};

std::vector<Code> allCodes();

}  // namespace tspace::bench
