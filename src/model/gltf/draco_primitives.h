// SPDX-License-Identifier: MIT
// Primitives compressed with KHR_draco_mesh_compression. Loading decodes them, so that their accessors have elements
// without a buffer view; the editor encodes changed primitives again.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>

#include "model/gltf/compression_extensions.h"
#include "model/gltf/document.h"

namespace tspace::gltf {

/// Returns the Draco attribute kind for an attribute name.
DracoKind dracoKind(const std::string& name);

/// Decodes the primitives whose accessors have no uncompressed data. An accessor that represents different data in
/// different primitives is duplicated; counts and modes are corrected to match the data. Fails with invalidFile at the
/// extension's JSON pointer. Without the library the accessors are marked as hidden.
void decodeDracoPrimitives(Document& document);

/// Stores data in a buffer view and returns its index; `replaces`: a view without other uses.
using StoreBlob = std::function<std::size_t(Bytes data, std::optional<std::size_t> replaces)>;

/// Encodes the Draco primitives that use one of the `changed` accessors. `view_uses`: number of references to each
/// view.
void encodeDracoPrimitives(Document& document, const std::set<std::size_t>& changed,
                           const std::vector<std::size_t>& view_uses, const StoreBlob& store);

}  // namespace tspace::gltf
