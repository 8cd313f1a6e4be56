// SPDX-License-Identifier: MIT
// Runs the cases as a compute shader; see compute.glsl.
StructuredBuffer<uint> words : register(t0);
RWStructuredBuffer<float4> results : register(u1);
uint wordAt(uint at) { return words[at]; }

#include "tspace.hlsl"
#include "cases.hlsl"

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    if (id.x >= words[1]) return;
    float4 a, b;
    runCase(words[0], 4u + id.x * words[2], a, b);
    results[2u * id.x] = a;
    results[2u * id.x + 1u] = b;
}
