// SPDX-License-Identifier: MIT
// Rows of texel centres through each triangle, in whole numbers.
#include "maps/uv_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "core/hash.h"

namespace tspace {

namespace {

/// Parts of a texel that UVs are rounded to.
constexpr std::int64_t kParts = 256;
constexpr double kMostRepeats = 64;
/// Triangles with more rows are remembered: many cards of one tree show the same large part of an image.
constexpr std::int64_t kLargeRows = 64;
constexpr std::size_t kMostRemembered = std::size_t{1} << 16;

struct Corner {
    std::int64_t x = 0, y = 0;
};

std::int64_t floorDiv(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }
std::int64_t ceilDiv(std::int64_t a, std::int64_t b) { return -floorDiv(-a, b); }

/// Moves three coordinates to where the image begins, and makes parts of a texel of them. False: left out.
bool place(const double (&from)[3], std::uint32_t size, TextureWrap wrap, std::int64_t (&to)[3]) {
    const double least = std::min({from[0], from[1], from[2]}), most = std::max({from[0], from[1], from[2]});
    if (!std::isfinite(least) || !std::isfinite(most) || !(most - least <= kMostRepeats)) return false;
    double begin = 0;
    if (wrap == TextureWrap::repeat) begin = std::floor(least);
    if (wrap == TextureWrap::mirror) begin = 2 * std::floor(least / 2);
    if (wrap == TextureWrap::clamp && (least < -kMostRepeats || most > kMostRepeats)) return false;
    for (int i = 0; i < 3; ++i) to[i] = std::llround((from[i] - begin) * size * kParts);
    return true;
}

/// Texel `at` of the endless row, in the image; `size` where there is none.
std::uint32_t wrapped(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return at >= 0 && at < size ? static_cast<std::uint32_t>(at) : size;
    const std::int64_t period = wrap == TextureWrap::mirror ? 2 * std::int64_t{size} : size;
    const std::int64_t inside = at - floorDiv(at, period) * period;
    return static_cast<std::uint32_t>(inside < size ? inside : period - 1 - inside);
}

class Coverage {
  public:
    Coverage(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps)
        : triangles_(triangles), mask_(mask), steps_(steps) {}

    bool run() {
        const std::span<const std::uint32_t> corners = triangles_.corners;
        for (std::size_t i = 0; i + 2 < corners.size() && !mask_.isWhole(); i += 3) {
            addTriangle({triangles_.uvs[corners[i]], triangles_.uvs[corners[i + 1]], triangles_.uvs[corners[i + 2]]});
            if (steps_ != 0) continue;
            mask_.fillAll();
            return false;
        }
        return true;
    }

  private:
    void addTriangle(const std::array<Vec2, 3>& uvs) {
        std::int64_t x[3], y[3];
        if (!place({uvs[0].x, uvs[1].x, uvs[2].x}, mask_.width(), triangles_.wrap_u, x) ||
            !place({uvs[0].y, uvs[1].y, uvs[2].y}, mask_.height(), triangles_.wrap_v, y)) {
            return;
        }
        const Corner corners[3] = {{x[0], y[0]}, {x[1], y[1]}, {x[2], y[2]}};
        const std::int64_t first = ceilDiv(std::min({y[0], y[1], y[2]}) - kParts / 2, kParts);
        const std::int64_t last = floorDiv(std::max({y[0], y[1], y[2]}) - kParts / 2, kParts);
        if (last - first >= kLargeRows && isKnown(corners)) return;
        for (std::int64_t row = first; row <= last; ++row) {
            take(1);
            const std::uint32_t at = wrapped(row, mask_.height(), triangles_.wrap_v);
            if (at < mask_.height() && !mask_.isWhole(at)) addRow(corners, row * kParts + kParts / 2, at);
        }
    }

    /// The part of the row of centres at `y` that lies in the triangle.
    void addRow(const Corner (&corners)[3], std::int64_t y, std::uint32_t row) {
        std::int64_t begin = INT64_MAX, last = INT64_MIN;
        const auto include = [&](std::int64_t over, std::int64_t under) {
            begin = std::min(begin, ceilDiv(over - kParts / 2 * under, kParts * under));
            last = std::max(last, floorDiv(over - kParts / 2 * under, kParts * under));
        };
        for (int i = 0; i < 3; ++i) {
            Corner a = corners[i], b = corners[(i + 1) % 3];
            if (a.y > b.y) std::swap(a, b);
            if (y < a.y || y > b.y) continue;
            if (a.y == b.y) {
                include(a.x, 1);
                include(b.x, 1);
            } else {
                include(a.x * (b.y - a.y) + (y - a.y) * (b.x - a.x), b.y - a.y);
            }
        }
        if (begin <= last) addSpan(begin, last + 1, row);
    }

    void addSpan(std::int64_t begin, std::int64_t end, std::uint32_t row) {
        const std::int64_t width = mask_.width();
        const TextureWrap wrap = triangles_.wrap_u;
        if (wrap == TextureWrap::clamp) {
            begin = std::max<std::int64_t>(begin, 0);
            end = std::min(end, width);
        } else if (end - begin >= (wrap == TextureWrap::mirror ? 2 : 1) * width) {
            begin = 0;
            end = width;
        }
        while (begin < end) {
            const std::int64_t tile = floorDiv(begin, width), in_tile = std::min(end, (tile + 1) * width);
            std::uint32_t from = wrapped(begin, mask_.width(), wrap), to = wrapped(in_tile - 1, mask_.width(), wrap);
            if (from > to) std::swap(from, to);
            mask_.fill(row, from, to + 1);
            take((to - from) / 64);
            begin = in_tile;
        }
    }

    void take(std::uint64_t steps) { steps_ -= std::min(steps_, steps); }

    /// Whether the triangle was there before, and remembers it.
    bool isKnown(const Corner (&corners)[3]) {
        std::array<std::int64_t, 6> key{};
        for (std::size_t i = 0; i < 3; ++i) {
            key[2 * i] = corners[i].x;
            key[2 * i + 1] = corners[i].y;
        }
        if (known_.contains(key)) return true;
        if (known_.size() < kMostRemembered) known_.insert(key);
        return false;
    }

    struct HashKey {
        std::size_t operator()(const std::array<std::int64_t, 6>& key) const {
            std::uint64_t hash = 0;
            for (const std::int64_t value : key) hash = foldHash(hash, static_cast<std::uint64_t>(value));
            return static_cast<std::size_t>(hash);
        }
    };

    const UvTriangles& triangles_;
    TexelMask& mask_;
    std::uint64_t& steps_;
    std::unordered_set<std::array<std::int64_t, 6>, HashKey> known_ = {};
};

}  // namespace

bool coverTexels(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps) {
    return mask.width() == 0 || mask.height() == 0 || Coverage(triangles, mask, steps).run();
}

}  // namespace tspace
