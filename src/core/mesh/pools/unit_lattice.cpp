// SPDX-License-Identifier: MIT
// Rounds unit vectors to a lattice, by selecting among the eight corners of a lattice cell.
#include "core/mesh/pools/unit_lattice.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/numbers.h"
#include "core/base/vec_math.h"

namespace tspace {
namespace {

constexpr double kLengthTolerance = 0.006;

std::int32_t clampedRound(double value, std::int32_t steps) {
    if (!(value == value)) return 0;
    return static_cast<std::int32_t>(std::lround(std::clamp(value, -1.0, 1.0) * steps));
}

/// Returns corner number `corner` of the cell: each of its three bits selects the lower or the upper bound of a
/// component.
LatticePoint cornerOf(const Vec3& vector, std::int32_t steps, unsigned corner) {
    const auto component = [&](float value, unsigned bit) {
        const double at = static_cast<double>(value) * steps;
        // A value within rounding distance of a lattice point has that point as both bounds.
        const double nearest = std::round(at);
        const double bound = std::abs(at - nearest) < 1e-3 ? nearest
                             : (corner & bit) != 0         ? std::ceil(at)
                                                           : std::floor(at);
        return static_cast<std::int32_t>(std::clamp(bound, -1.0 * steps, 1.0 * steps));
    };
    return {component(vector.x, 1), component(vector.y, 2), component(vector.z, 4)};
}

float valueOf(std::int32_t number, std::int32_t steps) {
    return std::max(static_cast<float>(number) / static_cast<float>(steps), -1.0f);
}

template <class Component>
std::vector<std::uint8_t> packAs(const std::vector<std::int32_t>& numbers) {
    std::vector<Component> values(numbers.begin(), numbers.end());
    std::vector<std::uint8_t> bytes(values.size() * sizeof(Component));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    convertLittleEndian(bytes, sizeof(Component));
    return bytes;
}

template <class Vec, class Append>
std::vector<std::uint8_t> pack(std::span<const Vec> vectors, VectorFormat format, Append append) {
    if (format == VectorFormat::float32) {
        std::vector<std::uint8_t> bytes(vectors.size_bytes());
        if (!bytes.empty()) std::memcpy(bytes.data(), vectors.data(), bytes.size());
        convertLittleEndian(bytes, sizeof(float));
        return bytes;
    }
    std::vector<std::int32_t> numbers;
    numbers.reserve(vectors.size() * (sizeof(Vec) / sizeof(float)));
    for (const Vec& vector : vectors) append(vector, numbers);
    return format == VectorFormat::snorm8 ? packAs<std::int8_t>(numbers) : packAs<std::int16_t>(numbers);
}

}  // namespace

std::int32_t latticeSteps(VectorFormat format) {
    return format == VectorFormat::snorm8 ? 127 : format == VectorFormat::snorm16 ? 32767 : 0;
}

LatticePoint nearestUnit(const Vec3& vector, std::int32_t steps) {
    const double length =
        std::sqrt(double{vector.x} * vector.x + double{vector.y} * vector.y + double{vector.z} * vector.z);
    if (!(std::abs(length - 1) < 0.1))
        return {clampedRound(vector.x, steps), clampedRound(vector.y, steps), clampedRound(vector.z, steps)};
    LatticePoint best;
    double best_cosine = 0, best_error = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const LatticePoint point = cornerOf(vector, steps, corner);
        const double reach =
            std::sqrt(double(point.x) * point.x + double(point.y) * point.y + double(point.z) * point.z);
        if (reach == 0) continue;
        const double cosine =
            (point.x * double{vector.x} + point.y * double{vector.y} + point.z * double{vector.z}) / reach;
        const double error = std::max(std::abs(reach / steps - 1), kLengthTolerance);
        if (best_error == 0 || error < best_error || (error == best_error && cosine > best_cosine)) {
            best = point;
            best_error = error;
            best_cosine = cosine;
        }
    }
    return best;
}

void roundUnits(std::span<Vec3> vectors, VectorFormat format) {
    const std::int32_t steps = latticeSteps(format);
    if (steps == 0) return;
    for (Vec3& vector : vectors) {
        const LatticePoint point = nearestUnit(vector, steps);
        vector = {valueOf(point.x, steps), valueOf(point.y, steps), valueOf(point.z, steps)};
    }
}

void roundUnits(std::span<Vec4> tangents, VectorFormat format) {
    const std::int32_t steps = latticeSteps(format);
    if (steps == 0) return;
    for (Vec4& tangent : tangents) {
        const LatticePoint point = nearestUnit(xyz(tangent), steps);
        tangent = {valueOf(point.x, steps), valueOf(point.y, steps), valueOf(point.z, steps),
                   tangent.w < 0 ? -1.0f : 1.0f};
    }
}

std::vector<std::uint8_t> packUnits(std::span<const Vec3> normals, VectorFormat format) {
    const std::int32_t steps = latticeSteps(format);
    return pack(normals, format, [steps](const Vec3& normal, std::vector<std::int32_t>& numbers) {
        const LatticePoint point = nearestUnit(normal, steps);
        numbers.insert(numbers.end(), {point.x, point.y, point.z});
    });
}

std::vector<std::uint8_t> packUnits(std::span<const Vec4> tangents, VectorFormat format) {
    const std::int32_t steps = latticeSteps(format);
    return pack(tangents, format, [steps](const Vec4& tangent, std::vector<std::int32_t>& numbers) {
        const LatticePoint point = nearestUnit(xyz(tangent), steps);
        numbers.insert(numbers.end(), {point.x, point.y, point.z, tangent.w < 0 ? -steps : steps});
    });
}

}  // namespace tspace
