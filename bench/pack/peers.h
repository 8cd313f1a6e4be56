// SPDX-License-Identifier: MIT
// Other encodings of whole frames, from engines and public code, with simple rounding instead of a search for the best
// code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tspace/span.h"

namespace tspace::bench {

struct PeerFrame {
    Vec3 normal;
    Vec4 tangent;
};
using PeerWords = std::uint64_t;

struct Peer {
    const char* name;
    const char* function;  ///< decoder in peers.glsl
    std::size_t bytes;
    PeerWords (*encode)(const PeerFrame& frame);
    PeerFrame (*decode)(PeerWords words);
};

std::span<const Peer> peers();

}  // namespace tspace::bench
