// SPDX-License-Identifier: MIT
// Rows of texel centres through each triangle, in whole numbers.
#include "maps/uv_coverage.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "maps/uv_rows.h"

namespace tspace {

namespace {

/// Triangles with more rows are remembered: many cards of one tree show the same large part of an image.
constexpr std::int64_t kLargeRows = 64;
constexpr std::size_t kMostRemembered = std::size_t{1} << 16;

class Coverage {
  public:
    Coverage(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps)
        : triangles_(triangles),
          shape_{mask.width(), mask.height(), triangles.wrap_u, triangles.wrap_v},
          mask_(mask),
          steps_(steps) {}

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
        PlacedTriangle triangle;
        if (triangle.place(uvs, shape_) != UvPlacing::placed) return;
        const TexelRange rows = triangle.rows();
        if (rows.last - rows.first >= kLargeRows && isKnown(triangle)) return;
        for (std::int64_t row = rows.first; row <= rows.last; ++row) {
            take(1);
            const std::uint32_t at = texelInImage(row, shape_.height, shape_.wrap_v);
            if (at >= shape_.height || mask_.isWhole(at)) continue;
            const TexelRange columns = triangle.columns(row);
            if (!columns.isEmpty()) addSpan(columns.first, columns.last + 1, at);
        }
    }

    void addSpan(std::int64_t begin, std::int64_t end, std::uint32_t row) {
        const std::int64_t width = shape_.width;
        const TextureWrap wrap = shape_.wrap_u;
        if (wrap == TextureWrap::clamp) {
            begin = std::max<std::int64_t>(begin, 0);
            end = std::min(end, width);
        } else if (end - begin >= (wrap == TextureWrap::mirror ? 2 : 1) * width) {
            begin = 0;
            end = width;
        }
        while (begin < end) {
            const std::int64_t tile = floorDiv(begin, width), in_tile = std::min(end, (tile + 1) * width);
            std::uint32_t from = texelInImage(begin, shape_.width, wrap),
                          to = texelInImage(in_tile - 1, shape_.width, wrap);
            if (from > to) std::swap(from, to);
            mask_.fill(row, from, to + 1);
            take((to - from) / 64);
            begin = in_tile;
        }
    }

    void take(std::uint64_t steps) { steps_ -= std::min(steps_, steps); }

    /// Whether the triangle was there before, and remembers it.
    bool isKnown(const PlacedTriangle& triangle) {
        const std::array<std::int64_t, 6> key = triangle.key();
        if (known_.contains(key)) return true;
        if (known_.size() < kMostRemembered) known_.insert(key);
        return false;
    }

    const UvTriangles& triangles_;
    TextureShape shape_;
    TexelMask& mask_;
    std::uint64_t& steps_;
    std::unordered_set<std::array<std::int64_t, 6>, HashPlacedKey> known_ = {};
};

}  // namespace

bool coverTexels(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps) {
    return mask.width() == 0 || mask.height() == 0 || Coverage(triangles, mask, steps).run();
}

}  // namespace tspace
