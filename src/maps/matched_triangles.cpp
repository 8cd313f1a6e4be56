// SPDX-License-Identifier: MIT
#include "maps/matched_triangles.h"

#include <algorithm>
#include <bit>

#include "core/base/hash.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

struct HashedTriangle {
    std::uint64_t hash = 0;
    std::uint32_t triangle = 0;
};

std::uint64_t hashOf(const MapSide& side, std::size_t triangle, bool with_positions) {
    std::array<std::uint64_t, 3> corners{};
    const auto bits = [](float f) { return std::uint64_t{std::bit_cast<std::uint32_t>(f == 0.0f ? 0.0f : f)}; };
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 uv = side.uvs[3 * triangle + i];
        corners[i] = foldHash(bits(uv.x) | bits(uv.y) << 32,
                              with_positions ? hashPosition(side.positions[3 * triangle + i]) : 0);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return foldHash(foldHash(foldHash(0, corners[0]), corners[1]), corners[2]);
}

Buffer<HashedTriangle> sorted(const MapSide& side, bool with_positions, const Allocator* allocator) {
    Buffer<HashedTriangle> list(allocator, side.uvs.count / 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i] = {hashOf(side, i, with_positions), static_cast<std::uint32_t>(i)};
    }
    sortList(list.begin(), list.end(), [](const HashedTriangle& a, const HashedTriangle& b) {
        return a.hash != b.hash ? a.hash < b.hash : a.triangle < b.triangle;
    });
    return list;
}

DVec3 positionAt(const MapSide& side, const UvTriangles& triangles, const TextureShape& shape,
                 const TexelPlace& place) {
    const std::array<double, 3> weights = weightsAt(triangles, shape, place);
    DVec3 sum{};
    for (std::size_t i = 0; i < 3; ++i) sum = sum + weights[i] * toDouble(side.positions[3 * place.triangle + i]);
    return sum;
}

}  // namespace

Buffer<std::uint32_t> matchTriangles(const MapSide& side, const MapSide& other, const Allocator* allocator) {
    const bool with_positions = !side.positions.empty() && !other.positions.empty();
    const Buffer<HashedTriangle> mine = sorted(side, with_positions, allocator);
    const Buffer<HashedTriangle> theirs = sorted(other, with_positions, allocator);
    Buffer<std::uint32_t> match(allocator, mine.size(), kNoTriangle);
    for (std::size_t a = 0, b = 0; a < mine.size() && b < theirs.size();) {
        if (mine[a].hash == theirs[b].hash) {
            match[mine[a++].triangle] = theirs[b++].triangle;
        } else if (mine[a].hash < theirs[b].hash) {
            ++a;
        } else {
            ++b;
        }
    }
    return match;
}

void chooseByPosition(const MapSide& side, const UvTriangles& triangles, const TexelTriangles& places,
                      const MapSide& other, const UvTriangles& other_triangles, TexelTriangles& other_places,
                      const Allocator* allocator) {
    const TextureShape& shape = other_places.shape;
    Buffer<double> distances(allocator, places.kinds.size(), static_cast<double>(INFINITY));
    for (std::size_t triangle = 0; triangle < other.uvs.count / 3; ++triangle) {
        forEachSample(cornerUvs(other_triangles, triangle), shape, 1, [&](const UvSample& sample) {
            const auto x = static_cast<std::int64_t>(std::floor(sample.x));
            const auto y = static_cast<std::int64_t>(std::floor(sample.y));
            const std::uint32_t column = texelInImage(x, shape.width, shape.wrap_u);
            const std::uint32_t row = texelInImage(y, shape.height, shape.wrap_v);
            if (column >= shape.width || row >= shape.height) return;
            const std::size_t texel = std::size_t{row} * shape.width + column;
            if (places.kinds[texel] != TexelKind::inside) return;
            const TexelPlace place{static_cast<std::uint32_t>(triangle), static_cast<std::int32_t>(x),
                                   static_cast<std::int32_t>(y)};
            const DVec3 apart = positionAt(other, other_triangles, shape, place) -
                                positionAt(side, triangles, shape, places.places[texel]);
            const double distance = dot(apart, apart);
            if (!(distance < distances[texel])) return;
            distances[texel] = distance;
            other_places.places[texel] = place;
        });
    }
}

}  // namespace tspace
