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

/// The indices [first, first + count) as 32-bit numbers: where they lie, or in `buffer`.
inline const std::uint32_t* readIndices(const IndexView& view, std::size_t first, std::size_t count,
                                        std::uint32_t* buffer) {
    [[maybe_unused]] const auto widen = [&](const auto* from) {
        for (std::size_t i = 0; i < count; ++i) buffer[i] = from[i];
        return buffer;
    };
    switch (view.type) {
        case IndexType::u32:
            return static_cast<const std::uint32_t*>(view.data) + first;
#ifndef TSPACE_SMALL
        case IndexType::u16:
            return widen(static_cast<const std::uint16_t*>(view.data) + first);
        case IndexType::u8:
            return widen(static_cast<const std::uint8_t*>(view.data) + first);
#endif
        default:
            break;
    }
    for (std::size_t i = 0; i < count; ++i) buffer[i] = static_cast<std::uint32_t>(first + i);
    return buffer;
}

}  // namespace tspace
