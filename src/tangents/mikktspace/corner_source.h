// SPDX-License-Identifier: MIT
// What a kernel is told about a call.
#pragma once

#include "tangents/mikktspace/corner_terms.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

inline bool wantsTangentsOnly(const TangentOutput& out) {
    return out.bitangents.empty() && out.magnitudes_s.empty() && out.magnitudes_t.empty();
}

/// `uvs` has one entry per vertex of the pose, of which there is at least one.
inline CornerSource cornerSource(const Pose& pose, const StridedSpan<const Vec2>& uvs, Method method,
                                 bool tangents_only) {
    CornerSource source;
    source.positions = reinterpret_cast<const std::byte*>(pose.positions.data);
    source.normals = reinterpret_cast<const std::byte*>(pose.normals.data);
    source.uvs = reinterpret_cast<const std::byte*>(uvs.data);
    source.position_stride = pose.positions.stride_bytes;
    source.normal_stride = pose.normals.stride_bytes;
    source.uv_stride = uvs.stride_bytes;
    source.last_vertex = static_cast<std::uint32_t>(pose.positions.count - 1);
    source.weighting = method == Method::uniform ? Weighting::one
                       : method == Method::angle ? Weighting::angle
                       : method == Method::area  ? Weighting::area
                                                 : Weighting::projected_angle;
    source.tangents_only = tangents_only;
    return source;
}

}  // namespace tspace::mikk
