// SPDX-License-Identifier: MIT
// Rasterizes bands of rows in parallel: first texels inside triangles, then the texels next to them. Texels farther
// away are filled ring by ring.
#include "maps/layout/texel_triangles.h"

#include <unordered_map>
#include <vector>

namespace tspace {

namespace {

constexpr std::uint32_t kBandRows = 64;
/// Bilinear filtering inside a chart reads no texel that is farther away than sqrt(2).
constexpr double kNearTexels = 1.5;
constexpr std::int64_t kNearRows = 2;
/// Triangles with more rows than this are remembered, as in uv_coverage: many cards of one tree share the same part of
/// an image.
constexpr std::int64_t kLargeTriangleRows = 64;
constexpr std::size_t kMostLarge = std::size_t{1} << 16;
/// Number of texels per work step.
constexpr std::uint64_t kTexelsOfStep = 16;
/// Temporary states during the search of rings: the texel gets a triangle in this ring, or is farther away than the
/// padding.
constexpr auto kPending = static_cast<TexelCoverage>(3), kRefused = static_cast<TexelCoverage>(4);

struct RowRange {
    std::int32_t first = 0, last = -1;
};

class TriangleSearch {
  public:
    TriangleSearch(const UvTriangles& triangles, TexelTriangles& found, std::uint32_t padding, Parallel& parallel,
                   const Allocator* allocator)
        : triangles_(triangles),
          found_(found),
          shape_(found.shape),
          near_(std::min<double>(padding, kNearTexels)),
          padding_(padding),
          parallel_(parallel),
          allocator_(allocator),
          band_count_((shape_.height + kBandRows - 1) / kBandRows) {}

    bool run() {
        const std::size_t texels = std::size_t{shape_.width} * shape_.height;
        if (!listBands()) return false;
        found_.places = Buffer<TexelPlace>(allocator_, texels, TexelPlace{});
        found_.kinds = Buffer<TexelCoverage>(allocator_, texels, TexelCoverage::none);
        found_.overlaps = Buffer<bool>(allocator_, texels, false);
        found_.is_read = Buffer<bool>(allocator_, texels, false);
        if (near_ > 0) distances_ = Buffer<float>(allocator_, texels, static_cast<float>(near_ * near_));
        parallel_.forTasks(band_count_, [&](std::size_t band) {
            for (const std::uint32_t triangle : entries(band)) addInside(triangle, band);
            if (near_ == 0) return;
            for (const std::uint32_t triangle : entries(band)) addNear(triangle, band);
        });
        if (padding_ > near_) addRings();
        countTexels();
        return true;
    }

  private:
    // Lists the triangles with rows in each band.

    bool listBands() {
        const std::size_t count = triangles_.corners.size() / 3;
        rows_ = Buffer<RowRange>(allocator_, count, RowRange{});
        begin_ = Buffer<std::size_t>(allocator_, band_count_ + 1, std::size_t{0});
        std::uint64_t steps = 0;
        for (std::size_t i = 0; i < count; ++i) {
            steps += placeRows(i);
            if (steps > kCoverSteps) return false;
            forBands(rows_[i], [&](std::size_t band) { ++begin_[band]; });
        }
        std::size_t total = 0;
        for (std::size_t band = 0; band <= band_count_; ++band) total += std::exchange(begin_[band], total);
        entries_ = Buffer<std::uint32_t>(allocator_, total);
        Buffer<std::size_t> next(allocator_, band_count_, std::size_t{0});
        for (std::size_t i = 0; i < count; ++i) {
            forBands(rows_[i],
                     [&](std::size_t band) { entries_[begin_[band] + next[band]++] = static_cast<std::uint32_t>(i); });
        }
        return true;
    }

    /// Sets the rows of a triangle. Returns its amount of work.
    std::uint64_t placeRows(std::size_t i) {
        PlacedTriangle placed;
        const UvPlacing placing = placed.place(cornerUvs(triangles_, i), shape_);
        TexelTriangleCounts& counts = found_.counts;
        if (placing == UvPlacing::notFinite) ++counts.not_finite;
        if (placing == UvPlacing::tooFar) ++counts.too_far;
        if (placing != UvPlacing::placed) return 0;
        const std::int64_t area = std::abs(placed.doubleArea());
        if (area == 0) {
            ++counts.without_area;
            return 0;
        }
        const TexelRange rows = placed.rows();
        if (rows.last - rows.first >= kLargeTriangleRows && isThird(placed)) {
            ++counts.repeated;
            return 0;
        }
        rows_[i] = {static_cast<std::int32_t>(rows.first - kNearRows),
                    static_cast<std::int32_t>(rows.last + kNearRows)};
        const auto row_count = static_cast<std::uint64_t>(rows_[i].last - rows_[i].first + 1);
        return row_count + static_cast<std::uint64_t>(area) / (2 * kTexelParts * kTexelParts * kTexelsOfStep);
    }

    /// Returns whether two earlier triangles have the same position. The second one still counts as overlapping.
    bool isThird(const PlacedTriangle& placed) {
        const std::array<std::int64_t, 6> key = placed.key();
        const auto known = known_.find(key);
        if (known != known_.end()) return ++known->second > 1;
        if (known_.size() < kMostLarge) known_.emplace(key, 0U);
        return false;
    }

    /// Calls visit(band) once for each band. A triangle over three tiles covers one of them completely.
    template <class Visit>
    void forBands(RowRange rows, const Visit& visit) {
        if (rows.last < rows.first) return;
        ++mark_;
        if (marks_.empty()) marks_ = Buffer<std::uint64_t>(allocator_, band_count_, std::uint64_t{0});
        const std::int64_t height = shape_.height;
        const bool is_clamped = shape_.wrap_v == TextureWrap::clamp;
        std::int64_t tile = is_clamped ? 0 : floorDiv(rows.first, height);
        const std::int64_t last_tile = is_clamped ? 0 : std::min(floorDiv(rows.last, height), tile + 2);
        for (; tile <= last_tile; ++tile) {
            const TexelRange inside =
                rowsOfTile({rows.first, rows.last}, tile, shape_.height, shape_.wrap_v, 0, height - 1);
            if (inside.isEmpty()) continue;
            for (std::int64_t band = inside.first / kBandRows; band <= inside.last / kBandRows; ++band) {
                std::uint64_t& mark = marks_[static_cast<std::size_t>(band)];
                if (mark != mark_) visit(static_cast<std::size_t>(band));
                mark = mark_;
            }
        }
    }

    [[nodiscard]] std::span<const std::uint32_t> entries(std::size_t band) const {
        return {entries_.data() + begin_[band], begin_[band + 1] - begin_[band]};
    }

    // Functions for one band.

    /// Calls visit(row, row in the image) for the rows of a triangle in a band.
    template <class Visit>
    void forRows(RowRange rows, std::size_t band, const Visit& visit) const {
        const std::int64_t height = shape_.height, first = static_cast<std::int64_t>(band) * kBandRows;
        const std::int64_t last = std::min(first + kBandRows, height) - 1;
        for (std::int64_t tile = floorDiv(rows.first, height); tile <= floorDiv(rows.last, height); ++tile) {
            const TexelRange inside =
                rowsOfTile({rows.first, rows.last}, tile, shape_.height, shape_.wrap_v, first, last);
            for (std::int64_t at = inside.first; at <= inside.last; ++at) {
                visit(tile * height + (isFlipped(tile, shape_.wrap_v) ? height - 1 - at : at),
                      static_cast<std::size_t>(at));
            }
        }
    }

    template <class Visit>
    void forColumns(TexelRange columns, const Visit& visit) const {
        forColumnsInImage(columns, shape_.width, shape_.wrap_u, visit);
    }

    void addInside(std::uint32_t triangle, std::size_t band) {
        PlacedTriangle placed;
        placed.place(cornerUvs(triangles_, triangle), shape_);
        const TexelRange own = placed.rows();
        const RowRange rows{static_cast<std::int32_t>(own.first), static_cast<std::int32_t>(own.last)};
        forRows(rows, band, [&](std::int64_t row, std::size_t image_row) {
            forColumns(placed.columns(row), [&](std::int64_t column, std::size_t image_column) {
                const std::size_t texel = image_row * shape_.width + image_column;
                if (found_.kinds[texel] == TexelCoverage::none) {
                    found_.kinds[texel] = TexelCoverage::inside;
                    found_.places[texel] = placeOf(triangle, column, row);
                } else if (!found_.overlaps[texel]) {
                    found_.overlaps[texel] = placed.isInner(column, row) || isInner(found_.places[texel]);
                }
            });
        });
    }

    /// Returns whether the texel center is strictly inside its triangle: a center on an edge that two triangles share
    /// is no overlap.
    [[nodiscard]] bool isInner(const TexelPlace& place) const {
        PlacedTriangle placed;
        placed.place(cornerUvs(triangles_, place.triangle), shape_);
        return placed.isInner(place.x, place.y);
    }

    static TexelPlace placeOf(std::uint32_t triangle, std::int64_t column, std::int64_t row) {
        return {triangle, static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
    }

    [[nodiscard]] ExactTriangle exact(std::uint32_t triangle) const {
        const std::array<Vec2, 3> uvs = cornerUvs(triangles_, triangle);
        PlacedTriangle placed;
        placed.place(uvs, shape_);
        return {uvs, placed, shape_};
    }

    void addNear(std::uint32_t triangle, std::size_t band) {
        const ExactTriangle corners = exact(triangle);
        forRows(rows_[triangle], band, [&](std::int64_t row, std::size_t image_row) {
            forColumns(nearColumns(corners, row), [&](std::int64_t column, std::size_t image_column) {
                const std::size_t texel = image_row * shape_.width + image_column;
                if (found_.kinds[texel] == TexelCoverage::inside) return;
                const double x = static_cast<double>(column) + 0.5, y = static_cast<double>(row) + 0.5;
                const auto distance = static_cast<float>(corners.squaredDistance(x, y));
                if (distance < 2 && !found_.is_read[texel]) found_.is_read[texel] = corners.isReadAt(x, y);
                const bool is_first = found_.kinds[texel] == TexelCoverage::none;
                if (is_first ? distance > distances_[texel] : distance >= distances_[texel]) return;
                found_.kinds[texel] = TexelCoverage::beside;
                found_.places[texel] = placeOf(triangle, column, row);
                distances_[texel] = distance;
            });
        });
    }

    /// Returns the columns of a row that may be close to the triangle.
    static TexelRange nearColumns(const ExactTriangle& corners, std::int64_t row) {
        const double low = static_cast<double>(row) + 0.5 - kNearTexels, high = low + 2 * kNearTexels;
        double least = INFINITY, most = -INFINITY;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3;
            const double from = std::min(corners.y[a], corners.y[b]), to = std::max(corners.y[a], corners.y[b]);
            if (from > high || to < low) continue;
            for (const double at : {std::max(from, low), std::min(to, high)}) {
                const double part = from == to ? 0 : (at - corners.y[a]) / (corners.y[b] - corners.y[a]);
                const double x = corners.x[a] + part * (corners.x[b] - corners.x[a]);
                least = std::min(least, x);
                most = std::max(most, x);
            }
            if (from == to) {
                least = std::min(least, corners.x[b]);
                most = std::max(most, corners.x[b]);
            }
        }
        if (!(least <= most)) return {};
        return {static_cast<std::int64_t>(std::floor(least - kNearTexels - 0.5)),
                static_cast<std::int64_t>(std::ceil(most + kNearTexels - 0.5))};
    }

    // Rings.

    void addRings() {
        std::vector<std::size_t> ring;
        for (std::size_t texel = 0; texel < found_.kinds.size(); ++texel) {
            if (hasTriangle(texel)) pushNeighbours(texel, ring);
        }
        std::vector<TexelPlace> places;
        std::vector<std::size_t> next;
        while (!ring.empty()) {
            places.assign(ring.size(), TexelPlace{});
            parallel_.forRanges(ring.size(), Parallel::kGrain / 16, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) places[i] = placeFromNeighbours(ring[i]);
            });
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const bool is_far = places[i].triangle == kNoTriangle;
                found_.kinds[ring[i]] = is_far ? kRefused : TexelCoverage::beside;
                if (!is_far) found_.places[ring[i]] = places[i];
            }
            next.clear();
            for (const std::size_t texel : ring) {
                if (hasTriangle(texel)) pushNeighbours(texel, next);
            }
            ring.swap(next);
        }
    }

    [[nodiscard]] bool hasTriangle(std::size_t texel) const {
        return found_.kinds[texel] == TexelCoverage::inside || found_.kinds[texel] == TexelCoverage::beside;
    }

    /// Calls visit(neighbor, dx, dy) for each of up to eight adjacent texels.
    template <class Visit>
    void forNeighbours(std::size_t texel, const Visit& visit) const {
        const auto x = static_cast<std::int64_t>(texel % shape_.width);
        const auto y = static_cast<std::int64_t>(texel / shape_.width);
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const std::size_t column = neighbour(x + dx, shape_.width, shape_.wrap_u);
                const std::size_t row = neighbour(y + dy, shape_.height, shape_.wrap_v);
                if ((dx != 0 || dy != 0) && column < shape_.width && row < shape_.height) {
                    visit(row * shape_.width + column, dx, dy);
                }
            }
        }
    }

    /// Returns the position of a neighbor, or `size` if there is none. At the edge of a mirrored image the neighbor
    /// would be the texel itself, so none is returned.
    static std::size_t neighbour(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
        return texelInImage(at, size, wrap == TextureWrap::repeat ? wrap : TextureWrap::clamp);
    }

    void pushNeighbours(std::size_t texel, std::vector<std::size_t>& ring) {
        forNeighbours(texel, [&](std::size_t other, int, int) {
            if (found_.kinds[other] != TexelCoverage::none) return;
            found_.kinds[other] = kPending;
            ring.push_back(other);
        });
    }

    /// Returns the nearest of the triangles assigned to the adjacent texels.
    [[nodiscard]] TexelPlace placeFromNeighbours(std::size_t texel) const {
        TexelPlace best;
        double best_distance = padding_ * padding_;
        TexelPlace last;
        forNeighbours(texel, [&](std::size_t other, int dx, int dy) {
            if (!hasTriangle(other)) return;
            const TexelPlace& there = found_.places[other];
            const TexelPlace here = placeOf(there.triangle, there.x - step(dx, there.x, shape_.width, shape_.wrap_u),
                                            there.y - step(dy, there.y, shape_.height, shape_.wrap_v));
            if (here.triangle == last.triangle && here.x == last.x && here.y == last.y) return;
            last = here;
            const double distance = exact(here.triangle).squaredDistance(here.x + 0.5, here.y + 0.5);
            if (best.triangle == kNoTriangle ? distance > best_distance : distance >= best_distance) return;
            best = here;
            best_distance = distance;
        });
        return best;
    }

    /// Converts a step in the image to a step in the infinite plane, where the texel is at `at`.
    [[nodiscard]] std::int64_t step(int in_image, std::int64_t at, std::uint32_t size, TextureWrap wrap) const {
        return isFlipped(floorDiv(at, size), wrap) ? -in_image : in_image;
    }

    void countTexels() {
        TexelTriangleCounts& counts = found_.counts;
        for (std::size_t texel = 0; texel < found_.kinds.size(); ++texel) {
            TexelCoverage& kind = found_.kinds[texel];
            if (kind == kRefused) kind = TexelCoverage::none;
            counts.inside += kind == TexelCoverage::inside ? 1 : 0;
            counts.beside += kind == TexelCoverage::beside ? 1 : 0;
            counts.overlapping += found_.overlaps[texel] ? 1 : 0;
        }
    }

    const UvTriangles& triangles_;
    TexelTriangles& found_;
    TextureShape shape_;
    double near_, padding_;
    Parallel& parallel_;
    const Allocator* allocator_;
    std::size_t band_count_;
    Buffer<RowRange> rows_ = {};  ///< rows near each triangle
    Buffer<std::size_t> begin_ = {};
    Buffer<std::uint32_t> entries_ = {};
    Buffer<std::uint64_t> marks_ = {};
    std::uint64_t mark_ = 0;
    Buffer<float> distances_ = {};
    std::unordered_map<std::array<std::int64_t, 6>, std::uint32_t, HashPlacedKey> known_ = {};
};

}  // namespace

std::optional<TexelTriangles> findTexelTriangles(const UvTriangles& triangles, std::uint32_t width,
                                                 std::uint32_t height, std::uint32_t padding, Parallel& parallel,
                                                 const Allocator* allocator) {
    std::optional<TexelTriangles> found(std::in_place);
    found->shape = {width, height, triangles.wrap_u, triangles.wrap_v};
    if (!TriangleSearch(triangles, *found, padding, parallel, allocator).run()) found.reset();
    return found;
}

ExactTriangle::ExactTriangle(const std::array<Vec2, 3>& uvs, const PlacedTriangle& placed, const TextureShape& shape) {
    for (std::size_t i = 0; i < 3; ++i) {
        x[i] = (uvs[i].x - placed.x.begin) * shape.width;
        y[i] = (uvs[i].y - placed.y.begin) * shape.height;
    }
    double_area_ = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
}

/// Returns barycentric coordinates, which are not finite if the triangle has no area.
std::array<double, 3> ExactTriangle::plane(double px, double py) const {
    const double at_1 = ((px - x[0]) * (y[2] - y[0]) - (py - y[0]) * (x[2] - x[0])) / double_area_;
    const double at_2 = ((x[1] - x[0]) * (py - y[0]) - (y[1] - y[0]) * (px - x[0])) / double_area_;
    return {1 - at_1 - at_2, at_1, at_2};
}

ExactTriangle::Nearest ExactTriangle::nearest(double px, double py) const {
    const std::array<double, 3> inside = plane(px, py);
    if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) return {inside, 0};
    Nearest best{{1, 0, 0}, INFINITY};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        const double dx = x[b] - x[a], dy = y[b] - y[a], squared = dx * dx + dy * dy;
        const double part = squared > 0 ? std::clamp(((px - x[a]) * dx + (py - y[a]) * dy) / squared, 0.0, 1.0) : 0.0;
        const double to_x = x[a] + part * dx - px, to_y = y[a] + part * dy - py;
        const double distance = to_x * to_x + to_y * to_y;
        if (!(distance < best.squared_distance)) continue;
        best.weights = {};
        best.weights[a] = 1 - part;
        best.weights[b] = part;
        best.squared_distance = distance;
    }
    return best;
}

std::array<double, 3> ExactTriangle::weights(double px, double py) const {
    constexpr double kLeast = -1;
    const std::array<double, 3> wanted = plane(px, py);
    if (wanted[0] >= kLeast && wanted[1] >= kLeast && wanted[2] >= kLeast) return wanted;
    const std::array<double, 3> from = nearest(px, py).weights;
    if (!std::isfinite(wanted[0]) || !std::isfinite(wanted[1]) || !std::isfinite(wanted[2])) return from;
    double part = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        if (wanted[i] < kLeast) part = std::min(part, (from[i] - kLeast) / (from[i] - wanted[i]));
    }
    std::array<double, 3> limited;
    for (std::size_t i = 0; i < 3; ++i) limited[i] = from[i] + part * (wanted[i] - from[i]);
    return limited;
}

double ExactTriangle::squaredDistance(double px, double py) const { return nearest(px, py).squared_distance; }

bool ExactTriangle::isReadAt(double px, double py) const {
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        const double from_x = x[a] - px, from_y = y[a] - py, dx = x[b] - x[a], dy = y[b] - y[a];
        // The maximum of both distances is smallest at an end of the edge, or where the distances are equal.
        for (const double part : {0.0, 1.0, (from_y - from_x) / (dx - dy), -(from_x + from_y) / (dx + dy)}) {
            if (!(part >= 0 && part <= 1)) continue;
            if (std::fabs(from_x + part * dx) < 1 && std::fabs(from_y + part * dy) < 1) return true;
        }
    }
    return squaredDistance(px, py) == 0;
}

std::array<double, 3> weightsAt(const UvTriangles& triangles, const TextureShape& shape, const TexelPlace& place) {
    const std::array<Vec2, 3> uvs = cornerUvs(triangles, place.triangle);
    PlacedTriangle placed;
    placed.place(uvs, shape);
    return ExactTriangle(uvs, placed, shape).weights(place.x + 0.5, place.y + 0.5);
}

}  // namespace tspace
