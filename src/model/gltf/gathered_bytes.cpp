// SPDX-License-Identifier: MIT
#include "model/gltf/gathered_bytes.h"

#include <algorithm>
#include <cstring>

#include "model/gltf/accessor.h"

namespace tspace::gltf {

void GatheredBytes::make(std::size_t begin, std::span<std::uint8_t> to) const {
    if (to.empty()) return;
    std::size_t element = begin / element_bytes_;
    std::uint8_t* out = to.data();
    if (const std::size_t skipped = begin % element_bytes_; skipped != 0) {
        const std::size_t count = std::min(element_bytes_ - skipped, to.size());
        std::memcpy(out, at(element++) + skipped, count);
        out += count;
    }
    const auto left = [&] { return static_cast<std::size_t>(to.data() + to.size() - out); };
    withElementSize(element_bytes_, [&](auto size) {
        const std::size_t end = element + left() / size, end_of_kept = std::min(end, sources_.kept);
        for (; element < end_of_kept; ++element, out += size) std::memcpy(out, data_ + element * stride_, size);
        const std::uint32_t* copies = sources_.copies->data();
        for (; element < end; ++element, out += size)
            std::memcpy(out, data_ + copies[element - sources_.kept] * stride_, size);
    });
    if (left() != 0) std::memcpy(out, at(element), left());
}

}  // namespace tspace::gltf
