// SPDX-License-Identifier: MIT
// Buffers that are left without a reader when geometry was packed or unpacked.
#pragma once

#include "model/gltf/document.h"

namespace tspace::gltf {

/// Removes buffers that no view and no compression extension names, but for those that the output writes itself. Views
/// and extensions follow.
void removeUnreferencedBuffers(Document& document);

/// Removes buffers of the output that lost all their bytes: a buffer of length 0 is not valid.
void removeEmptiedBuffers(Document& document);

}  // namespace tspace::gltf
