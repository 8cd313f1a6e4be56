// SPDX-License-Identifier: MIT
// Primitives that KHR_draco_mesh_compression compresses. Loading decodes them, so that their accessors have elements
// although they have no buffer view; the editor asks to have changed primitives encoded.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>

#include "model/gltf/compression_extensions.h"
#include "model/gltf/document.h"

namespace tspace::gltf {

/// The kind of attribute that Draco is told for this name.
DracoKind dracoKind(const std::string& name);

/// Decodes the primitives whose accessors have no data of their own. Accessors without data that stand for different
/// data in different primitives are given to each of them; counts and modes are corrected to what the data hold. Fails
/// with invalidFile at the extension's pointer. Without the library the accessors are marked as hidden.
void decodeDracoPrimitives(Document& document);

/// Puts data into a buffer view and returns its index; `replaces`: a view that nothing else uses any more.
using StoreBlob = std::function<std::size_t(Bytes data, std::optional<std::size_t> replaces)>;

/// Encodes the Draco primitives that use one of the `changed` accessors. `view_uses`: references to each view.
void encodeDracoPrimitives(Document& document, const std::set<std::size_t>& changed,
                           const std::vector<std::size_t>& view_uses, const StoreBlob& store);

}  // namespace tspace::gltf
