// SPDX-License-Identifier: MIT
// Pools and primitives for tests of computeFrames: a few fixed valid ones, and random ones with all special cases.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "support/same_bits.h"

namespace tspace::test {

using Indices = std::vector<std::uint32_t>;

struct PoolOutcome {
    PoolFrames frames;
    std::vector<FramesReport> reports;
};

inline PoolOutcome compute(const PoolView& pool, const std::vector<PrimitiveGeometry>& primitives,
                           const FramesOptions& options) {
    std::vector<FramesReport> reports(primitives.size());
    Result<PoolFrames> frames = computeFrames(pool, primitives, options, reports);
    EXPECT_TRUE(frames.ok()) << (frames.ok() ? "" : frames.error().message);
    return {frames.ok() ? *std::move(frames) : PoolFrames{}, std::move(reports)};
}

/// Returns the mesh that a reader would get from the written file.
inline OwnedMesh rebuilt(const OwnedMesh& pool, const PoolFrames& frames) {
    OwnedMesh result;
    result.normals = frames.normals;
    for (const std::uint32_t source : frames.source_vertices) {
        result.positions.push_back(pool.positions[source]);
        if (!frames.normals_generated) result.normals.push_back(pool.normals[source]);
        if (!pool.uvs.empty()) result.uvs.push_back(pool.uvs[source]);
    }
    return result;
}

inline std::vector<PrimitiveGeometry> rebuilt(const PoolFrames& frames) {
    std::vector<PrimitiveGeometry> result;
    for (const Indices& indices : frames.indices) result.push_back({.indices = indices});
    return result;
}

inline FramesOptions withMethod(Method method) {
    FramesOptions options;
    options.tangents.method = method;
    return options;
}

/// Returns a square of two triangles with axis-aligned UVs.
inline OwnedMesh square() {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
            .normals = {4, Vec3{0, 0, 1}},
            .uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
}

inline float anyNumber() {
    return *rc::gen::element(0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 2.0f, 0.25f, -0.75f, 3.0f, 1e20f, 1e-30f, std::nanf(""));
}

/// Returns a number, nearly always a small integer, so that neighbors, mirrored UVs, degenerate faces and collapsed UVs
/// all occur.
inline float someNumber() {
    return *rc::gen::inRange(0, 60) == 0 ? anyNumber() : static_cast<float>(*rc::gen::inRange(-2, 3));
}

inline OwnedMesh anyPool() {
    OwnedMesh pool;
    const auto count = *rc::gen::inRange<std::size_t>(1, 14);
    const bool has_normals = *rc::gen::arbitrary<bool>();
    for (std::size_t v = 0; v < count; ++v) {
        pool.positions.push_back({someNumber(), someNumber(), someNumber()});
        pool.uvs.push_back({someNumber(), someNumber()});
        if (has_normals) pool.normals.push_back({someNumber(), someNumber(), someNumber()});
    }
    return pool;
}

/// Returns whether no value is NaN or huge.
inline bool isOrdinary(const OwnedMesh& pool) {
    const auto are = [](const auto&... values) { return ((std::fabs(values) < 1e6f) && ...); };
    const auto are3 = [&](const Vec3& v) { return are(v.x, v.y, v.z); };
    return std::all_of(pool.positions.begin(), pool.positions.end(), are3) &&
           std::all_of(pool.normals.begin(), pool.normals.end(), are3) &&
           std::all_of(pool.uvs.begin(), pool.uvs.end(), [&](const Vec2& v) { return are(v.x, v.y); });
}

inline std::vector<PrimitiveGeometry> anyTriangles(const OwnedMesh& pool) {
    std::vector<PrimitiveGeometry> primitives(*rc::gen::inRange<std::size_t>(1, 4));
    const auto vertices = static_cast<std::uint32_t>(pool.positions.size());
    for (PrimitiveGeometry& primitive : primitives) {
        const auto faces = *rc::gen::inRange<std::size_t>(0, 20);
        primitive.indices = *rc::gen::container<Indices>(3 * faces, rc::gen::inRange<std::uint32_t>(0, vertices));
    }
    return primitives;
}

/// Returns random primitives: triangles, or sometimes faces of 1 to 6 corners.
inline std::vector<PrimitiveGeometry> anyFaces(const OwnedMesh& pool) {
    std::vector<PrimitiveGeometry> primitives = anyTriangles(pool);
    for (PrimitiveGeometry& primitive : primitives) {
        if (*rc::gen::arbitrary<bool>()) continue;
        for (std::size_t left = primitive.indices.size(); left > 0; left -= primitive.face_sizes.back()) {
            const auto size = *rc::gen::inRange<std::uint32_t>(1, 7);
            primitive.face_sizes.push_back(std::min(size, static_cast<std::uint32_t>(left)));
        }
    }
    return primitives;
}

inline FramesOptions anyOptions() {
    FramesOptions options =
        withMethod(*rc::gen::element(Method::mikktspace, Method::uniform, Method::angle, Method::area, Method::flat,
                                     Method::basis, Method::fast, Method::best));
    options.normals.weighting =
        *rc::gen::element(NormalWeighting::flat, NormalWeighting::angle, NormalWeighting::area, NormalWeighting::best);
    options.normals.crease_angle_deg = *rc::gen::element(180.0f, 30.0f);
    options.tangents.pairing = *rc::gen::element(Pairing::reference, Pairing::corrected);
    options.sanitize = *rc::gen::inRange(0, 4) != 0;
    options.bitangents = *rc::gen::arbitrary<bool>();
    return options;
}

}  // namespace tspace::test
