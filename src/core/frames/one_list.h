// SPDX-License-Identifier: MIT
// A mesh whose normals or UVs have index lists of their own, as one with a single list.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/owned_mesh.h"
#include "tspace/execution.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

/// A mesh with a vertex for each combination of position, normal and UV that corners name. Corners and faces are those of
/// the given mesh, which must outlive it.
struct OneListMesh {
    OwnedMesh own = {};                               ///< normals are zero where no corner uses the vertex
    std::vector<std::uint32_t> source_vertices = {};  ///< one per vertex here: the given mesh's
    std::vector<std::uint32_t> source_normals = {};  ///< index of the source normal, or kNoCorner if no corner uses one
    MeshView view = {};  ///< view of the arrays above, with the faces of the given mesh; the struct must not be moved

    OneListMesh() = default;
    OneListMesh(const OneListMesh&) = delete;
    OneListMesh& operator=(const OneListMesh&) = delete;
};

/// Whether normals or UVs have an index list of their own; never with TSPACE_MIKKTSPACE_ONLY, whose caller refuses it.
inline bool hasOwnLists([[maybe_unused]] const MeshView& mesh) {
#ifdef TSPACE_MIKKTSPACE_ONLY
    return false;
#else
    return mesh.hasOwnLists();
#endif
}

/// to[i] = values[sources[i]]; zero where that is kNoCorner, of vertices that no corner uses.
template <class T>
void gather(const StridedSpan<const T>& values, std::span<const std::uint32_t> sources, T* to) {
    for (std::size_t i = 0; i < sources.size(); ++i) to[i] = sources[i] == kNoCorner ? T{} : values[sources[i]];
}

/// Splits the vertices where the attributes' own lists tell corners apart, and where any of `further` does. The vertices
/// of the mesh keep their places. `welded`: the vertices of a mesh without indices, of which some are one; then normals
/// and UVs without a list tell corners apart as well. The mesh is a valid one. Errors: outOfMemory, and those of
/// splitVertices for `further`. O(corners) expected.
Result<Done> useOneList(const MeshView& mesh, const Execution& execution, OneListMesh& made,
                        std::span<const std::uint32_t> welded = {}, std::span<const CornerAttribute> further = {});

/// body(view) of the mesh with one list. For functions that give one result per corner: these stay where they are.
template <class Body>
auto withOneList(const MeshView& mesh, const Execution& execution, Body&& body) -> decltype(body(mesh)) {
    if (Result<Done> valid = validate(mesh); !valid) return std::move(valid).error();
    OneListMesh made;
    if (Result<Done> done = useOneList(mesh, execution, made); !done) return std::move(done).error();
    return body(made.view);
}

}  // namespace tspace
