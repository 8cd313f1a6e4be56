// SPDX-License-Identifier: MIT
// Conversion of a mesh with separate index lists for normals or UVs to a mesh with a single list.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/build_parts.h"
#include "core/base/owned_mesh.h"
#include "tspace/execution.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

/// A mesh with a vertex for each combination of position, normal and UV that corners use. Corners and faces are those
/// of the input mesh, which must outlive it.
struct OneListMesh {
    /// arrays of the new vertices; normals are zero for vertices that no corner uses
    OwnedMesh own = {};
    std::vector<std::uint32_t> source_vertices = {};  ///< one per vertex: the vertex of the input mesh
    /// source normal of each vertex; kNoCorner: no corner uses the vertex
    std::vector<std::uint32_t> source_normals = {};
    MeshView view = {};  ///< view of these arrays, with the faces of the input mesh; the struct must not be moved

    OneListMesh() = default;
    OneListMesh(const OneListMesh&) = delete;
    OneListMesh& operator=(const OneListMesh&) = delete;
};

/// Returns whether normals or UVs have their own index list.
inline bool hasOwnLists(const MeshView& mesh) { return !kIsMinimal && mesh.hasOwnLists(); }

/// Sets to[i] = values[sources[i]]; zero for kNoCorner, that is, for vertices that no corner uses.
template <class T>
void gather(const StridedSpan<const T>& values, std::span<const std::uint32_t> sources, T* to) {
    for (std::size_t i = 0; i < sources.size(); ++i) to[i] = sources[i] == kNoCorner ? T{} : values[sources[i]];
}

/// Splits vertices whose corners differ in any attribute index list or in `further`. Existing vertices keep their
/// indices. `welded`: weld result of a non-indexed mesh; normals and UVs without a list then also cause splits.
/// Requires a valid mesh. Errors: outOfMemory, and those of splitVertices for `further`. O(corners) expected.
Result<Done> useOneList(const MeshView& mesh, const Execution& execution, OneListMesh& made,
                        std::span<const std::uint32_t> welded = {}, std::span<const CornerAttribute> further = {});

/// Returns body(view), where view is the mesh with a single index list. For functions with one result per corner, whose
/// order does not change.
template <class Body>
auto withOneList(const MeshView& mesh, const Execution& execution, Body&& body) -> decltype(body(mesh)) {
    if (Result<Done> valid = validate(mesh); !valid) return std::move(valid).error();
    OneListMesh made;
    if (Result<Done> done = useOneList(mesh, execution, made); !done) return std::move(done).error();
    return body(made.view);
}

}  // namespace tspace
