// SPDX-License-Identifier: MIT
// One dP/du and dP/dv per face, made orthogonal to the normal of each of its corners.
//
// For a polygon they are the mean over its UV area, sum(t2 E1 - t1 E2) / sum(determinant) over any fan of
// triangles: by Green's theorem a value of the border alone, which no choice of diagonals changes.
#include "core/base/parallel.h"
#include "core/base/uv_frame.h"
#include "core/tangents/indexed_methods.h"

namespace tspace {

namespace {

Derivatives faceDerivatives(const IndexedPlan& plan, const Pose& pose, std::uint32_t first, std::uint32_t past) {
    const std::uint32_t v0 = plan.corner_vertices[first];
    UvFrame sum;
    for (std::uint32_t c = first + 1; c + 1 < past; ++c) {
        const std::uint32_t v1 = plan.corner_vertices[c];
        const std::uint32_t v2 = plan.corner_vertices[c + 1];
        const UvFrame frame = uvFrame(pose.positions[v0], pose.positions[v1], pose.positions[v2], plan.uvs[v0],
                                      plan.uvs[v1], plan.uvs[v2]);
        sum = {sum.tangent + frame.tangent, sum.bitangent + frame.bitangent, sum.determinant + frame.determinant};
    }
    if (!hasUvArea(sum.determinant)) return {};
    const double r = 1 / sum.determinant;
    const Derivatives d{r * sum.tangent, r * sum.bitangent};
    return std::isfinite(length(d.s)) && std::isfinite(length(d.t)) ? d : Derivatives{};
}

}  // namespace

void evaluateFlat(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, Parallel& parallel,
                  TangentReport& report) {
    report.default_corner_count =
        sumRanges(parallel, plan.face_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            std::uint64_t count = 0;
            for (std::size_t face = begin; face < end; ++face) {
                const std::uint32_t first = plan.faceBegin(face);
                const std::uint32_t past = plan.faceBegin(face + 1);
                if (first == past || !plan.isUsed(first)) continue;
                const Derivatives d = faceDerivatives(plan, pose, first, past);
                for (std::uint32_t c = first; c < past; ++c) {
                    const CornerFrame frame =
                        makeCornerFrame(d, pose.normals[plan.corner_vertices[c]], plan.sign_factor);
                    writeFrame(out, c, frame);
                    count += frame.is_default ? 1 : 0;
                }
            }
            return count;
        });
}

}  // namespace tspace
