// SPDX-License-Identifier: MIT
// Buffer views compressed with EXT_meshopt_compression or KHR_meshopt_compression. Loading fills fallback buffers that
// have no data, so that all other code finds decoded bytes in every view; the editor encodes changed views again.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "model/gltf/accessor.h"
#include "model/gltf/codecs/codecs.h"
#include "model/gltf/compression_extensions.h"
#include "model/gltf/document.h"

namespace tspace::gltf {

/// Parsed meshopt extension of one buffer view.
struct MeshoptView {
    const char* extension = kExtMeshopt;
    std::size_t buffer = 0, begin = 0, byte_count = 0;  ///< range of the compressed bytes
    MeshoptCoding coding = {};
};

/// Returns the checked extension of view `index`, or nullopt if it has none.
std::optional<MeshoptView> readMeshoptView(const Document& document, std::size_t index);

/// Checks all extensions, and decodes the views whose fallback buffer has no data. The required memory is at most
/// meshoptRatio times the size of the file. Fails with invalidFile at the extension's JSON pointer. Without the
/// library, these fallback buffers stay absent.
void decodeMeshoptViews(Document& document);

/// Returns the elements sources[0], sources[1], ... of an accessor as they are before the filter of the view is
/// applied, in rows of a multiple of 4 bytes. Empty if there is no filter, or if the filter mixes bytes of several
/// accessors.
Bytes gatherUnfiltered(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources);

/// Returns the filter of the view that contains an accessor.
MeshoptFilter filterOf(const Document& document, const Accessor& accessor);

/// Compression parameters of a rewritten view.
struct MeshoptRequest {
    const char* extension = kExtMeshopt;
    MeshoptFilter filter = MeshoptFilter::none;
    Bytes unfiltered = {};  ///< rows to encode if there is a filter
    bool is_indices = false;
    std::size_t stride = 0;
};

/// Encodes the uncompressed bytes of a view, appends the result to buffer `data_buffer`, and adds the extension to the
/// view.
void encodeMeshoptView(Document& document, std::size_t view, const MeshoptRequest& request, std::size_t data_buffer);

}  // namespace tspace::gltf
