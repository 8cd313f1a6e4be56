// SPDX-License-Identifier: MIT
// Tangent frames in the Metal shading language: decoding of packed frames, normal maps, skinning, morphing, and frames
// for meshes without tangents. For Metal 1 and later. Include it; files with fragment functions define TSPACE_FRAGMENT
// first, to enable the function that uses derivatives. tspace.glsl, tspace.hlsl and tspace.wgsl contain the same
// functions. docs/concepts/pack.md of tspace documents the words and their accuracy; docs/reference/shaders.md has the
// rules for everything else.
//
// Costs are scalar operations as counted by GLSL's compiler: each + - * < ? & | ^ << >> and each conversion counts as
// one per component, a division of integers by a constant as two (high product and shift). Roots are inverse square
// roots or square roots. Counts are before compiler optimizations, which merge some operations.
#pragma once

#include <metal_stdlib>

// N and T are unit. tangent.w is the sign, +1 or -1: the bitangent is cross(normal, tangent.xyz) * tangent.w.
struct tspace_Frame {
    float3 normal;
    float4 tangent;
};

// ---- helpers

// Returns v normalized, or `otherwise` if v has no direction.
// Cost: 12 operations, 1 root.
inline float3 tspace_unit(float3 v, float3 otherwise) {
    float square = metal::dot(v, v);
    return square > 0.0f ? v * metal::rsqrt(square) : otherwise;
}

// Returns the sum of the absolute components: an upper bound of the length without a root.
// Cost: 5 operations.
inline float tspace_sizeOf(float3 v) { return metal::abs(v.x) + metal::abs(v.y) + metal::abs(v.z); }

// Returns a unit vector perpendicular to the unit vector n.
// Cost: 12 operations, 1 division.
inline float3 tspace_axisAcross(float3 n) {
    float s = n.z < 0.0f ? -1.0f : 1.0f;
    float h = -1.0f / (s + n.z);
    return float3(1.0f + s * n.x * n.x * h, s * n.x * n.y * h, -s * n.x);
}

// Returns +1 or -1 for an interpolated sign. Signs that differ within a triangle are a fault of the mesh.
// Cost: 2 operations.
inline float tspace_signOf(float w) { return w < 0.0f ? -1.0f : 1.0f; }

// Cost: 14 operations.
inline float3 tspace_bitangent(float3 normal, float4 tangent) {
    return metal::cross(normal, tangent.xyz) * tspace_signOf(tangent.w);
}

// ---- packed frames. Words are little-endian: the first word contains the lowest bytes. Decode in the vertex shader
// and interpolate the decoded frames, never words. Every word is a valid frame. The fold of the octahedron, the side of
// the basis and the sign are computed from integers, so GPU rounding cannot flip a frame; sine and cosine are not used.

// Returns the word of a four-byte attribute: _FRAME32, _OCT32. Bind it as integers, not normalized.
// Cost: 6 operations.
inline uint tspace_word(uint4 bytes) { return bytes.x | bytes.y << 8u | bytes.z << 16u | bytes.w << 24u; }

// Returns the words of an attribute of shorts: _FRAME48 (with w = 0), _FRAME64. Bind it as integers, not normalized.
// Cost: 4 operations.
inline uint2 tspace_words(uint4 shorts) { return shorts.xz | shorts.yw << 16u; }

// Decodes 4 bytes, N and T within 0.135 degrees: a small rotation, followed by one of 24 rotations of the axes.
// Cost: 119 operations, 1 division.
inline tspace_Frame tspace_decodeFrame32(uint word) {
    uint code = metal::min(word >> 1u, 2147306975u);
    uint columns = code / 453u, z = code - columns * 453u;
    uint rest = columns / 436u, y = columns - rest * 436u;
    uint g = rest / 453u, x = rest - g * 453u;
    float3 u = float3(float(x) - 226.0f, float(2u * y + ((x + z) & 1u)) - 436.0f, float(z) - 226.0f);
    u *= float3(1.0f / 226.0f, 1.0f / 435.0f, 1.0f / 226.0f);
    float3 p = u * (0.38728967f + 0.02692388f * (u * u));  // axis times the tangent of half the angle
    float k = 2.0f / (1.0f + metal::dot(p, p));
    float3 n = float3(k * (p.x * p.z + p.y), k * (p.y * p.z - p.x), 1.0f - k * (p.x * p.x + p.y * p.y));
    float3 t = float3(1.0f - k * (p.y * p.y + p.z * p.z), k * (p.x * p.y + p.z), k * (p.x * p.z - p.y));
    bool is_swap = g >= 12u;
    uint turns = is_swap ? g - 12u : g;
    n = is_swap ? n.xzy : n;
    t = is_swap ? t.xzy : t;
    n = turns < 4u ? n : turns < 8u ? n.yzx : n.zxy;
    t = turns < 4u ? t : turns < 8u ? t.yzx : t.zxy;
    uint third = (g ^ g >> 1u) & 1u;
    float3 s = 1.0f - 2.0f * float3(float(g & 1u), float(g >> 1u & 1u), float(is_swap ? third ^ 1u : third));
    return tspace_Frame{n * s, float4(t * s, 1.0f - 2.0f * float(word & 1u))};
}

// Returns the frame whose N is at `ij` of the unfolded octahedron, a grid of 2 * half_width + 1 points per side. T is
// rotated around N by `quarters` quarter turns and `k` steps; a quarter turn has `quarter` steps.
// Cost: 84 operations, 2 roots, 1 division.
inline tspace_Frame tspace_frameOfAngle(float2 ij, uint quarters, float k, float half_width, float quarter,
                                        uint mirrored) {
    float2 d = ij - half_width;
    // c is an exact integer: negative in the lower half of the octahedron, which is folded over the edges.
    float c = half_width - metal::abs(d.x) - metal::abs(d.y);
    float s = c < 0.0f ? -1.0f : 1.0f;
    float3 b = float3(metal::abs(d) + metal::min(c, 0.0f), metal::abs(c));
    float3 n = b * (2.5f * half_width - b);
    n *= metal::rsqrt(metal::dot(n, n));
    n = float3(d.x < 0.0f ? -n.x : n.x, d.y < 0.0f ? -n.y : n.y, s * n.z);

    float h = -1.0f / (s + n.z), e = n.x * n.y * h;
    float3 p = float3(1.0f + s * n.x * n.x * h, s * e, -s * n.x), q = float3(e, s + n.y * n.y * h, -n.y);
    float l = quarter - k, run = l * (2.75f * quarter - l), rise = k * (2.75f * quarter - k);
    float scale = metal::rsqrt(run * run + rise * rise);
    scale = (quarters & 2u) != 0u ? -scale : scale;
    float2 turn = (quarters & 1u) != 0u ? float2(-rise, run) : float2(run, rise);
    return tspace_Frame{n, float4((p * turn.x + q * turn.y) * scale, 1.0f - 2.0f * float(mirrored))};
}

// Decodes 4 bytes, N within 0.15 and T within 0.165 degrees.
// Cost: 97 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeOct32(uint word) {
    float2 ij = float2(float(metal::min(word >> 22u, 1022u)), float(metal::min(word >> 12u & 1023u, 1022u)));
    return tspace_frameOfAngle(ij, word >> 10u & 3u, float(word >> 1u & 511u), 511.0f, 512.0f, word & 1u);
}

// Decodes 6 bytes, N within 0.0037 and T within 0.0042 degrees. words.y contains the upper 16 bits; higher bits are
// ignored.
// Cost: 100 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeFrame48(uint2 words) {
    uint ij = metal::min(words.y << 15u | words.x >> 17u, 2147302920u);
    uint i = ij / 46339u;
    float2 place = float2(float(i), float(ij - i * 46339u));
    return tspace_frameOfAngle(place, words.x >> 15u & 3u, float(words.x >> 1u & 16383u), 23169.0f, 16384.0f,
                               words.x & 1u);
}

// Decodes 8 bytes, N within 0.0001 and T within 0.00015 degrees.
// Cost: 99 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeFrame64(uint2 words) {
    uint i = metal::min(words.y >> 11u, 2097150u);
    uint j = metal::min((words.y << 10u & 2096128u) | words.x >> 22u, 2097150u);
    return tspace_frameOfAngle(float2(float(i), float(j)), words.x >> 20u & 3u, float(words.x >> 1u & 524287u),
                               1048575.0f, 524288.0f, words.x & 1u);
}

// Decodes a quaternion of any length, as in a normalized attribute: qtangent64 in glTF (_QTANGENT64), Filament and
// CryEngine. The sign of the frame is the sign of w. Encoders therefore store 1/32767 or -1/32767 instead of a w of 0
// (half turns). Half precision may flush such a w to zero, and lose the sign.
// Cost: 39 operations, 1 division.
inline tspace_Frame tspace_frameOfQuaternion(float4 q) {
    float square = metal::dot(q, q), w = square > 0.0f ? q.w : 1.0f, k = square > 0.0f ? 2.0f / square : 2.0f;
    float3 v = q.xyz;
    float3 normal = float3(k * (v.z * v.x + w * v.y), k * (v.y * v.z - w * v.x), 1.0f - k * (v.x * v.x + v.y * v.y));
    float3 tangent = float3(1.0f - k * (v.y * v.y + v.z * v.z), k * (v.x * v.y + w * v.z), k * (v.z * v.x - w * v.y));
    return tspace_Frame{normal, float4(tangent, tspace_signOf(w))};
}

// Normalizes N and T that are stored separately: snorm pairs as normalized attributes, (T, 1) and (N, sign), and glTF's
// quantized (T, sign) and N.
// Cost: 38 operations, 2 roots, 1 division.
inline tspace_Frame tspace_frameOfVectors(float3 normal, float3 tangent, float mirrored) {
    float3 n = tspace_unit(normal, float3(0.0f, 0.0f, 1.0f));
    return tspace_Frame{n, float4(tspace_unit(tangent, tspace_axisAcross(n)), tspace_signOf(mirrored))};
}

// Unpacks signed integers from a word, least significant first: two of 16 bits, or four of 8. The minimum value is
// clamped to its successor, as for SNORM.
// Cost: 7 operations.
inline float2 tspace_shortsOf(uint word) {
    return metal::max(float2(float(int(word << 16u) >> 16u), float(int(word) >> 16u)), -32767.0f);
}
// Cost: 15 operations.
inline float4 tspace_bytesOf(uint word) {
    int4 bytes = int4(int(word << 24u), int(word << 16u), int(word << 8u), int(word)) >> 24;
    return metal::max(float4(bytes), -127.0f);
}

// Decodes 8 bytes, N and T within 0.004 degrees.
// Cost: 53 operations, 1 division.
inline tspace_Frame tspace_decodeQtangent64(uint2 words) {
    return tspace_frameOfQuaternion(float4(tspace_shortsOf(words.x), tspace_shortsOf(words.y)));
}

// Decodes 8 bytes, N and T within 0.391 degrees: (T, 1) and (N, sign), as Unreal's TangentX and TangentZ.
// Cost: 68 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeSnorm8Pair(uint2 words) {
    float4 normal = tspace_bytesOf(words.y);
    return tspace_frameOfVectors(normal.xyz, tspace_bytesOf(words.x).xyz, normal.w);
}

// Decodes 16 bytes, N and T within 0.00152 degrees: (T, 1) and (N, sign).
// Cost: 66 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeSnorm16Pair(uint4 words) {
    float2 tangent = tspace_shortsOf(words.x), normal = tspace_shortsOf(words.z), last = tspace_shortsOf(words.w);
    return tspace_frameOfVectors(float3(normal, last.x), float3(tangent, tspace_shortsOf(words.y).x), last.y);
}

// Decodes 7 bytes, N and T within 0.391 degrees: (T, sign) and N, as in KHR_mesh_quantization. The eighth byte is
// ignored.
// Cost: 68 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeGltfSnorm8(uint2 words) {
    float4 tangent = tspace_bytesOf(words.x);
    return tspace_frameOfVectors(tspace_bytesOf(words.y).xyz, tangent.xyz, tangent.w);
}

// Decodes 14 bytes, N and T within 0.00152 degrees: (T, sign) and N. The upper half of the last word is ignored.
// Cost: 66 operations, 2 roots, 1 division.
inline tspace_Frame tspace_decodeGltfSnorm16(uint4 words) {
    float2 tangent = tspace_shortsOf(words.x), last = tspace_shortsOf(words.y);
    return tspace_frameOfVectors(float3(tspace_shortsOf(words.z), tspace_shortsOf(words.w).x), float3(tangent, last.x),
                                 last.y);
}

// ---- texels of normal maps: green points along the bitangent. For maps made for DirectX negate y.

// Decodes a texel of a map with three channels.
// Cost: 6 operations.
inline float3 tspace_texel(float3 rgb) { return rgb * 2.0f - 1.0f; }

// Decodes a texel of a map with two channels (BC5, EAC, RG8); for x in alpha and y in green (DXT5nm) pass rgba.ag. z is
// never negative. Filtering shortens (x, y), so z is too long between texels that differ: the cost of two channels.
// Cost: 9 operations, 1 root.
inline float3 tspace_texelOfTwo(float2 rg) {
    float2 v = rg * 2.0f - 1.0f;
    return float3(v, metal::sqrt(metal::max(0.0f, 1.0f - metal::dot(v, v))));
}

// ---- applying a texel. Use the function for which the map was baked: results differ by degrees on coarse meshes. Pass
// normal, tangent and bitangent as interpolated. At the vertices they must be unit vectors, as tspace_transformFrame
// returns them; other lengths change the slopes of the relief.

// MikkTSpace, bitangent per pixel (Blender): only the result is normalized.
// Cost: 37 operations, 1 root.
inline float3 tspace_applyMikktspace(float3 texel, float3 normal, float4 tangent) {
    return metal::normalize(texel.x * tangent.xyz + texel.y * tspace_bitangent(normal, tangent) + texel.z * normal);
}

// MikkTSpace, bitangent per vertex (Unity's built-in pipeline): the vertex shader calls tspace_bitangent.
// Cost: 23 operations, 1 root.
inline float3 tspace_applyMikktspacePerVertex(float3 texel, float3 normal, float3 tangent, float3 bitangent) {
    return metal::normalize(texel.x * tangent + texel.y * bitangent + texel.z * normal);
}

// three.js: bitangent per vertex, each vector normalized first. `face`: -1 on back faces of double-sided materials,
// whose frame is flipped as a whole, otherwise 1.
// Cost: 50 operations, 4 roots.
inline float3 tspace_applyThree(float3 texel, float3 normal, float3 tangent, float3 bitangent, float face) {
    float3 t = metal::normalize(tangent), b = metal::normalize(bitangent), n = metal::normalize(normal);
    return metal::normalize(texel.x * t + texel.y * b + texel.z * n) * face;
}

// Unreal: MikkTSpace per pixel, maps with two channels. Unreal's bitangents point along V, downward, like green in its
// maps.
// Cost: 46 operations, 2 roots.
inline float3 tspace_applyUnreal(float2 rg, float3 normal, float4 tangent) {
    return tspace_applyMikktspace(tspace_texelOfTwo(rg), normal, tangent);
}

// Unity, URP and HDRP: MikkTSpace per pixel; x is red times alpha, which supports maps with x in red or in alpha. The
// sign from the vertex shader is TANGENT.w * unity_WorldTransformParams.w.
// Cost: 47 operations, 2 roots.
inline float3 tspace_applyUnity(float4 rgba, float3 normal, float4 tangent) {
    return tspace_applyMikktspace(tspace_texelOfTwo(float2(rgba.x * rgba.w, rgba.y)), normal, tangent);
}

// Godot 4: bitangent per vertex, each vector normalized first, maps with two channels, and `depth` (normal_map_depth)
// blends with the normal.
// Cost: 65 operations, 5 roots.
inline float3 tspace_applyGodot(float2 rg, float3 normal, float3 tangent, float3 bitangent, float depth) {
    float3 texel = tspace_texelOfTwo(rg), n = metal::normalize(normal);
    float3 mapped = texel.x * metal::normalize(tangent) + texel.y * metal::normalize(bitangent) + texel.z * n;
    return metal::normalize(metal::mix(n, mapped, depth));
}

// ---- deformed meshes: glTF's order is morphing, then skinning, then the node's matrix.

// Returns a frame after the linear map m (without the translation). T, a direction on the surface, is
// transformed by m itself. N is transformed by the cofactor matrix: cof(m) cross(a, b) = cross(m a, m b), and
// dot(cof(m) N, m T) = det(m) dot(N, T) = 0, so N and T remain perpendicular under any scale or shear, which m alone
// would not ensure; unlike the inverse transpose it needs no division and is valid for flat m. If m mirrors (det < 0),
// cof(m) N points inward: N is flipped outward again, and the sign with it, so that the bitangent remains m B. If m
// is flat, rounding decides the sign of det, so tiny volumes count as zero. A renderer that flips normals of back faces
// and cannot reverse the winding of such triangles (skins) needs N and the sign both negated: the bitangent is the
// same.
// Cost: 111 operations, 2 roots.
inline tspace_Frame tspace_transformFrame(tspace_Frame frame, metal::float3x3 m) {
    float3 c0 = metal::cross(m[1], m[2]), c1 = metal::cross(m[2], m[0]), c2 = metal::cross(m[0], m[1]);
    float least = 0.000002f * tspace_sizeOf(m[0]) * tspace_sizeOf(m[1]) * tspace_sizeOf(m[2]);
    float s = tspace_signOf(metal::dot(m[0], c0) + least);
    float3 n = (c0 * frame.normal.x + c1 * frame.normal.y + c2 * frame.normal.z) * s;
    float3 t = m[0] * frame.tangent.x + m[1] * frame.tangent.y + m[2] * frame.tangent.z;
    return tspace_Frame{tspace_unit(n, frame.normal), float4(tspace_unit(t, frame.tangent.xyz), frame.tangent.w * s)};
}

// Returns the frame of a skinned vertex: linear blend skinning with up to four bones. The blended matrix that
// transforms the position transforms both N and T: blending frames of single bones instead would lose the right angle.
// Cost: 174 operations, 2 roots.
inline tspace_Frame tspace_skinFrame(tspace_Frame frame, metal::float3x3 bone0, metal::float3x3 bone1,
                                     metal::float3x3 bone2, metal::float3x3 bone3, float4 weights) {
    return tspace_transformFrame(frame, bone0 * weights.x + bone1 * weights.y + bone2 * weights.z + bone3 * weights.w);
}

// Returns a frame with morph targets: the deltas are the sums of weight times target. N is normalized, T is made unit
// and perpendicular to it; the sign is kept, as glTF's targets have none. If a sum has no direction, the original
// vector is kept.
// Cost: 65 operations, 3 roots, 1 division.
inline tspace_Frame tspace_morphFrame(tspace_Frame frame, float3 normal_delta, float3 tangent_delta) {
    float3 n = tspace_unit(frame.normal + normal_delta, frame.normal);
    float3 t = tspace_unit(frame.tangent.xyz + tangent_delta, frame.tangent.xyz);
    return tspace_Frame{n, float4(tspace_unit(t - n * metal::dot(n, t), tspace_axisAcross(n)), frame.tangent.w)};
}

// ---- meshes without tangents

// Returns the frame from the change of position and UV between pixels: T along dP/du, perpendicular to N, and the sign
// of the UVs as seen along N. dP/du is constant over each triangle, so there are seams where stored tangents would be
// smooth. V must increase in the direction of green: for glTF pass (u, -v). If UVs do not change, T is any vector
// perpendicular to N.
// Cost: 91 operations, 3 roots, 1 division.
inline tspace_Frame tspace_frameOfSteps(float3 normal, float3 p_dx, float3 p_dy, float2 uv_dx, float2 uv_dy) {
    float3 n = metal::normalize(normal);
    float area = uv_dx.x * uv_dy.y - uv_dx.y * uv_dy.x;
    float3 t = tspace_unit((p_dx * uv_dy.y - p_dy * uv_dx.y) * tspace_signOf(area), float3(0.0f, 0.0f, 0.0f));
    float s = tspace_signOf(area) * tspace_signOf(metal::dot(metal::cross(p_dx, p_dy), n));
    return tspace_Frame{n, float4(tspace_unit(t - n * metal::dot(n, t), tspace_axisAcross(n)), s)};
}

#ifdef TSPACE_FRAGMENT
// Calls tspace_frameOfSteps with the derivatives at this pixel. `position` must be in the space of `normal`.
// Cost: 91 operations, 3 roots, 1 division, 10 derivatives.
inline tspace_Frame tspace_frameOfPixel(float3 normal, float3 position, float2 uv) {
    return tspace_frameOfSteps(normal, metal::dfdx(position), metal::dfdy(position), metal::dfdx(uv), metal::dfdy(uv));
}
#endif
