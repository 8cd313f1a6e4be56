// SPDX-License-Identifier: MIT
// The vertex data of one call, as kernels read it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace {

struct VertexArrays {
    const std::byte* positions = nullptr;
    const std::byte* normals = nullptr;
    const std::byte* uvs = nullptr;
    std::size_t position_stride = 0, normal_stride = 0, uv_stride = 0;
    /// Right after this one's position and normal nothing may be read; all bits set: there is no such vertex.
    std::uint32_t last_vertex = 0;
};

/// From spans of one entry per vertex, of which there is at least one.
template <class Pose, class Uvs>
VertexArrays vertexArrays(const Pose& pose, const Uvs& uvs) {
    return {reinterpret_cast<const std::byte*>(pose.positions.data),
            reinterpret_cast<const std::byte*>(pose.normals.data),
            reinterpret_cast<const std::byte*>(uvs.data),
            pose.positions.stride_bytes,
            pose.normals.stride_bytes,
            uvs.stride_bytes,
            static_cast<std::uint32_t>(pose.positions.count - 1)};
}

}  // namespace tspace
