#version 450
// SPDX-License-Identifier: MIT
// Runs the cases as a Vulkan compute shader. The buffer contains the case number, the number of items, and then the
// words of each item.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; };
uint wordAt(uint at) { return words[at]; }

#include "tspace.glsl"
#include "cases.glsl"

void main() {
    uint item = gl_GlobalInvocationID.x;
    if (item >= words[1]) return;
    vec4 a, b;
    runCase(words[0], 4u + item * words[2], a, b);
    results[2u * item] = a;
    results[2u * item + 1u] = b;
}
