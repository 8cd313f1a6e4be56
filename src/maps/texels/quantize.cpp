// SPDX-License-Identifier: MIT
#include "maps/texels/quantize.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tspace {
namespace {

using Components = std::array<double, 3>;

double valueOf(double integer, unsigned most) { return 2 * integer / most - 1; }

double nearestTo(double value, unsigned most) {
    return std::clamp(std::floor((value + 1) * 0.5 * most + 0.5), 0.0, static_cast<double>(most));
}

/// Returns the squared sine of the angle between two vectors, multiplied by the squared length of `direction`. Returns
/// 4 if the angle is at least a right angle.
double distance(const DVec3& vector, const DVec3& direction) {
    const double along = dot(vector, direction), squared = dot(vector, vector);
    if (!(along > 0)) return 4;
    const DVec3 across = cross(vector, direction);
    return dot(across, across) / squared;
}

DVec3 scaled(const DVec3& v, double scale) { return {scale * v.x, scale * v.y, v.z}; }

DVec3 nearestOfTwoChannels(const IntegerVectors& numbers, const DVec3& direction) {
    const unsigned most = numbers.most;
    const DVec3 seen = scaled(direction, numbers.scale);
    DVec3 best{};
    double least = INFINITY;
    const double x = nearestTo(direction.x, most), y = nearestTo(direction.y, most);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (x + dx < 0 || y + dy < 0 || x + dx > most || y + dy > most) continue;
            DVec3 vector{valueOf(x + dx, most), valueOf(y + dy, most), 0};
            vector.z = std::sqrt(std::fmax(0.0, 1 - vector.x * vector.x - vector.y * vector.y));
            const double error = distance(scaled(vector, numbers.scale), seen);
            if (!(error < least)) continue;
            least = error;
            best = vector;
        }
    }
    best.z = valueOf(nearestTo(best.z, most), most);
    return best;
}

}  // namespace

DVec3 roundedVector(unsigned most, const DVec3& vector) {
    return {valueOf(nearestTo(vector.x, most), most), valueOf(nearestTo(vector.y, most), most),
            valueOf(nearestTo(vector.z, most), most)};
}

DVec3 nearestIntegers(const IntegerVectors& numbers, const DVec3& direction) {
    const unsigned most = numbers.most;
    if (numbers.is_two_channel) return nearestOfTwoChannels(numbers, direction);
    const Components d{direction.x, direction.y, direction.z};
    const DVec3 seen = scaled(direction, numbers.scale);
    std::size_t main = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        if (std::fabs(d[i]) > std::fabs(d[main])) main = i;
    }
    // For every integer of the largest component, tries the best integers of the other components. Among equally good
    // vectors the longest is chosen.
    const double first = d[main] < 0 ? 0 : most, toward = d[main] < 0 ? 1 : -1;
    const auto steps = static_cast<unsigned>((1 - numbers.least_length * std::fabs(d[main])) * 0.5 * most) + 1;
    DVec3 best{};
    double least = INFINITY;
    for (unsigned step = 0; step <= steps; ++step) {
        const double value = valueOf(first + toward * step, most), size = value / d[main];
        // Tries both integers around each of the other components: for long vectors the nearer integer may give a worse
        // direction.
        for (unsigned sides = 0; sides < 4; ++sides) {
            Components vector{};
            vector[main] = value;
            for (unsigned i = 1; i < 3; ++i) {
                const double below = std::floor((size * d[(main + i) % 3] + 1) * 0.5 * most);
                vector[(main + i) % 3] = valueOf(below + (sides >> (i - 1) & 1), most);
            }
            const DVec3 candidate{vector[0], vector[1], vector[2]};
            const double squared = dot(candidate, candidate);
            if (squared > 1 || squared < numbers.least_length * numbers.least_length) continue;
            const double error = distance(scaled(candidate, numbers.scale), seen);
            if (!(error < least)) continue;
            least = error;
            best = candidate;
        }
    }
    return least < INFINITY ? best : roundedVector(most, direction);
}

}  // namespace tspace
