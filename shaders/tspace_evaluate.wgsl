// SPDX-License-Identifier: MIT
// Written by scripts/shaders from tspace_evaluate.hlsl.
// Computes normals and tangents of a pose from a plan
// (planBuffers of tspace), in WGSL: one result per thread.
// Threads use no atomics and add in a fixed order, so results have the same bits in every run. docs/guides/gpu.md of
// tspace describes the buffers.
//
// Dispatch tspace_evaluate with 64 threads per group and ceil(results / 64) groups: in x, or in rows of 65535 along y.

// The words of a plan: PlanBuffers in plan_buffers.h.
@group(0) @binding(0) var<storage, read> tspace_plan: array<u32>;
// Layout of the arrays of a pose in their buffers: 32 words, whose indices are tspace_position_format and following.
@group(0) @binding(1) var<storage, read> tspace_settings: array<u32>;
@group(0) @binding(2) var<storage, read> tspace_positions: array<u32>;
// Morph deltas, joints, weights and matrices, if the settings enable them.
@group(0) @binding(3) var<storage, read> tspace_deform: array<u32>;
// Written if the plan computes normals, otherwise read.
@group(0) @binding(4) var<storage, read_write> tspace_normals: array<u32>;
@group(0) @binding(5) var<storage, read_write> tspace_tangents: array<u32>;

// Words of tspace_settings. Offsets and strides are in bytes.
const tspace_position_format: u32 = 0u;  // 0: three floats; 1: three snorm16, times the scale
const tspace_position_offset: u32 = 1u;
const tspace_position_stride: u32 = 2u;
const tspace_position_scale: u32 = 3u;  // three floats
const tspace_normal_format: u32 = 6u;   // 0: no normals are written; 1: three floats. Input normals are always floats
const tspace_normal_offset: u32 = 7u;
const tspace_normal_stride: u32 = 8u;
const tspace_tangent_format: u32 = 9u;  // 0: T and sign as four floats; 1: frame32; 2: oct32; 3: snorm8 pair
const tspace_tangent_offset: u32 = 10u;
const tspace_tangent_stride: u32 = 11u;
const tspace_morph_count: u32 = 12u;      // number of morph targets, consecutive arrays of three floats per vertex; 0: none
const tspace_morph_weights: u32 = 13u;    // word offset of the weights in tspace_deform
const tspace_morph_deltas: u32 = 14u;     // word offset of the deltas in tspace_deform
const tspace_vertex_count: u32 = 15u;     // number of vertices of the morph targets
const tspace_skin: u32 = 16u;             // 1: skinned with four joints per vertex
const tspace_skin_joints: u32 = 17u;      // word offset of the joints in tspace_deform: 4 words per vertex
const tspace_skin_weights: u32 = 18u;     // word offset of the joint weights: 4 floats per vertex
const tspace_skin_matrices: u32 = 19u;    // word offset of the matrices: 3 rows of 4 floats per joint
const tspace_first_result: u32 = 20u;     // first result of this dispatch

const tspace_no_tangent: u32 = 0x80000000u;
const tspace_no_normal: u32 = 0x40000000u;
const tspace_next_part: u32 = 0xffffffffu;
const tspace_doubles: u32 = 0xffffffffu;
const tspace_least_normal: f32 = 1.17549435e-38;
const tspace_greatest: f32 = 3.4e38;

fn tspace_setting(word: u32) -> u32 { return tspace_settings[word]; }
fn tspace_float(word: u32) -> f32 { return bitcast<f32>(tspace_settings[word]); }

// Returns whether a component is neither zero nor subnormal; NaN counts as zero.
fn tspace_notZero(v: vec3f) -> bool {
    return abs(v.x) > tspace_least_normal || abs(v.y) > tspace_least_normal || abs(v.z) > tspace_least_normal;
}
fn tspace_isFinite(v: vec3f) -> bool {
    return abs(v.x) < tspace_greatest && abs(v.y) < tspace_greatest && abs(v.z) < tspace_greatest;
}
fn tspace_normalized(v: vec3f) -> vec3f {
    if (!tspace_notZero(v)) {
        return v;
    }
    return (1.0 / sqrt(dot(v, v))) * v;
}
// Returns v without its component along n, as a unit vector. n is used as given, without normalization.
fn tspace_flatten(n: vec3f, v: vec3f) -> vec3f { return tspace_normalized(v - dot(n, v) * n); }

fn tspace_arcCosine(cosine: f32) -> f32 {
    var c: f32 = clamp(cosine, -1.0, 1.0);
    var a: f32 = abs(c);
    var is_steep: bool = a > 0.5;
    var y: f32 = a * a;
    if (is_steep) {
        y = 0.5 - 0.5 * a;
    }
    var s: f32 = sqrt(y);
    var p: f32 = ((((0.0421632 * y + 0.0241812) * y + 0.0454702) * y + 0.0749530) * y + 0.1666675) * y;
    var arc: f32 = s + s * p;
    if (!is_steep) {
        if (c < 0.0) {
            return 1.57079637 + arc;
        }
        return 1.57079637 - arc;
    }
    if (c < 0.0) {
        return 3.14159274 - 2.0 * arc;
    }
    return 2.0 * arc;
}

// Returns the angle in [0, pi] of the direction (x, y), where y is not negative.
fn tspace_angle(x: f32, y: f32) -> f32 {
    var size: f32 = abs(x);
    var t: f32 = min(size, y) / max(max(size, y), tspace_least_normal);
    var q: f32 = t * t;
    var p: f32 = -2.386997316e-03;
    p = p * q + 1.350777142e-02;
    p = p * q - 3.587153898e-02;
    p = p * q + 6.250169444e-02;
    p = p * q - 8.656880430e-02;
    p = p * q + 1.103376412e-01;
    p = p * q - 1.427856875e-01;
    p = p * q + 1.999973933e-01;
    p = p * q - 3.333333173e-01;
    var angle: f32 = t + t * (q * p);
    if (size <= y) {
        angle = 1.57079637 - angle;
    }
    if (x < 0.0) {
        return 3.14159274 - angle;
    }
    return angle;
}

// ---- inputs of a pose

// Returns v. Compilers cannot know that v is unchanged, because they do not know the version in the first word of a plan,
// so they cannot fuse or reorder the operations before and after. The operations between such calls are additions,
// subtractions and multiplications, which round equally on all devices.
fn tspace_kept(v: vec3f) -> vec3f {
    var zero: u32 = tspace_plan[0] ^ 1u;
    return vec3f(bitcast<f32>(bitcast<u32>(v.x) ^ zero), bitcast<f32>(bitcast<u32>(v.y) ^ zero), bitcast<f32>(bitcast<u32>(v.z) ^ zero));
}

fn tspace_shortAt(byte: u32) -> f32 {
    var word: u32 = tspace_positions[byte >> 2u];
    if ((byte & 2u) == 0u) {
        word = word << 16u;
    }
    return max(f32(i32(word) >> 16u) / 32767.0, -1.0);
}

fn tspace_storedPosition(vertex_number: u32) -> vec3f {
    var at: u32 = tspace_setting(tspace_position_offset) + vertex_number * tspace_setting(tspace_position_stride);
    var scale: vec3f = vec3f(tspace_float(tspace_position_scale), tspace_float(tspace_position_scale + 1u),
                          tspace_float(tspace_position_scale + 2u));
    if (tspace_setting(tspace_position_format) == 1u) {
        return scale * vec3f(tspace_shortAt(at), tspace_shortAt(at + 2u), tspace_shortAt(at + 4u));
    }
    var word: u32 = at >> 2u;
    return vec3f(bitcast<f32>(tspace_positions[word]), bitcast<f32>(tspace_positions[word + 1u]),
                  bitcast<f32>(tspace_positions[word + 2u]));
}

fn tspace_deformVector(word: u32, step: u32) -> vec3f {
    return vec3f(bitcast<f32>(tspace_deform[word]), bitcast<f32>(tspace_deform[word + step]),
                  bitcast<f32>(tspace_deform[word + 2u * step]));
}

fn tspace_morphed(position: vec3f, vertex_number: u32) -> vec3f {
    var sum: vec3f = position;
    var count: u32 = tspace_setting(tspace_morph_count);
    for (var shape: u32 = 0u; shape < count; shape++) {
        var weight: f32 = bitcast<f32>(tspace_deform[tspace_setting(tspace_morph_weights) + shape]);
        var row: u32 = 3u * (shape * tspace_setting(tspace_vertex_count) + vertex_number);
        if (weight != 0.0) {
            sum = tspace_kept(sum + tspace_kept(weight * tspace_deformVector(tspace_setting(tspace_morph_deltas) + row, 1u)));
        }
    }
    return sum;
}

fn tspace_skinned(position: vec3f, vertex_number: u32) -> vec3f {
    var sum: vec3f = vec3f(0.0, 0.0, 0.0);
    for (var i: u32 = 0u; i < 4u; i++) {
        var weight: f32 = bitcast<f32>(tspace_deform[tspace_setting(tspace_skin_weights) + 4u * vertex_number + i]);
        var joint: u32 = tspace_deform[tspace_setting(tspace_skin_joints) + 4u * vertex_number + i];
        var row: u32 = tspace_setting(tspace_skin_matrices) + 12u * joint;
        if (weight != 0.0) {
            var moved: vec3f = tspace_kept(position.x * tspace_deformVector(row, 4u));
            moved = tspace_kept(moved + tspace_kept(position.y * tspace_deformVector(row + 1u, 4u)));
            moved = tspace_kept(moved + tspace_kept(position.z * tspace_deformVector(row + 2u, 4u)));
            moved = tspace_kept(moved + tspace_deformVector(row + 3u, 4u));
            sum = tspace_kept(sum + tspace_kept(weight * moved));
        }
    }
    return sum;
}

// Returns the position of a vertex: stored, then morphed, then skinned.
fn tspace_positionOf(vertex_number: u32) -> vec3f {
    var position: vec3f = tspace_storedPosition(vertex_number);
    if (tspace_setting(tspace_morph_count) != 0u) {
        position = tspace_morphed(position, vertex_number);
    }
    if (tspace_setting(tspace_skin) != 0u) {
        position = tspace_skinned(position, vertex_number);
    }
    return position;
}

fn tspace_normalOf(vertex_number: u32) -> vec3f {
    var word: u32 = (tspace_setting(tspace_normal_offset) + vertex_number * tspace_setting(tspace_normal_stride)) >> 2u;
    var normal: vec3f =
        vec3f(bitcast<f32>(tspace_normals[word]), bitcast<f32>(tspace_normals[word + 1u]), bitcast<f32>(tspace_normals[word + 2u]));
    if ((tspace_plan[2] & 4u) == 0u) {
        return normal;
    }
    // Lengths that differ from 1 by no more than rounding to 8 bits explains are not changed.
    var square: f32 = dot(normal, normal);
    if (abs(square - 1.0) <= 0.0134 || !(square >= 1e-12) || !(square < tspace_greatest)) {
        return normal;
    }
    return normal / sqrt(square);
}

// ---- triangles of a plan

// A corner of a triangle.
struct tspace_Corner {
    e1: vec3f,        // first edge of the triangle: from corner 0 to corner 1
    e2: vec3f,        // second edge: from corner 0 to corner 2
    next: vec3f,      // from this corner to the next one
    previous: vec3f,  // from this corner to the previous one
    p0: vec3f,        // positions of the triangle
    p1: vec3f,
    p2: vec3f,
    vertex_number: u32,
    uvs: u32,  // offset of the UV coefficients in tspace_plan
}

fn tspace_vertexOf(entry: u32) -> u32 {
    return tspace_plan[tspace_plan[10] + ((entry & 0x3fffffffu) >> 2u) * tspace_plan[7] + (entry & 3u)];
}

fn tspace_cornerOf(entry: u32) -> tspace_Corner {
    var k: u32 = entry & 3u;
    var at: u32 = tspace_plan[10] + ((entry & 0x3fffffffu) >> 2u) * tspace_plan[7];
    var p0: vec3f = vec3f(0.0, 0.0, 0.0);
    var p1: vec3f = p0;
    var p2: vec3f = p0;
    for (var i: u32 = 0u; i < 3u; i++) {  // a loop, so that compilers inline the called functions only once
        p0 = p1;
        p1 = p2;
        p2 = tspace_positionOf(tspace_plan[at + i]);
    }
    var corner: tspace_Corner;
    corner.p0 = p0;
    corner.p1 = p1;
    corner.p2 = p2;
    corner.e1 = p1 - p0;
    corner.e2 = p2 - p0;
    corner.next = corner.e1;
    corner.previous = corner.e2;
    if (k == 1u) {
        corner.next = p2 - p1;
        corner.previous = p0 - p1;
    }
    if (k == 2u) {
        corner.next = p0 - p2;
        corner.previous = p1 - p2;
    }
    corner.vertex_number = tspace_plan[at + k];
    corner.uvs = at + 3u;
    return corner;
}

fn tspace_largest(v: vec3f) -> f32 { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Returns an even power of two near 1 / size. Its square root is a power of two too.
fn tspace_inverseSize(size: f32) -> f32 {
    var exponent: u32 = clamp(bitcast<u32>(size) >> 23u, 1u, 253u);
    return bitcast<f32>(((254u - exponent) | 1u) << 23u);
}

// Returns a power of two that scales the edges of a result to about 1, so that products stay in range; 0 without edges.
fn tspace_scaleOf(begin: u32, end: u32) -> f32 {
    var largest: f32 = 0.0;
    for (var i: u32 = begin; i < end; i++) {
        var entry: u32 = tspace_plan[i];
        if (entry != tspace_next_part) {
            var corner: tspace_Corner = tspace_cornerOf(entry);
            var size: f32 = max(tspace_largest(corner.e1), tspace_largest(corner.e2));
            if (size < tspace_greatest) {
                largest = max(largest, size);
            }
        }
    }
    if (largest == 0.0) {
        return 0.0;
    }
    return tspace_inverseSize(largest);
}

// ---- normals

// Returns the triangle's normal, with length twice the area, from its two shortest edges, where cancellation is smallest.
fn tspace_faceNormal(e1: vec3f, e2: vec3f) -> vec3f {
    var e3: vec3f = e2 - e1;
    var a: f32 = dot(e1, e1);
    var b: f32 = dot(e2, e2);
    var c: f32 = dot(e3, e3);
    if (a >= b && a >= c) {
        return cross(e2, e3);
    }
    if (b >= c) {
        return cross(e1, e3);
    }
    return cross(e1, e2);
}

// Returns the weight of a triangle's unit normal at a corner. `area`: twice the area of the triangle.
fn tspace_normalWeight(corner: tspace_Corner, scale: f32, area: f32) -> f32 {
    var weighting: u32 = tspace_plan[3];
    var weight: f32 = 1.0;
    if (weighting == 3u || weighting == 4u) {
        weight = tspace_angle(dot(scale * corner.next, scale * corner.previous), area);
    }
    if (weighting == 2u || weighting == 4u) {
        weight *= area;
    }
    if (weighting == 5u) {
        var next: vec3f = scale * corner.next;
        var previous: vec3f = scale * corner.previous;
        weight = (area / dot(next, next)) / dot(previous, previous);
    }
    return weight;
}

// Returns the normal of a result. w is 1 if the mean is zero: the normal is then that of the result's own triangle, so
// other corners of the vertex have different normals.
fn tspace_normalOfResult(begin: u32, end: u32, own: u32, scale: f32) -> vec4f {
    var factor: f32 = 1.0;
    if ((tspace_plan[2] & 2u) != 0u) {
        factor = -1.0;
    }
    var sum: vec3f = vec3f(0.0, 0.0, 0.0);
    var own_normal: vec3f = vec3f(0.0, 0.0, factor);
    var weights: f32 = 0.0;
    // The last iteration is the corner's own triangle, which is used if the mean is zero.
    for (var i: u32 = begin; i <= end; i++) {
        var entry: u32 = own;
        if (i < end) {
            entry = tspace_plan[i];
        }
        var is_own: bool = i == end && entry != tspace_next_part;
        if (is_own || (i < end && (entry & tspace_no_normal) == 0u)) {
            var corner: tspace_Corner = tspace_cornerOf(entry);
            var n: vec3f = tspace_faceNormal(scale * corner.e1, scale * corner.e2);
            var area: f32 = sqrt(dot(n, n));
            if (area > 0.0 && area < tspace_greatest) {
                if (is_own) {
                    own_normal = n / area;
                } else {
                    var weight: f32 = tspace_normalWeight(corner, scale, area);
                    sum += (weight / area) * n;
                    weights += weight;
                }
            }
        }
    }
    var size: f32 = sqrt(dot(sum, sum));
    if (size > 1e-6 * weights) {
        var mean: vec3f = (factor / size) * sum;
        return vec4f(mean.x, mean.y, mean.z, 0.0);
    }
    own_normal = factor * own_normal;
    return vec4f(own_normal.x, own_normal.y, own_normal.z, 1.0);
}

// Returns the normal of a corner's result.
fn tspace_normalAt(entry: u32, vertex_number: u32) -> vec3f {
    var result: u32 = vertex_number;
    if ((tspace_plan[2] & 8u) != 0u) {
        result = 3u * ((entry & 0x3fffffffu) >> 2u) + (entry & 3u);
    }
    var row: u32 = tspace_plan[8] + 3u * result;
    var begin: u32 = tspace_plan[9] + tspace_plan[row];
    var end: u32 = begin + (tspace_plan[row + 1u] & 0x0fffffffu);
    var made: vec4f = tspace_normalOfResult(begin, end, tspace_plan[row + 2u], tspace_scaleOf(begin, end));
    return vec3f(made.x, made.y, made.z);
}

// ---- double precision, in integers: lengyel, where the library computes in double precision, with the same bits

// The number (high, low) * 2^exponent, negated if sign is 1. The first bit of `high` is 1, unless the number is 0.
struct tspace_Double {
    sign: u32,
    exponent: i32,
    high: u32,
    low: u32,
}

// Returns the number (high, low) * 2^exponent rounded to 53 bits, to the nearest, or to the even one of two.
fn tspace_rounded(sign: u32, exponent: i32, high: u32, low: u32) -> tspace_Double {
    var made: tspace_Double;
    made.sign = sign;
    made.exponent = exponent;
    made.high = high;
    made.low = low;
    if ((high | low) == 0u) {
        return made;
    }
    while (made.high < 0x80000000u) {
        made.high = (made.high << 1u) | (made.low >> 31u);
        made.low = made.low << 1u;
        made.exponent -= 1;
    }
    var rest: u32 = made.low & 2047u;
    made.low -= rest;
    if (rest > 1024u || (rest == 1024u && (made.low & 2048u) != 0u)) {
        made.low += 2048u;
        if (made.low == 0u) {
            made.high += 1u;
        }
        if (made.high == 0u) {
            made.high = 0x80000000u;
            made.exponent += 1;
        }
    }
    return made;
}

// Returns a float as a double.
fn tspace_widened(x: f32) -> tspace_Double {
    var made: tspace_Double;
    made.sign = bitcast<u32>(x) >> 31u;
    made.exponent = i32((bitcast<u32>(x) >> 23u) & 255u) - 190;
    made.high = (bitcast<u32>(x) << 8u) | 0x80000000u;
    made.low = 0u;
    if (made.exponent == -190) {
        made.exponent = -189;
        made.high = (bitcast<u32>(x) << 9u) >> 1u;
        while (made.high != 0u && made.high < 0x80000000u) {
            made.high = made.high << 1u;
            made.exponent -= 1;
        }
    }
    return made;
}

// Returns a double of the plan: a word with its high bits, and one with its low bits.
fn tspace_storedDouble(word: u32) -> tspace_Double {
    var bits: u32 = tspace_plan[word];
    var made: tspace_Double;
    made.sign = bits >> 31u;
    made.exponent = i32((bits >> 20u) & 2047u) - 1086;
    made.high = 0u;
    made.low = tspace_plan[word + 1u] << 11u;
    if (made.exponent != -1086) {
        made.high = 0x80000000u | (bits << 11u) | (tspace_plan[word + 1u] >> 21u);
    }
    return made;
}

// Returns the nearest float to d * 2^shift.
fn tspace_narrowed(d: tspace_Double, shift: i32) -> f32 {
    var field: i32 = clamp(d.exponent + shift + 190, -31, 255);
    var count: u32 = 8u;
    if (field < 1) {
        count = u32(9 - field);
        field = 1;
    }
    var bits: u32 = d.high;
    var last: u32 = 0u;
    var lost: u32 = d.low;
    for (var i: u32 = 0u; i < count; i++) {
        lost = lost | last;
        last = bits & 1u;
        bits = bits >> 1u;
    }
    if (last != 0u && (lost | (bits & 1u)) != 0u) {
        bits += 1u;
    }
    if (d.high != 0u) {
        bits += u32(field - 1) << 23u;
    }
    return bitcast<f32>(min(bits, 0x7f800000u) | (d.sign << 31u));
}

// Returns a * b.
fn tspace_product(a: tspace_Double, b: tspace_Double) -> tspace_Double {
    var a_high: u32 = a.high >> 1u;
    var a_low: u32 = (a.high << 31u) | (a.low >> 1u);
    var bits: u32 = b.low >> 11u;
    var high: u32 = 0u;
    var low: u32 = 0u;
    var lost: u32 = 0u;
    for (var i: u32 = 0u; i < 53u; i++) {
        if (i == 21u) {
            bits = b.high;
        }
        if ((bits & 1u) != 0u) {
            high += a_high;
            low += a_low;
            if (low < a_low) {
                high += 1u;
            }
        }
        bits = bits >> 1u;
        lost = lost | (low & 1u);
        low = (low >> 1u) | (high << 31u);
        high = high >> 1u;
    }
    return tspace_rounded(a.sign ^ b.sign, a.exponent + b.exponent + 65, high, low | lost);
}

fn tspace_negated(a: tspace_Double) -> tspace_Double {
    var made: tspace_Double = a;
    made.sign = 1u - a.sign;
    return made;
}

// Returns whether |a| < |b|.
fn tspace_isSmaller(a: tspace_Double, b: tspace_Double) -> bool {
    if (a.exponent != b.exponent) {
        return a.exponent < b.exponent;
    }
    return a.high < b.high || (a.high == b.high && a.low < b.low);
}

// Returns a + b.
fn tspace_total(a: tspace_Double, b: tspace_Double) -> tspace_Double {
    if (b.high == 0u) {
        return a;
    }
    if (a.high == 0u) {
        return b;
    }
    var large: tspace_Double = a;
    var small: tspace_Double = b;
    if (tspace_isSmaller(a, b)) {
        large = b;
        small = a;
    }
    var lost: u32 = 0u;
    var count: u32 = min(u32(large.exponent - small.exponent), 64u);
    for (var i: u32 = 0u; i <= count; i++) {
        lost = lost | (small.low & 1u);
        small.low = (small.low >> 1u) | (small.high << 31u);
        small.high = small.high >> 1u;
    }
    small.low = small.low | lost;
    var low: u32 = (large.high << 31u) | (large.low >> 1u);
    var high: u32 = large.high >> 1u;
    if (large.sign == small.sign) {
        high += small.high;
        low += small.low;
        if (low < small.low) {
            high += 1u;
        }
    }
    if (large.sign != small.sign) {
        high -= small.high;
        if (low < small.low) {
            high -= 1u;
        }
        low -= small.low;
    }
    return tspace_rounded(large.sign, large.exponent + 1, high, low);
}

fn tspace_difference(a: tspace_Double, b: tspace_Double) -> tspace_Double { return tspace_total(a, tspace_negated(b)); }

// Returns the next axis as x. Loops that rotate vectors, here and below, call each function once, because compilers
// inline all calls.
fn tspace_turned(v: vec3f) -> vec3f { return vec3f(v.y, v.z, v.x); }

// Returns whether the determinant of three vectors is negative.
fn tspace_isMirrored(normal: vec3f, along_u: vec3f, along_v: vec3f) -> bool {
    var n: vec3f = normal;
    var s: vec3f = along_u;
    var t: vec3f = along_v;
    var volume: tspace_Double = tspace_widened(0.0);
    for (var i: u32 = 0u; i < 3u; i++) {
        var first: tspace_Double = tspace_product(tspace_widened(n.y), tspace_widened(s.z));
        var second: tspace_Double = tspace_product(tspace_widened(n.z), tspace_widened(s.y));
        volume = tspace_total(volume, tspace_product(tspace_difference(first, second), tspace_widened(t.x)));
        n = tspace_turned(n);
        s = tspace_turned(s);
        t = tspace_turned(t);
    }
    return volume.sign == 1u && volume.high != 0u;
}

// Returns s without its component along the unit vector n, times a power of two.
fn tspace_wideRest(normal: vec3f, along_u: vec3f) -> vec3f {
    var n: vec3f = normal;
    var s: vec3f = along_u;
    var along: tspace_Double = tspace_widened(0.0);
    for (var i: u32 = 0u; i < 3u; i++) {
        along = tspace_total(along, tspace_product(tspace_widened(n.x), tspace_widened(s.x)));
        n = tspace_turned(n);
        s = tspace_turned(s);
    }
    var x: tspace_Double = along;
    var y: tspace_Double = along;
    var z: tspace_Double = along;
    var largest: i32 = -2000;
    for (var k: u32 = 0u; k < 3u; k++) {
        x = y;
        y = z;
        z = tspace_difference(tspace_widened(s.x), tspace_product(along, tspace_widened(n.x)));
        if (z.high != 0u) {
            largest = max(largest, z.exponent);
        }
        n = tspace_turned(n);
        s = tspace_turned(s);
    }
    var shift: i32 = -64 - largest;
    return vec3f(tspace_narrowed(x, shift), tspace_narrowed(y, shift), tspace_narrowed(z, shift));
}

// Sums over the corners of a result. `a`: tangents. `b`: a second sum, for fast and lengyel.
struct tspace_Sums {
    a: vec3f,
    b: vec3f,
}

// Returns a UV coefficient of the plan.
fn tspace_coefficient(is_double: bool, word: u32) -> tspace_Double {
    if (is_double) {
        return tspace_storedDouble(word);
    }
    return tspace_widened(bitcast<f32>(tspace_plan[word]));
}

// Returns dP/du and dP/dv of the triangle of a corner, rounded to floats.
fn tspace_wideDerivatives(corner: tspace_Corner) -> tspace_Sums {
    var is_double: bool = tspace_plan[corner.uvs] == tspace_doubles;
    var word: u32 = corner.uvs;
    var step: u32 = 1u;
    var factor: tspace_Double = tspace_widened(1.0);
    if (is_double) {
        word = tspace_plan[corner.uvs + 1u] + 2u;
        step = 2u;
        factor = tspace_storedDouble(word - 2u);
    }
    var o: vec3f = corner.p0;
    var p: vec3f = corner.p1;
    var q: vec3f = corner.p2;
    var made: tspace_Sums;
    made.a = o;
    made.b = o;
    for (var i: u32 = 0u; i < 6u; i++) {
        if (i == 3u) {
            p = corner.p2;
            q = corner.p1;
            word += 2u * step;
        }
        var origin: tspace_Double = tspace_widened(o.x);
        var first: tspace_Double = tspace_product(tspace_coefficient(is_double, word),
                                             tspace_difference(tspace_widened(p.x), origin));
        var second: tspace_Double = tspace_product(tspace_coefficient(is_double, word + step),
                                              tspace_difference(tspace_widened(q.x), origin));
        var value: tspace_Double = tspace_product(factor, tspace_difference(first, second));
        made.a = vec3f(made.a.y, made.a.z, made.b.x);
        made.b = vec3f(made.b.y, made.b.z, tspace_narrowed(value, 0));
        o = tspace_turned(o);
        p = tspace_turned(p);
        q = tspace_turned(q);
    }
    return made;
}

// ---- tangents

// Returns a * x - b * y for the coefficients a and b at a word of the plan, with the same bits on every device.
fn tspace_combined(word: u32, x: vec3f, y: vec3f) -> vec3f {
    var first: vec3f = tspace_kept(bitcast<f32>(tspace_plan[word]) * tspace_kept(x));
    return tspace_kept(first - tspace_kept(bitcast<f32>(tspace_plan[word + 1u]) * tspace_kept(y)));
}

// Returns dP/du and dP/dv of the triangle of a corner, with the bits of the library.
fn tspace_derivatives(corner: tspace_Corner) -> tspace_Sums {
    var made: tspace_Sums;
    made.a = tspace_combined(corner.uvs, corner.e1, corner.e2);
    made.b = tspace_combined(corner.uvs + 2u, corner.e2, corner.e1);
    var is_wide: bool = tspace_plan[corner.uvs] == tspace_doubles || !tspace_isFinite(made.a) || !tspace_isFinite(made.b);
    if (is_wide && tspace_isFinite(corner.p0) && tspace_isFinite(corner.p1) && tspace_isFinite(corner.p2)) {
        return tspace_wideDerivatives(corner);
    }
    return made;
}

// Returns what a corner adds to the sum of mikktspace, uniform, angle and area: its unit tangent perpendicular to the
// normal, times its weight.
fn tspace_weightedTangent(corner: tspace_Corner, n: vec3f, method: u32) -> vec3f {
    var along: vec3f = tspace_combined(corner.uvs, corner.e1, corner.e2);
    var size: f32 = sqrt(dot(along, along));
    var tangent: vec3f = vec3f(0.0, 0.0, 0.0);
    if (size > tspace_least_normal) {
        tangent = tspace_flatten(n, (1.0 / size) * along);
    }
    var weight: f32 = 1.0;
    if (method == 0u) {
        weight = tspace_arcCosine(dot(tspace_flatten(n, corner.previous), tspace_flatten(n, corner.next)));
    }
    if (method == 3u) {
        weight = tspace_arcCosine(dot(tspace_normalized(corner.previous), tspace_normalized(corner.next)));
    }
    if (method == 4u) {
        var c: vec3f = cross(corner.next, corner.previous);
        weight = 0.5 * sqrt(dot(c, c));
    }
    return weight * tangent;
}

// Returns what a corner adds to the two sums of fast: `a` is accurate on smooth surfaces, `b` is robust.
fn tspace_twoWeights(corner: tspace_Corner, scale: f32) -> tspace_Sums {
    var sums: tspace_Sums;
    sums.a = vec3f(0.0, 0.0, 0.0);
    sums.b = vec3f(0.0, 0.0, 0.0);
    var e1: vec3f = scale * corner.e1;
    var e2: vec3f = scale * corner.e2;
    var e3: vec3f = scale * (corner.p2 - corner.p1);
    var squares: f32 = dot(e1, e1) + dot(e3, e3) + dot(e2, e2);
    if (!(squares < tspace_greatest)) {
        return sums;
    }
    var along: vec3f = tspace_combined(corner.uvs, e1, e2);
    var size: f32 = sqrt(dot(along, along));
    var c: vec3f = cross(e1, e2);
    var area: f32 = sqrt(dot(c, c));
    var root: f32 = sqrt(squares);
    var next: vec3f = scale * corner.next;
    var previous: vec3f = scale * corner.previous;
    var w: f32 = (1.0 / dot(next, next)) * (1.0 / dot(previous, previous));
    if (w < tspace_greatest) {
        sums.a = w * along;
    }
    var robust: f32 = (area * area) / (root * sqrt(root));
    if (size > 0.0 && robust < tspace_greatest) {
        sums.b = (robust / size) * along;
    }
    return sums;
}

// Returns v as a unit vector, or zero.
fn tspace_direction(v: vec3f) -> vec3f {
    var square: f32 = dot(v, v);
    if (square > 0.0 && square < tspace_greatest) {
        return (1.0 / sqrt(square)) * v;
    }
    return vec3f(0.0, 0.0, 0.0);
}

// Returns the normal as a unit vector, (0, 0, 1) if it has no direction.
fn tspace_unitNormal(normal: vec3f) -> vec3f {
    var n: vec3f = tspace_direction(normal);
    if (dot(n, n) == 0.0) {
        n = vec3f(0.0, 0.0, 1.0);
    }
    return n;
}

// Returns the part of v that is perpendicular to the unit vector n, as a unit vector, or zero.
fn tspace_across(n: vec3f, v: vec3f) -> vec3f { return tspace_direction(v - dot(n, v) * n); }

fn tspace_mixed(normal: vec3f, sums: tspace_Sums) -> vec3f {
    var n: vec3f = tspace_unitNormal(normal);
    var accurate: vec3f = tspace_across(n, tspace_inverseSize(tspace_largest(sums.a)) * sums.a);
    var robust: vec3f = tspace_across(n, tspace_inverseSize(tspace_largest(sums.b)) * sums.b);
    var across: vec3f = cross(accurate, robust);
    var square: f32 = dot(across, across);
    if (dot(accurate, robust) < 0.0) {
        square = 1.0;
    }
    var r: f32 = square / 0.00351691;
    var m: f32 = r / (1.0 + r);
    if (dot(accurate, accurate) == 0.0) {
        m = 1.0;
    }
    return tspace_direction((1.0 - m) * accurate + m * robust);
}

// Returns the tangent of lengyel from the sums of dP/du and dP/dv, by Gram-Schmidt. w: the sign.
fn tspace_fromDerivatives(n: vec3f, sums: tspace_Sums) -> vec4f {
    var largest: f32 = tspace_largest(sums.a);
    if (!(largest > 0.0) || !(largest < tspace_greatest) || !tspace_isFinite(n)) {
        return vec4f(1.0, 0.0, 0.0, 1.0);
    }
    var s: vec3f = sums.a / largest;
    var b: vec3f = sums.b / max(tspace_largest(sums.b), tspace_least_normal);
    var along: f32 = dot(n, s);
    var rest: vec3f = s - along * n;
    var volume: f32 = dot(cross(n, rest), b);
    var is_mirrored: bool = volume < 0.0;
    // Far from these limits, rounding does not decide.
    var size: f32 = tspace_largest(rest);
    if (!(size > 0.0625 * abs(along)) || !(abs(volume) > 0.001 * size)) {
        rest = tspace_wideRest(n, sums.a);
        is_mirrored = tspace_isMirrored(n, sums.a, sums.b);
        size = tspace_largest(rest);
    }
    if (!(size > 0.0)) {
        return vec4f(1.0, 0.0, 0.0, 1.0);
    }
    var t: vec3f = tspace_direction(rest / size);
    var sign: f32 = 1.0;
    if (is_mirrored) {
        sign = -1.0;
    }
    return vec4f(t.x, t.y, t.z, sign);
}

// Returns the tangent for a sum: normalized, or the default if it is zero and the result's flags request that.
fn tspace_finish(normal: vec3f, sums: tspace_Sums, method: u32, flags: u32) -> vec3f {
    var tangent: vec3f = sums.a;
    if (method == 7u) {
        tangent = tspace_mixed(normal, sums);
    }
    if (method != 7u) {
        tangent = tspace_normalized(tangent);
    }
    if ((flags & 0x40000000u) != 0u && !tspace_notZero(tangent) && tangent.x == tangent.x) {
        return vec3f(1.0, 0.0, 0.0);
    }
    return tangent;
}

fn tspace_tangentOfResult(begin: u32, end: u32, flags: u32, made_normal: vec3f, scale: f32) -> vec4f {
    var method: u32 = tspace_plan[1];
    var makes_normals: bool = (tspace_plan[2] & 1u) != 0u;
    var sign: f32 = 1.0;
    if ((flags & 0x80000000u) != 0u) {
        sign = -1.0;
    }
    var normal: vec3f = made_normal;
    var sums: tspace_Sums;
    sums.a = vec3f(0.0, 0.0, 0.0);
    sums.b = vec3f(0.0, 0.0, 0.0);
    var merged: vec3f = vec3f(0.0, 0.0, 0.0);
    var has_parts: bool = false;
    for (var i: u32 = begin; i < end; i++) {
        var entry: u32 = tspace_plan[i];
        if (entry == tspace_next_part) {
            var part: vec3f = tspace_finish(normal, sums, method, flags);
            if (has_parts) {
                part = tspace_normalized(merged + part);
            }
            merged = part;
            has_parts = true;
            sums.a = vec3f(0.0, 0.0, 0.0);
            sums.b = vec3f(0.0, 0.0, 0.0);
        }
        if ((entry & tspace_no_tangent) == 0u) {
            var corner: tspace_Corner = tspace_cornerOf(entry);
            if (!makes_normals) {
                normal = tspace_normalOf(corner.vertex_number);
            }
            if (method == 1u) {
                var more: tspace_Sums = tspace_derivatives(corner);
                if (tspace_isFinite(more.a) && tspace_isFinite(more.b)) {
                    sums.a = tspace_kept(sums.a + more.a);
                    sums.b = tspace_kept(sums.b + more.b);
                }
            }
            if (method == 7u) {
                var more: tspace_Sums = tspace_twoWeights(corner, scale);
                sums.a += more.a;
                sums.b += more.b;
            }
            if (method != 1u && method != 7u) {
                var n: vec3f = normal;
                if ((flags & 0x10000000u) != 0u) {
                    n = tspace_normalAt(entry, corner.vertex_number);
                }
                sums.a += tspace_weightedTangent(corner, n, method);
            }
        }
    }
    if (method == 1u) {
        var frame: vec4f = tspace_fromDerivatives(normal, sums);
        return vec4f(frame.x, frame.y, frame.z, sign * frame.w);
    }
    var tangent: vec3f = tspace_finish(normal, sums, method, flags);
    if (has_parts) {
        tangent = tspace_normalized(merged + tangent);
    }
    return vec4f(tangent.x, tangent.y, tangent.z, sign);
}

// ---- output formats

fn tspace_byte(x: f32) -> u32 { return u32(i32(floor(clamp(x, -1.0, 1.0) * 127.0 + 0.5))) & 255u; }

// Returns the normal at a grid point of oct32; w: the sign of z.
fn tspace_octNormal(i: f32, j: f32) -> vec4f {
    var a: f32 = abs(i - 511.0);
    var b: f32 = abs(j - 511.0);
    var rest: f32 = 511.0 - a - b;
    a += min(rest, 0.0);
    b += min(rest, 0.0);
    var c: f32 = abs(rest);
    var n: vec3f = tspace_direction(vec3f(a * (1277.5 - a), b * (1277.5 - b), c * (1277.5 - c)));
    var sign: f32 = 1.0;
    if (rest < 0.0) {
        sign = -1.0;
    }
    var x: f32 = n.x;
    var y: f32 = n.y;
    if (i < 511.0) {
        x = -x;
    }
    if (j < 511.0) {
        y = -y;
    }
    return vec4f(x, y, sign * n.z, sign);
}

// Returns the direction of angle 0 around a grid normal; tspace_octAlong returns the direction a quarter turn further.
fn tspace_octAcross(n: vec4f) -> vec3f {
    var h: f32 = -1.0 / (n.w + n.z);
    return vec3f(1.0 + n.w * n.x * n.x * h, n.w * n.x * n.y * h, -n.w * n.x);
}
fn tspace_octAlong(n: vec4f) -> vec3f {
    var h: f32 = -1.0 / (n.w + n.z);
    return vec3f(n.x * n.y * h, n.w + n.y * n.y * h, -n.y);
}

// Returns the tangent at one of the 2048 angles around a grid normal.
fn tspace_octTangent(n: vec4f, k: u32) -> vec3f {
    var x: f32 = f32(k & 511u);
    var y: f32 = 512.0 - x;
    var run: f32 = y * (1408.0 - y);
    var rise: f32 = x * (1408.0 - x);
    var across: vec3f = tspace_octAcross(n);
    var along: vec3f = tspace_octAlong(n);
    var t: vec3f = run * across + rise * along;
    if ((k & 512u) != 0u) {
        t = run * along - rise * across;
    }
    if ((k & 1024u) != 0u) {
        t = -t;
    }
    return tspace_direction(t);
}

// Returns the point of the unfolded octahedron, -1 to 1, whose normal is the unit vector n. Its barycentric coordinates
// b have the sum 1, and b (2.5 - b) is parallel to |n|; three steps of Newton's method solve this.
fn tspace_octPoint(n: vec3f) -> vec2f {
    var size: vec3f = abs(n);
    var b: vec3f = size / (size.x + size.y + size.z);
    for (var i: u32 = 0u; i < 3u; i++) {
        var value: vec3f = b * (2.5 - b);
        var slope: vec3f = 2.5 - 2.0 * b;
        var inverse: vec3f = vec3f(slope.y * slope.z, slope.z * slope.x, slope.x * slope.y);
        var reach: f32 = dot(value, inverse) / dot(size, inverse);
        b += (1.0 / (slope.x * inverse.x)) * inverse * (reach * size - value);
    }
    var x: f32 = b.x;
    var y: f32 = b.y;
    if (n.z < 0.0) {
        x = 1.0 - b.y;
        y = 1.0 - b.x;
    }
    if (n.x < 0.0) {
        x = -x;
    }
    if (n.y < 0.0) {
        y = -y;
    }
    return vec2f(x, y);
}

// Returns the largest of the 2048 angle steps that does not exceed atan2(s, c). (c, s) need not be a unit vector.
fn tspace_octAngle(c: f32, s: f32) -> u32 {
    var run: f32 = abs(c);
    var rise: f32 = abs(s);
    var turns: u32 = 0u;
    var is_second_half: bool = c + s < 0.0;
    if (c * s < 0.0) {
        run = abs(s);
        rise = abs(c);
        turns = 512u;
        is_second_half = s < 0.0;
    }
    if (is_second_half) {
        turns += 1024u;
    }
    var l: f32 = 2.75 * run + 0.75 * rise;
    var x: f32 = 3.5 * rise / (l + sqrt(max(l * l + 7.0 * (rise - run) * rise, 0.0)));
    return turns + u32(clamp(512.0 * x, 0.0, 512.0));
}

// Returns the lowest bit of frame32 and oct32: 1 for the sign -1.
fn tspace_mirroredBit(tangent: vec4f) -> u32 {
    if (tangent.w < 0.0) {
        return 1u;
    }
    return 0u;
}

// Encodes a frame as oct32: the nearest grid normal, then the nearest angle around it (docs/concepts/pack.md).
fn tspace_encodeOct32(normal: vec3f, tangent: vec4f) -> u32 {
    var n: vec3f = tspace_unitNormal(normal);
    var at: vec2f = tspace_octPoint(n);
    var first_i: f32 = clamp(floor((at.x + 1.0) * 511.0), 0.0, 1021.0);
    var first_j: f32 = clamp(floor((at.y + 1.0) * 511.0), 0.0, 1021.0);
    var i: f32 = first_i;
    var j: f32 = first_j;
    var grid: vec4f = tspace_octNormal(i, j);
    var least: f32 = 8.0;
    for (var corner: u32 = 0u; corner < 4u; corner++) {
        var next_i: f32 = first_i + f32(corner >> 1u);
        var next_j: f32 = first_j + f32(corner & 1u);
        var found: vec4f = tspace_octNormal(next_i, next_j);
        var off: vec3f = vec3f(found.x, found.y, found.z) - n;
        if (dot(off, off) < least) {
            least = dot(off, off);
            grid = found;
            i = next_i;
            j = next_j;
        }
    }
    var t: vec3f = tspace_across(n, vec3f(tangent.x, tangent.y, tangent.z));
    if (dot(t, t) == 0.0) {
        t = tspace_octAcross(grid);
    }
    var k: u32 = tspace_octAngle(dot(t, tspace_octAcross(grid)), dot(t, tspace_octAlong(grid))) & 2047u;
    var next: u32 = (k + 1u) & 2047u;
    var before: vec3f = tspace_octTangent(grid, k) - t;
    var after: vec3f = tspace_octTangent(grid, next) - t;
    if (dot(after, after) < dot(before, before)) {
        k = next;
    }
    return (u32(i) << 22u) | (u32(j) << 12u) | (k << 1u) | tspace_mirroredBit(tangent);
}

// Returns a coordinate of the Rodrigues vector for a coordinate u of a chart of frame32, from -1 to 1.
fn tspace_warped(u: f32) -> f32 { return u * (0.38728988 + 0.026923878 * (u * u)); }

// Returns the inverse of tspace_warped, by an initial guess and two steps of Newton's method.
fn tspace_unwarped(p: f32) -> f32 {
    var straight: f32 = p * 2.41421356;
    var u: f32 = straight * (1.0 + 0.065 * (1.0 - straight * straight));
    for (var i: u32 = 0u; i < 2u; i++) {
        u -= (tspace_warped(u) - p) / (0.38728988 + 0.080771634 * (u * u));
    }
    return u;
}

// Returns v in the axes of chart g of frame32: with reordered components, some of them negated.
fn tspace_inChart(v: vec3f, g: u32) -> vec3f {
    var order: u32 = g >> 2u;
    var first: f32 = 1.0;
    var second: f32 = 1.0;
    var third: f32 = 1.0;
    if ((g & 1u) != 0u) {
        first = -1.0;
    }
    if ((g & 2u) != 0u) {
        second = -1.0;
    }
    if (order > 2u) {
        third = -1.0;
    }
    var s: vec3f = vec3f(first * v.x, second * v.y, first * second * third * v.z);
    var turned: vec3f = s;
    if (order == 1u || order == 4u) {
        turned = vec3f(s.z, s.x, s.y);
    }
    if (order == 2u || order == 5u) {
        turned = vec3f(s.y, s.z, s.x);
    }
    if (order > 2u) {
        turned = vec3f(turned.x, turned.z, turned.y);
    }
    return turned;
}

// Returns the code of frame32 nearest to a rotation in one chart: x, twice y, z, and the square of its angular error in w.
fn tspace_nearestInChart(p: vec3f) -> vec4f {
    var first_x: f32 = clamp(floor(tspace_unwarped(p.x) * 226.0 + 226.0), 0.0, 451.0);
    var first_z: f32 = clamp(floor(tspace_unwarped(p.z) * 226.0 + 226.0), 0.0, 451.0);
    var twice_row: f32 = tspace_unwarped(p.y) * 435.0 + 436.0;
    var best: vec4f = vec4f(first_x, 0.0, first_z, 1e9);
    for (var i: u32 = 0u; i < 8u; i++) {
        var x: f32 = first_x + f32(i & 1u);
        var z: f32 = first_z + f32((i >> 1u) & 1u);
        var half_sum: f32 = 0.5 * (x + z);
        var shift: f32 = 2.0 * (half_sum - floor(half_sum));  // columns whose sum is odd are shifted by half a row
        var below: f32 = clamp(floor(0.5 * (twice_row - shift)), 0.0, 434.0);
        var twice_y: f32 = 2.0 * (below + f32(i >> 2u)) + shift;
        var d: vec3f = vec3f(tspace_warped((x - 226.0) / 226.0), tspace_warped((twice_y - 436.0) / 435.0),
                          tspace_warped((z - 226.0) / 226.0)) - p;
        var turn: vec3f = d - cross(p, d);
        var error: f32 = turn.y * turn.y + max(turn.x * turn.x, turn.z * turn.z);
        if (error < best.w) {
            best = vec4f(x, twice_y, z, error);
        }
    }
    return best;
}

// Encodes a frame as frame32: returns the nearest code of all quaternion charts that contain its rotation
// (docs/concepts/pack.md).
fn tspace_encodeFrame32(normal: vec3f, tangent: vec4f) -> u32 {
    var n: vec3f = tspace_unitNormal(normal);
    var t: vec3f = tspace_across(n, vec3f(tangent.x, tangent.y, tangent.z));
    if (dot(t, t) == 0.0) {
        var side: f32 = 1.0;
        if (n.z < 0.0) {
            side = -1.0;
        }
        t = tspace_direction(tspace_octAcross(vec4f(n.x, n.y, n.z, side)));
    }
    var b: vec3f = cross(n, t);
    var least: f32 = 1e9;
    var code: u32 = 0u;
    for (var g: u32 = 0u; g < 24u; g++) {
        var row_t: vec3f = tspace_inChart(t, g);
        var row_b: vec3f = tspace_inChart(b, g);
        var row_n: vec3f = tspace_inChart(n, g);
        var trace: f32 = row_t.x + row_b.y + row_n.z;
        var axis: vec3f = vec3f(row_b.z - row_n.y, row_n.x - row_t.z, row_t.y - row_b.x);
        // A chart is a cube of Rodrigues vectors. Its faces are at tan(22.5 degrees), and its corners have a trace of
        // 1.64; the limits allow half a step beyond.
        if (trace > 1.63 && tspace_largest(axis) <= 0.41531323 * (1.0 + trace)) {
            var found: vec4f = tspace_nearestInChart((1.0 / (1.0 + trace)) * axis);
            if (found.w < least) {
                least = found.w;
                code = ((g * 453u + u32(found.x)) * 436u + (u32(found.y) >> 1u)) * 453u + u32(found.z);
            }
        }
    }
    return (code << 1u) | tspace_mirroredBit(tangent);
}

fn tspace_writeTangent(result: u32, normal: vec3f, tangent: vec4f) {
    var at: u32 = (tspace_setting(tspace_tangent_offset) + result * tspace_setting(tspace_tangent_stride)) >> 2u;
    var format: u32 = tspace_setting(tspace_tangent_format);
    if (format == 0u) {
        tspace_tangents[at] = bitcast<u32>(tangent.x);
        tspace_tangents[at + 1u] = bitcast<u32>(tangent.y);
        tspace_tangents[at + 2u] = bitcast<u32>(tangent.z);
        tspace_tangents[at + 3u] = bitcast<u32>(tangent.w);
    }
    if (format == 1u) {
        tspace_tangents[at] = tspace_encodeFrame32(normal, tangent);
    }
    if (format == 2u) {
        tspace_tangents[at] = tspace_encodeOct32(normal, tangent);
    }
    if (format == 3u) {
        var t: u32 = tspace_byte(tangent.x) | (tspace_byte(tangent.y) << 8u) | (tspace_byte(tangent.z) << 16u);
        var n: u32 = tspace_byte(normal.x) | (tspace_byte(normal.y) << 8u) | (tspace_byte(normal.z) << 16u);
        tspace_tangents[at] = t | (127u << 24u);
        tspace_tangents[at + 1u] = n | (tspace_byte(tangent.w) << 24u);
    }
}

fn tspace_evaluateResult(result: u32) {
    var row: u32 = tspace_plan[8] + 3u * result;
    var begin: u32 = tspace_plan[9] + tspace_plan[row];
    var flags: u32 = tspace_plan[row + 1u];
    var own: u32 = tspace_plan[row + 2u];
    var end: u32 = begin + (flags & 0x0fffffffu);
    var scale: f32 = 1.0;
    if ((tspace_plan[2] & 1u) != 0u || tspace_plan[1] == 7u) {
        scale = tspace_scaleOf(begin, end);
    }
    var normal: vec3f = vec3f(0.0, 0.0, 1.0);
    if ((tspace_plan[2] & 1u) != 0u) {
        var made: vec4f = tspace_normalOfResult(begin, end, own, scale);
        normal = vec3f(made.x, made.y, made.z);
        if (made.w != 0.0) {
            flags = flags | 0x10000000u;  // PlanBuffers::mixes_normals
        }
        if (tspace_setting(tspace_normal_format) == 1u) {
            var at: u32 = (tspace_setting(tspace_normal_offset) + result * tspace_setting(tspace_normal_stride)) >> 2u;
            tspace_normals[at] = bitcast<u32>(normal.x);
            tspace_normals[at + 1u] = bitcast<u32>(normal.y);
            tspace_normals[at + 2u] = bitcast<u32>(normal.z);
        }
    }
    var tangent: vec4f = vec4f(0.0, 0.0, 0.0, 0.0);
    if ((flags & 0x20000000u) == 0u) {
        tangent = tspace_tangentOfResult(begin, end, flags, normal, scale);
    }
    if (tspace_setting(tspace_tangent_format) != 0u && (tspace_plan[2] & 1u) == 0u && own != tspace_next_part) {
        normal = tspace_normalOf(tspace_vertexOf(own));
    }
    tspace_writeTangent(result, normal, tangent);
}

@compute @workgroup_size(64)
fn tspace_evaluate(@builtin(global_invocation_id) id: vec3u) {
    var result: u32 = tspace_setting(tspace_first_result) + id.x + id.y * 4194240u;
    if (result < tspace_plan[4]) {
        tspace_evaluateResult(result);
    }
}
