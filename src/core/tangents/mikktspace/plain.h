// SPDX-License-Identifier: MIT
// The method `mikktspace` in its plainest form: scalar code that follows docs/concepts/methods/mikktspace.md step by
// step. It is written to be read, and tests compare the engine with it bit for bit. The library itself does not contain
// it.
#pragma once

#include "tspace/tangents.h"

namespace tspace::mikk {

/// Computes the result of generateTangents() with Method::mikktspace and Ngons::skip, without threads and kernels.
///
/// mesh     a mesh that validate() accepts, with normals and UVs
/// options  convention, angular_threshold_deg and pairing are used
/// out      spans of mesh.cornerCount() entries; empty spans are not written
/// Quadratic in the number of triangles around a vertex and on an edge. Throws std::bad_alloc.
void plainMikktspace(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out);

}  // namespace tspace::mikk
