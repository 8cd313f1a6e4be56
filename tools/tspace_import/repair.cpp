// SPDX-License-Identifier: MIT
// Replaces and counts invalid numbers by the rules for OBJ (src/model/obj).
#include "repair.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace tspace::import {
namespace {

/// Normals that are unit within the validator's tolerance keep their bits.
constexpr double kUnitTolerance = 5e-4;

using Vec = std::array<double, 3>;

Vec at(const std::vector<float>& values, std::size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

double lengthOf(const Vec& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

bool hasDirection(double length) { return std::isfinite(length) && length > 1e-30; }

void put(std::vector<float>& values, std::size_t i, const Vec& v, double length) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = static_cast<float>(v[k] / length);
}

Vec crossOf(const Vec& a, const Vec& b, const Vec& c) {
    const Vec e = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, f = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
}

}  // namespace

std::vector<std::string> RepairCounts::warnings() const {
    std::vector<std::string> list;
    const auto add = [&list](std::size_t count, const char* one, const char* several) {
        if (count != 0) list.push_back(std::to_string(count) + " " + (count == 1 ? one : several));
    };
    add(positions, "position is not finite and was moved to the origin",
        "positions are not finite and were moved to the origin");
    add(uvs, "texture coordinate is not finite and was set to 0",
        "texture coordinates are not finite and were set to 0");
    add(normals, "normal is zero or not finite and was replaced by a face normal",
        "normals are zero or not finite and were replaced by face normals");
    add(tangents, "tangent is not finite and was set to 0", "tangents are not finite and were set to 0");
    add(transforms, "node or joint matrix is not finite and was ignored",
        "node or joint matrices are not finite and were ignored");
    if (coarse_places != 0) {
        char meters[32];
        const auto end = std::to_chars(meters, meters + sizeof meters, worst_place, std::chars_format::general, 2);
        list.push_back(std::to_string(coarse_places) + (coarse_places == 1 ? " node is" : " nodes are") +
                       " so far from the origin that rounding of the translation to 32-bit floats in the importer may "
                       "change the position by up to " +
                       std::string(meters, end.ptr) + " m");
    }
    return list;
}

std::string RepairCounts::coarseness() const {
    return "positions are so far from the origin that 32-bit floats distort the shape: rounding changes " +
           std::to_string(coarse_edges) + " of " + std::to_string(edges) + " edges of triangles";
}

double unitInterval(float value, double otherwise) {
    return std::isfinite(value) ? std::clamp(static_cast<double>(value), 0.0, 1.0) : otherwise;
}

bool isFinite(const float* values, std::size_t count) {
    return std::all_of(values, values + count, [](float value) { return std::isfinite(value); });
}

std::size_t zeroNotFinite(std::vector<float>& values, std::size_t components) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size(); i += components) {
        if (isFinite(&values[i], components)) continue;
        std::fill_n(&values[i], components, 0.0f);
        ++count;
    }
    return count;
}

std::size_t repairNormals(std::vector<float>& normals, const std::vector<float>& positions,
                          const std::vector<std::uint32_t>& triangles) {
    const std::size_t vertex_count = normals.size() / 3;
    std::vector<bool> is_bad(vertex_count, false);
    std::size_t count = 0;
    for (std::size_t i = 0; i < vertex_count; ++i) {
        const double length = lengthOf(at(normals, i));
        if (!hasDirection(length)) {
            is_bad[i] = true;
            ++count;
            put(normals, i, {0, 0, 1}, 1);
        } else if (std::abs(length - 1) > kUnitTolerance) {
            put(normals, i, at(normals, i), length);
        }
    }
    for (std::size_t t = 0; count != 0 && t + 2 < triangles.size(); t += 3) {
        const std::uint32_t* corners = &triangles[t];
        if (!is_bad[corners[0]] && !is_bad[corners[1]] && !is_bad[corners[2]]) continue;
        const Vec cross = crossOf(at(positions, corners[0]), at(positions, corners[1]), at(positions, corners[2]));
        const double length = lengthOf(cross);
        if (!hasDirection(length)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_bad[corners[k]]) put(normals, corners[k], cross, length);
            is_bad[corners[k]] = false;
        }
    }
    return count;
}

void countCoarseEdges(const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles,
                      RepairCounts& repairs) {
    constexpr double kMinSteps = 500, kFar = 1 << 14;
    // In floats of integers and short fractions the last bits are zero; in rounded numbers they rarely are.
    constexpr std::uint32_t kLastBits = 63;
    const auto isRound = [](float value) { return (std::bit_cast<std::uint32_t>(value) & kLastBits) == 0; };
    const auto stepAt = [](float value) {
        const float size = std::fabs(value);
        return double{std::nextafter(size, std::numeric_limits<float>::infinity())} - double{size};
    };
    const std::size_t edges_before = repairs.edges;
    bool is_far = false;
    for (std::size_t c = 0; c < triangles.size(); ++c) {
        const float* const a = &positions[std::size_t{3} * triangles[c]];
        const float* const b = &positions[std::size_t{3} * triangles[c - c % 3 + (c + 1) % 3]];
        const double length = lengthOf({double{b[0]} - a[0], double{b[1]} - a[1], double{b[2]} - a[2]});
        is_far = is_far || lengthOf({a[0], a[1], a[2]}) > kFar;
        if (!(length > 0)) continue;
        ++repairs.edges;
        bool is_coarse = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const double step = std::max(stepAt(a[k]), stepAt(b[k]));
            is_coarse = is_coarse || (step * kMinSteps > length && !(isRound(a[k]) && isRound(b[k])));
        }
        repairs.coarse_edges += is_coarse;
    }
    if (repairs.edges != edges_before || !is_far) return;
    repairs.edges += triangles.size();
    repairs.coarse_edges += triangles.size();
}

void countCoarsePlace(const aiMatrix4x4& matrix, double meters, RepairCounts& repairs) {
    constexpr double kMinMeters = 0.001;
    float largest = 0;
    for (const float value : {matrix.a4, matrix.b4, matrix.c4}) {
        if (std::isfinite(value)) largest = std::max(largest, std::fabs(value));
    }
    const double step = double{std::nextafter(largest, std::numeric_limits<float>::infinity())} - double{largest};
    const double error = meters * step / 2;
    if (!std::isfinite(error) || error < kMinMeters) return;
    ++repairs.coarse_places;
    repairs.worst_place = std::max(repairs.worst_place, error);
}

std::vector<float> columnsOf(const aiMatrix4x4& matrix, RepairCounts& repairs) {
    aiMatrix4x4 m = matrix;
    if (!isFinite(m[0], 16)) {
        m = aiMatrix4x4();
        ++repairs.transforms;
    }
    return {m.a1, m.b1, m.c1, 0, m.a2, m.b2, m.c2, 0, m.a3, m.b3, m.c3, 0, m.a4, m.b4, m.c4, 1};
}

aiQuaternion unitRotation(const aiQuaternion& rotation) {
    const double x = rotation.x, y = rotation.y, z = rotation.z, w = rotation.w;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!hasDirection(length)) return {};
    return {static_cast<float>(w / length), static_cast<float>(x / length), static_cast<float>(y / length),
            static_cast<float>(z / length)};
}

}  // namespace tspace::import
