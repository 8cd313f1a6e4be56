// SPDX-License-Identifier: MIT
// Written by scripts/shaders from tspace_evaluate.hlsl.
// Computes normals and tangents of a pose from a plan
// (planBuffers of tspace), in the Metal shading language: one result per thread.
// Threads use no atomics and add in a fixed order, so results have the same bits in every run. docs/guides/gpu.md of
// tspace describes the buffers.
//
// Dispatch tspace_evaluate with 64 threads per group and ceil(results / 64) groups: in x, or in rows of 65535 along y.

#include <metal_stdlib>

// Words of tspace_settings. Offsets and strides are in bytes.
constant uint tspace_position_format = 0u;  // 0: three floats; 1: three snorm16, times the scale
constant uint tspace_position_offset = 1u;
constant uint tspace_position_stride = 2u;
constant uint tspace_position_scale = 3u;  // three floats
constant uint tspace_normal_format = 6u;  // 0: no normals are written; 1: three floats. Input normals are always floats
constant uint tspace_normal_offset = 7u;
constant uint tspace_normal_stride = 8u;
constant uint tspace_tangent_format = 9u;  // 0: T and sign as four floats; 1: frame32; 2: oct32; 3: snorm8 pair
constant uint tspace_tangent_offset = 10u;
constant uint tspace_tangent_stride = 11u;
constant uint tspace_morph_count =
    12u;  // number of morph targets, consecutive arrays of three floats per vertex; 0: none
constant uint tspace_morph_weights = 13u;  // word offset of the weights in tspace_deform
constant uint tspace_morph_deltas = 14u;   // word offset of the deltas in tspace_deform
constant uint tspace_vertex_count = 15u;   // number of vertices of the morph targets
constant uint tspace_skin = 16u;           // 1: skinned with four joints per vertex
constant uint tspace_skin_joints = 17u;    // word offset of the joints in tspace_deform: 4 words per vertex
constant uint tspace_skin_weights = 18u;   // word offset of the joint weights: 4 floats per vertex
constant uint tspace_skin_matrices = 19u;  // word offset of the matrices: 3 rows of 4 floats per joint
constant uint tspace_first_result = 20u;   // first result of this dispatch

constant uint tspace_no_tangent = 0x80000000u;
constant uint tspace_no_normal = 0x40000000u;
constant uint tspace_next_part = 0xffffffffu;
constant uint tspace_doubles = 0xffffffffu;
constant float tspace_least_normal = 1.17549435e-38f;
constant float tspace_greatest = 3.4e38f;

struct tspace_Evaluator {
    // The words of a plan: PlanBuffers in plan_buffers.h.
    const device uint* tspace_plan;
    // Layout of the arrays of a pose in their buffers: 32 words, whose indices are tspace_position_format and following.
    const device uint* tspace_settings;
    const device uint* tspace_positions;
    // Morph deltas, joints, weights and matrices, if the settings enable them.
    const device uint* tspace_deform;
    // Written if the plan computes normals, otherwise read.
    device uint* tspace_normals;
    device uint* tspace_tangents;

    uint tspace_setting(uint word) { return tspace_settings[word]; }
    float tspace_float(uint word) { return as_type<float>(tspace_settings[word]); }

    // Returns whether a component is neither zero nor subnormal; NaN counts as zero.
    bool tspace_notZero(float3 v) {
        return metal::abs(v.x) > tspace_least_normal || metal::abs(v.y) > tspace_least_normal ||
               metal::abs(v.z) > tspace_least_normal;
    }
    bool tspace_isFinite(float3 v) {
        return metal::abs(v.x) < tspace_greatest && metal::abs(v.y) < tspace_greatest &&
               metal::abs(v.z) < tspace_greatest;
    }
    float3 tspace_normalized(float3 v) {
        if (!tspace_notZero(v)) {
            return v;
        }
        return (1.0f / metal::sqrt(metal::dot(v, v))) * v;
    }
    // Returns v without its component along n, as a unit vector. n is used as given, without normalization.
    float3 tspace_flatten(float3 n, float3 v) { return tspace_normalized(v - metal::dot(n, v) * n); }

    float tspace_arcCosine(float cosine) {
        float c = metal::clamp(cosine, -1.0f, 1.0f);
        float a = metal::abs(c);
        bool is_steep = a > 0.5f;
        float y = a * a;
        if (is_steep) {
            y = 0.5f - 0.5f * a;
        }
        float s = metal::sqrt(y);
        float p = ((((0.0421632f * y + 0.0241812f) * y + 0.0454702f) * y + 0.0749530f) * y + 0.1666675f) * y;
        float arc = s + s * p;
        if (!is_steep) {
            if (c < 0.0f) {
                return 1.57079637f + arc;
            }
            return 1.57079637f - arc;
        }
        if (c < 0.0f) {
            return 3.14159274f - 2.0f * arc;
        }
        return 2.0f * arc;
    }

    // Returns the angle in [0, pi] of the direction (x, y), where y is not negative.
    float tspace_angle(float x, float y) {
        float size = metal::abs(x);
        float t = metal::min(size, y) / metal::max(metal::max(size, y), tspace_least_normal);
        float q = t * t;
        float p = -2.386997316e-03f;
        p = p * q + 1.350777142e-02f;
        p = p * q - 3.587153898e-02f;
        p = p * q + 6.250169444e-02f;
        p = p * q - 8.656880430e-02f;
        p = p * q + 1.103376412e-01f;
        p = p * q - 1.427856875e-01f;
        p = p * q + 1.999973933e-01f;
        p = p * q - 3.333333173e-01f;
        float angle = t + t * (q * p);
        if (size <= y) {
            angle = 1.57079637f - angle;
        }
        if (x < 0.0f) {
            return 3.14159274f - angle;
        }
        return angle;
    }

    // ---- inputs of a pose

    // Returns v. Compilers cannot know that v is unchanged, because they do not know the version in the first word of a plan,
    // so they cannot fuse or reorder the operations before and after. The operations between such calls are additions,
    // subtractions and multiplications, which round equally on all devices.
    float3 tspace_kept(float3 v) {
        uint zero = tspace_plan[0] ^ 1u;
        return float3(as_type<float>(as_type<uint>(v.x) ^ zero), as_type<float>(as_type<uint>(v.y) ^ zero),
                      as_type<float>(as_type<uint>(v.z) ^ zero));
    }

    float tspace_shortAt(uint byte) {
        uint word = tspace_positions[byte >> 2u];
        if ((byte & 2u) == 0u) {
            word = word << 16u;
        }
        return metal::max(float(int(word) >> 16u) / 32767.0f, -1.0f);
    }

    float3 tspace_storedPosition(uint vertex_number) {
        uint at = tspace_setting(tspace_position_offset) + vertex_number * tspace_setting(tspace_position_stride);
        float3 scale = float3(tspace_float(tspace_position_scale), tspace_float(tspace_position_scale + 1u),
                              tspace_float(tspace_position_scale + 2u));
        if (tspace_setting(tspace_position_format) == 1u) {
            return scale * float3(tspace_shortAt(at), tspace_shortAt(at + 2u), tspace_shortAt(at + 4u));
        }
        uint word = at >> 2u;
        return float3(as_type<float>(tspace_positions[word]), as_type<float>(tspace_positions[word + 1u]),
                      as_type<float>(tspace_positions[word + 2u]));
    }

    float3 tspace_deformVector(uint word, uint step) {
        return float3(as_type<float>(tspace_deform[word]), as_type<float>(tspace_deform[word + step]),
                      as_type<float>(tspace_deform[word + 2u * step]));
    }

    float3 tspace_morphed(float3 position, uint vertex_number) {
        float3 sum = position;
        uint count = tspace_setting(tspace_morph_count);
        for (uint shape = 0u; shape < count; ++shape) {
            float weight = as_type<float>(tspace_deform[tspace_setting(tspace_morph_weights) + shape]);
            uint row = 3u * (shape * tspace_setting(tspace_vertex_count) + vertex_number);
            if (weight != 0.0f) {
                sum = tspace_kept(
                    sum + tspace_kept(weight * tspace_deformVector(tspace_setting(tspace_morph_deltas) + row, 1u)));
            }
        }
        return sum;
    }

    float3 tspace_skinned(float3 position, uint vertex_number) {
        float3 sum = float3(0.0f, 0.0f, 0.0f);
        for (uint i = 0u; i < 4u; ++i) {
            float weight = as_type<float>(tspace_deform[tspace_setting(tspace_skin_weights) + 4u * vertex_number + i]);
            uint joint = tspace_deform[tspace_setting(tspace_skin_joints) + 4u * vertex_number + i];
            uint row = tspace_setting(tspace_skin_matrices) + 12u * joint;
            if (weight != 0.0f) {
                float3 moved = tspace_kept(position.x * tspace_deformVector(row, 4u));
                moved = tspace_kept(moved + tspace_kept(position.y * tspace_deformVector(row + 1u, 4u)));
                moved = tspace_kept(moved + tspace_kept(position.z * tspace_deformVector(row + 2u, 4u)));
                moved = tspace_kept(moved + tspace_deformVector(row + 3u, 4u));
                sum = tspace_kept(sum + tspace_kept(weight * moved));
            }
        }
        return sum;
    }

    // Returns the position of a vertex: stored, then morphed, then skinned.
    float3 tspace_positionOf(uint vertex_number) {
        float3 position = tspace_storedPosition(vertex_number);
        if (tspace_setting(tspace_morph_count) != 0u) {
            position = tspace_morphed(position, vertex_number);
        }
        if (tspace_setting(tspace_skin) != 0u) {
            position = tspace_skinned(position, vertex_number);
        }
        return position;
    }

    float3 tspace_normalOf(uint vertex_number) {
        uint word = (tspace_setting(tspace_normal_offset) + vertex_number * tspace_setting(tspace_normal_stride)) >> 2u;
        float3 normal = float3(as_type<float>(tspace_normals[word]), as_type<float>(tspace_normals[word + 1u]),
                               as_type<float>(tspace_normals[word + 2u]));
        if ((tspace_plan[2] & 4u) == 0u) {
            return normal;
        }
        // Lengths that differ from 1 by no more than rounding to 8 bits explains are not changed.
        float square = metal::dot(normal, normal);
        if (metal::abs(square - 1.0f) <= 0.0134f || !(square >= 1e-12f) || !(square < tspace_greatest)) {
            return normal;
        }
        return normal / metal::sqrt(square);
    }

    // ---- triangles of a plan

    // A corner of a triangle.
    struct tspace_Corner {
        float3 e1;        // first edge of the triangle: from corner 0 to corner 1
        float3 e2;        // second edge: from corner 0 to corner 2
        float3 next;      // from this corner to the next one
        float3 previous;  // from this corner to the previous one
        float3 p0;        // positions of the triangle
        float3 p1;
        float3 p2;
        uint vertex_number;
        uint uvs;  // offset of the UV coefficients in tspace_plan
    };

    uint tspace_vertexOf(uint entry) {
        return tspace_plan[tspace_plan[10] + ((entry & 0x3fffffffu) >> 2u) * tspace_plan[7] + (entry & 3u)];
    }

    tspace_Corner tspace_cornerOf(uint entry) {
        uint k = entry & 3u;
        uint at = tspace_plan[10] + ((entry & 0x3fffffffu) >> 2u) * tspace_plan[7];
        float3 p0 = float3(0.0f, 0.0f, 0.0f);
        float3 p1 = p0;
        float3 p2 = p0;
        for (uint i = 0u; i < 3u; ++i) {  // a loop, so that compilers inline the called functions only once
            p0 = p1;
            p1 = p2;
            p2 = tspace_positionOf(tspace_plan[at + i]);
        }
        tspace_Corner corner;
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

    float tspace_largest(float3 v) { return metal::max(metal::abs(v.x), metal::max(metal::abs(v.y), metal::abs(v.z))); }

    // Returns an even power of two near 1 / size. Its square root is a power of two too.
    float tspace_inverseSize(float size) {
        uint exponent = metal::clamp(as_type<uint>(size) >> 23u, 1u, 253u);
        return as_type<float>(((254u - exponent) | 1u) << 23u);
    }

    // Returns a power of two that scales the edges of a result to about 1, so that products stay in range; 0 without edges.
    float tspace_scaleOf(uint begin, uint end) {
        float largest = 0.0f;
        for (uint i = begin; i < end; ++i) {
            uint entry = tspace_plan[i];
            if (entry != tspace_next_part) {
                tspace_Corner corner = tspace_cornerOf(entry);
                float size = metal::max(tspace_largest(corner.e1), tspace_largest(corner.e2));
                if (size < tspace_greatest) {
                    largest = metal::max(largest, size);
                }
            }
        }
        if (largest == 0.0f) {
            return 0.0f;
        }
        return tspace_inverseSize(largest);
    }

    // ---- normals

    // Returns the triangle's normal, with length twice the area, from its two shortest edges, where cancellation is smallest.
    float3 tspace_faceNormal(float3 e1, float3 e2) {
        float3 e3 = e2 - e1;
        float a = metal::dot(e1, e1);
        float b = metal::dot(e2, e2);
        float c = metal::dot(e3, e3);
        if (a >= b && a >= c) {
            return metal::cross(e2, e3);
        }
        if (b >= c) {
            return metal::cross(e1, e3);
        }
        return metal::cross(e1, e2);
    }

    // Returns the weight of a triangle's unit normal at a corner. `area`: twice the area of the triangle.
    float tspace_normalWeight(tspace_Corner corner, float scale, float area) {
        uint weighting = tspace_plan[3];
        float weight = 1.0f;
        if (weighting == 3u || weighting == 4u) {
            weight = tspace_angle(metal::dot(scale * corner.next, scale * corner.previous), area);
        }
        if (weighting == 2u || weighting == 4u) {
            weight *= area;
        }
        if (weighting == 5u) {
            float3 next = scale * corner.next;
            float3 previous = scale * corner.previous;
            weight = (area / metal::dot(next, next)) / metal::dot(previous, previous);
        }
        return weight;
    }

    // Returns the normal of a result. w is 1 if the mean is zero: the normal is then that of the result's own triangle, so
    // other corners of the vertex have different normals.
    float4 tspace_normalOfResult(uint begin, uint end, uint own, float scale) {
        float factor = 1.0f;
        if ((tspace_plan[2] & 2u) != 0u) {
            factor = -1.0f;
        }
        float3 sum = float3(0.0f, 0.0f, 0.0f);
        float3 own_normal = float3(0.0f, 0.0f, factor);
        float weights = 0.0f;
        // The last iteration is the corner's own triangle, which is used if the mean is zero.
        for (uint i = begin; i <= end; ++i) {
            uint entry = own;
            if (i < end) {
                entry = tspace_plan[i];
            }
            bool is_own = i == end && entry != tspace_next_part;
            if (is_own || (i < end && (entry & tspace_no_normal) == 0u)) {
                tspace_Corner corner = tspace_cornerOf(entry);
                float3 n = tspace_faceNormal(scale * corner.e1, scale * corner.e2);
                float area = metal::sqrt(metal::dot(n, n));
                if (area > 0.0f && area < tspace_greatest) {
                    if (is_own) {
                        own_normal = n / area;
                    } else {
                        float weight = tspace_normalWeight(corner, scale, area);
                        sum += (weight / area) * n;
                        weights += weight;
                    }
                }
            }
        }
        float size = metal::sqrt(metal::dot(sum, sum));
        if (size > 1e-6f * weights) {
            float3 mean = (factor / size) * sum;
            return float4(mean.x, mean.y, mean.z, 0.0f);
        }
        own_normal = factor * own_normal;
        return float4(own_normal.x, own_normal.y, own_normal.z, 1.0f);
    }

    // Returns the normal of a corner's result.
    float3 tspace_normalAt(uint entry, uint vertex_number) {
        uint result = vertex_number;
        if ((tspace_plan[2] & 8u) != 0u) {
            result = 3u * ((entry & 0x3fffffffu) >> 2u) + (entry & 3u);
        }
        uint row = tspace_plan[8] + 3u * result;
        uint begin = tspace_plan[9] + tspace_plan[row];
        uint end = begin + (tspace_plan[row + 1u] & 0x0fffffffu);
        float4 made = tspace_normalOfResult(begin, end, tspace_plan[row + 2u], tspace_scaleOf(begin, end));
        return float3(made.x, made.y, made.z);
    }

    // ---- double precision, in integers: lengyel, where the library computes in double precision, with the same bits

    // The number (high, low) * 2^exponent, negated if sign is 1. The first bit of `high` is 1, unless the number is 0.
    struct tspace_Double {
        uint sign;
        int exponent;
        uint high;
        uint low;
    };

    // Returns the number (high, low) * 2^exponent rounded to 53 bits, to the nearest, or to the even one of two.
    tspace_Double tspace_rounded(uint sign, int exponent, uint high, uint low) {
        tspace_Double made;
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
        uint rest = made.low & 2047u;
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
    tspace_Double tspace_widened(float x) {
        tspace_Double made;
        made.sign = as_type<uint>(x) >> 31u;
        made.exponent = int((as_type<uint>(x) >> 23u) & 255u) - 190;
        made.high = (as_type<uint>(x) << 8u) | 0x80000000u;
        made.low = 0u;
        if (made.exponent == -190) {
            made.exponent = -189;
            made.high = (as_type<uint>(x) << 9u) >> 1u;
            while (made.high != 0u && made.high < 0x80000000u) {
                made.high = made.high << 1u;
                made.exponent -= 1;
            }
        }
        return made;
    }

    // Returns a double of the plan: a word with its high bits, and one with its low bits.
    tspace_Double tspace_storedDouble(uint word) {
        uint bits = tspace_plan[word];
        tspace_Double made;
        made.sign = bits >> 31u;
        made.exponent = int((bits >> 20u) & 2047u) - 1086;
        made.high = 0u;
        made.low = tspace_plan[word + 1u] << 11u;
        if (made.exponent != -1086) {
            made.high = 0x80000000u | (bits << 11u) | (tspace_plan[word + 1u] >> 21u);
        }
        return made;
    }

    // Returns the nearest float to d * 2^shift.
    float tspace_narrowed(tspace_Double d, int shift) {
        int field = metal::clamp(d.exponent + shift + 190, -31, 255);
        uint count = 8u;
        if (field < 1) {
            count = uint(9 - field);
            field = 1;
        }
        uint bits = d.high;
        uint last = 0u;
        uint lost = d.low;
        for (uint i = 0u; i < count; ++i) {
            lost = lost | last;
            last = bits & 1u;
            bits = bits >> 1u;
        }
        if (last != 0u && (lost | (bits & 1u)) != 0u) {
            bits += 1u;
        }
        if (d.high != 0u) {
            bits += uint(field - 1) << 23u;
        }
        return as_type<float>(metal::min(bits, 0x7f800000u) | (d.sign << 31u));
    }

    // Returns a * b.
    tspace_Double tspace_product(tspace_Double a, tspace_Double b) {
        uint a_high = a.high >> 1u;
        uint a_low = (a.high << 31u) | (a.low >> 1u);
        uint bits = b.low >> 11u;
        uint high = 0u;
        uint low = 0u;
        uint lost = 0u;
        for (uint i = 0u; i < 53u; ++i) {
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

    tspace_Double tspace_negated(tspace_Double a) {
        tspace_Double made = a;
        made.sign = 1u - a.sign;
        return made;
    }

    // Returns whether |a| < |b|.
    bool tspace_isSmaller(tspace_Double a, tspace_Double b) {
        if (a.exponent != b.exponent) {
            return a.exponent < b.exponent;
        }
        return a.high < b.high || (a.high == b.high && a.low < b.low);
    }

    // Returns a + b.
    tspace_Double tspace_total(tspace_Double a, tspace_Double b) {
        if (b.high == 0u) {
            return a;
        }
        if (a.high == 0u) {
            return b;
        }
        tspace_Double large = a;
        tspace_Double small = b;
        if (tspace_isSmaller(a, b)) {
            large = b;
            small = a;
        }
        uint lost = 0u;
        uint count = metal::min(uint(large.exponent - small.exponent), 64u);
        for (uint i = 0u; i <= count; ++i) {
            lost = lost | (small.low & 1u);
            small.low = (small.low >> 1u) | (small.high << 31u);
            small.high = small.high >> 1u;
        }
        small.low = small.low | lost;
        uint low = (large.high << 31u) | (large.low >> 1u);
        uint high = large.high >> 1u;
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

    tspace_Double tspace_difference(tspace_Double a, tspace_Double b) { return tspace_total(a, tspace_negated(b)); }

    // Returns the next axis as x. Loops that rotate vectors, here and below, call each function once, because compilers
    // inline all calls.
    float3 tspace_turned(float3 v) { return float3(v.y, v.z, v.x); }

    // Returns whether the determinant of three vectors is negative.
    bool tspace_isMirrored(float3 normal, float3 along_u, float3 along_v) {
        float3 n = normal;
        float3 s = along_u;
        float3 t = along_v;
        tspace_Double volume = tspace_widened(0.0f);
        for (uint i = 0u; i < 3u; ++i) {
            tspace_Double first = tspace_product(tspace_widened(n.y), tspace_widened(s.z));
            tspace_Double second = tspace_product(tspace_widened(n.z), tspace_widened(s.y));
            volume = tspace_total(volume, tspace_product(tspace_difference(first, second), tspace_widened(t.x)));
            n = tspace_turned(n);
            s = tspace_turned(s);
            t = tspace_turned(t);
        }
        return volume.sign == 1u && volume.high != 0u;
    }

    // Returns s without its component along the unit vector n, times a power of two.
    float3 tspace_wideRest(float3 normal, float3 along_u) {
        float3 n = normal;
        float3 s = along_u;
        tspace_Double along = tspace_widened(0.0f);
        for (uint i = 0u; i < 3u; ++i) {
            along = tspace_total(along, tspace_product(tspace_widened(n.x), tspace_widened(s.x)));
            n = tspace_turned(n);
            s = tspace_turned(s);
        }
        tspace_Double x = along;
        tspace_Double y = along;
        tspace_Double z = along;
        int largest = -2000;
        for (uint k = 0u; k < 3u; ++k) {
            x = y;
            y = z;
            z = tspace_difference(tspace_widened(s.x), tspace_product(along, tspace_widened(n.x)));
            if (z.high != 0u) {
                largest = metal::max(largest, z.exponent);
            }
            n = tspace_turned(n);
            s = tspace_turned(s);
        }
        int shift = -64 - largest;
        return float3(tspace_narrowed(x, shift), tspace_narrowed(y, shift), tspace_narrowed(z, shift));
    }

    // Sums over the corners of a result. `a`: tangents. `b`: a second sum, for fast and lengyel.
    struct tspace_Sums {
        float3 a;
        float3 b;
    };

    // Returns a UV coefficient of the plan.
    tspace_Double tspace_coefficient(bool is_double, uint word) {
        if (is_double) {
            return tspace_storedDouble(word);
        }
        return tspace_widened(as_type<float>(tspace_plan[word]));
    }

    // Returns dP/du and dP/dv of the triangle of a corner, rounded to floats.
    tspace_Sums tspace_wideDerivatives(tspace_Corner corner) {
        bool is_double = tspace_plan[corner.uvs] == tspace_doubles;
        uint word = corner.uvs;
        uint step = 1u;
        tspace_Double factor = tspace_widened(1.0f);
        if (is_double) {
            word = tspace_plan[corner.uvs + 1u] + 2u;
            step = 2u;
            factor = tspace_storedDouble(word - 2u);
        }
        float3 o = corner.p0;
        float3 p = corner.p1;
        float3 q = corner.p2;
        tspace_Sums made;
        made.a = o;
        made.b = o;
        for (uint i = 0u; i < 6u; ++i) {
            if (i == 3u) {
                p = corner.p2;
                q = corner.p1;
                word += 2u * step;
            }
            tspace_Double origin = tspace_widened(o.x);
            tspace_Double first =
                tspace_product(tspace_coefficient(is_double, word), tspace_difference(tspace_widened(p.x), origin));
            tspace_Double second = tspace_product(tspace_coefficient(is_double, word + step),
                                                  tspace_difference(tspace_widened(q.x), origin));
            tspace_Double value = tspace_product(factor, tspace_difference(first, second));
            made.a = float3(made.a.y, made.a.z, made.b.x);
            made.b = float3(made.b.y, made.b.z, tspace_narrowed(value, 0));
            o = tspace_turned(o);
            p = tspace_turned(p);
            q = tspace_turned(q);
        }
        return made;
    }

    // ---- tangents

    // Returns a * x - b * y for the coefficients a and b at a word of the plan, with the same bits on every device.
    float3 tspace_combined(uint word, float3 x, float3 y) {
        float3 first = tspace_kept(as_type<float>(tspace_plan[word]) * tspace_kept(x));
        return tspace_kept(first - tspace_kept(as_type<float>(tspace_plan[word + 1u]) * tspace_kept(y)));
    }

    // Returns dP/du and dP/dv of the triangle of a corner, with the bits of the library.
    tspace_Sums tspace_derivatives(tspace_Corner corner) {
        tspace_Sums made;
        made.a = tspace_combined(corner.uvs, corner.e1, corner.e2);
        made.b = tspace_combined(corner.uvs + 2u, corner.e2, corner.e1);
        bool is_wide =
            tspace_plan[corner.uvs] == tspace_doubles || !tspace_isFinite(made.a) || !tspace_isFinite(made.b);
        if (is_wide && tspace_isFinite(corner.p0) && tspace_isFinite(corner.p1) && tspace_isFinite(corner.p2)) {
            return tspace_wideDerivatives(corner);
        }
        return made;
    }

    // Returns what a corner adds to the sum of mikktspace, uniform, angle and area: its unit tangent perpendicular to the
    // normal, times its weight.
    float3 tspace_weightedTangent(tspace_Corner corner, float3 n, uint method) {
        float3 along = tspace_combined(corner.uvs, corner.e1, corner.e2);
        float size = metal::sqrt(metal::dot(along, along));
        float3 tangent = float3(0.0f, 0.0f, 0.0f);
        if (size > tspace_least_normal) {
            tangent = tspace_flatten(n, (1.0f / size) * along);
        }
        float weight = 1.0f;
        if (method == 0u) {
            weight = tspace_arcCosine(metal::dot(tspace_flatten(n, corner.previous), tspace_flatten(n, corner.next)));
        }
        if (method == 3u) {
            weight = tspace_arcCosine(metal::dot(tspace_normalized(corner.previous), tspace_normalized(corner.next)));
        }
        if (method == 4u) {
            float3 c = metal::cross(corner.next, corner.previous);
            weight = 0.5f * metal::sqrt(metal::dot(c, c));
        }
        return weight * tangent;
    }

    // Returns what a corner adds to the two sums of fast: `a` is accurate on smooth surfaces, `b` is robust.
    tspace_Sums tspace_twoWeights(tspace_Corner corner, float scale) {
        tspace_Sums sums;
        sums.a = float3(0.0f, 0.0f, 0.0f);
        sums.b = float3(0.0f, 0.0f, 0.0f);
        float3 e1 = scale * corner.e1;
        float3 e2 = scale * corner.e2;
        float3 e3 = scale * (corner.p2 - corner.p1);
        float squares = metal::dot(e1, e1) + metal::dot(e3, e3) + metal::dot(e2, e2);
        if (!(squares < tspace_greatest)) {
            return sums;
        }
        float3 along = tspace_combined(corner.uvs, e1, e2);
        float size = metal::sqrt(metal::dot(along, along));
        float3 c = metal::cross(e1, e2);
        float area = metal::sqrt(metal::dot(c, c));
        float root = metal::sqrt(squares);
        float3 next = scale * corner.next;
        float3 previous = scale * corner.previous;
        float w = (1.0f / metal::dot(next, next)) * (1.0f / metal::dot(previous, previous));
        if (w < tspace_greatest) {
            sums.a = w * along;
        }
        float robust = (area * area) / (root * metal::sqrt(root));
        if (size > 0.0f && robust < tspace_greatest) {
            sums.b = (robust / size) * along;
        }
        return sums;
    }

    // Returns v as a unit vector, or zero.
    float3 tspace_direction(float3 v) {
        float square = metal::dot(v, v);
        if (square > 0.0f && square < tspace_greatest) {
            return (1.0f / metal::sqrt(square)) * v;
        }
        return float3(0.0f, 0.0f, 0.0f);
    }

    // Returns the normal as a unit vector, (0, 0, 1) if it has no direction.
    float3 tspace_unitNormal(float3 normal) {
        float3 n = tspace_direction(normal);
        if (metal::dot(n, n) == 0.0f) {
            n = float3(0.0f, 0.0f, 1.0f);
        }
        return n;
    }

    // Returns the part of v that is perpendicular to the unit vector n, as a unit vector, or zero.
    float3 tspace_across(float3 n, float3 v) { return tspace_direction(v - metal::dot(n, v) * n); }

    float3 tspace_mixed(float3 normal, tspace_Sums sums) {
        float3 n = tspace_unitNormal(normal);
        float3 accurate = tspace_across(n, tspace_inverseSize(tspace_largest(sums.a)) * sums.a);
        float3 robust = tspace_across(n, tspace_inverseSize(tspace_largest(sums.b)) * sums.b);
        float3 across = metal::cross(accurate, robust);
        float square = metal::dot(across, across);
        if (metal::dot(accurate, robust) < 0.0f) {
            square = 1.0f;
        }
        float r = square / 0.00351691f;
        float m = r / (1.0f + r);
        if (metal::dot(accurate, accurate) == 0.0f) {
            m = 1.0f;
        }
        return tspace_direction((1.0f - m) * accurate + m * robust);
    }

    // Returns the tangent of lengyel from the sums of dP/du and dP/dv, by Gram-Schmidt. w: the sign.
    float4 tspace_fromDerivatives(float3 n, tspace_Sums sums) {
        float largest = tspace_largest(sums.a);
        if (!(largest > 0.0f) || !(largest < tspace_greatest) || !tspace_isFinite(n)) {
            return float4(1.0f, 0.0f, 0.0f, 1.0f);
        }
        float3 s = sums.a / largest;
        float3 b = sums.b / metal::max(tspace_largest(sums.b), tspace_least_normal);
        float along = metal::dot(n, s);
        float3 rest = s - along * n;
        float volume = metal::dot(metal::cross(n, rest), b);
        bool is_mirrored = volume < 0.0f;
        // Far from these limits, rounding does not decide.
        float size = tspace_largest(rest);
        if (!(size > 0.0625f * metal::abs(along)) || !(metal::abs(volume) > 0.001f * size)) {
            rest = tspace_wideRest(n, sums.a);
            is_mirrored = tspace_isMirrored(n, sums.a, sums.b);
            size = tspace_largest(rest);
        }
        if (!(size > 0.0f)) {
            return float4(1.0f, 0.0f, 0.0f, 1.0f);
        }
        float3 t = tspace_direction(rest / size);
        float sign = 1.0f;
        if (is_mirrored) {
            sign = -1.0f;
        }
        return float4(t.x, t.y, t.z, sign);
    }

    // Returns the tangent for a sum: normalized, or the default if it is zero and the result's flags request that.
    float3 tspace_finish(float3 normal, tspace_Sums sums, uint method, uint flags) {
        float3 tangent = sums.a;
        if (method == 7u) {
            tangent = tspace_mixed(normal, sums);
        }
        if (method != 7u) {
            tangent = tspace_normalized(tangent);
        }
        if ((flags & 0x40000000u) != 0u && !tspace_notZero(tangent) && tangent.x == tangent.x) {
            return float3(1.0f, 0.0f, 0.0f);
        }
        return tangent;
    }

    float4 tspace_tangentOfResult(uint begin, uint end, uint flags, float3 made_normal, float scale) {
        uint method = tspace_plan[1];
        bool makes_normals = (tspace_plan[2] & 1u) != 0u;
        float sign = 1.0f;
        if ((flags & 0x80000000u) != 0u) {
            sign = -1.0f;
        }
        float3 normal = made_normal;
        tspace_Sums sums;
        sums.a = float3(0.0f, 0.0f, 0.0f);
        sums.b = float3(0.0f, 0.0f, 0.0f);
        float3 merged = float3(0.0f, 0.0f, 0.0f);
        bool has_parts = false;
        for (uint i = begin; i < end; ++i) {
            uint entry = tspace_plan[i];
            if (entry == tspace_next_part) {
                float3 part = tspace_finish(normal, sums, method, flags);
                if (has_parts) {
                    part = tspace_normalized(merged + part);
                }
                merged = part;
                has_parts = true;
                sums.a = float3(0.0f, 0.0f, 0.0f);
                sums.b = float3(0.0f, 0.0f, 0.0f);
            }
            if ((entry & tspace_no_tangent) == 0u) {
                tspace_Corner corner = tspace_cornerOf(entry);
                if (!makes_normals) {
                    normal = tspace_normalOf(corner.vertex_number);
                }
                if (method == 1u) {
                    tspace_Sums more = tspace_derivatives(corner);
                    if (tspace_isFinite(more.a) && tspace_isFinite(more.b)) {
                        sums.a = tspace_kept(sums.a + more.a);
                        sums.b = tspace_kept(sums.b + more.b);
                    }
                }
                if (method == 7u) {
                    tspace_Sums more = tspace_twoWeights(corner, scale);
                    sums.a += more.a;
                    sums.b += more.b;
                }
                if (method != 1u && method != 7u) {
                    float3 n = normal;
                    if ((flags & 0x10000000u) != 0u) {
                        n = tspace_normalAt(entry, corner.vertex_number);
                    }
                    sums.a += tspace_weightedTangent(corner, n, method);
                }
            }
        }
        if (method == 1u) {
            float4 frame = tspace_fromDerivatives(normal, sums);
            return float4(frame.x, frame.y, frame.z, sign * frame.w);
        }
        float3 tangent = tspace_finish(normal, sums, method, flags);
        if (has_parts) {
            tangent = tspace_normalized(merged + tangent);
        }
        return float4(tangent.x, tangent.y, tangent.z, sign);
    }

    // ---- output formats

    uint tspace_byte(float x) { return uint(int(metal::floor(metal::clamp(x, -1.0f, 1.0f) * 127.0f + 0.5f))) & 255u; }

    // Returns the normal at a grid point of oct32; w: the sign of z.
    float4 tspace_octNormal(float i, float j) {
        float a = metal::abs(i - 511.0f);
        float b = metal::abs(j - 511.0f);
        float rest = 511.0f - a - b;
        a += metal::min(rest, 0.0f);
        b += metal::min(rest, 0.0f);
        float c = metal::abs(rest);
        float3 n = tspace_direction(float3(a * (1277.5f - a), b * (1277.5f - b), c * (1277.5f - c)));
        float sign = 1.0f;
        if (rest < 0.0f) {
            sign = -1.0f;
        }
        float x = n.x;
        float y = n.y;
        if (i < 511.0f) {
            x = -x;
        }
        if (j < 511.0f) {
            y = -y;
        }
        return float4(x, y, sign * n.z, sign);
    }

    // Returns the direction of angle 0 around a grid normal; tspace_octAlong returns the direction a quarter turn further.
    float3 tspace_octAcross(float4 n) {
        float h = -1.0f / (n.w + n.z);
        return float3(1.0f + n.w * n.x * n.x * h, n.w * n.x * n.y * h, -n.w * n.x);
    }
    float3 tspace_octAlong(float4 n) {
        float h = -1.0f / (n.w + n.z);
        return float3(n.x * n.y * h, n.w + n.y * n.y * h, -n.y);
    }

    // Returns the tangent at one of the 2048 angles around a grid normal.
    float3 tspace_octTangent(float4 n, uint k) {
        float x = float(k & 511u);
        float y = 512.0f - x;
        float run = y * (1408.0f - y);
        float rise = x * (1408.0f - x);
        float3 across = tspace_octAcross(n);
        float3 along = tspace_octAlong(n);
        float3 t = run * across + rise * along;
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
    float2 tspace_octPoint(float3 n) {
        float3 size = metal::abs(n);
        float3 b = size / (size.x + size.y + size.z);
        for (uint i = 0u; i < 3u; i++) {
            float3 value = b * (2.5f - b);
            float3 slope = 2.5f - 2.0f * b;
            float3 inverse = float3(slope.y * slope.z, slope.z * slope.x, slope.x * slope.y);
            float reach = metal::dot(value, inverse) / metal::dot(size, inverse);
            b += (1.0f / (slope.x * inverse.x)) * inverse * (reach * size - value);
        }
        float x = b.x;
        float y = b.y;
        if (n.z < 0.0f) {
            x = 1.0f - b.y;
            y = 1.0f - b.x;
        }
        if (n.x < 0.0f) {
            x = -x;
        }
        if (n.y < 0.0f) {
            y = -y;
        }
        return float2(x, y);
    }

    // Returns the largest of the 2048 angle steps that does not exceed atan2(s, c). (c, s) need not be a unit vector.
    uint tspace_octAngle(float c, float s) {
        float run = metal::abs(c);
        float rise = metal::abs(s);
        uint turns = 0u;
        bool is_second_half = c + s < 0.0f;
        if (c * s < 0.0f) {
            run = metal::abs(s);
            rise = metal::abs(c);
            turns = 512u;
            is_second_half = s < 0.0f;
        }
        if (is_second_half) {
            turns += 1024u;
        }
        float l = 2.75f * run + 0.75f * rise;
        float x = 3.5f * rise / (l + metal::sqrt(metal::max(l * l + 7.0f * (rise - run) * rise, 0.0f)));
        return turns + uint(metal::clamp(512.0f * x, 0.0f, 512.0f));
    }

    // Returns the lowest bit of frame32 and oct32: 1 for the sign -1.
    uint tspace_mirroredBit(float4 tangent) {
        if (tangent.w < 0.0f) {
            return 1u;
        }
        return 0u;
    }

    // Encodes a frame as oct32: the nearest grid normal, then the nearest angle around it (docs/concepts/pack.md).
    uint tspace_encodeOct32(float3 normal, float4 tangent) {
        float3 n = tspace_unitNormal(normal);
        float2 at = tspace_octPoint(n);
        float first_i = metal::clamp(metal::floor((at.x + 1.0f) * 511.0f), 0.0f, 1021.0f);
        float first_j = metal::clamp(metal::floor((at.y + 1.0f) * 511.0f), 0.0f, 1021.0f);
        float i = first_i;
        float j = first_j;
        float4 grid = tspace_octNormal(i, j);
        float least = 8.0f;
        for (uint corner = 0u; corner < 4u; corner++) {
            float next_i = first_i + float(corner >> 1u);
            float next_j = first_j + float(corner & 1u);
            float4 found = tspace_octNormal(next_i, next_j);
            float3 off = float3(found.x, found.y, found.z) - n;
            if (metal::dot(off, off) < least) {
                least = metal::dot(off, off);
                grid = found;
                i = next_i;
                j = next_j;
            }
        }
        float3 t = tspace_across(n, float3(tangent.x, tangent.y, tangent.z));
        if (metal::dot(t, t) == 0.0f) {
            t = tspace_octAcross(grid);
        }
        uint k = tspace_octAngle(metal::dot(t, tspace_octAcross(grid)), metal::dot(t, tspace_octAlong(grid))) & 2047u;
        uint next = (k + 1u) & 2047u;
        float3 before = tspace_octTangent(grid, k) - t;
        float3 after = tspace_octTangent(grid, next) - t;
        if (metal::dot(after, after) < metal::dot(before, before)) {
            k = next;
        }
        return (uint(i) << 22u) | (uint(j) << 12u) | (k << 1u) | tspace_mirroredBit(tangent);
    }

    // Returns a coordinate of the Rodrigues vector for a coordinate u of a chart of frame32, from -1 to 1.
    float tspace_warped(float u) { return u * (0.38728988f + 0.026923878f * (u * u)); }

    // Returns the inverse of tspace_warped, by an initial guess and two steps of Newton's method.
    float tspace_unwarped(float p) {
        float straight = p * 2.41421356f;
        float u = straight * (1.0f + 0.065f * (1.0f - straight * straight));
        for (uint i = 0u; i < 2u; ++i) {
            u -= (tspace_warped(u) - p) / (0.38728988f + 0.080771634f * (u * u));
        }
        return u;
    }

    // Returns v in the axes of chart g of frame32: with reordered components, some of them negated.
    float3 tspace_inChart(float3 v, uint g) {
        uint order = g >> 2u;
        float first = 1.0f;
        float second = 1.0f;
        float third = 1.0f;
        if ((g & 1u) != 0u) {
            first = -1.0f;
        }
        if ((g & 2u) != 0u) {
            second = -1.0f;
        }
        if (order > 2u) {
            third = -1.0f;
        }
        float3 s = float3(first * v.x, second * v.y, first * second * third * v.z);
        float3 turned = s;
        if (order == 1u || order == 4u) {
            turned = float3(s.z, s.x, s.y);
        }
        if (order == 2u || order == 5u) {
            turned = float3(s.y, s.z, s.x);
        }
        if (order > 2u) {
            turned = float3(turned.x, turned.z, turned.y);
        }
        return turned;
    }

    // Returns the code of frame32 nearest to a rotation in one chart: x, twice y, z, and the square of its angular error in w.
    float4 tspace_nearestInChart(float3 p) {
        float first_x = metal::clamp(metal::floor(tspace_unwarped(p.x) * 226.0f + 226.0f), 0.0f, 451.0f);
        float first_z = metal::clamp(metal::floor(tspace_unwarped(p.z) * 226.0f + 226.0f), 0.0f, 451.0f);
        float twice_row = tspace_unwarped(p.y) * 435.0f + 436.0f;
        float4 best = float4(first_x, 0.0f, first_z, 1e9f);
        for (uint i = 0u; i < 8u; ++i) {
            float x = first_x + float(i & 1u);
            float z = first_z + float((i >> 1u) & 1u);
            float half_sum = 0.5f * (x + z);
            float shift =
                2.0f * (half_sum - metal::floor(half_sum));  // columns whose sum is odd are shifted by half a row
            float below = metal::clamp(metal::floor(0.5f * (twice_row - shift)), 0.0f, 434.0f);
            float twice_y = 2.0f * (below + float(i >> 2u)) + shift;
            float3 d = float3(tspace_warped((x - 226.0f) / 226.0f), tspace_warped((twice_y - 436.0f) / 435.0f),
                              tspace_warped((z - 226.0f) / 226.0f)) -
                       p;
            float3 turn = d - metal::cross(p, d);
            float error = turn.y * turn.y + metal::max(turn.x * turn.x, turn.z * turn.z);
            if (error < best.w) {
                best = float4(x, twice_y, z, error);
            }
        }
        return best;
    }

    // Encodes a frame as frame32: returns the nearest code of all quaternion charts that contain its rotation
    // (docs/concepts/pack.md).
    uint tspace_encodeFrame32(float3 normal, float4 tangent) {
        float3 n = tspace_unitNormal(normal);
        float3 t = tspace_across(n, float3(tangent.x, tangent.y, tangent.z));
        if (metal::dot(t, t) == 0.0f) {
            float side = 1.0f;
            if (n.z < 0.0f) {
                side = -1.0f;
            }
            t = tspace_direction(tspace_octAcross(float4(n.x, n.y, n.z, side)));
        }
        float3 b = metal::cross(n, t);
        float least = 1e9f;
        uint code = 0u;
        for (uint g = 0u; g < 24u; ++g) {
            float3 row_t = tspace_inChart(t, g);
            float3 row_b = tspace_inChart(b, g);
            float3 row_n = tspace_inChart(n, g);
            float trace = row_t.x + row_b.y + row_n.z;
            float3 axis = float3(row_b.z - row_n.y, row_n.x - row_t.z, row_t.y - row_b.x);
            // A chart is a cube of Rodrigues vectors. Its faces are at tan(22.5 degrees), and its corners have a trace of
            // 1.64; the limits allow half a step beyond.
            if (trace > 1.63f && tspace_largest(axis) <= 0.41531323f * (1.0f + trace)) {
                float4 found = tspace_nearestInChart((1.0f / (1.0f + trace)) * axis);
                if (found.w < least) {
                    least = found.w;
                    code = ((g * 453u + uint(found.x)) * 436u + (uint(found.y) >> 1u)) * 453u + uint(found.z);
                }
            }
        }
        return (code << 1u) | tspace_mirroredBit(tangent);
    }

    void tspace_writeTangent(uint result, float3 normal, float4 tangent) {
        uint at = (tspace_setting(tspace_tangent_offset) + result * tspace_setting(tspace_tangent_stride)) >> 2u;
        uint format = tspace_setting(tspace_tangent_format);
        if (format == 0u) {
            tspace_tangents[at] = as_type<uint>(tangent.x);
            tspace_tangents[at + 1u] = as_type<uint>(tangent.y);
            tspace_tangents[at + 2u] = as_type<uint>(tangent.z);
            tspace_tangents[at + 3u] = as_type<uint>(tangent.w);
        }
        if (format == 1u) {
            tspace_tangents[at] = tspace_encodeFrame32(normal, tangent);
        }
        if (format == 2u) {
            tspace_tangents[at] = tspace_encodeOct32(normal, tangent);
        }
        if (format == 3u) {
            uint t = tspace_byte(tangent.x) | (tspace_byte(tangent.y) << 8u) | (tspace_byte(tangent.z) << 16u);
            uint n = tspace_byte(normal.x) | (tspace_byte(normal.y) << 8u) | (tspace_byte(normal.z) << 16u);
            tspace_tangents[at] = t | (127u << 24u);
            tspace_tangents[at + 1u] = n | (tspace_byte(tangent.w) << 24u);
        }
    }

    void tspace_evaluateResult(uint result) {
        uint row = tspace_plan[8] + 3u * result;
        uint begin = tspace_plan[9] + tspace_plan[row];
        uint flags = tspace_plan[row + 1u];
        uint own = tspace_plan[row + 2u];
        uint end = begin + (flags & 0x0fffffffu);
        float scale = 1.0f;
        if ((tspace_plan[2] & 1u) != 0u || tspace_plan[1] == 7u) {
            scale = tspace_scaleOf(begin, end);
        }
        float3 normal = float3(0.0f, 0.0f, 1.0f);
        if ((tspace_plan[2] & 1u) != 0u) {
            float4 made = tspace_normalOfResult(begin, end, own, scale);
            normal = float3(made.x, made.y, made.z);
            if (made.w != 0.0f) {
                flags = flags | 0x10000000u;  // PlanBuffers::mixes_normals
            }
            if (tspace_setting(tspace_normal_format) == 1u) {
                uint at = (tspace_setting(tspace_normal_offset) + result * tspace_setting(tspace_normal_stride)) >> 2u;
                tspace_normals[at] = as_type<uint>(normal.x);
                tspace_normals[at + 1u] = as_type<uint>(normal.y);
                tspace_normals[at + 2u] = as_type<uint>(normal.z);
            }
        }
        float4 tangent = float4(0.0f, 0.0f, 0.0f, 0.0f);
        if ((flags & 0x20000000u) == 0u) {
            tangent = tspace_tangentOfResult(begin, end, flags, normal, scale);
        }
        if (tspace_setting(tspace_tangent_format) != 0u && (tspace_plan[2] & 1u) == 0u && own != tspace_next_part) {
            normal = tspace_normalOf(tspace_vertexOf(own));
        }
        tspace_writeTangent(result, normal, tangent);
    }
};

kernel void tspace_evaluate(const device uint* tspace_plan [[buffer(0)]],
                            const device uint* tspace_settings [[buffer(1)]],
                            const device uint* tspace_positions [[buffer(2)]],
                            const device uint* tspace_deform [[buffer(3)]], device uint* tspace_normals [[buffer(4)]],
                            device uint* tspace_tangents [[buffer(5)]], uint3 id [[thread_position_in_grid]]) {
    tspace_Evaluator evaluator{tspace_plan,   tspace_settings, tspace_positions,
                               tspace_deform, tspace_normals,  tspace_tangents};

    uint result = evaluator.tspace_setting(tspace_first_result) + id.x + id.y * 4194240u;
    if (result < evaluator.tspace_plan[4]) {
        evaluator.tspace_evaluateResult(result);
    }
}
