// SPDX-License-Identifier: MIT
#include "scans.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/vec_math.h"

namespace tspace::accuracy {

namespace {

constexpr double kHalfSize = 1.05;  // half the edge of the grid's cube; shapes lie in the cube from -1 to 1

/// Returns an approximately normally distributed number: the sum of twelve uniform numbers. It avoids functions whose
/// last bits differ between C libraries.
double normalNumber(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    return sum;
}

using Cell = std::array<int, 3>;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Values of a shape at the corners of grid cells.
class Field {
  public:
    Field(const Shape& shape, int cells, double noise, Random& random)
        : side_(cells + 1), step_(2 * kHalfSize / cells) {
        for (int z = 0; z < side_; ++z) {
            for (int y = 0; y < side_; ++y) {
                for (int x = 0; x < side_; ++x) {
                    const double moved = noise > 0 ? noise * step_ * normalNumber(random) : 0;
                    values_.push_back(shape.distance(place(x, y, z)) + moved);
                }
            }
        }
    }

    [[nodiscard]] std::size_t count() const { return values_.size(); }
    [[nodiscard]] std::size_t index(const Cell& c) const {
        return static_cast<std::size_t>((c[2] * side_ + c[1]) * side_ + c[0]);
    }
    [[nodiscard]] double value(const Cell& c) const { return values_[index(c)]; }
    [[nodiscard]] bool isInside(const Cell& c) const { return value(c) < 0; }
    [[nodiscard]] DVec3 place(double x, double y, double z) const {
        return {step_ * x - kHalfSize, step_ * y - kHalfSize, step_ * z - kHalfSize};
    }
    /// Returns the intersection of the shape with the edge between two corners, in cells.
    [[nodiscard]] DVec3 crossing(const Cell& a, const Cell& b) const {
        const double share = value(a) / (value(a) - value(b));
        return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
    }
    template <class Body>
    void forCells(int first, const Body& body) const {
        for (int z = first; z + 1 < side_; ++z) {
            for (int y = first; y + 1 < side_; ++y) {
                for (int x = first; x + 1 < side_; ++x) body(x, y, z);
            }
        }
    }

  private:
    int side_;
    double step_;
    std::vector<double> values_;
};

/// Surface nets: one point in each cell that the shape crosses.
class Nets {
  public:
    explicit Nets(const Field& field) : field_(field) {}

    void build(Scan& to) {
        points_.assign(field_.count(), kNone);
        field_.forCells(0, [&](int x, int y, int z) { addPoint(x, y, z, to); });
        field_.forCells(1, [&](int x, int y, int z) {
            for (int axis = 0; axis < 3; ++axis) addQuad({x, y, z}, axis, to);
        });
    }

  private:
    /// Adds the mean of the intersections of the shape with the cell's edges.
    void addPoint(int x, int y, int z, Scan& to) {
        DVec3 sum;
        int count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            for (int k = 0; k < 4; ++k) {
                Cell a{x, y, z};
                a[static_cast<std::size_t>((axis + 1) % 3)] += k & 1;
                a[static_cast<std::size_t>((axis + 2) % 3)] += k >> 1;
                Cell b = a;
                ++b[static_cast<std::size_t>(axis)];
                if (field_.isInside(a) == field_.isInside(b)) continue;
                sum = sum + field_.crossing(a, b);
                ++count;
            }
        }
        if (count == 0) return;
        points_[field_.index({x, y, z})] = static_cast<std::uint32_t>(to.positions.size());
        to.positions.push_back(toFloat(field_.place(sum.x / count, sum.y / count, sum.z / count)));
    }

    /// Adds a quad if the shape crosses an edge of the grid: its corners are the points of the four cells around the
    /// edge, and it is cut along the shorter diagonal.
    void addQuad(const Cell& from, int axis, Scan& to) const {
        Cell end = from;
        ++end[static_cast<std::size_t>(axis)];
        const bool is_inside = field_.isInside(from);
        if (is_inside == field_.isInside(end)) return;
        const auto b = static_cast<std::size_t>((axis + 1) % 3), c = static_cast<std::size_t>((axis + 2) % 3);
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t k = 0; k < 4; ++k) {
            Cell cell = from;
            cell[b] -= k == 0 || k == 3 ? 1 : 0;
            cell[c] -= k < 2 ? 1 : 0;
            quad[is_inside ? k : 3 - k] = points_[field_.index(cell)];
        }
        const auto square = [&](std::size_t k) {
            const DVec3 d = toDouble(to.positions[quad[k]]) - toDouble(to.positions[quad[k + 2]]);
            return dot(d, d);
        };
        const std::size_t s = square(0) < square(1) ? 0 : 1;
        to.indices.insert(to.indices.end(),
                          {quad[s], quad[s + 1], quad[s + 2], quad[s], quad[s + 2], quad[(s + 3) % 4]});
    }

    const Field& field_;
    std::vector<std::uint32_t> points_;
};

/// Marching cubes: the vertices are points at which the shape crosses edges of the grid.
class Cubes {
  public:
    explicit Cubes(const Field& field) : field_(field), points_(3 * field.count(), kNone) {}

    void build(Scan& to) {
        field_.forCells(0, [&](int x, int y, int z) { addCell({x, y, z}, to); });
    }

  private:
    /// Corners of each face of a cell, as bits of x, y and z: counter-clockwise seen from outside.
    static constexpr unsigned kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

    /// Adds the triangles of a cell. On each face of the cell, a segment separates each run of corners inside the shape
    /// from the other corners. The segments form loops, and each loop is triangulated as a fan.
    void addCell(const Cell& cell, Scan& to) {
        std::array<std::uint32_t, 64>
            next{};  // by the corners of an edge of the cell, lower one times 8: kNone or a point's
        std::array<std::uint32_t, 64> points{};
        next.fill(kNone);
        const auto at = [&](unsigned corner) {
            return Cell{cell[0] + static_cast<int>(corner & 1), cell[1] + static_cast<int>(corner >> 1 & 1),
                        cell[2] + static_cast<int>(corner >> 2)};
        };
        for (const auto& side : kSides) {
            std::array<bool, 4> in{};
            for (std::size_t k = 0; k < 4; ++k) in[k] = field_.isInside(at(side[k]));
            for (std::size_t k = 0; k < 4; ++k) {
                if (in[k] || !in[(k + 1) % 4]) continue;  // not the start of a run of inside corners
                std::size_t last = (k + 1) % 4;
                while (in[(last + 1) % 4]) last = (last + 1) % 4;
                const std::size_t leave = slot(side[last], side[(last + 1) % 4]),
                                  enter = slot(side[k], side[(k + 1) % 4]);
                next[enter] = static_cast<std::uint32_t>(leave);
                points[enter] = pointAt(at(side[k]), at(side[(k + 1) % 4]), to);
            }
        }
        for (std::size_t start = 0; start < next.size(); ++start) {
            std::vector<std::uint32_t> loop;
            for (std::size_t i = start; next[i] != kNone;) {
                loop.push_back(points[i]);
                const std::size_t following = next[i];
                next[i] = kNone;
                i = following;
            }
            for (std::size_t k = 2; k < loop.size(); ++k)
                to.indices.insert(to.indices.end(), {loop[0], loop[k - 1], loop[k]});
        }
    }
    static std::size_t slot(unsigned a, unsigned b) { return 8 * std::min(a, b) + std::max(a, b); }
    std::uint32_t pointAt(Cell a, Cell b, Scan& to) {
        if (b < a) std::swap(a, b);
        const std::size_t axis = a[0] != b[0] ? 0 : a[1] != b[1] ? 1 : 2;
        std::uint32_t& point = points_[3 * field_.index(a) + axis];
        if (point == kNone) {
            point = static_cast<std::uint32_t>(to.positions.size());
            const DVec3 p = field_.crossing(a, b);
            to.positions.push_back(toFloat(field_.place(p.x, p.y, p.z)));
        }
        return point;
    }

    const Field& field_;
    std::vector<std::uint32_t> points_;
};

}  // namespace

Scan surfaceNets(const Shape& shape, int cells, double noise, Random random) {
    Scan made{&shape};
    Nets(Field(shape, cells, noise, random)).build(made);
    return made;
}

Scan marchingCubes(const Shape& shape, int cells, double noise, Random random) {
    Scan made{&shape};
    Cubes(Field(shape, cells, noise, random)).build(made);
    return made;
}

Scan scan(const Shape& shape, int cells, double noise, Random random) {
    Scan made = surfaceNets(shape, cells, 0, random);
    for (Vec3& p : made.positions) p = toFloat(shape.nearest(toDouble(p)));
    double edges = 0;
    for (std::size_t c = 0; c < made.indices.size(); ++c) {
        const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
        edges += length(toDouble(made.positions[made.indices[next]]) - toDouble(made.positions[made.indices[c]]));
    }
    const double size = noise * edges / static_cast<double>(made.indices.size());
    for (Vec3& p : made.positions) {
        const double x = normalNumber(random), y = normalNumber(random), z = normalNumber(random);
        if (size > 0) p = toFloat(toDouble(p) + size * DVec3{x, y, z});
    }
    return made;
}

double shadedError(const Scan& scan, const std::vector<Vec3>& normals, int points, Random random) {
    const auto position = [&](std::size_t corner) { return toDouble(scan.positions[scan.indices[corner]]); };
    std::vector<double> areas;
    double area = 0;
    for (std::size_t c = 0; c < scan.indices.size(); c += 3) {
        area += length(cross(position(c + 1) - position(c), position(c + 2) - position(c)));
        areas.push_back(area);
    }
    double sum = 0;
    for (int i = 0; i < points; ++i) {
        const double at = area * (i + random.unit()) / points;
        const auto triangle = std::lower_bound(areas.begin(), areas.end() - 1, at) - areas.begin();
        const std::size_t c = 3 * static_cast<std::size_t>(triangle);
        double u = random.unit(), v = random.unit();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const auto interpolate = [&](const auto& of) { return (1 - u - v) * of(c) + u * of(c + 1) + v * of(c + 2); };
        const DVec3 exact = scan.shape->normalAt(scan.shape->nearest(interpolate(position)));
        sum += angleBetween(interpolate([&](std::size_t corner) { return toDouble(normals[corner]); }), exact);
    }
    return sum / points * (180 / kPi);
}

}  // namespace tspace::accuracy
