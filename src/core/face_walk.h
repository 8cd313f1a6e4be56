// SPDX-License-Identifier: MIT
// Walking faces in order with the number of their first corner.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tspace/mesh.h"

namespace tspace {

inline std::uint32_t faceSize(const MeshView& mesh, std::size_t face) {
    return mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[face];
}

/// body(face, first_corner, corner_count) for each face in order.
template <class Body>
void forEachFace(const MeshView& mesh, Body&& body) {
    const std::size_t faces = mesh.faceCount();
    // In variables of their own, which no store of the body can change.
    const std::uint32_t* const sizes = mesh.face_sizes.data();
    const bool one_size = mesh.face_sizes.empty();
    const std::uint32_t same_size = mesh.face_size;
    std::size_t corner = 0;
    for (std::size_t face = 0; face < faces; ++face) {
        const std::uint32_t size = one_size ? same_size : sizes[face];
        body(face, corner, size);
        corner += size;
    }
}

}  // namespace tspace
