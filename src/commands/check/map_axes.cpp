// SPDX-License-Identifier: MIT
#include "commands/check/map_axes.h"

#include <algorithm>
#include <cmath>

#include "core/base/vec_math.h"

namespace tspace {

double bestAgreement(const Moments& moments) {
    // The eigenvalues of the symmetric matrix S = M^T M, by the roots of its characteristic polynomial (Smith 1961).
    std::array<std::array<double, 3>, 3> s{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (const auto& row : moments.sum) s[i][k] += row[i] * row[k] / moments.weight / moments.weight;
        }
    }
    const double mean = (s[0][0] + s[1][1] + s[2][2]) / 3;
    for (std::size_t i = 0; i < 3; ++i) s[i][i] -= mean;
    double squares = 0;
    for (const auto& row : s) squares += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
    const double p = std::sqrt(squares / 6);
    const double det = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) -
                       s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                       s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
    const double angle = p > 0 ? std::acos(std::clamp(det / (2 * p * p * p), -1.0, 1.0)) / 3 : 0;
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += std::sqrt(std::max(0.0, mean + 2 * p * std::cos(angle + k * 2 * kPi / 3)));
    return sum;
}

Axes bestAxes(const Moments& moments) {
    constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    Axes best;
    for (const auto& order : kOrders) {
        double agreement = 0;
        std::array<MapComponent, 3> components;
        for (std::size_t i = 0; i < 3; ++i) {
            const double part = moments.sum[i][order[i]];
            agreement += std::fabs(part) / moments.weight;
            components[i] = {static_cast<MapChannel>(order[i]), part < 0};
        }
        if (agreement > best.agreement + 1e-9)
            best = {{.x = components[0], .y = components[1], .z = components[2]}, agreement};
    }
    return best;
}

}  // namespace tspace
