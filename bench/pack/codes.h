// SPDX-License-Identifier: MIT
// Codes of frames by one interface: tspace's formats and the others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/pack/random_frames.h"

namespace tspace::bench {

inline constexpr std::size_t kBatch = 16384;  ///< frames that stay in the cache

struct Code {
    std::string name, function;  ///< the function decodes in GLSL
    std::size_t bytes = 0;
    /// kBatch frames at a time; decode gives those that were encoded last.
    std::function<void(const test::FrameList&)> encode;
    std::function<void(test::FrameList&)> decode;
};

std::vector<Code> allCodes();

}  // namespace tspace::bench
