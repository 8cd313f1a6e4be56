// SPDX-License-Identifier: MIT
// References to accessors, buffer views and bytes, which an edit must know before it changes or frees them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"

namespace tspace::gltf {

/// Bytes that one accessor reads, or a whole buffer view if something other than accessors may read it.
struct Extent {
    static constexpr std::size_t kNoAccessor = ~std::size_t{0};

    std::size_t accessor = kNoAccessor;
    std::size_t buffer = 0;
    std::size_t begin = 0, end = 0;
    std::size_t stride = 0, element_bytes = 0;  ///< stride 0: a contiguous range
};

struct ByteRange {
    std::size_t buffer = 0, begin = 0, end = 0;
};

/// Returns the number of references to each accessor from primitives, morph targets, skins, animations and GPU
/// instancing.
std::vector<std::size_t> countAccessorUses(const Document& document);

/// Returns the number of references to each buffer view, counting every member named "bufferView".
std::vector<std::size_t> countViewUses(const Document& document);

/// Returns the bytes of an accessor in its view (without its sparse parts); the whole view for an unknown type. The
/// accessor must have a view.
Extent extentOf(const Document& document, const Accessor& accessor);

/// Returns the extents of all readers of any buffer.
std::vector<Extent> collectExtents(const Document& document);

/// Returns whether both extents share a byte. Interleaved elements with the same stride are distinguished.
bool overlaps(const Extent& a, const Extent& b);

/// Cuts unused bytes in the ranges of `vacated` from the buffers that the output owns (Buffer::own) and from decoded
/// buffers, and adjusts all later offsets.
void cutVacated(Document& document, std::span<const ByteRange> vacated);

/// Removes buffers that neither a view nor a compression extension references, except those that the output owns.
/// Renumbers the indices in views and extensions.
void removeUnreferencedBuffers(Document& document);

/// Removes buffers that the output owns and that became empty: glTF does not allow buffers of length 0.
void removeEmptiedBuffers(Document& document);

}  // namespace tspace::gltf
