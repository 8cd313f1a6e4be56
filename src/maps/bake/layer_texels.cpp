// SPDX-License-Identifier: MIT
#include "maps/bake/layer_texels.h"

#include <array>

namespace tspace {
namespace {

class MissingTexels {
  public:
    MissingTexels(std::span<float> values, std::uint32_t channel_count, std::span<const TexelState> states,
                  const TextureShape& shape, Filling filling)
        : values_(values), channel_count_(channel_count), states_(states.begin(), states.end()), shape_(shape),
          filling_(filling) {}

    void fill() {
        std::vector<std::size_t> missing, next;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            if (states_[i] == TexelState::missing) missing.push_back(i);
        }
        std::vector<std::array<float, 3>> made;
        std::vector<std::size_t> filled;
        while (!missing.empty()) {
            made.clear();
            filled.clear();
            next.clear();
            for (const std::size_t texel : missing) {
                std::array<float, 3> value{};
                if (around(texel, value)) {
                    made.push_back(value);
                    filled.push_back(texel);
                } else {
                    next.push_back(texel);
                }
            }
            if (filled.empty()) return;
            for (std::size_t i = 0; i < filled.size(); ++i) {
                states_[filled[i]] = TexelState::known;
                for (std::uint32_t c = 0; c < channel_count_; ++c) values_[channel_count_ * filled[i] + c] = made[i][c];
            }
            missing.swap(next);
        }
    }

  private:
    bool around(std::size_t texel, std::array<float, 3>& value) const {
        const auto x = static_cast<std::int64_t>(texel % shape_.width),
                   y = static_cast<std::int64_t>(texel / shape_.width);
        int count = 0;
        for (const int dy : {-1, 0, 1}) {
            for (const int dx : {-1, 0, 1}) {
                const std::size_t near =
                    std::size_t{wrappedTexel(y + dy, shape_.height, shape_.wrap_v)} * shape_.width +
                    wrappedTexel(x + dx, shape_.width, shape_.wrap_u);
                if (states_[near] != TexelState::known) continue;
                ++count;
                for (std::uint32_t c = 0; c < channel_count_; ++c) value[c] += values_[channel_count_ * near + c];
                if (filling_ == Filling::copy) return true;
            }
        }
        for (float& channel : value) channel /= static_cast<float>(count > 0 ? count : 1);
        return count > 0;
    }

    std::span<float> values_;
    std::uint32_t channel_count_;
    std::vector<TexelState> states_;
    TextureShape shape_;
    Filling filling_;
};

}  // namespace

void fillMissing(std::span<float> values, std::uint32_t channel_count, std::span<const TexelState> states,
                 const TextureShape& shape, Filling filling) {
    MissingTexels(values, channel_count, states, shape, filling).fill();
}

}  // namespace tspace
