// SPDX-License-Identifier: MIT
// Rasterizes bands of rows in parallel, in these steps:
//
//   1. listBands: the triangles with rows in each band
//   2. addInside: texels inside triangles
//   3. addNear: texels next to them
//   4. addRings: texels farther away, ring by ring
//   5. countTexels
#include "maps/layout/texel_triangles.h"

#include <vector>

#include "maps/layout/row_bands.h"

namespace tspace {
namespace {

constexpr std::uint32_t kBandRows = 64;
/// Distance from a triangle, in texels, within which texels outside it are assigned to it: bilinear filtering inside a
/// chart reads no texel that is farther away than sqrt(2).
constexpr double kNearTexels = 1.5;
constexpr std::int64_t kNearRows = 2;
/// Number of texels per work step.
constexpr std::uint64_t kTexelsOfStep = 16;
/// Temporary states during the search of rings: the texel gets a triangle in this ring, or it is farther away than the
/// padding.
constexpr auto kPending = static_cast<TexelCoverage>(3), kRefused = static_cast<TexelCoverage>(4);

/// State of a search, which its steps share.
struct TriangleSearch {
    const UvTriangles& triangles;
    TexelTriangles& found;
    TextureShape shape;
    double near, padding;
    Parallel& parallel;
    const Allocator* allocator;
    RowBands bands;
    Buffer<float> distances = {};
    LargeTriangles large = {};
};

// -- 1. bands of rows --

/// Returns the rows in or near a triangle.
TexelRange nearRows(const PlacedTriangle& placed) {
    const TexelRange rows = placed.rows();
    return {rows.first - kNearRows, rows.last + kNearRows};
}

/// Lists a triangle in its bands, and returns the amount of work for it.
std::uint64_t listTriangle(TriangleSearch& search, std::size_t i) {
    PlacedTriangle placed;
    const UvPlacing placing = placed.place(search.triangles[i], search.shape);
    TexelTriangleCounts& counts = search.found.counts;
    if (placing == UvPlacing::notFinite) ++counts.not_finite;
    if (placing == UvPlacing::tooFar) ++counts.too_far;
    if (placing != UvPlacing::placed) return 0;
    const std::int64_t area = std::abs(placed.doubleArea());
    if (area == 0) {
        ++counts.without_area;
        return 0;
    }
    // The second of several equal triangles is not skipped, so that its overlap is counted.
    if (search.large.countEarlier(placed) > 1) {
        ++counts.repeated;
        return 0;
    }
    const TexelRange rows = nearRows(placed);
    search.bands.add(static_cast<std::uint32_t>(i), rows);
    return static_cast<std::uint64_t>(rows.last - rows.first + 1) +
           static_cast<std::uint64_t>(area) / (2 * kTexelParts * kTexelParts * kTexelsOfStep);
}

/// Returns false if the triangles would take too much work.
bool listBands(TriangleSearch& search) {
    std::uint64_t steps = 0;
    for (std::size_t i = 0; i < search.triangles.size() && steps <= kCoverSteps; ++i) steps += listTriangle(search, i);
    return steps <= kCoverSteps;
}

// -- 2. texels inside triangles --

/// Calls visit(row, row in the image) for the rows of a triangle in a band.
template <class Visit>
void forRows(const TriangleSearch& search, TexelRange rows, std::size_t band, const Visit& visit) {
    const std::int64_t height = search.shape.height, first = static_cast<std::int64_t>(band) * kBandRows;
    const std::int64_t last = std::min(first + kBandRows, height) - 1;
    for (std::int64_t tile = floorDiv(rows.first, height); tile <= floorDiv(rows.last, height); ++tile) {
        const TexelRange inside = rowsOfTile(rows, tile, search.shape.height, search.shape.wrap_v, first, last);
        for (std::int64_t at = inside.first; at <= inside.last; ++at) {
            visit(tile * height + (isFlipped(tile, search.shape.wrap_v) ? height - 1 - at : at),
                  static_cast<std::size_t>(at));
        }
    }
}

template <class Visit>
void forColumns(const TriangleSearch& search, TexelRange columns, const Visit& visit) {
    forColumnsInImage(columns, search.shape.width, search.shape.wrap_u, visit);
}

TexelPlace placeOf(std::uint32_t triangle, std::int64_t column, std::int64_t row) {
    return {triangle, static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
}

/// Returns whether the texel center is strictly inside its triangle: a center on an edge that two triangles share is
/// not an overlap.
bool isInner(const TriangleSearch& search, const TexelPlace& place) {
    PlacedTriangle placed;
    placed.place(search.triangles[place.triangle], search.shape);
    return placed.isInner(place.x, place.y);
}

void addInside(TriangleSearch& search, std::uint32_t triangle, std::size_t band) {
    PlacedTriangle placed;
    placed.place(search.triangles[triangle], search.shape);
    forRows(search, placed.rows(), band, [&](std::int64_t row, std::size_t image_row) {
        forColumns(search, placed.columns(row), [&](std::int64_t column, std::size_t image_column) {
            const std::size_t texel = image_row * search.shape.width + image_column;
            if (search.found.kinds[texel] == TexelCoverage::none) {
                search.found.kinds[texel] = TexelCoverage::inside;
                search.found.places[texel] = placeOf(triangle, column, row);
            } else if (!search.found.overlaps[texel]) {
                search.found.overlaps[texel] =
                    placed.isInner(column, row) || isInner(search, search.found.places[texel]);
            }
        });
    });
}

// -- 3. texels next to triangles --

ExactTriangle exact(const TriangleSearch& search, std::uint32_t triangle, PlacedTriangle& placed) {
    const std::array<Vec2, 3> uvs = search.triangles[triangle];
    placed.place(uvs, search.shape);
    return {uvs, placed, search.shape};
}

/// Returns the columns of a row that may be close to the triangle.
TexelRange nearColumns(const ExactTriangle& corners, std::int64_t row) {
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

void addNear(TriangleSearch& search, std::uint32_t triangle, std::size_t band) {
    PlacedTriangle placed;
    const ExactTriangle corners = exact(search, triangle, placed);
    forRows(search, nearRows(placed), band, [&](std::int64_t row, std::size_t image_row) {
        forColumns(search, nearColumns(corners, row), [&](std::int64_t column, std::size_t image_column) {
            const std::size_t texel = image_row * search.shape.width + image_column;
            if (search.found.kinds[texel] == TexelCoverage::inside) return;
            const double x = static_cast<double>(column) + 0.5, y = static_cast<double>(row) + 0.5;
            const auto distance = static_cast<float>(corners.squaredDistance(x, y));
            if (distance < 2 && !search.found.is_read[texel]) search.found.is_read[texel] = corners.isReadAt(x, y);
            const bool is_first = search.found.kinds[texel] == TexelCoverage::none;
            if (is_first ? distance > search.distances[texel] : distance >= search.distances[texel]) return;
            search.found.kinds[texel] = TexelCoverage::adjacent;
            search.found.places[texel] = placeOf(triangle, column, row);
            search.distances[texel] = distance;
        });
    });
}

// -- 4. rings of padding --

bool hasTriangle(const TriangleSearch& search, std::size_t texel) {
    return search.found.kinds[texel] == TexelCoverage::inside || search.found.kinds[texel] == TexelCoverage::adjacent;
}

/// Returns the position of a neighbor, or `size` if there is none. At the edge of a mirrored image the neighbor
/// would be the texel itself, so none is returned.
std::size_t neighbor(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
    return texelInImage(at, size, wrap == TextureWrap::repeat ? wrap : TextureWrap::clamp);
}

/// Calls visit(neighbor, dx, dy) for each of up to eight adjacent texels.
template <class Visit>
void forNeighbors(const TriangleSearch& search, std::size_t texel, const Visit& visit) {
    const auto x = static_cast<std::int64_t>(texel % search.shape.width);
    const auto y = static_cast<std::int64_t>(texel / search.shape.width);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const std::size_t column = neighbor(x + dx, search.shape.width, search.shape.wrap_u);
            const std::size_t row = neighbor(y + dy, search.shape.height, search.shape.wrap_v);
            if ((dx != 0 || dy != 0) && column < search.shape.width && row < search.shape.height)
                visit(row * search.shape.width + column, dx, dy);
        }
    }
}

void pushNeighbors(TriangleSearch& search, std::size_t texel, std::vector<std::size_t>& ring) {
    forNeighbors(search, texel, [&](std::size_t other, int, int) {
        if (search.found.kinds[other] != TexelCoverage::none) return;
        search.found.kinds[other] = kPending;
        ring.push_back(other);
    });
}

/// Converts a step in the image to a step in the infinite plane, where `at` is the position of the texel.
std::int64_t step(int in_image, std::int64_t at, std::uint32_t size, TextureWrap wrap) {
    return isFlipped(floorDiv(at, size), wrap) ? -in_image : in_image;
}

/// Returns the nearest of the triangles assigned to the adjacent texels.
TexelPlace placeFromNeighbors(const TriangleSearch& search, std::size_t texel) {
    TexelPlace best;
    double best_distance = search.padding * search.padding;
    TexelPlace last;
    forNeighbors(search, texel, [&](std::size_t other, int dx, int dy) {
        if (!hasTriangle(search, other)) return;
        const TexelPlace& there = search.found.places[other];
        const TexelPlace here =
            placeOf(there.triangle, there.x - step(dx, there.x, search.shape.width, search.shape.wrap_u),
                    there.y - step(dy, there.y, search.shape.height, search.shape.wrap_v));
        if (here.triangle == last.triangle && here.x == last.x && here.y == last.y) return;
        last = here;
        PlacedTriangle placed;
        const double distance = exact(search, here.triangle, placed).squaredDistance(here.x + 0.5, here.y + 0.5);
        if (best.triangle == kNoTriangle ? distance > best_distance : distance >= best_distance) return;
        best = here;
        best_distance = distance;
    });
    return best;
}

void addRings(TriangleSearch& search) {
    std::vector<std::size_t> ring;
    for (std::size_t texel = 0; texel < search.found.kinds.size(); ++texel) {
        if (hasTriangle(search, texel)) pushNeighbors(search, texel, ring);
    }
    std::vector<TexelPlace> places;
    std::vector<std::size_t> next;
    while (!ring.empty()) {
        places.assign(ring.size(), TexelPlace{});
        search.parallel.forRanges(ring.size(), Parallel::kGrain / 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) places[i] = placeFromNeighbors(search, ring[i]);
        });
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const bool is_far = places[i].triangle == kNoTriangle;
            search.found.kinds[ring[i]] = is_far ? kRefused : TexelCoverage::adjacent;
            if (!is_far) search.found.places[ring[i]] = places[i];
        }
        next.clear();
        for (const std::size_t texel : ring) {
            if (hasTriangle(search, texel)) pushNeighbors(search, texel, next);
        }
        ring.swap(next);
    }
}

// -- 5. counts --

void countTexels(TriangleSearch& search) {
    TexelTriangleCounts& counts = search.found.counts;
    for (std::size_t texel = 0; texel < search.found.kinds.size(); ++texel) {
        TexelCoverage& kind = search.found.kinds[texel];
        if (kind == kRefused) kind = TexelCoverage::none;
        counts.inside += kind == TexelCoverage::inside ? 1 : 0;
        counts.beside += kind == TexelCoverage::adjacent ? 1 : 0;
        counts.overlapping += search.found.overlaps[texel] ? 1 : 0;
    }
}

/// Finds the triangles of all texels. Returns false if they would take too much work.
bool findTriangles(TriangleSearch& search) {
    const std::size_t texels = std::size_t{search.shape.width} * search.shape.height;
    if (!listBands(search)) return false;
    search.found.places = Buffer<TexelPlace>(search.allocator, texels, TexelPlace{});
    search.found.kinds = Buffer<TexelCoverage>(search.allocator, texels, TexelCoverage::none);
    search.found.overlaps = Buffer<bool>(search.allocator, texels, false);
    search.found.is_read = Buffer<bool>(search.allocator, texels, false);
    if (search.near > 0)
        search.distances = Buffer<float>(search.allocator, texels, static_cast<float>(search.near * search.near));
    search.parallel.forTasks(search.bands.size(), [&](std::size_t band) {
        for (const std::uint32_t triangle : search.bands[band]) addInside(search, triangle, band);
        if (search.near == 0) return;
        for (const std::uint32_t triangle : search.bands[band]) addNear(search, triangle, band);
    });
    if (search.padding > search.near) addRings(search);
    countTexels(search);
    return true;
}

}  // namespace

std::optional<TexelTriangles> findTexelTriangles(const UvTriangles& triangles, std::uint32_t width,
                                                 std::uint32_t height, std::uint32_t padding, Parallel& parallel,
                                                 const Allocator* allocator) {
    std::optional<TexelTriangles> found(std::in_place);
    found->shape = {width, height, triangles.wrap_u, triangles.wrap_v};
    TriangleSearch search{.triangles = triangles,
                          .found = *found,
                          .shape = found->shape,
                          .near = std::min<double>(padding, kNearTexels),
                          .padding = static_cast<double>(padding),
                          .parallel = parallel,
                          .allocator = allocator,
                          .bands = {found->shape, kBandRows}};
    if (!findTriangles(search)) found.reset();
    return found;
}

ExactTriangle::ExactTriangle(const std::array<Vec2, 3>& uvs, const PlacedTriangle& placed, const TextureShape& shape) {
    for (std::size_t i = 0; i < 3; ++i) {
        x[i] = (uvs[i].x - placed.x.begin) * shape.width;
        y[i] = (uvs[i].y - placed.y.begin) * shape.height;
    }
    double_area_ = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
}

/// Returns the barycentric coordinates of a point in the plane. They are not finite if the triangle has no area.
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
        // The maximum of the two distances is smallest at an end of the edge, or where both distances are equal.
        for (const double part : {0.0, 1.0, (from_y - from_x) / (dx - dy), -(from_x + from_y) / (dx + dy)}) {
            if (!(part >= 0 && part <= 1)) continue;
            if (std::fabs(from_x + part * dx) < 1 && std::fabs(from_y + part * dy) < 1) return true;
        }
    }
    return squaredDistance(px, py) == 0;
}

std::array<double, 3> weightsAt(const UvTriangles& triangles, const TextureShape& shape, const TexelPlace& place) {
    const std::array<Vec2, 3> uvs = triangles[place.triangle];
    PlacedTriangle placed;
    placed.place(uvs, shape);
    return ExactTriangle(uvs, placed, shape).weights(place.x + 0.5, place.y + 0.5);
}

}  // namespace tspace
