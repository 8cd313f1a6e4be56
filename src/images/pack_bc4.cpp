// SPDX-License-Identifier: MIT
#include "images/pack_bc4.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace tspace {

namespace {

/// What a block may be: ends from 0 to `most`, and either eight values between them or six, 0 and the most.
struct Bc4Ends {
    int first = 0, second = 0;  ///< first > second: eight values
    float error = 3.4e38F;

    [[nodiscard]] bool isFull() const { return first > second; }
};

class Bc4Search {
  public:
    Bc4Search(const std::array<float, 16>& values, int most) : most_(most) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values_[i] = std::clamp(values[i], 0.0F, 1.0F) * static_cast<float>(most);
    }

    Bc4Ends best() {
        const auto [least, largest] = std::minmax_element(values_.begin(), values_.end());
        // Between two ends that are near each other the steps of a fifth help as often as those of a seventh.
        constexpr float kNear = 12, kAtEnd = 4;
        const float range = *largest - *least;
        const bool touches_end = *least < kAtEnd || *largest > static_cast<float>(most_) - kAtEnd;
        searchInside(*largest, *least);
        if (range < kNear || touches_end) searchInside(*least, *largest);
        return best_;
    }

    /// The code of each value, three bits.
    [[nodiscard]] std::uint64_t codes(const Bc4Ends& ends) const {
        std::array<float, 8> palette{static_cast<float>(ends.first), static_cast<float>(ends.second), 0, 0, 0, 0, 0,
                                     static_cast<float>(most_)};
        const int parts = ends.isFull() ? 7 : 5;
        for (int k = 1; k < parts; ++k)
            palette[static_cast<std::size_t>(k) + 1] =
                static_cast<float>((parts - k) * ends.first + k * ends.second) / static_cast<float>(parts);
        std::uint64_t codes = 0;
        for (std::size_t i = 0; i < values_.size(); ++i) {
            std::size_t nearest = 0;
            for (std::size_t k = 1; k < palette.size(); ++k) {
                if (distance(values_[i], palette[k]) < distance(values_[i], palette[nearest])) nearest = k;
            }
            codes |= std::uint64_t{nearest} << 3 * i;
        }
        return codes;
    }

  private:
    static float distance(float a, float b) { return a < b ? b - a : a - b; }

    [[nodiscard]] float errorOf(int first, int second) const {
        if (first < 0 || second < 0 || first > most_ || second > most_) return Bc4Ends{}.error;
        return first > second ? errorOf(first, second, 7) : errorOfSix(first, second);
    }

    /// From ends at the extremes and inside of them, in steps that become smaller. All pairs have as many values.
    void searchInside(float first, float second) {
        constexpr std::size_t kKept = 2;
        constexpr float kInside[] = {0, 0.05F, 0.1F, 0.16F};
        std::array<Bc4Ends, std::size(kInside) * std::size(kInside)> starts{};
        Bc4Ends* start = starts.data();
        for (const float a : kInside) {
            for (const float b : kInside) {
                start->first = static_cast<int>(first + a * (second - first) + 0.5F);
                start->second = static_cast<int>(second + b * (first - second) + 0.5F);
                const bool is_wanted = (first > second) == start->isFull();
                if (is_wanted) start->error = errorOf(start->first, start->second);
                ++start;
            }
        }
        // Between equal ends nothing is left to choose but the neighbours.
        if (first - second < 1 && second - first < 1) starts[0] = nearPair(first, second);
        std::partial_sort(starts.begin(), starts.begin() + kKept, starts.end(),
                          [](const Bc4Ends& x, const Bc4Ends& y) { return x.error < y.error; });
        for (std::size_t i = 0; i < kKept; ++i) improve(starts[i]);
    }

    [[nodiscard]] Bc4Ends nearPair(float first, float second) const {
        const int low = std::min(static_cast<int>(std::min(first, second)), most_ - 1);
        Bc4Ends pair{low, low + 1};
        if (first > second) std::swap(pair.first, pair.second);
        pair.error = errorOf(pair.first, pair.second);
        return pair;
    }

    /// To better pairs, as long as there are any.
    void improve(Bc4Ends pair) {
        constexpr int kMostRounds = 64;
        for (const int step : {2, 1}) {
            for (int round = 0; round < kMostRounds; ++round) {
                const Bc4Ends from = pair;
                for (int a = -step; a <= step; a += step) {
                    for (int b = -step; b <= step; b += step) {
                        const Bc4Ends near{from.first + a, from.second + b};
                        if (near.isFull() != from.isFull()) continue;
                        const float error = errorOf(near.first, near.second);
                        if (error < pair.error) pair = {near.first, near.second, error};
                    }
                }
                if (pair.error == from.error) break;
            }
        }
        if (pair.error < best_.error) best_ = pair;
    }

    /// With `parts` equal steps between the ends.
    [[nodiscard]] float errorOf(int first, int second, int parts) const {
        const auto start = static_cast<float>(first), steps = static_cast<float>(parts);
        const float step = static_cast<float>(second - first) / steps;
        const float scale = step == 0 ? 0 : 1 / step;
        std::array<float, 16> errors{};
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const float place = std::min(std::max((values_[i] - start) * scale, 0.0F), steps);
            const float off = values_[i] - (start + static_cast<float>(static_cast<int>(place + 0.5F)) * step);
            errors[i] = off * off;
        }
        return sumOf(errors);
    }

    /// With 0 and the most beside them.
    [[nodiscard]] float errorOfSix(int first, int second) const {
        const auto start = static_cast<float>(first), most = static_cast<float>(most_);
        const float step = static_cast<float>(second - first) / 5;
        const float scale = step == 0 ? 0 : 1 / step;
        std::array<float, 16> errors{};
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const float place = std::min(std::max((values_[i] - start) * scale, 0.0F), 5.0F);
            const float off = values_[i] - (start + static_cast<float>(static_cast<int>(place + 0.5F)) * step);
            const float from_most = most - values_[i];
            errors[i] = std::min({off * off, values_[i] * values_[i], from_most * from_most});
        }
        return sumOf(errors);
    }

    static float sumOf(const std::array<float, 16>& errors) {
        float sum = 0;
        for (const float error : errors) sum += error;
        return sum;
    }

    int most_;
    std::array<float, 16> values_ = {};
    Bc4Ends best_ = {};
};

}  // namespace

std::array<std::uint8_t, 8> packBc4(const std::array<float, 16>& values, bool is_signed) {
    Bc4Search search(values, is_signed ? 254 : 255);
    const Bc4Ends ends = search.best();
    const int zero = is_signed ? 127 : 0;
    std::array<std::uint8_t, 8> block{static_cast<std::uint8_t>(ends.first - zero),
                                      static_cast<std::uint8_t>(ends.second - zero)};
    const std::uint64_t codes = search.codes(ends);
    for (std::size_t i = 0; i < 6; ++i) block[2 + i] = static_cast<std::uint8_t>(codes >> 8 * i);
    return block;
}

}  // namespace tspace
