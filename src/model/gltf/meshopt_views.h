// SPDX-License-Identifier: MIT
// Buffer views that EXT_meshopt_compression or KHR_meshopt_compression compresses. Loading fills the fallback buffers
// that have no data, so that all other code finds plain bytes in every view; the editor asks to have changed views
// encoded.
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

/// The extension of one buffer view.
struct MeshoptView {
    const char* extension = kExtMeshopt;
    std::size_t buffer = 0, begin = 0, byte_count = 0;  ///< the compressed bytes
    MeshoptCoding coding = {};
};

/// The checked extension of view `index`, or nothing.
std::optional<MeshoptView> readMeshoptView(const Document& document, std::size_t index);

/// Checks all extensions, and decodes the views whose fallback buffer has no data. The memory that this takes is at
/// most meshoptRatio times the bytes of the file. Fails with invalidFile at the extension's pointer. Without the
/// library those buffers stay absent.
void decodeMeshoptViews(Document& document);

/// Elements sources[0], sources[1], ... of an accessor before the filter of its view, in rows of a multiple of 4 bytes.
/// Empty when there is no filter, or when the filter mixes bytes of several accessors.
Bytes gatherUnfiltered(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources);

/// The filter of the view that an accessor lies in.
MeshoptFilter filterOf(const Document& document, const Accessor& accessor);

/// How to compress a view that was stored anew.
struct MeshoptRequest {
    const char* extension = kExtMeshopt;
    MeshoptFilter filter = MeshoptFilter::none;
    Bytes unfiltered = {};  ///< rows to encode where there is a filter
    bool is_indices = false;
    std::size_t stride = 0;
};

/// Encodes the plain bytes of a view, appends the result to buffer `data_buffer`, and gives the view its extension.
void encodeMeshoptView(Document& document, std::size_t view, const MeshoptRequest& request, std::size_t data_buffer);

}  // namespace tspace::gltf
