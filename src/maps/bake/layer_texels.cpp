// SPDX-License-Identifier: MIT
#include "maps/bake/layer_texels.h"

#include <array>
#include <optional>

#include "core/base/fill_rings.h"

namespace tspace {

void fillMissing(std::span<float> values, std::uint32_t channel_count, std::span<const TexelState> states,
                 const TextureShape& shape, Filling filling) {
    using Value = std::array<float, 3>;
    std::vector<bool> is_missing(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) is_missing[i] = states[i] == TexelState::missing;
    const auto forAround = [&](std::size_t texel, const auto& visit) { forTexelsAround(shape, texel, visit); };
    const auto valueAround = [&](std::size_t texel) -> std::optional<Value> {
        Value value{};
        int count = 0;
        forAround(texel, [&](std::size_t near) {
            const bool is_known = !is_missing[near] && states[near] != TexelState::empty;
            if (!is_known || (count > 0 && filling == Filling::copy)) return;
            ++count;
            for (std::uint32_t c = 0; c < channel_count; ++c) value[c] += values[channel_count * near + c];
        });
        if (count == 0) return std::nullopt;
        for (float& channel : value) channel /= static_cast<float>(count);
        return value;
    };
    fillRings(is_missing, forAround, valueAround, [&](std::size_t texel, const Value& value) {
        for (std::uint32_t c = 0; c < channel_count; ++c) values[channel_count * texel + c] = value[c];
    });
}

}  // namespace tspace
