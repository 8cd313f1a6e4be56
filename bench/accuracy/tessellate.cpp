// SPDX-License-Identifier: MIT
// Grids over the unit square of the parameters of a surface.
#include <algorithm>

#include "test_mesh.h"

namespace tspace::accuracy {

namespace {

struct Point {
    double s = 0, t = 0;
};

double turn(const Point& a, const Point& b, const Point& c) {
    return (b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s);
}

/// Returns whether d is inside the circle through a, b, c (in counter-clockwise order).
bool inCircle(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double ax = a.s - d.s, ay = a.t - d.t, bx = b.s - d.s, by = b.t - d.t, cx = c.s - d.s, cy = c.t - d.t;
    const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    return ax * (by * cc - bb * cy) - ay * (bx * cc - bb * cx) + aa * (bx * cy - by * cx) > 0;
}

/// Returns the grid lines, from 0 to 1.
std::vector<double> lines(int cells, bool loops) {
    std::vector<double> line(1, 0.0);
    for (int i = 0; i < cells; ++i) line.push_back(line.back() + (loops && i % 4 == 3 ? 0.1 : 1.0));
    const double all = line.back();
    for (double& x : line) x /= all;
    return line;
}

class Grid {
  public:
    Grid(const Surface& surface, Tessellation kind, int cells, Random random)
        : surface_(surface), kind_(kind), random_(random), columns_(cells) {
        rows_ = kind == Tessellation::anisotropic ? std::max(1, cells / 8) : cells;
        placePoints();
    }

    TestMesh mesh() {
        mesh_.surface = &surface_;
        addVertices();
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) addCell(column, row);
        }
        mesh_.measured.resize(mesh_.triangleCount());
        for (std::uint32_t i = 0; i < mesh_.measured.size(); ++i) mesh_.measured[i] = i;
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] std::size_t number(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_ + 1) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool onFold(const Point& p) const { return std::fabs(p.s - surface_.fold) < 1e-12; }

    void placePoints() {
        const bool loops = kind_ == Tessellation::loops;
        const std::vector<double> s = lines(columns_, loops), t = lines(rows_, loops);
        double reach = 0;
        if (kind_ == Tessellation::irregular || kind_ == Tessellation::anisotropic) reach = 0.36;
        if (kind_ == Tessellation::random) reach = 0.3;
        points_.resize(number(columns_, rows_) + 1);
        for (int row = 0; row <= rows_; ++row) {
            for (int column = 0; column <= columns_; ++column) {
                Point p{s[static_cast<std::size_t>(column)], t[static_cast<std::size_t>(row)]};
                const double ds = random_.around(reach) / columns_, dt = random_.around(reach) / rows_;
                const bool inside = column != 0 && column != columns_ && row != 0 && row != rows_;
                if (inside && !onFold(p)) p.s += ds;
                if (inside) p.t += dt;
                points_[number(column, row)] = p;
            }
        }
    }

    void addVertices() {
        first_copies_.resize(points_.size());
        for (int row = 0; row <= rows_; ++row) {
            for (int column = 0; column <= columns_; ++column) {
                const Point p = points_[number(column, row)];
                const bool inside = column != 0 && column != columns_ && row != 0 && row != rows_ && !onFold(p);
                first_copies_[number(column, row)] = static_cast<std::uint32_t>(mesh_.positions.size());
                addVertex(p, p.s < surface_.fold || onFold(p) ? -1 : 1, inside);
                if (onFold(p)) addVertex(p, 1, inside);
            }
        }
    }

    void addVertex(const Point& p, int side, bool inside) {
        const ExactFrame frame = exactFrame(surface_, p.s, p.t, side);
        mesh_.positions.push_back(toFloat(frame.position));
        mesh_.normals.push_back(toFloat(frame.normal));
        mesh_.uvs.push_back({static_cast<float>(frame.u), static_cast<float>(frame.v)});
        mesh_.frames.push_back(frame);
        mesh_.s.push_back(p.s);
        mesh_.t.push_back(p.t);
        mesh_.sides.push_back(static_cast<std::int8_t>(side));
        mesh_.is_inside.push_back(inside ? 1 : 0);
    }

    void addCell(int column, int row) {
        const std::size_t corner[4] = {number(column, row), number(column + 1, row), number(column + 1, row + 1),
                                       number(column, row + 1)};
        const int first = firstOfDiagonal(corner, column, row);
        addTriangle(corner[first], corner[first + 1], corner[first + 2]);
        addTriangle(corner[first], corner[first + 2], corner[(first + 3) % 4]);
    }

    /// Returns the first corner of the cell's diagonal: 0 if it connects corners 0 and 2, 1 if it connects corners 1
    /// and 3.
    int firstOfDiagonal(const std::size_t (&corner)[4], int column, int row) {
        const Point &a = points_[corner[0]], &b = points_[corner[1]], &c = points_[corner[2]], &d = points_[corner[3]];
        const bool chance = random_.coin();
        switch (kind_) {
            case Tessellation::regular:
            case Tessellation::loops: return 0;
            case Tessellation::alternating: return (column + row) % 2;
            default: break;
        }
        // If a cell has a reflex corner, only one diagonal is inside.
        if (turn(a, b, c) <= 0 || turn(a, c, d) <= 0) return 1;
        if (turn(b, c, d) <= 0 || turn(b, d, a) <= 0) return 0;
        if (kind_ == Tessellation::random) return chance ? 1 : 0;
        return inCircle(scaled(a), scaled(b), scaled(c), scaled(d)) ? 1 : 0;
    }

    /// Returns a point in units of cells.
    [[nodiscard]] Point scaled(const Point& p) const { return {p.s * columns_, p.t * rows_}; }

    void addTriangle(std::size_t a, std::size_t b, std::size_t c) {
        const double middle = (points_[a].s + points_[b].s + points_[c].s) / 3;
        for (const std::size_t point : {a, b, c}) {
            const bool second = onFold(points_[point]) && middle > surface_.fold;
            mesh_.indices.push_back(first_copies_[point] + (second ? 1 : 0));
        }
    }

    const Surface& surface_;
    Tessellation kind_;
    Random random_;
    int columns_, rows_ = 0;
    std::vector<Point> points_;
    std::vector<std::uint32_t> first_copies_;
    TestMesh mesh_;
};

}  // namespace

const char* nameOf(Tessellation tessellation) {
    switch (tessellation) {
        case Tessellation::regular: return "regular";
        case Tessellation::alternating: return "alternating";
        case Tessellation::irregular: return "irregular";
        case Tessellation::random: return "random";
        case Tessellation::anisotropic: return "anisotropic";
        case Tessellation::loops: return "loops";
    }
    return "";
}

TestMesh tessellate(const Surface& surface, Tessellation tessellation, int cells, Random random) {
    return Grid(surface, tessellation, cells, random).mesh();
}

}  // namespace tspace::accuracy
