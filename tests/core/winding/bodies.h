// SPDX-License-Identifier: MIT
// Bodies with counter-clockwise winding seen from outside, and functions that damage the winding.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "support/simple_mesh.h"

namespace tspace::test {

/// Triangles, and the number of the body to which each of them belongs.
struct Bodies {
    SimpleMesh mesh = {};
    std::vector<std::uint32_t> body_of = {};
    std::uint32_t body_count = 0;

    [[nodiscard]] std::size_t faceCount() const { return mesh.indices.size() / 3; }
    [[nodiscard]] MeshView view() const { return mesh.view(); }
    void closeBody() {
        body_of.resize(faceCount(), body_count);
        ++body_count;
    }
    void turn(std::size_t face) { std::swap(mesh.indices[3 * face + 1], mesh.indices[3 * face + 2]); }
    [[nodiscard]] double areaOf(std::size_t face) const {
        const Vec3 &a = mesh.positions[mesh.indices[3 * face]], &b = mesh.positions[mesh.indices[3 * face + 1]],
                   &c = mesh.positions[mesh.indices[3 * face + 2]];
        const double ux = double{b.x} - a.x, uy = double{b.y} - a.y, uz = double{b.z} - a.z;
        const double vx = double{c.x} - a.x, vy = double{c.y} - a.y, vz = double{c.z} - a.z;
        return std::sqrt(std::pow(uy * vz - uz * vy, 2) + std::pow(uz * vx - ux * vz, 2) +
                         std::pow(ux * vy - uy * vx, 2));
    }
};

/// Adds a sheet over [0, 1]^2 with u_cells x v_cells cells. If opposite sides have equal positions, the sheet is closed
/// there, but the two sides have separate vertices, so that the seam is open by indices. `keeps`: selects the cells to
/// create.
inline void addSheet(
    Bodies& to, std::uint32_t u_cells, std::uint32_t v_cells, const std::function<Vec3(double, double)>& at,
    const std::function<bool(std::uint32_t, std::uint32_t)>& keeps = [](std::uint32_t, std::uint32_t) {
        return true;
    }) {
    const auto first = static_cast<std::uint32_t>(to.mesh.positions.size());
    for (std::uint32_t j = 0; j <= v_cells; ++j) {
        for (std::uint32_t i = 0; i <= u_cells; ++i)
            to.mesh.positions.push_back(at(double{1} * i / u_cells, double{1} * j / v_cells));
    }
    for (std::uint32_t j = 0; j < v_cells; ++j) {
        for (std::uint32_t i = 0; i < u_cells; ++i) {
            if (!keeps(i, j)) continue;
            const std::uint32_t a = first + j * (u_cells + 1) + i, b = a + u_cells + 1;
            to.mesh.addTriangle(a, a + 1, b + 1);
            to.mesh.addTriangle(a, b + 1, b);
        }
    }
    to.closeBody();
}

/// Return the sine and cosine of a fraction of a turn. The results for 0 and 1 have the same bits.
inline double sineOfTurn(double turn) { return std::sin(6.283185307179586 * (turn == 1 ? 0 : turn)); }
inline double cosineOfTurn(double turn) { return std::cos(6.283185307179586 * (turn == 1 ? 0 : turn)); }
inline Vec3 vec3(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

inline void addTorus(Bodies& to, Vec3 center, double large, double small, std::uint32_t cells = 24) {
    addSheet(to, 2 * cells, cells, [=](double u, double v) {
        const double r = large + small * cosineOfTurn(v);
        return vec3(center.x + r * cosineOfTurn(u), center.y + r * sineOfTurn(u), center.z + small * sineOfTurn(v));
    });
}
/// Adds a sphere from the south pole to the fraction `top` of the way to the north pole. The triangles at the poles
/// have no area.
inline void addSphere(
    Bodies& to, Vec3 center, double radius, double top = 1, std::uint32_t cells = 24,
    const std::function<bool(std::uint32_t, std::uint32_t)>& keeps = [](std::uint32_t, std::uint32_t) {
        return true;
    }) {
    addSheet(
        to, cells, cells,
        [=](double u, double v) {
            const double up = v * top, out = up == 1 || up == 0 ? 0 : radius * sineOfTurn(up / 2);
            return vec3(center.x + out * cosineOfTurn(u), center.y + out * sineOfTurn(u),
                        center.z - radius * cosineOfTurn(up / 2));
        },
        keeps);
}
inline void addBox(Bodies& to, Vec3 least, Vec3 most) {
    const auto first = static_cast<std::uint32_t>(to.mesh.positions.size());
    for (unsigned i = 0; i < 8; ++i) {
        to.mesh.positions.push_back(
            {(i & 1) != 0 ? most.x : least.x, (i & 2) != 0 ? most.y : least.y, (i & 4) != 0 ? most.z : least.z});
    }
    for (const auto& face : kCubeFaces) {
        to.mesh.addTriangle(first + face[0], first + face[1], first + face[2]);
        to.mesh.addTriangle(first + face[0], first + face[2], first + face[3]);
    }
    to.closeBody();
}
/// Merges vertices that have equal positions.
inline void shareVertices(Bodies& bodies) {
    std::vector<Vec3> positions;
    for (std::uint32_t& index : bodies.mesh.indices) {
        const Vec3 p = bodies.mesh.positions[index];
        std::size_t i = 0;
        while (i < positions.size() && positions[i] != p) ++i;
        if (i == positions.size()) positions.push_back(p);
        index = static_cast<std::uint32_t>(i);
    }
    bodies.mesh.positions = positions;
}
/// Gives each corner a vertex of its own.
inline void separateVertices(Bodies& bodies) {
    std::vector<Vec3> positions;
    for (std::uint32_t& index : bodies.mesh.indices) {
        positions.push_back(bodies.mesh.positions[index]);
        index = static_cast<std::uint32_t>(positions.size() - 1);
    }
    bodies.mesh.positions = positions;
}

/// Returns a Moebius band, which has only one side.
inline Bodies moebiusBand(std::uint32_t cells) {
    Bodies band;
    for (std::uint32_t i = 0; i < cells; ++i) {
        const double turn = double{1} * i / cells, lean = turn / 2;
        for (const double side : {-0.3, 0.3}) {
            const double r = 1 + side * cosineOfTurn(lean);
            band.mesh.positions.push_back(vec3(r * cosineOfTurn(turn), r * sineOfTurn(turn), side * sineOfTurn(lean)));
        }
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1;
        const bool is_last = i + 1 == cells;
        const std::uint32_t c = is_last ? 1 : a + 2, d = is_last ? 0 : a + 3;
        band.mesh.addTriangle(a, c, d);
        band.mesh.addTriangle(a, d, b);
    }
    band.closeBody();
    return band;
}

/// Returns the bodies with each face flipped with probability `share`.
inline Bodies turnedByChance(Bodies bodies, double share, unsigned seed) {
    std::mt19937 random(seed);
    for (std::size_t f = 0; f < bodies.faceCount(); ++f) {
        if (random() < share * 4294967296.0) bodies.turn(f);
    }
    return bodies;
}
/// Returns the bodies with faces in random balls flipped, until the given share of all faces is flipped.
inline Bodies turnedInPatches(Bodies bodies, double share, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<bool> turned(bodies.faceCount());
    const auto at = [&](std::size_t f) { return bodies.mesh.positions[bodies.mesh.indices[3 * f]]; };
    for (std::size_t count = 0; count < static_cast<std::size_t>(share * static_cast<double>(turned.size()));) {
        const Vec3 middle = at(random() % turned.size());
        for (std::size_t f = 0; f < turned.size(); ++f) {
            const Vec3 p = at(f);
            const float x = p.x - middle.x, y = p.y - middle.y, z = p.z - middle.z;
            if (turned[f] || x * x + y * y + z * z > 0.04f) continue;
            turned[f] = true;
            ++count;
        }
    }
    for (std::size_t f = 0; f < turned.size(); ++f) {
        if (turned[f]) bodies.turn(f);
    }
    return bodies;
}
/// Returns the bodies with every second body flipped, or all of them.
inline Bodies turnedWhole(Bodies bodies, bool all) {
    for (std::size_t f = 0; f < bodies.faceCount(); ++f) {
        if (all || bodies.body_of[f] % 2 == 0) bodies.turn(f);
    }
    return bodies;
}

}  // namespace tspace::test
