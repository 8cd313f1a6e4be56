#version 450
// SPDX-License-Identifier: MIT
// Calls every decoder once, for counting its operations.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Words { uvec4 words; vec4 result; };

#include "tspace.glsl"
#include "peers.glsl"

void main() {
    uvec2 two = words.xy;
    result = tspace_decodeFrame32(two.x).tangent + tspace_decodeOct32(two.x).tangent + tspace_decodeFrame48(two).tangent +
             tspace_decodeFrame64(two).tangent + tspace_decodeQtangent64(two).tangent +
             tspace_decodeSnorm8Pair(two).tangent + tspace_decodeSnorm16Pair(words).tangent +
             tspace_decodeGltfSnorm8(two).tangent + tspace_decodeGltfSnorm16(words).tangent +
             peer_oct10_10_11(two).tangent + peer_oct11_11_9(two).tangent + peer_smallestThree(two).tangent +
             peer_qtangent16(two).tangent + peer_twoOct16(two).tangent;
}
