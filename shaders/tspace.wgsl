// SPDX-License-Identifier: MIT
// Tangent frames in WGSL, for WebGPU: decoding of packed frames, normal maps, skinning, morphing, and frames for meshes
// without tangents. Put it before or after your own code: all its names start with tspace_, and it has no entry points.
// tspace.glsl, tspace.hlsl and tspace.metal contain the same functions. docs/concepts/pack.md of tspace documents the
// words and their accuracy; docs/reference/shaders.md has the rules for everything else.
//
// Costs are scalar operations as counted by GLSL's compiler: each + - * < ? & | ^ << >> and each conversion counts as
// one per component, a division of integers by a constant as two (high product and shift). Roots are inverse square
// roots or square roots. Counts are before compiler optimizations, which merge some operations.

// N and T are unit. tangent.w is the sign, +1 or -1: the bitangent is cross(normal, tangent.xyz) * tangent.w.
struct tspace_Frame {
    normal: vec3f,
    tangent: vec4f,
}

// ---- helpers

// Returns v normalized, or `otherwise` if v has no direction.
// Cost: 12 operations, 1 root.
fn tspace_unit(v: vec3f, otherwise: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(otherwise, v * inverseSqrt(square), square > 0.0);
}

// Returns the sum of the absolute components: an upper bound of the length without a root.
// Cost: 5 operations.
fn tspace_sizeOf(v: vec3f) -> f32 { return abs(v.x) + abs(v.y) + abs(v.z); }

// Returns a unit vector perpendicular to the unit vector n.
// Cost: 12 operations, 1 division.
fn tspace_axisAcross(n: vec3f) -> vec3f {
    let s = select(1.0, -1.0, n.z < 0.0);
    let h = -1.0 / (s + n.z);
    return vec3f(1.0 + s * n.x * n.x * h, s * n.x * n.y * h, -s * n.x);
}

// Returns +1 or -1 for an interpolated sign. Signs that differ within a triangle are a fault of the mesh.
// Cost: 2 operations.
fn tspace_signOf(w: f32) -> f32 { return select(1.0, -1.0, w < 0.0); }

// Cost: 14 operations.
fn tspace_bitangent(normal: vec3f, tangent: vec4f) -> vec3f {
    return cross(normal, tangent.xyz) * tspace_signOf(tangent.w);
}

// ---- packed frames. Words are little-endian: the first word contains the lowest bytes. Decode in the vertex shader
// and interpolate the decoded frames, never words. Every word is a valid frame. The fold of the octahedron, the side of
// the basis and the sign are computed from integers, so GPU rounding cannot flip a frame; sine and cosine are not used.

// Returns the word of a four-byte attribute: _FRAME32, _OCT32. Bind it as integers, not normalized.
// Cost: 6 operations.
fn tspace_word(bytes: vec4u) -> u32 {
    return bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (bytes.w << 24u);
}

// Returns the words of an attribute of shorts: _FRAME48 (with w = 0), _FRAME64. Bind it as integers, not normalized.
// Cost: 4 operations.
fn tspace_words(shorts: vec4u) -> vec2u { return shorts.xz | (shorts.yw << vec2u(16u)); }

// Decodes 4 bytes, N and T within 0.135 degrees: a small rotation, followed by one of 24 rotations of the axes.
// Cost: 119 operations, 1 division.
fn tspace_decodeFrame32(word: u32) -> tspace_Frame {
    let code = min(word >> 1u, 2147306975u);
    let columns = code / 453u;
    let z = code - columns * 453u;
    let rest = columns / 436u;
    let y = columns - rest * 436u;
    let g = rest / 453u;
    let x = rest - g * 453u;
    let places = vec3f(f32(x) - 226.0, f32(2u * y + ((x + z) & 1u)) - 436.0, f32(z) - 226.0);
    let u = places * vec3f(1.0 / 226.0, 1.0 / 435.0, 1.0 / 226.0);
    let p = u * (0.38728967 + 0.02692388 * (u * u));  // axis times the tangent of half the angle
    let k = 2.0 / (1.0 + dot(p, p));
    var n = vec3f(k * (p.x * p.z + p.y), k * (p.y * p.z - p.x), 1.0 - k * (p.x * p.x + p.y * p.y));
    var t = vec3f(1.0 - k * (p.y * p.y + p.z * p.z), k * (p.x * p.y + p.z), k * (p.x * p.z - p.y));
    let is_swap = g >= 12u;
    let turns = select(g, g - 12u, is_swap);
    n = select(n, n.xzy, is_swap);
    t = select(t, t.xzy, is_swap);
    n = select(select(n.zxy, n.yzx, turns < 8u), n, turns < 4u);
    t = select(select(t.zxy, t.yzx, turns < 8u), t, turns < 4u);
    let third = (g ^ (g >> 1u)) & 1u;
    let s = 1.0 - 2.0 * vec3f(f32(g & 1u), f32((g >> 1u) & 1u), f32(select(third, third ^ 1u, is_swap)));
    return tspace_Frame(n * s, vec4f(t * s, 1.0 - 2.0 * f32(word & 1u)));
}

// Returns the frame whose N is at `ij` of the unfolded octahedron, a grid of 2 * half_width + 1 points per side. T is
// rotated around N by `quarters` quarter turns and `k` steps; a quarter turn has `quarter` steps.
// Cost: 84 operations, 2 roots, 1 division.
fn tspace_frameOfAngle(ij: vec2f, quarters: u32, k: f32, half_width: f32, quarter: f32, mirrored: u32) -> tspace_Frame {
    let d = ij - half_width;
    // c is an exact integer: negative in the lower half of the octahedron, which is folded over the edges.
    let c = half_width - abs(d.x) - abs(d.y);
    let s = select(1.0, -1.0, c < 0.0);
    let b = vec3f(abs(d) + min(c, 0.0), abs(c));
    let above = b * (2.5 * half_width - b);
    let unit = above * inverseSqrt(dot(above, above));
    let n = vec3f(select(unit.x, -unit.x, d.x < 0.0), select(unit.y, -unit.y, d.y < 0.0), s * unit.z);

    let h = -1.0 / (s + n.z);
    let e = n.x * n.y * h;
    let p = vec3f(1.0 + s * n.x * n.x * h, s * e, -s * n.x);
    let q = vec3f(e, s + n.y * n.y * h, -n.y);
    let l = quarter - k;
    let run = l * (2.75 * quarter - l);
    let rise = k * (2.75 * quarter - k);
    let length = inverseSqrt(run * run + rise * rise);
    let scale = select(length, -length, (quarters & 2u) != 0u);
    let turn = select(vec2f(run, rise), vec2f(-rise, run), (quarters & 1u) != 0u);
    return tspace_Frame(n, vec4f((p * turn.x + q * turn.y) * scale, 1.0 - 2.0 * f32(mirrored)));
}

// Decodes 4 bytes, N within 0.15 and T within 0.165 degrees.
// Cost: 97 operations, 2 roots, 1 division.
fn tspace_decodeOct32(word: u32) -> tspace_Frame {
    let ij = vec2f(f32(min(word >> 22u, 1022u)), f32(min((word >> 12u) & 1023u, 1022u)));
    return tspace_frameOfAngle(ij, (word >> 10u) & 3u, f32((word >> 1u) & 511u), 511.0, 512.0, word & 1u);
}

// Decodes 6 bytes, N within 0.0037 and T within 0.0042 degrees. words.y contains the upper 16 bits; higher bits are
// ignored.
// Cost: 100 operations, 2 roots, 1 division.
fn tspace_decodeFrame48(words: vec2u) -> tspace_Frame {
    let ij = min((words.y << 15u) | (words.x >> 17u), 2147302920u);
    let i = ij / 46339u;
    let place = vec2f(f32(i), f32(ij - i * 46339u));
    return tspace_frameOfAngle(place, (words.x >> 15u) & 3u, f32((words.x >> 1u) & 16383u), 23169.0, 16384.0,
                               words.x & 1u);
}

// Decodes 8 bytes, N within 0.0001 and T within 0.00015 degrees.
// Cost: 99 operations, 2 roots, 1 division.
fn tspace_decodeFrame64(words: vec2u) -> tspace_Frame {
    let i = min(words.y >> 11u, 2097150u);
    let j = min(((words.y << 10u) & 2096128u) | (words.x >> 22u), 2097150u);
    return tspace_frameOfAngle(vec2f(f32(i), f32(j)), (words.x >> 20u) & 3u, f32((words.x >> 1u) & 524287u), 1048575.0,
                               524288.0, words.x & 1u);
}

// Decodes a quaternion of any length, as in a normalized attribute: qtangent64 in glTF (_QTANGENT64), Filament and
// CryEngine. The sign of the frame is the sign of w. Encoders therefore store 1/32767 or -1/32767 instead of a w of 0
// (half turns). Half precision may flush such a w to zero, and lose the sign.
// Cost: 39 operations, 1 division.
fn tspace_frameOfQuaternion(q: vec4f) -> tspace_Frame {
    let square = dot(q, q);
    let w = select(1.0, q.w, square > 0.0);
    let k = select(2.0, 2.0 / square, square > 0.0);
    let v = q.xyz;
    let normal = vec3f(k * (v.z * v.x + w * v.y), k * (v.y * v.z - w * v.x), 1.0 - k * (v.x * v.x + v.y * v.y));
    let tangent = vec3f(1.0 - k * (v.y * v.y + v.z * v.z), k * (v.x * v.y + w * v.z), k * (v.z * v.x - w * v.y));
    return tspace_Frame(normal, vec4f(tangent, tspace_signOf(w)));
}

// Normalizes N and T that are stored separately: snorm pairs as normalized attributes, (T, 1) and (N, sign), and glTF's
// quantized (T, sign) and N.
// Cost: 38 operations, 2 roots, 1 division.
fn tspace_frameOfVectors(normal: vec3f, tangent: vec3f, mirrored: f32) -> tspace_Frame {
    let n = tspace_unit(normal, vec3f(0.0, 0.0, 1.0));
    return tspace_Frame(n, vec4f(tspace_unit(tangent, tspace_axisAcross(n)), tspace_signOf(mirrored)));
}

// Unpacks signed integers from a word, least significant first: two of 16 bits, or four of 8. The minimum value is
// clamped to its successor, as for SNORM.
// Cost: 7 operations.
fn tspace_shortsOf(word: u32) -> vec2f {
    let shorts = vec2i(bitcast<i32>(word << 16u), bitcast<i32>(word)) >> vec2u(16u);
    return max(vec2f(shorts), vec2f(-32767.0));
}
// Cost: 15 operations.
fn tspace_bytesOf(word: u32) -> vec4f {
    let bytes = bitcast<vec4i>(vec4u(word << 24u, word << 16u, word << 8u, word)) >> vec4u(24u);
    return max(vec4f(bytes), vec4f(-127.0));
}

// Decodes 8 bytes, N and T within 0.004 degrees.
// Cost: 53 operations, 1 division.
fn tspace_decodeQtangent64(words: vec2u) -> tspace_Frame {
    return tspace_frameOfQuaternion(vec4f(tspace_shortsOf(words.x), tspace_shortsOf(words.y)));
}

// Decodes 8 bytes, N and T within 0.391 degrees: (T, 1) and (N, sign), as Unreal's TangentX and TangentZ.
// Cost: 68 operations, 2 roots, 1 division.
fn tspace_decodeSnorm8Pair(words: vec2u) -> tspace_Frame {
    let normal = tspace_bytesOf(words.y);
    return tspace_frameOfVectors(normal.xyz, tspace_bytesOf(words.x).xyz, normal.w);
}

// Decodes 16 bytes, N and T within 0.00152 degrees: (T, 1) and (N, sign).
// Cost: 66 operations, 2 roots, 1 division.
fn tspace_decodeSnorm16Pair(words: vec4u) -> tspace_Frame {
    let tangent = tspace_shortsOf(words.x);
    let normal = tspace_shortsOf(words.z);
    let last = tspace_shortsOf(words.w);
    return tspace_frameOfVectors(vec3f(normal, last.x), vec3f(tangent, tspace_shortsOf(words.y).x), last.y);
}

// Decodes 7 bytes, N and T within 0.391 degrees: (T, sign) and N, as in KHR_mesh_quantization. The eighth byte is
// ignored.
// Cost: 68 operations, 2 roots, 1 division.
fn tspace_decodeGltfSnorm8(words: vec2u) -> tspace_Frame {
    let tangent = tspace_bytesOf(words.x);
    return tspace_frameOfVectors(tspace_bytesOf(words.y).xyz, tangent.xyz, tangent.w);
}

// Decodes 14 bytes, N and T within 0.00152 degrees: (T, sign) and N. The upper half of the last word is ignored.
// Cost: 66 operations, 2 roots, 1 division.
fn tspace_decodeGltfSnorm16(words: vec4u) -> tspace_Frame {
    let tangent = tspace_shortsOf(words.x);
    let last = tspace_shortsOf(words.y);
    return tspace_frameOfVectors(vec3f(tspace_shortsOf(words.z), tspace_shortsOf(words.w).x), vec3f(tangent, last.x),
                                 last.y);
}

// ---- texels of normal maps: green points along the bitangent. For maps made for DirectX negate y.

// Decodes a texel of a map with three channels.
// Cost: 6 operations.
fn tspace_texel(rgb: vec3f) -> vec3f { return rgb * 2.0 - 1.0; }

// Decodes a texel of a map with two channels (BC5, EAC, RG8); for x in alpha and y in green (DXT5nm) pass rgba.ag. z is
// never negative. Filtering shortens (x, y), so z is too long between texels that differ: the cost of two channels.
// Cost: 9 operations, 1 root.
fn tspace_texelOfTwo(rg: vec2f) -> vec3f {
    let v = rg * 2.0 - 1.0;
    return vec3f(v, sqrt(max(0.0, 1.0 - dot(v, v))));
}

// ---- applying a texel. Use the function for which the map was baked: results differ by degrees on coarse meshes. Pass
// normal, tangent and bitangent as interpolated. At the vertices they must be unit vectors, as tspace_transformFrame
// returns them; other lengths change the slopes of the relief.

// MikkTSpace, bitangent per pixel (Blender): only the result is normalized.
// Cost: 37 operations, 1 root.
fn tspace_applyMikktspace(texel: vec3f, normal: vec3f, tangent: vec4f) -> vec3f {
    return normalize(texel.x * tangent.xyz + texel.y * tspace_bitangent(normal, tangent) + texel.z * normal);
}

// MikkTSpace, bitangent per vertex (Unity's built-in pipeline): the vertex shader calls tspace_bitangent.
// Cost: 23 operations, 1 root.
fn tspace_applyMikktspacePerVertex(texel: vec3f, normal: vec3f, tangent: vec3f, bitangent: vec3f) -> vec3f {
    return normalize(texel.x * tangent + texel.y * bitangent + texel.z * normal);
}

// three.js: bitangent per vertex, each vector normalized first. `face`: -1 on back faces of double-sided materials,
// whose frame is flipped as a whole, otherwise 1.
// Cost: 50 operations, 4 roots.
fn tspace_applyThree(texel: vec3f, normal: vec3f, tangent: vec3f, bitangent: vec3f, face: f32) -> vec3f {
    return normalize(texel.x * normalize(tangent) + texel.y * normalize(bitangent) + texel.z * normalize(normal)) *
           face;
}

// Unreal: MikkTSpace per pixel, maps with two channels. Unreal's bitangents point along V, downward, like green in its
// maps.
// Cost: 46 operations, 2 roots.
fn tspace_applyUnreal(rg: vec2f, normal: vec3f, tangent: vec4f) -> vec3f {
    return tspace_applyMikktspace(tspace_texelOfTwo(rg), normal, tangent);
}

// Unity, URP and HDRP: MikkTSpace per pixel; x is red times alpha, which supports maps with x in red or in alpha. The
// sign from the vertex shader is TANGENT.w * unity_WorldTransformParams.w.
// Cost: 47 operations, 2 roots.
fn tspace_applyUnity(rgba: vec4f, normal: vec3f, tangent: vec4f) -> vec3f {
    return tspace_applyMikktspace(tspace_texelOfTwo(vec2f(rgba.r * rgba.a, rgba.g)), normal, tangent);
}

// Godot 4: bitangent per vertex, each vector normalized first, maps with two channels, and `depth` (normal_map_depth)
// blends with the normal.
// Cost: 65 operations, 5 roots.
fn tspace_applyGodot(rg: vec2f, normal: vec3f, tangent: vec3f, bitangent: vec3f, depth: f32) -> vec3f {
    let texel = tspace_texelOfTwo(rg);
    let n = normalize(normal);
    let mapped = texel.x * normalize(tangent) + texel.y * normalize(bitangent) + texel.z * n;
    return normalize(mix(n, mapped, depth));
}

// ---- deformed meshes: glTF's order is morphing, then skinning, then the node's matrix.

// Returns a frame after the linear map m (without the translation). T, a direction on the surface, is transformed by m
// itself. N is transformed by the cofactor matrix: cof(m) cross(a, b) = cross(m a, m b), and dot(cof(m) N, m T) =
// det(m) dot(N, T) = 0, so N and T remain perpendicular under any scale or shear, which m alone would not ensure;
// unlike the inverse transpose it needs no division and is valid for flat m. If m mirrors (det < 0), cof(m) N points
// inward: N is flipped outward again, and the sign with it, so that the bitangent remains m B. If m is flat, rounding
// decides the sign of det, so tiny volumes count as zero. A renderer that flips normals of back faces and cannot
// reverse the winding of such triangles (skins) needs N and the sign both negated: the bitangent is the same.
// Cost: 111 operations, 2 roots.
fn tspace_transformFrame(frame: tspace_Frame, m: mat3x3f) -> tspace_Frame {
    let c0 = cross(m[1], m[2]);
    let c1 = cross(m[2], m[0]);
    let c2 = cross(m[0], m[1]);
    let least = 0.000002 * tspace_sizeOf(m[0]) * tspace_sizeOf(m[1]) * tspace_sizeOf(m[2]);
    let s = tspace_signOf(dot(m[0], c0) + least);
    let n = (c0 * frame.normal.x + c1 * frame.normal.y + c2 * frame.normal.z) * s;
    let t = m[0] * frame.tangent.x + m[1] * frame.tangent.y + m[2] * frame.tangent.z;
    return tspace_Frame(tspace_unit(n, frame.normal), vec4f(tspace_unit(t, frame.tangent.xyz), frame.tangent.w * s));
}

// Returns the frame of a skinned vertex: linear blend skinning with up to four bones. The blended matrix that
// transforms the position transforms both N and T: blending frames of single bones instead would lose the right angle.
// Cost: 174 operations, 2 roots.
fn tspace_skinFrame(frame: tspace_Frame, bone0: mat3x3f, bone1: mat3x3f, bone2: mat3x3f, bone3: mat3x3f,
                    weights: vec4f) -> tspace_Frame {
    return tspace_transformFrame(frame, bone0 * weights.x + bone1 * weights.y + bone2 * weights.z + bone3 * weights.w);
}

// Returns a frame with morph targets: the deltas are the sums of weight times target. N is normalized, T is made unit
// and perpendicular to it; the sign is kept, as glTF's targets have none. If a sum has no direction, the original
// vector is kept.
// Cost: 65 operations, 3 roots, 1 division.
fn tspace_morphFrame(frame: tspace_Frame, normal_delta: vec3f, tangent_delta: vec3f) -> tspace_Frame {
    let n = tspace_unit(frame.normal + normal_delta, frame.normal);
    let t = tspace_unit(frame.tangent.xyz + tangent_delta, frame.tangent.xyz);
    return tspace_Frame(n, vec4f(tspace_unit(t - n * dot(n, t), tspace_axisAcross(n)), frame.tangent.w));
}

// ---- meshes without tangents

// Returns the frame from the change of position and UV between pixels: T along dP/du, perpendicular to N, and the sign
// of the UVs as seen along N. dP/du is constant over each triangle, so there are seams where stored tangents would be
// smooth. V must increase in the direction of green: for glTF pass (u, -v). If UVs do not change, T is any vector
// perpendicular to N.
// Cost: 91 operations, 3 roots, 1 division.
fn tspace_frameOfSteps(normal: vec3f, p_dx: vec3f, p_dy: vec3f, uv_dx: vec2f, uv_dy: vec2f) -> tspace_Frame {
    let n = normalize(normal);
    let area = uv_dx.x * uv_dy.y - uv_dx.y * uv_dy.x;
    let t = tspace_unit((p_dx * uv_dy.y - p_dy * uv_dx.y) * tspace_signOf(area), vec3f(0.0));
    let s = tspace_signOf(area) * tspace_signOf(dot(cross(p_dx, p_dy), n));
    return tspace_Frame(n, vec4f(tspace_unit(t - n * dot(n, t), tspace_axisAcross(n)), s));
}

// Calls tspace_frameOfSteps with the derivatives at this pixel, in fragment shaders. `position` must be in the space of
// `normal`.
// Cost: 91 operations, 3 roots, 1 division, 10 derivatives.
fn tspace_frameOfPixel(normal: vec3f, position: vec3f, uv: vec2f) -> tspace_Frame {
    return tspace_frameOfSteps(normal, dpdx(position), dpdy(position), dpdx(uv), dpdy(uv));
}
