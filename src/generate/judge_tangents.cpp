// SPDX-License-Identifier: MIT
// What is there, judged by the engine of `check`.
#include "generate/judge_tangents.h"

#include "check/findings.h"
#include "check/quad_reading.h"

namespace tspace {

namespace {

constexpr const char* kVertices = "vertices";

/// Mended even where it concerns a single vertex, because no file may have it.
std::string whyForbidden(const FrameHealth& health) {
    if (health.not_finite.count != 0) return countText(health.not_finite, kVertices) + " have NaN or infinite tangents";
    if (health.not_unit.count != 0) return "the tangents of " + countText(health.not_unit, kVertices) + " are not unit";
    if (health.sign_not_one.count != 0)
        return "the sign of " + countText(health.sign_not_one, kVertices) + " is neither +1 nor -1";
    return {};
}

}  // namespace

Result<std::string> whyTangentsCannotStay(const VertexPool& pool, std::span<const Vec4> tangents,
                                          std::span<const PrimitiveGeometry> primitives,
                                          const GenerateOptions& options) {
    std::vector<std::uint32_t> corners;
    for (const PrimitiveGeometry& primitive : primitives)
        corners.insert(corners.end(), primitive.indices.begin(), primitive.indices.end());
    const bool is_turned = !pool.uv_matrix.isIdentity();
    const std::vector<Vec2> turned = is_turned ? transformUvs(pool.uvs, pool.uv_matrix) : std::vector<Vec2>{};
    const TangentView mesh = {.positions = pool.positions,
                              .normals = pool.normals,
                              .tangents = tangents,
                              .uvs = is_turned ? std::span<const Vec2>(turned) : std::span<const Vec2>(pool.uvs),
                              .corners = corners};
    CheckOptions check;
    check.convention = options.tangents.convention;
    check.execution = options.tangents.execution;
    const Surface surface = describeSurface(mesh);
    Result<FrameHealth> health = examineTangents(mesh, surface, check);
    if (!health) return health.error();
    const Result<std::optional<QuadReading>> quads = findQuads(mesh, surface, *health, check);
    if (!quads) return quads.error();
    if (*quads) {
        TangentView on_quads = mesh;
        on_quads.corners = (*quads)->corners;
        health = examineTangents(on_quads, (*quads)->surface, check);
        if (!health) return health.error();
    }
    std::string why = whyForbidden(*health);
    return why.empty() ? whyTangentsAreWrong(*health, check) : why;
}

}  // namespace tspace
