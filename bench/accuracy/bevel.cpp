// SPDX-License-Identifier: MIT
// A square face with rounded borders: large flat triangles next to thin ones. On the rounded borders the texture may
// have another direction. If the UV map is sheared by 45 degrees, the patches at the face's corners have no UV area; if
// it is sheared by 72 degrees, they are mirrored.
#include "test_mesh.h"

namespace tspace::accuracy {

namespace {

// half of a right angle: the other half of each rounded edge belongs to the adjacent face
constexpr double kQuarter = 0.78539816339744831;

class BevelGrid {
  public:
    BevelGrid(const Bevel& bevel, Random random) : bevel_(bevel), random_(random) {
        for (int i = bevel.strips; i > 0; --i) lines_.push_back({-1, -kQuarter * i / bevel.strips});
        for (int i = 0; i <= bevel.flat_cells; ++i) lines_.push_back({2.0 * i / bevel.flat_cells - 1, 0});
        for (int i = 1; i <= bevel.strips; ++i) lines_.push_back({1, kQuarter * i / bevel.strips});
    }

    TestMesh mesh() {
        const int count = static_cast<int>(lines_.size());
        for (int row = 0; row < count; ++row) {
            for (int column = 0; column < count; ++column) addVertex(line(column), line(row));
        }
        for (int row = 0; row + 1 < count; ++row) {
            for (int column = 0; column + 1 < count; ++column) addCell(column, row);
        }
        return std::move(mesh_);
    }

  private:
    struct Line {
        double flat = 0;   ///< coordinate on the flat part
        double angle = 0;  ///< angle of the normal at this line
    };

    [[nodiscard]] const Line& line(int i) const { return lines_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] bool isFlat(int cell) const { return line(cell).angle == 0 && line(cell + 1).angle == 0; }

    void addVertex(const Line& x, const Line& y) {
        const double r = bevel_.radius;
        const DVec3 normal = unit({std::tan(x.angle), std::tan(y.angle), 1});
        const double shear = std::tan(bevel_.shear_deg * kQuarter / 45);
        const double past_x = r * x.angle, past_y = r * y.angle;  // arc length beyond the flat part
        ExactFrame frame;
        frame.position = DVec3{x.flat, y.flat, -r} + r * normal;
        frame.normal = normal;
        frame.tangent = {1, 0, 0};  // exact only on the flat part; errors on the rounded part are not measured
        frame.bitangent = {0, 1, 0};
        frame.u = x.flat + bevel_.stretch * past_x + shear * past_y;
        frame.v = y.flat + bevel_.stretch * past_y + shear * past_x;
        mesh_.positions.push_back(toFloat(frame.position));
        mesh_.normals.push_back(toFloat(frame.normal));
        mesh_.uvs.push_back({static_cast<float>(frame.u), static_cast<float>(frame.v)});
        mesh_.frames.push_back(frame);
        mesh_.s.push_back(x.flat);
        mesh_.t.push_back(y.flat);
        mesh_.sides.push_back(1);
        mesh_.is_inside.push_back(1);
    }

    void addCell(int column, int row) {
        const auto count = static_cast<std::uint32_t>(lines_.size());
        const auto first = static_cast<std::uint32_t>(row) * count + static_cast<std::uint32_t>(column);
        const std::uint32_t corner[4] = {first, first + 1, first + count + 1, first + count};
        const bool chance = random_.coin();
        const std::size_t turned = bevel_.diagonal == 2 ? (chance ? 1 : 0) : static_cast<std::size_t>(bevel_.diagonal);
        for (const std::size_t step : {std::size_t{1}, std::size_t{2}}) {
            if (isFlat(column) && isFlat(row)) {
                mesh_.measured.push_back(static_cast<std::uint32_t>(mesh_.indices.size() / 3));
            }
            for (const std::size_t k : {std::size_t{0}, step, step + 1}) {
                mesh_.indices.push_back(corner[(turned + k) % 4]);
            }
        }
    }

    const Bevel& bevel_;
    Random random_;
    std::vector<Line> lines_;
    TestMesh mesh_;
};

}  // namespace

std::vector<Bevel> bevels() {
    std::vector<Bevel> all;
    for (const double radius : {0.02, 0.05, 0.15}) {
        for (const int strips : {1, 2}) {
            for (const int flat_cells : {1, 4}) {
                for (const int diagonal : {0, 1, 2}) {
                    for (const double stretch : {1.0, 4.0, 0.25}) {
                        all.push_back({radius, strips, flat_cells, diagonal, stretch, 0});
                    }
                    for (const double shear : {45.0, 72.0}) {
                        all.push_back({radius, strips, flat_cells, diagonal, 1, shear});
                    }
                }
            }
        }
    }
    return all;
}

TestMesh bevelMesh(const Bevel& bevel, Random random) { return BevelGrid(bevel, random).mesh(); }

}  // namespace tspace::accuracy
