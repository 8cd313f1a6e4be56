// SPDX-License-Identifier: MIT
// Evidence first: tangents, then who wrote the file.
#include "core/mesh/quads/choose_faces.h"

#include <utility>

namespace tspace {

namespace {

/// In a mesh of quads as Blender writes it nearly all triangles meet in one of its two ways; in one of triangles few
/// do.
constexpr double kMostTriangles = 0.6;

/// Blender cuts a quad along its first and third corner, one that this would turn over along the others, and writes the
/// corners of both triangles in the order of the quad's.
bool isBlendersCut(unsigned pattern) {
    constexpr unsigned kFan = 3 * 2 + 0, kOther = 3 * 1 + 2;
    return pattern == kFan || pattern == kOther;
}

bool looksLikeBlendersQuads(const QuadCandidates& candidates, const QuadPairs& pairs) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < pairs.size(); ++t) {
        if (pairs[t] != PairKind::none && isBlendersCut(candidates.patternOf(t))) count += 2;
    }
    return static_cast<double>(count) >= kMostTriangles * static_cast<double>(candidates.triangleCount());
}

}  // namespace

Result<QuadFaces> chooseFaces(const MeshView& triangles, std::span<const Vec4> stored, bool is_blenders, Faces faces,
                              const Execution& execution) {
    if (faces == Faces::triangles) return QuadFaces{};
    if (!stored.empty()) {
        Result<QuadFit> fit = fitQuads(triangles, stored, execution);
        if (!fit) return std::move(fit).error();
        if (fit->wins()) return std::move(fit->faces);
        if (faces == Faces::automatic) return QuadFaces{};
    } else if (faces == Faces::automatic && !is_blenders) {
        return QuadFaces{};
    }
    const QuadCandidates candidates(triangles);
    if (candidates.count() == 0) return QuadFaces{};
    const QuadPairs pairs = pairsByShape(triangles, candidates);
    if (faces == Faces::automatic && !looksLikeBlendersQuads(candidates, pairs)) return QuadFaces{};
    return facesOfPairs(candidates, pairs);
}

QuadFaces facesOfPolygons(std::span<const std::uint32_t> face_sizes, const Triangulation& triangles) {
    constexpr std::uint32_t kSkipped = 0xffffffffU;
    QuadFaces faces;
    std::vector<std::uint32_t> face_corner_of;  // per corner of a polygon
    for (const std::uint32_t size : face_sizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            face_corner_of.push_back(size < 3 ? kSkipped : static_cast<std::uint32_t>(faces.corners.size()));
            if (size >= 3) faces.corners.push_back(kSkipped);
        }
        if (size >= 3) faces.sizes.push_back(size);
        faces.quad_count += size > 3 ? 1 : 0;
    }
    faces.face_corners.reserve(triangles.corners.size());
    for (std::size_t c = 0; c < triangles.corners.size(); ++c) {
        const std::uint32_t face_corner = face_corner_of[triangles.corners[c]];
        faces.corners[face_corner] = static_cast<std::uint32_t>(c);
        faces.face_corners.push_back(face_corner);
    }
    return faces;
}

}  // namespace tspace
