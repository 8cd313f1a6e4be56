// SPDX-License-Identifier: MIT
#include "scans.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/vec_math.h"

namespace tspace::accuracy {

namespace {

constexpr double kHalfSize = 1.05;  // of the grid; shapes lie in the unit cube

DVec3 unitOf(const DVec3& v) { return (1 / length(v)) * v; }
double larger(double a, double b) { return a > b ? a : b; }

double blend(double a, double b, double width) {
    const double h = std::clamp(0.5 + 0.5 * (b - a) / width, 0.0, 1.0);
    return b + h * (a - b) - width * h * (1 - h);
}
double ellipsoid(const DVec3& p, const DVec3& centre, const DVec3& radii) {
    const DVec3 q = p - centre;
    const DVec3 a{q.x / radii.x, q.y / radii.y, q.z / radii.z}, b{a.x / radii.x, a.y / radii.y, a.z / radii.z};
    return length(b) > 0 ? length(a) * (length(a) - 1) / length(b) : -1;
}
double box(const DVec3& p, const DVec3& half) {
    const DVec3 q{std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
    return length(DVec3{larger(q.x, 0), larger(q.y, 0), larger(q.z, 0)}) + std::min(larger(q.x, larger(q.y, q.z)), 0.0);
}
double cylinder(double radius, double height, double most_radius, double half_height) {
    return box({radius, height, 0}, {most_radius, half_height, 1});
}
double radiusOf(double x, double y) { return std::sqrt(x * x + y * y); }
/// So that nothing lies along the grid.
DVec3 turned(const DVec3& p) {
    constexpr double c = 0.921060994, s = 0.389418342, d = 0.764842187, t = 0.644217687;
    const double y = s * p.x + c * p.y;
    return {c * p.x - s * p.y, d * y - t * p.z, t * y + d * p.z};
}

double blob(const DVec3& p) {
    double d = ellipsoid(p, {0, 0.35, 0}, {0.33, 0.42, 0.38});
    d = blend(d, ellipsoid(p, {0, -0.55, 0}, {0.75, 0.35, 0.4}), 0.25);
    d = blend(d, ellipsoid(p, {0, -0.1, 0}, {0.2, 0.35, 0.2}), 0.12);
    d = blend(d, ellipsoid(p, {0, 0.32, 0.4}, {0.07, 0.12, 0.1}), 0.06);
    for (const double side : {-1.0, 1.0}) {
        d = blend(d, ellipsoid(p, {side * 0.33, 0.33, 0}, {0.05, 0.1, 0.08}), 0.05);
        d = -blend(-d, ellipsoid(p, {side * 0.14, 0.45, 0.38}, {0.07, 0.05, 0.06}), 0.05);
    }
    return d;
}
double torus(const DVec3& at) {
    const DVec3 p = turned(at);
    return radiusOf(radiusOf(p.x, p.y) - 0.6, p.z) - 0.25;
}
double roundedBox(const DVec3& at) { return box(turned(at), {0.4, 0.3, 0.5}) - 0.2; }

double part(const DVec3& at) {
    const DVec3 p = turned(at);
    double d = box(p, {0.6, 0.4, 0.3});
    d = larger(d, 0.2 - radiusOf(p.x - 0.2, p.y));
    d = std::min(d, cylinder(radiusOf(p.y, p.z), p.x + 0.45, 0.22, 0.4));
    return larger(d, -box(p - DVec3{-0.1, 0.4, 0.3}, {0.15, 0.15, 0.15}));
}
double gear(const DVec3& at) {
    const DVec3 p = turned(at);
    const double radius = radiusOf(p.x, p.y);
    double d = cylinder(radius, p.z, 0.6, 0.2);
    for (int tooth = 0; tooth < 12; ++tooth) {
        const auto [sine, cosine] = sineCosine(kPi / 6 * tooth);
        d = std::min(d, box({cosine * p.x + sine * p.y - 0.65, cosine * p.y - sine * p.x, p.z}, {0.15, 0.07, 0.2}));
    }
    return larger(d, 0.2 - radius);
}

constexpr Shape kShapes[] = {
    {"blob", blob}, {"torus", torus}, {"rounded box", roundedBox}, {"part", part, true}, {"gear", gear, true}};

DVec3 differences(const Shape& shape, const DVec3& p) {
    constexpr double h = 1e-4;
    const auto along = [&](const DVec3& d) { return (shape.distance(p + d) - shape.distance(p - d)) / (2 * h); };
    return {along({h, 0, 0}), along({0, h, 0}), along({0, 0, h})};
}

/// Nearly: the sum of twelve uniform numbers, without functions whose last bits differ between C libraries.
double normalNumber(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    return sum;
}

/// Values of a shape at the corners of cells, and the points in the cells that it passes through.
class Nets {
  public:
    Nets(const Shape& shape, int cells) : side_(cells + 1), step_(2 * kHalfSize / cells) {
        for (int z = 0; z < side_; ++z) {
            for (int y = 0; y < side_; ++y) {
                for (int x = 0; x < side_; ++x) values_.push_back(shape.distance(place(x, y, z)));
            }
        }
    }

    void build(Scan& to) {
        points_.assign(values_.size(), kNone);
        forCells(0, [&](int x, int y, int z) { addPoint(x, y, z, to); });
        forCells(1, [&](int x, int y, int z) {
            for (int axis = 0; axis < 3; ++axis) addQuad({x, y, z}, axis, to);
        });
    }

  private:
    using Cell = std::array<int, 3>;
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    template <class Body>
    void forCells(int first, const Body& body) const {
        for (int z = first; z + 1 < side_; ++z) {
            for (int y = first; y + 1 < side_; ++y) {
                for (int x = first; x + 1 < side_; ++x) body(x, y, z);
            }
        }
    }
    [[nodiscard]] std::size_t index(const Cell& c) const {
        return static_cast<std::size_t>((c[2] * side_ + c[1]) * side_ + c[0]);
    }
    [[nodiscard]] double value(const Cell& c) const { return values_[index(c)]; }
    [[nodiscard]] DVec3 place(double x, double y, double z) const {
        return {step_ * x - kHalfSize, step_ * y - kHalfSize, step_ * z - kHalfSize};
    }

    /// The mean of where the shape crosses the cell's edges.
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
                if ((value(a) < 0) == (value(b) < 0)) continue;
                const double share = value(a) / (value(a) - value(b));
                sum = sum +
                      DVec3{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
                ++count;
            }
        }
        if (count == 0) return;
        points_[index({x, y, z})] = static_cast<std::uint32_t>(to.positions.size());
        to.positions.push_back(toFloat(place(sum.x / count, sum.y / count, sum.z / count)));
    }

    /// The points of the four cells around an edge that the shape crosses, cut along the shorter diagonal.
    void addQuad(const Cell& from, int axis, Scan& to) const {
        Cell end = from;
        ++end[static_cast<std::size_t>(axis)];
        const bool is_inside = value(from) < 0;
        if (is_inside == (value(end) < 0)) return;
        const auto b = static_cast<std::size_t>((axis + 1) % 3), c = static_cast<std::size_t>((axis + 2) % 3);
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t k = 0; k < 4; ++k) {
            Cell cell = from;
            cell[b] -= k == 0 || k == 3 ? 1 : 0;
            cell[c] -= k < 2 ? 1 : 0;
            quad[is_inside ? k : 3 - k] = points_[index(cell)];
        }
        const auto square = [&](std::size_t k) {
            const DVec3 d = toDouble(to.positions[quad[k]]) - toDouble(to.positions[quad[k + 2]]);
            return dot(d, d);
        };
        const std::size_t s = square(0) < square(1) ? 0 : 1;
        to.indices.insert(to.indices.end(),
                          {quad[s], quad[s + 1], quad[s + 2], quad[s], quad[s + 2], quad[(s + 3) % 4]});
    }

    int side_;
    double step_;
    std::vector<double> values_;
    std::vector<std::uint32_t> points_;
};

}  // namespace

DVec3 Shape::normalAt(const DVec3& p) const { return unitOf(differences(*this, p)); }

DVec3 Shape::nearest(DVec3 p) const {
    for (int step = 0; step < 4; ++step) {
        const DVec3 slope = differences(*this, p);
        p = p - (distance(p) / larger(dot(slope, slope), 0.1)) * slope;
    }
    return p;
}

std::span<const Shape> shapes() { return kShapes; }

Scan scan(const Shape& shape, int cells, double noise, Random random) {
    Scan made{&shape};
    Nets(shape, cells).build(made);
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
