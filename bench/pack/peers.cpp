// SPDX-License-Identifier: MIT
// Encoders for the decoders of peers.glsl, which is also compiled as C++ here.
#include "peers.h"

#include <cmath>

#include "core/base/vec_math.h"

// GLSL types, emulated with the Metal header; included last because it defines macros.
#include <metal_stdlib>

namespace tspace::bench {

namespace {

using metal::abs;
using metal::max;
using metal::normalize;
using metal::sqrt;
using std::cos;
using std::sin;
using vec3 = float3;
using vec4 = float4;
using uvec2 = uint2;
#include "peers.glsl"

template <peer_Frame (*decode)(uvec2)>
PeerFrame decoded(PeerWords words) {
    const peer_Frame f = decode(uvec2(static_cast<uint>(words), static_cast<uint>(words >> 32)));
    return {{f.normal.x, f.normal.y, f.normal.z}, {f.tangent.x, f.tangent.y, f.tangent.z, f.tangent.w}};
}

struct Point {
    double x, y;
};
Point unfolded(const DVec3& v) {
    const double scale = 1 / (std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z)), x = v.x * scale, y = v.y * scale;
    if (v.z >= 0) return {x, y};
    return {std::copysign(1 - std::fabs(y), x), std::copysign(1 - std::fabs(x), y)};
}
DVec3 tangentOf(const PeerFrame& f) { return {f.tangent.x, f.tangent.y, f.tangent.z}; }
bool isMirrored(const PeerFrame& f) { return f.tangent.w < 0; }
std::uint32_t rounded(double x) { return static_cast<std::uint32_t>(std::lround(x)); }

/// Encodes N as an octahedron with kBits per coordinate, and the angle of T with the remaining bits except one for the
/// sign.
template <unsigned kBits, peer_Frame (*decode)(uvec2)>
PeerWords encodeAngle(const PeerFrame& f) {
    constexpr unsigned kAngleBits = 31 - 2 * kBits;
    constexpr double kHalf = (1u << (kBits - 1)) - 1, kAngles = 1u << kAngleBits;
    const Point at = unfolded(toDouble(f.normal));
    const std::uint32_t i = rounded((at.x + 1) * kHalf), j = rounded((at.y + 1) * kHalf);
    const std::uint32_t word = i << (32 - kBits) | j << (32 - 2 * kBits) | (isMirrored(f) ? 1 : 0);
    // The decoded T for angle 0 and for a quarter turn are the axes from which the decoder measures the angle.
    const DVec3 p = tangentOf(decoded<decode>(word)), q = tangentOf(decoded<decode>(word | 1u << (kAngleBits - 1)));
    const double angle = std::atan2(dot(tangentOf(f), q), dot(tangentOf(f), p)) / 6.283185307179586;
    return word | (rounded((angle + 1) * kAngles) & ((1u << kAngleBits) - 1)) << 1;
}

struct Quaternion {
    double at[4];
};
/// Returns the unit quaternion of the rotation with columns T, N x T, N, with w >= 0. For accuracy, the other
/// components are computed from the largest one.
Quaternion quaternionOf(const PeerFrame& f) {
    const DVec3 t = tangentOf(f), n = toDouble(f.normal), b = cross(n, t);
    const double squares[4] = {1 + t.x - b.y - n.z, 1 - t.x + b.y - n.z, 1 - t.x - b.y + n.z, 1 + t.x + b.y + n.z};
    const double columns[4][4] = {{squares[0], t.y + b.x, n.x + t.z, b.z - n.y},
                                  {t.y + b.x, squares[1], b.z + n.y, n.x - t.z},
                                  {n.x + t.z, b.z + n.y, squares[2], t.y - b.x},
                                  {b.z - n.y, n.x - t.z, t.y - b.x, squares[3]}};
    int largest = 0;
    for (int m = 1; m < 4; ++m) {
        if (squares[m] > squares[largest]) largest = m;
    }
    Quaternion q{};
    double square = 0;
    for (int m = 0; m < 4; ++m) square += columns[largest][m] * columns[largest][m];
    const double scale = (columns[largest][3] < 0 ? -1 : 1) / std::sqrt(square);
    for (int m = 0; m < 4; ++m) q.at[m] = scale * columns[largest][m];
    return q;
}

PeerWords encodeSmallestThree(const PeerFrame& f) {
    const Quaternion q = quaternionOf(f);
    std::uint32_t largest = 0;
    for (std::uint32_t m = 1; m < 4; ++m) {
        if (std::fabs(q.at[m]) > std::fabs(q.at[largest])) largest = m;
    }
    constexpr unsigned kBits[] = {10, 10, 9};
    PeerWords word = 0;
    for (std::uint32_t m = 0, left = 0; m < 4; ++m) {
        if (m == largest) continue;
        const double part = std::copysign(1, q.at[largest]) * q.at[m] * 1.4142135623730951;
        const unsigned bits = kBits[left++];
        word = word << bits | rounded((part + 1) / 2 * ((1u << bits) - 1));
    }
    return word << 3 | largest << 1 | (isMirrored(f) ? 1 : 0);
}

/// Makes w at least one step, so that it has a sign, and reduces the other components accordingly, as in the SIGGRAPH
/// talk (peers.glsl).
PeerWords encodeQtangent16(const PeerFrame& f) {
    Quaternion q = quaternionOf(f);
    constexpr double kBias = 1.0 / 32767;
    if (q.at[3] < kBias) {
        const double room = std::sqrt(1 - kBias * kBias);
        for (int m = 0; m < 3; ++m) q.at[m] *= room;
        q.at[3] = kBias;
    }
    PeerWords words = 0;
    for (int m = 4; m-- > 0;) {
        const auto number = static_cast<int>(std::lround((isMirrored(f) ? -1 : 1) * q.at[m] * 32767));
        words = words << 16 | static_cast<std::uint16_t>(number);
    }
    return words;
}

PeerWords encodeTwoOct16(const PeerFrame& f) {
    const Point n = unfolded(toDouble(f.normal)), t = unfolded(tangentOf(f));
    const auto bits = [](double x) { return static_cast<PeerWords>(rounded((x + 1) / 2 * 65535)); };
    // A bias of one step keeps this value from being 0, so that it always has a sign.
    const double half_y = std::fmax((t.y + 1) / 2, 1.0 / 32767);
    return bits(n.x) | bits(n.y) << 16 | bits(t.x) << 32 | bits(isMirrored(f) ? -half_y : half_y) << 48;
}

template <peer_Frame (*decode)(uvec2)>
constexpr Peer peer(const char* name, const char* function, std::size_t bytes, PeerWords (*encode)(const PeerFrame&)) {
    return {name, function, bytes, encode, decoded<decode>};
}

constexpr Peer kPeers[] = {
    peer<peer_oct10_10_11>("oct 10+10, angle 11", "peer_oct10_10_11", 4, encodeAngle<10, peer_oct10_10_11>),
    peer<peer_oct11_11_9>("oct 11+11, angle 9", "peer_oct11_11_9", 4, encodeAngle<11, peer_oct11_11_9>),
    peer<peer_smallestThree>("smallest three 10+10+9", "peer_smallestThree", 4, encodeSmallestThree),
    peer<peer_qtangent16>("qtangent, plain rounding", "peer_qtangent16", 8, encodeQtangent16),
    peer<peer_twoOct16>("oct 16+16 twice (Godot)", "peer_twoOct16", 8, encodeTwoOct16),
};

}  // namespace

std::span<const Peer> peers() { return kPeers; }

}  // namespace tspace::bench
