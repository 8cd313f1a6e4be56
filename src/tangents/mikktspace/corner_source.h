// SPDX-License-Identifier: MIT
// What a kernel is told about a call.
#pragma once

#include "tangents/mikktspace/corner_terms.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

inline bool wantsTangentsOnly(const TangentOutput& out) {
#ifdef TSPACE_MIKKTSPACE_ONLY
    return true;
#endif
    return out.bitangents.empty() && out.magnitudes_s.empty() && out.magnitudes_t.empty();
}

/// `fast` and `best` sum in a way of their own (estimators/), and use these kernels for marks.
inline Weighting weightingOf(Method method) {
    switch (method) {
        case Method::fast:
        case Method::best:
            return Weighting::none;
        case Method::uniform:
            return Weighting::one;
        case Method::angle:
            return Weighting::angle;
        case Method::area:
            return Weighting::area;
        default:
            return Weighting::projected_angle;
    }
}

/// `uvs` has one entry per vertex of the pose, of which there is at least one.
inline CornerSource cornerSource(const Pose& pose, const StridedSpan<const Vec2>& uvs, Method method,
                                 bool tangents_only) {
    return {vertexArrays(pose, uvs), weightingOf(method), tangents_only};
}

}  // namespace tspace::mikk
