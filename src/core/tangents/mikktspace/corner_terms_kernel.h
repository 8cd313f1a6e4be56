// SPDX-License-Identifier: MIT
// Kernel of corner_terms.h. Included once per instruction set, after lanes_*.h and with TSPACE_LANES set to its
// namespace. Each lane is one triangle and performs the operations of the reference in the same order; zero tests and
// unit vectors as in evaluate.h.
#pragma once

#include "core/simd/vectors_kernel.h"
#include "core/tangents/mikktspace/corner_terms.h"

namespace tspace::mikk::TSPACE_LANES {

using namespace simd::TSPACE_LANES;

namespace {

constexpr float kSmallestNormal = 1.17549435e-38f;

inline Mask notZero(Floats a) { return absolute(a) > broadcast(kSmallestNormal); }
inline Mask equal(Vectors a, Vectors b) { return (a.x == b.x) & (a.y == b.y) & (a.z == b.z); }
inline Vectors select(Mask m, Vectors yes, Vectors no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}

/// Computes unit() of evaluate.h for a vector whose square is known. If the square is positive, some component is above
/// the smallest normal number (squares of smaller ones are zero), so notZero is tested only if the square is zero or
/// NaN.
inline Vectors unitByRules(Vectors v, Floats square) {
    const Vectors scaled = (broadcast(1.0f) / squareRoot(square)) * v;
    if (all(square > broadcast(0.0f))) [[likely]]
        return scaled;
    return select(notZero(v.x) | notZero(v.y) | notZero(v.z), scaled, v);
}

inline Vectors unitByRules(Vectors v) { return unitByRules(v, dot(v, v)); }
inline Vectors alongPlane(Vectors n, Vectors v) { return v - dot(n, v) * n; }
inline Vectors flatten(Vectors n, Vectors v) { return unitByRules(alongPlane(n, v)); }

/// Vertex data of one group of kWidth triangles.
struct Group {
    Vectors position[3];
    Floats u[3], v[3];

    void load(const CornerSource& source, const std::uint32_t* vertices, bool exact) {
#pragma GCC unroll 3  // keeps the arrays in registers
        for (std::size_t k = 0; k < 3; ++k) {
            position[k] = gatherVectors(source.positions, source.position_stride, vertices + k, exact);
            if (source.uv_stride == 8)
                gather2(source.uvs, 8, vertices + k, u[k], v[k]);
            else
                gather2(source.uvs, source.uv_stride, vertices + k, u[k], v[k]);
        }
    }

    [[nodiscard]] Mask isDegenerate() const {
        return equal(position[0], position[1]) | equal(position[1], position[2]) | equal(position[2], position[0]);
    }
};

/// Values of dP/du and dP/dv of triangles. Without `all`, only dP/du and the orientation.
struct Shape {
    Vectors s, t{zero(), zero(), zero()};
    Floats length_s = zero(), length_t = zero();
    Mask positive, no_area{}, finite{};

    Shape(const Group& g, bool all) {
        const Floats x = g.u[1] - g.u[0], y = g.v[1] - g.v[0], z = g.u[2] - g.u[0], w = g.v[2] - g.v[0];
        const Vectors d1 = g.position[1] - g.position[0], d2 = g.position[2] - g.position[0];
        const Floats area = x * w - y * z, size = absolute(area);
        const Vectors along_u = w * d1 - y * d2;
        const Floats long_u = squareRoot(dot(along_u, along_u));
        positive = area > zero();
        const Floats facing = select(positive, broadcast(1.0f), broadcast(-1.0f));
        s = keep(notZero(long_u), (facing / long_u) * along_u);
        if (!all) return;
        const Vectors along_v = minus(z) * d1 + x * d2;
        const Floats long_v = squareRoot(dot(along_v, along_v));
        t = keep(notZero(long_v), (facing / long_v) * along_v);
        length_s = long_u / size;
        length_t = long_v / size;
        no_area = !(notZero(area) & notZero(length_s) & notZero(length_t));
        const Floats infinity = broadcast(__builtin_huge_valf());
        finite = (length_s < infinity) & (length_t < infinity);
    }
};

/// Appends six marks: component x above the margin, below it, and the same for y and z.
inline Bits appendSides(Bits marks, Vectors v) {
    const Floats above = broadcast(kSideMargin), below = broadcast(-kSideMargin);
    for (const Floats component : {v.x, v.y, v.z})
        marks = appendBit(appendBit(marks, component > above), component < below);
    return marks;
}

/// Returns the marks of a corner: `facing`, the marks of its unit tangent s, whose square was `square` before it was
/// normalized, and the marks of its projected bitangent t.
inline Bits sidesOf(Vectors s, Floats square, Vectors t, Bits facing) {
    static_assert(kFacing == 0x3 && kTangentSides == 0x3f << 2 && kBitangentSides == 0x3f << 8);
    const Bits sides = appendSides(appendSides(broadcastBits(0), t), s);
    const Mask are_sure = (square > broadcast(kSmallestSquare)) & (dot(t, t) < broadcast(kLargestSquare));
    return shiftLeft<2>(keepWhere(sides, are_sure)) | facing;
}

/// Returns the weight of a corner, or, for the two weightings by angles, the cosine of the weight. projected_angle is
/// the weighting of MikkTSpace: the two edges at the corner are projected perpendicular to N and normalized, and the
/// angle between them is the weight.
inline Floats weightOrCosine(Weighting weighting, const Vectors& normal, const Vectors& previous, const Vectors& next) {
    if (weighting == Weighting::projected_angle) return dot(flatten(normal, previous), flatten(normal, next));
    if (weighting == Weighting::angle) return dot(unitByRules(previous), unitByRules(next));
    if (weighting == Weighting::one) return broadcast(1.0f);
    const Vectors c = cross(next, previous);
    return broadcast(0.5f) * squareRoot(dot(c, c));
}

inline void groupTerms(const CornerSource& source, const std::uint32_t* vertices, std::size_t first, unsigned valid,
                       bool exact, CornerTerms& terms) {
    Group group;
    group.load(source, vertices, exact);
    const Weighting weighting = kHasAllMethods ? source.weighting : Weighting::projected_angle;
    const bool with_marks = source.with_marks, with_bitangents = with_marks || !source.tangents_only;
    const Shape shape(group, with_bitangents);
    Bits facing = broadcastBits(0), flags = broadcastBits(0);
    Mask usable{};
    if (with_marks) {
        const Mask degenerate = group.isDegenerate();
        facing = orWhere(orWhere(facing, shape.positive, kFacesUp), !shape.positive, kFacesDown);
        usable = shape.finite & !shape.no_area;
        flags = orWhere(orWhere(flags, shape.no_area, kNoUvArea), degenerate, kDegenerateMark);
        flags = orWhere(flags, !shape.positive, kMirroredMark);
        if (weighting == Weighting::none) {
            const Bits all_marks = keepWhere(facing, usable) | flags;
            for (std::size_t k = 0; k < 3; ++k) store(terms.marks[k] + first, all_marks);
            return;
        }
        if (source.adding_only && (~bitsOf(shape.no_area | degenerate) & valid) == 0) [[unlikely]] {
            for (std::size_t k = 0; k < 3; ++k) store(terms.marks[k] + first, flags);
            return;
        }
    }
    const bool is_mikktspace = weighting == Weighting::projected_angle;
    Vectors s[3], t[3];
    Floats weights[3];
    Bits marks[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vectors normal = gatherVectors(source.normals, source.normal_stride, vertices + k, exact);
        const Vectors projected = alongPlane(normal, shape.s);
        const Floats square = dot(projected, projected);
        s[k] = unitByRules(projected, square);
        if (with_bitangents) {
            const Vectors projected_t = alongPlane(normal, shape.t);
            if (!source.tangents_only) t[k] = unitByRules(projected_t);
            if (source.directions != nullptr) {
                const Floats directions[2][3] = {{s[k].x, s[k].y, s[k].z},
                                                 {projected_t.x, projected_t.y, projected_t.z}};
                for (std::size_t i = 0; i < 3; ++i) {
                    store(source.directions->unit_s[i][k] + first, directions[0][i]);
                    store(source.directions->projected_t[i][k] + first, directions[1][i]);
                }
            }
            marks[k] = is_mikktspace ? sidesOf(s[k], square, projected_t, facing) : facing;
        }
        const Vectors here = group.position[k];
        weights[k] =
            weightOrCosine(weighting, normal, group.position[(k + 2) % 3] - here, group.position[(k + 1) % 3] - here);
    }
    if (is_mikktspace || weighting == Weighting::angle) {
        const Floats cosines[3] = {weights[0], weights[1], weights[2]};
        arcCosines(cosines, weights);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Floats weight = weights[k];
        if (with_marks) store(terms.marks[k] + first, keepWhere(marks[k], usable & (weight == weight)) | flags);
        const std::size_t row = 3 * first + k;
        storeRows(terms.s[row], weight * s[k].x, weight * s[k].y, weight * s[k].z, weight);
        if (!source.tangents_only) {
            storeRows(terms.t[row], weight * t[k].x, weight * t[k].y, weight * t[k].z, weight * shape.length_s);
            store(terms.lengths_t[k] + first, weight * shape.length_t);
        }
    }
}

}  // namespace

void cornerTerms(const CornerSource& source, const std::uint32_t* vertices, std::size_t count, CornerTerms& terms) {
    for (std::size_t t = 0; t < count; t += kWidth) {
        const std::size_t left = count - t;
        const unsigned valid = left >= kWidth ? (1u << kWidth) - 1 : (1u << left) - 1;
        groupTerms(source, vertices + 3 * t, t, valid, includesLast(vertices + 3 * t, source.last_vertex), terms);
    }
}

}  // namespace tspace::mikk::TSPACE_LANES
