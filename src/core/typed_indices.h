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
    if (view.type == IndexType::u32)
        return body([data = static_cast<const std::uint32_t*>(view.data)](std::size_t c) { return data[c]; });
    return body([view](std::size_t c) { return view[c]; });
}

}  // namespace tspace
