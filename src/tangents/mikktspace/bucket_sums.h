// SPDX-License-Identifier: MIT
// The sums of all nodes of a mesh in random order.
#pragma once

#include <span>

#include "tangents/mikktspace/node_buckets.h"
#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// Fills `sums`, whose buffers have their sizes, and whose marks of triangles are 0. nodes.vertex() must be
/// valid.
void sumBuckets(const NodeBuckets& buckets, const Nodes& nodes, const CornerSource& source, CornerTermsFunction terms,
                NodeSums& sums, const FinishNodes& finish, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
