// SPDX-License-Identifier: MIT
// Indices in loops over all corners: their type is asked for once, not for each corner.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tspace/mesh.h"

namespace tspace {

/// body(vertexOf), where vertexOf(c) is view[c].
template <class Body>
decltype(auto) withIndices(const IndexView& view, Body&& body) {
    const auto from = [](const auto* data) { return [data](std::size_t c) { return std::uint32_t{data[c]}; }; };
    switch (view.type) {
        case IndexType::u8:
            return body(from(static_cast<const std::uint8_t*>(view.data)));
        case IndexType::u16:
            return body(from(static_cast<const std::uint16_t*>(view.data)));
        case IndexType::u32:
            return body(from(static_cast<const std::uint32_t*>(view.data)));
        case IndexType::none:
            break;
    }
    return body([](std::size_t c) { return static_cast<std::uint32_t>(c); });
}

}  // namespace tspace
