// SPDX-License-Identifier: MIT
// A second look at the fans that fan.h could not follow, because triangles came in an order for which two
// paths are not enough.
#pragma once

#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// Lists the corners of these nodes after all, and pairs them as pairing.h says. Where they turn out to be
/// one fan, the node's fan is made so. Does nothing when they are few: then listing them costs more than it
/// saves. Nodes of many triangles stay as they are. Reads all indices once. Throws OutOfMemory.
void checkFans(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, NodeSums& sums,
               const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
