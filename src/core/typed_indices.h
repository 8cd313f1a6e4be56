// SPDX-License-Identifier: MIT
// Indices in loops over all corners: their type is asked for once, not for each corner.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tspace/mesh.h"

namespace tspace {

/// body(vertexOf), where vertexOf(c) is view[c]. Compiled for the usual type and for any.
template <class Body>
decltype(auto) withIndices(const IndexView& view, Body&& body) {
#ifdef TSPACE_SMALL  // which has no others
    const auto* data = view.type == IndexType::none ? nullptr : static_cast<const std::uint32_t*>(view.data);
    return body([data](std::size_t c) { return data == nullptr ? static_cast<std::uint32_t>(c) : data[c]; });
#endif
    if (view.type == IndexType::u32)
        return body([data = static_cast<const std::uint32_t*>(view.data)](std::size_t c) { return data[c]; });
    return body([view](std::size_t c) { return view[c]; });
}

/// Writes the indices [first, first + count), of another type than 32-bit numbers, to `buffer` and returns it.
const std::uint32_t* widenIndices(const IndexView& view, std::size_t first, std::size_t count, std::uint32_t* buffer);

/// The indices [first, first + count) as 32-bit numbers: where they lie, or in `buffer`.
inline const std::uint32_t* readIndices(const IndexView& view, std::size_t first, std::size_t count,
                                        std::uint32_t* buffer) {
    if (view.type == IndexType::u32) return static_cast<const std::uint32_t*>(view.data) + first;
    return widenIndices(view, first, count, buffer);
}

}  // namespace tspace
