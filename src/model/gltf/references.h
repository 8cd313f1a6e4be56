// SPDX-License-Identifier: MIT
// References to accessors, buffer views and bytes, which an edit must know before it changes or frees any of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"

namespace tspace::gltf {

/// The bytes that one accessor reads, or a whole buffer view when something other than accessors may read it.
struct Extent {
    static constexpr std::size_t kNoAccessor = ~std::size_t{0};

    std::size_t accessor = kNoAccessor;
    std::size_t buffer = 0;
    std::size_t begin = 0, end = 0;
    std::size_t stride = 0, element_bytes = 0;  ///< stride 0: solid
};

struct ByteRange {
    std::size_t buffer = 0, begin = 0, end = 0;
};

/// References to each accessor from primitives, morph targets, skins, animations and GPU instancing.
std::vector<std::size_t> countAccessorUses(const Document& document);

/// References to each buffer view from anywhere: every member named "bufferView".
std::vector<std::size_t> countViewUses(const Document& document);

/// The bytes of an accessor in its view (not those of its sparse parts); the whole view for an unknown type. The accessor
/// must have a view.
Extent extentOf(const Document& document, const Accessor& accessor);

/// Everything that reads bytes of any buffer.
std::vector<Extent> collectExtents(const Document& document);

/// True when both read a byte in common. Interleaved elements of one stride are told apart.
bool overlaps(const Extent& a, const Extent& b);

/// Cuts the bytes of `vacated` that nothing reads any more out of the output's own buffers, and moves all offsets behind.
void cutVacated(Document& document, std::span<const ByteRange> vacated);

/// Removes buffers that neither a view nor a compression extension names, except the output's own. Indices in views and
/// extensions are renumbered.
void removeUnreferencedBuffers(Document& document);

/// Removes own buffers that lost all their bytes: a buffer of length 0 is not valid.
void removeEmptiedBuffers(Document& document);

}  // namespace tspace::gltf
