// SPDX-License-Identifier: MIT
// A second look at the nodes whose sums did not show that their group cannot split (corner_terms.h): there,
// each tangent and bitangent is looked at.
#pragma once

#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// Of the given nodes, sets kCannotSplit at those with one fan and one orientation where all tangents are on
/// one side of the plane across their sum, and all bitangents on one side of the plane across theirs: no two
/// are opposed then. `source` must be the one of the sums, but not tangents_only. Reads all indices once.
/// Throws OutOfMemory.
void checkSplits(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                 std::span<const std::uint32_t> candidates, const CornerSource& source,
                 CornerTermsFunction terms, NodeSums& sums, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
