// SPDX-License-Identifier: MIT
// Pairs triangles by their corners or by their positions, and primitives by geometry (since names repeat and tools drop
// them), then by name, then by index in the file.
#include "commands/diff/pair_primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>

#include "core/base/sort.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"

namespace tspace {

// Keys of triangles: three corner hashes, starting with the smallest.

namespace {

/// Returns the first UV set, or null if there is none. Other sets are not compared, because tools add and drop them.
const SharedArray<Vec2>* firstUvs(const ScenePrimitive& primitive) {
    return primitive.uv_sets.empty() || primitive.uv_sets[0].empty() ? nullptr : &primitive.uv_sets[0];
}

class CornerHashes {
  public:
    CornerHashes(const ScenePrimitive& primitive, bool with_uvs) : corners_(primitive.corners) {
        const SharedArray<Vec2>* uvs = with_uvs ? firstUvs(primitive) : nullptr;
        vertices_.reserve(primitive.positions.size());
        for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
            std::uint64_t hash = hashPosition(primitive.positions[i]);
            if (uvs != nullptr) hash = foldHash(hash, hashPosition({(*uvs)[i].x, (*uvs)[i].y, 0}));
            vertices_.push_back(hash);
        }
    }

    struct Key {
        std::uint64_t hash = 0;
        std::uint32_t first = 0;  ///< the corner with which the key begins
    };
    /// Starts with the smallest rotation, so that the key does not depend on the first corner in the file.
    [[nodiscard]] Key keyOf(std::size_t triangle) const {
        const std::array<std::uint64_t, 3> h = {at(triangle, 0), at(triangle, 1), at(triangle, 2)};
        std::uint32_t first = 0;
        for (std::uint32_t k = 1; k < 3; ++k) {
            if (rotated(h, k) < rotated(h, first)) first = k;
        }
        return {foldHash(foldHash(h[first], h[(first + 1) % 3]), h[(first + 2) % 3]), first};
    }

  private:
    static std::array<std::uint64_t, 3> rotated(const std::array<std::uint64_t, 3>& h, std::uint32_t k) {
        return {h[k], h[(k + 1) % 3], h[(k + 2) % 3]};
    }
    [[nodiscard]] std::uint64_t at(std::size_t triangle, std::size_t k) const {
        return vertices_[corners_[triangle * 3 + k]];
    }

    SharedArray<std::uint32_t> corners_;
    std::vector<std::uint64_t> vertices_;
};

/// Pairs triangles that are not yet paired. `paired_b` has one entry per triangle.
void pairEqualKeys(const ScenePrimitive& a, const ScenePrimitive& b, bool with_uvs, std::vector<char>& paired_a,
                   std::vector<char>& paired_b, std::vector<TrianglePair>& pairs) {
    const CornerHashes hashes_a(a, with_uvs), hashes_b(b, with_uvs);
    constexpr std::uint32_t kNone = 0xffffffffu;
    struct List {
        std::uint32_t head = kNone, tail = kNone;
    };
    std::unordered_map<std::uint64_t, List> by_key;
    std::vector<std::uint32_t> next(paired_b.size(), kNone);
    for (std::uint32_t t = 0; t < paired_b.size(); ++t) {
        if (paired_b[t] != 0) continue;
        List& list = by_key[hashes_b.keyOf(t).hash];
        (list.head == kNone ? list.head : next[list.tail]) = t;
        list.tail = t;
    }
    for (std::uint32_t t = 0; t < paired_a.size(); ++t) {
        if (paired_a[t] != 0) continue;
        const CornerHashes::Key key = hashes_a.keyOf(t);
        const auto found = by_key.find(key.hash);
        if (found == by_key.end() || found->second.head == kNone) continue;
        const std::uint32_t partner = found->second.head;
        found->second.head = next[partner];
        paired_a[t] = paired_b[partner] = 1;
        pairs.push_back({t, partner, (hashes_b.keyOf(partner).first + 3 - key.first) % 3});
    }
}

constexpr double kPlaceTolerance = 1e-3;

/// Returns the used vertices, moved and scaled so that the center of their bounding box is 0 and its largest side is 1.
std::vector<DVec3> boxedPositions(const ScenePrimitive& primitive) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    DVec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
    for (const std::uint32_t vertex : primitive.corners) {
        const DVec3 p = toDouble(primitive.positions[vertex]);
        if (!isFinite(primitive.positions[vertex])) continue;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const DVec3 extent = high - low;
    const double size = std::max({extent.x, extent.y, extent.z});
    const double scale = size > 0 ? 1 / size : 1;
    const DVec3 center = 0.5 * (low + high);
    std::vector<DVec3> boxed;
    boxed.reserve(primitive.positions.size());
    for (const Vec3& p : primitive.positions)
        boxed.push_back(isFinite(p) ? scale * (toDouble(p) - center) : DVec3{kInfinity, kInfinity, kInfinity});
    return boxed;
}

/// Grid of the triangles of one mesh; each is in the cell that contains its center.
class TriangleGrid {
  public:
    explicit TriangleGrid(const ScenePrimitive& primitive)
        : corners_(primitive.corners), positions_(boxedPositions(primitive)) {
        for (std::uint32_t t = 0; t < corners_.size() / 3; ++t) {
            const DVec3 center = centerOf(t);
            if (std::isfinite(center.x + center.y + center.z)) cells_[cellHash(center, 0)].push_back(t);
        }
    }

    [[nodiscard]] const DVec3& at(std::uint32_t triangle, std::uint32_t k) const {
        return positions_[corners_[std::size_t{3} * triangle + k]];
    }
    [[nodiscard]] DVec3 centerOf(std::uint32_t t) const { return (1.0 / 3) * (at(t, 0) + at(t, 1) + at(t, 2)); }

    /// Calls visit(triangle) for triangles near `center`, at most 100 per cell, until it returns true.
    template <class Visit>
    void visitNear(const DVec3& center, Visit&& visit) const {
        constexpr std::size_t kMaxPerCell = 100;
        if (!std::isfinite(center.x + center.y + center.z)) return;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const auto found = cells_.find(cellHash(center, corner));
            if (found == cells_.end()) continue;
            const std::vector<std::uint32_t>& cell = found->second;
            for (std::size_t i = 0; i < std::min(cell.size(), kMaxPerCell); ++i) {
                if (visit(cell[i])) return;
            }
        }
    }

  private:
    /// Cells are twice as wide as the tolerance, so near centers are in the same cell or in the adjacent cells on the
    /// nearer side: bit k of `corner` selects the step along axis k. Corner 0 is the cell itself.
    static std::uint64_t cellHash(const DVec3& p, unsigned corner) {
        const auto cell = [&](double x, unsigned axis) {
            const double scaled = x / (2 * kPlaceTolerance);
            const double own = std::floor(scaled);
            const double step = scaled - own < 0.5 ? -1 : 1;
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(own + ((corner >> axis & 1U) != 0 ? step : 0)));
        };
        return foldHash(foldHash(mixBits(cell(p.x, 0)), cell(p.y, 1)), cell(p.z, 2));
    }

    SharedArray<std::uint32_t> corners_;
    std::vector<DVec3> positions_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_ = {};
};

/// Returns the rotation that maps triangle `t` of A to triangle `u` of B, or 3 if there is none.
std::uint32_t rotationBetween(const TriangleGrid& a, std::uint32_t t, const TriangleGrid& b, std::uint32_t u) {
    for (std::uint32_t rotation = 0; rotation < 3; ++rotation) {
        bool is_near = true;
        for (std::uint32_t k = 0; k < 3 && is_near; ++k)
            is_near = length(a.at(t, k) - b.at(u, (k + rotation) % 3)) <= kPlaceTolerance;
        if (is_near) return rotation;
    }
    return 3;
}

}  // namespace

std::uint64_t geometryHash(const ScenePrimitive& primitive) {
    const CornerHashes hashes(primitive, false);
    const std::size_t count = primitive.corners.size() / 3;
    std::uint64_t sum = count;
    for (std::size_t t = 0; t < count; ++t) sum += mixBits(hashes.keyOf(t).hash);
    return sum;
}

std::vector<TrianglePair> pairByCorners(const ScenePrimitive& a, const ScenePrimitive& b) {
    std::vector<char> paired_a(a.corners.size() / 3, 0), paired_b(b.corners.size() / 3, 0);
    std::vector<TrianglePair> pairs;
    pairs.reserve(paired_a.size());
    if (firstUvs(a) != nullptr && firstUvs(b) != nullptr) pairEqualKeys(a, b, true, paired_a, paired_b, pairs);
    if (pairs.size() < paired_a.size()) pairEqualKeys(a, b, false, paired_a, paired_b, pairs);
    sortList(pairs.begin(), pairs.end(), [](const TrianglePair& x, const TrianglePair& y) { return x.a < y.a; });
    return pairs;
}

std::vector<TrianglePair> pairByPlace(const ScenePrimitive& a, const ScenePrimitive& b) {
    const TriangleGrid grid_a(a), grid_b(b);
    std::vector<char> is_paired(b.corners.size() / 3, 0);
    std::vector<TrianglePair> pairs;
    for (std::uint32_t t = 0; t < a.corners.size() / 3; ++t) {
        const auto pairWith = [&](std::uint32_t u) {
            if (is_paired[u] != 0) return false;
            const std::uint32_t rotation = rotationBetween(grid_a, t, grid_b, u);
            if (rotation == 3) return false;
            is_paired[u] = 1;
            pairs.push_back({t, u, rotation});
            return true;
        };
        // The triangle with the same index is tried first: most files keep the order of triangles, and the order
        // distinguishes coincident triangles.
        if (t < is_paired.size() && pairWith(t)) continue;
        grid_b.visitNear(grid_a.centerOf(t), pairWith);
    }
    return pairs;
}

namespace {

/// Returns the key of a primitive: primitives with equal keys are paired. Primitives with an empty key are not paired.
using KeyOf = std::function<std::string(const ScenePrimitive&)>;

class Pairer {
  public:
    Pairer(const Scene& a, const Scene& b)
        : a_(a), b_(b), partner_(a.primitives.size(), kNoPrimitive), how_(a.primitives.size(), "none") {
        for (const ScenePrimitive& primitive : b.primitives) taken_.push_back(primitive.corners.empty());
    }

    /// Pairs primitives with equal keys. If several primitives have the same key, they are paired in order.
    void pairBy(const char* how, const KeyOf& key_of) {
        std::map<std::string, std::vector<std::size_t>> free_by_key;
        for (std::size_t k = b_.primitives.size(); k-- > 0;) {
            if (!taken_[k]) free_by_key[key_of(b_.primitives[k])].push_back(k);
        }
        for (std::size_t i = 0; i < a_.primitives.size(); ++i) {
            const ScenePrimitive& mine = a_.primitives[i];
            if (partner_[i] != kNoPrimitive || mine.corners.empty()) continue;
            const std::string key = key_of(mine);
            const auto found = free_by_key.find(key);
            if (key.empty() || found == free_by_key.end() || found->second.empty()) continue;
            partner_[i] = found->second.back();
            found->second.pop_back();
            taken_[partner_[i]] = true;
            how_[i] = how;
        }
    }

    std::vector<PrimitivePair> result() const {
        std::vector<PrimitivePair> pairs;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (a_.primitives[i].corners.empty()) continue;
            PrimitivePair& pair = pairs.emplace_back();
            pair.a = i;
            pair.b = partner_[i];
            pair.paired_by = how_[i];
            if (pair.b != kNoPrimitive) pairTriangles(pair);
        }
        for (std::size_t k = 0; k < taken_.size(); ++k) {
            if (!taken_[k]) pairs.emplace_back().b = k;
        }
        return pairs;
    }

  private:
    void pairTriangles(PrimitivePair& pair) const {
        const ScenePrimitive& mine = a_.primitives[pair.a];
        const ScenePrimitive& other = b_.primitives[pair.b];
        pair.triangles = pairByCorners(mine, other);
        // If corners differ, all vertices may have moved slightly: the mesh was quantized, or written with fewer
        // digits.
        if (pair.triangles.size() < mine.corners.size() / 3) {
            std::vector<TrianglePair> by_place = pairByPlace(mine, other);
            if (by_place.size() > pair.triangles.size()) pair.triangles = std::move(by_place);
        }
    }

    const Scene& a_;
    const Scene& b_;
    std::vector<std::size_t> partner_;  ///< index in B per primitive of A
    std::vector<std::string> how_;
    std::vector<bool> taken_ = {};  ///< per primitive of B: paired, or without triangles
};

/// Returns the geometry keys of all primitives, which are computed once because they are used several times.
std::map<const ScenePrimitive*, std::string> geometryKeys(const Scene& a, const Scene& b) {
    std::map<const ScenePrimitive*, std::string> keys;
    for (const Scene* scene : {&a, &b}) {
        for (const ScenePrimitive& primitive : scene->primitives) {
            if (!primitive.corners.empty()) keys[&primitive] = std::to_string(geometryHash(primitive)) + ' ';
        }
    }
    return keys;
}

std::string nameKey(const ScenePrimitive& p) {
    return p.mesh_name.empty() ? "" : std::to_string(p.primitive) + ' ' + p.mesh_name;
}

std::string placeKey(const ScenePrimitive& p) { return std::to_string(p.mesh) + ' ' + std::to_string(p.primitive); }

}  // namespace

std::vector<PrimitivePair> pairPrimitives(const Scene& a, const Scene& b) {
    const auto geometry = geometryKeys(a, b);
    const auto keyed = [&](const auto& more) {
        return [&](const ScenePrimitive& p) { return geometry.at(&p) + more(p); };
    };
    Pairer pairer(a, b);
    pairer.pairBy("geometry", keyed([](const ScenePrimitive& p) { return nameKey(p) + '/' + placeKey(p); }));
    pairer.pairBy("geometry", keyed(nameKey));
    pairer.pairBy("geometry", keyed(placeKey));
    pairer.pairBy("geometry", keyed([](const ScenePrimitive&) { return std::string(); }));
    pairer.pairBy("name", nameKey);
    pairer.pairBy("order",
                  [](const ScenePrimitive& p) { return placeKey(p) + ' ' + std::to_string(p.corners.size()); });
    return pairer.result();
}

}  // namespace tspace
