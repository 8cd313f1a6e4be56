// SPDX-License-Identifier: MIT
// Other codes of whole frames, as engines and public code have them: plain rounding, no search.
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
    const char* function;  ///< of peers.glsl, which decodes it
    std::size_t bytes;
    PeerWords (*encode)(const PeerFrame& frame);
    PeerFrame (*decode)(PeerWords words);
};

std::span<const Peer> peers();

}  // namespace tspace::bench
