// SPDX-License-Identifier: MIT
// A large mesh as OBJ text.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

namespace tspace::test {

/// Returns a square of side * side quads with UVs and with hills of this height. `use`: lines before the faces.
inline std::string gridObj(int side, double height, const std::string& use = {}) {
    std::ostringstream text;
    for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) {
            const double u = 1.0 * x / side, v = 1.0 * y / side;
            text << "v " << u << ' ' << v << ' ' << height * std::sin(40 * u) * std::cos(30 * v) << "\nvt " << u << ' '
                 << v << '\n';
        }
    }
    text << use;
    for (int y = 0; y < side; ++y) {
        for (int x = 1; x <= side; ++x) {
            text << 'f';
            const int corner = y * (side + 1) + x;
            for (const int at : {corner, corner + 1, corner + side + 2, corner + side + 1})
                text << ' ' << at << '/' << at;
            text << '\n';
        }
    }
    return text.str();
}

}  // namespace tspace::test
