// SPDX-License-Identifier: MIT
// Loops over all faces, and over all indices: their type is dispatched once per loop, not per corner.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tspace/mesh.h"

namespace tspace {

/// body(vertexOf), where vertexOf(c) is view[c]. Compiled for the usual type and for any.
template <class Body>
decltype(auto) withIndices(const IndexView& view, Body&& body) {
#ifdef TSPACE_SMALL  // which has no others
    const auto* data = view.type == IndexType::none ? nullptr : static_cast<const std::uint32_t*>(view.data);
    return body([data](std::size_t c) { return data == nullptr ? static_cast<std::uint32_t>(c) : data[c]; });
#endif
    if (view.type == IndexType::u32)
        return body([data = static_cast<const std::uint32_t*>(view.data)](std::size_t c) { return data[c]; });
    return body([view](std::size_t c) { return view[c]; });
}

/// Writes the indices [first, first + count), of another type than 32-bit numbers, to `buffer` and returns it.
const std::uint32_t* widenIndices(const IndexView& view, std::size_t first, std::size_t count, std::uint32_t* buffer);

/// The indices [first, first + count) as 32-bit numbers: where they lie, or in `buffer`.
inline const std::uint32_t* readIndices(const IndexView& view, std::size_t first, std::size_t count,
                                        std::uint32_t* buffer) {
    if (view.type == IndexType::u32) return static_cast<const std::uint32_t*>(view.data) + first;
    return widenIndices(view, first, count, buffer);
}

inline std::uint32_t faceSize(const MeshView& mesh, std::size_t face) {
    return mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[face];
}

/// body(face, first_corner, corner_count) for each face in order.
template <class Body>
void forEachFace(const MeshView& mesh, Body&& body) {
    const std::size_t faces = mesh.faceCount();
    // Local copies, which stores of the body cannot alias.
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
