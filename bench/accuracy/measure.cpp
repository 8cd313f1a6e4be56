// SPDX-License-Identifier: MIT
#include "measure.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace tspace::accuracy {

namespace {

DVec3 pointAt(const TestMesh& mesh, std::uint32_t triangle, std::size_t k) {
    return toDouble(mesh.positions[mesh.indices[3 * std::size_t{triangle} + k]]);
}

/// Calls visit(corner) for the selected corners.
template <class Visit>
void forCorners(const TestMesh& mesh, Corners corners, Visit visit) {
    if (corners == Corners::measured) {
        for (const std::uint32_t triangle : mesh.measured) {
            for (std::size_t k = 0; k < 3; ++k) visit(3 * std::size_t{triangle} + k);
        }
        return;
    }
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const bool is_inside = mesh.is_inside[mesh.indices[c]] != 0;
        if (corners == Corners::all || is_inside == (corners == Corners::inside)) visit(c);
    }
}

template <class ErrorOf>
Spread spreadOver(const TestMesh& mesh, Corners corners, ErrorOf errorOf) {
    std::vector<double> errors;
    errors.reserve(mesh.indices.size());
    forCorners(mesh, corners, [&](std::size_t c) { errors.push_back(errorOf(c, mesh.indices[c])); });
    return spreadOf(std::move(errors));
}

/// Returns a tangent-space normal that varies over the texture and is tilted by up to 30 degrees.
DVec3 texelAt(double u, double v) {
    constexpr double kTurn = 6.283185307179586;
    const double x = 0.38 * std::sin(kTurn * (3 * u + 0.5 * v) + 0.7), y = 0.38 * std::cos(kTurn * (2 * v - 0.6 * u));
    return unit({x, y, 1});
}

DVec3 mix(const double (&weights)[3], const DVec3& a, const DVec3& b, const DVec3& c) {
    return weights[0] * a + weights[1] * b + weights[2] * c;
}

DVec3 tangentOf(const Frames& frames, std::size_t corner) { return toDouble(xyz(frames.tangents[corner])); }

}  // namespace

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    Spread spread;
    spread.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 95 / 100);
    std::nth_element(values.begin(), place, values.end());
    spread.p95 = *place;
    spread.max = *std::max_element(place, values.end());
    return spread;
}

Spread tangentErrors(const TestMesh& mesh, const Frames& frames, Corners corners) {
    return spreadOver(mesh, corners, [&](std::size_t c, std::uint32_t v) {
        return angleDeg(tangentOf(frames, c), mesh.frames[v].tangentAcross(toDouble(mesh.normals[v])));
    });
}

Spread bitangentErrors(const TestMesh& mesh, const Frames& frames, Corners corners) {
    return spreadOver(mesh, corners, [&](std::size_t c, std::uint32_t v) {
        return angleDeg(toDouble(frames.bitangents[c]), mesh.frames[v].bitangent);
    });
}

Spread crossErrors(const TestMesh& mesh, const Frames& frames, Corners corners) {
    return spreadOver(mesh, corners, [&](std::size_t c, std::uint32_t v) {
        const DVec3 b = cross(toDouble(mesh.normals[v]), tangentOf(frames, c));
        return angleDeg(double{frames.tangents[c].w} * b, mesh.frames[v].bitangent);
    });
}

double foldGap(const TestMesh& mesh, const Frames& frames) {
    std::map<std::pair<double, double>, std::size_t> other_side;
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const std::uint32_t v = mesh.indices[c];
        if (mesh.surface != nullptr && mesh.sides[v] < 0) other_side[{mesh.s[v], mesh.t[v]}] = c;
    }
    double sum = 0;
    std::size_t count = 0;
    std::vector<std::uint8_t> done(mesh.positions.size());
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const std::uint32_t v = mesh.indices[c];
        if (mesh.surface == nullptr || mesh.sides[v] < 0 || std::exchange(done[v], std::uint8_t{1}) != 0) continue;
        const auto other = other_side.find({mesh.s[v], mesh.t[v]});
        if (other == other_side.end()) continue;
        sum += angleDeg(tangentOf(frames, c), -1.0 * tangentOf(frames, other->second));
        ++count;
    }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

Spread normalErrors(const TestMesh& mesh, const std::vector<Vec3>& normals, Corners corners) {
    return spreadOver(mesh, corners, [&](std::size_t c, std::uint32_t v) {
        return angleDeg(toDouble(normals[c]), mesh.frames[v].normal);
    });
}

Shading::Shading(const TestMesh& mesh, int count, Random random) : mesh_(mesh) {
    std::vector<double> sums;
    double sum = 0;
    for (const std::uint32_t triangle : mesh.measured) {
        const DVec3 o = pointAt(mesh, triangle, 0);
        sum += length(cross(pointAt(mesh, triangle, 1) - o, pointAt(mesh, triangle, 2) - o));
        sums.push_back(sum);
    }
    for (int i = 0; i < count; ++i) {
        const double wanted = sum * (i + random.unit()) / count;
        auto place = std::upper_bound(sums.begin(), sums.end(), wanted);
        if (place == sums.end()) --place;
        addSample(mesh.measured[static_cast<std::size_t>(place - sums.begin())], random);
    }
}

void Shading::addSample(std::uint32_t triangle, Random& random) {
    Sample sample{triangle, {}, {}, {}, {}};
    const double root = std::sqrt(random.unit()), along = random.unit();
    sample.weights[0] = 1 - root;
    sample.weights[1] = root * (1 - along);
    sample.weights[2] = root * along;
    double u = 0, v = 0, s = 0, t = 0;
    const std::uint32_t* vertices = mesh_.indices.data() + 3 * std::size_t{triangle};
    for (std::size_t k = 0; k < 3; ++k) {
        u += sample.weights[k] * double{mesh_.uvs[vertices[k]].x};
        v += sample.weights[k] * double{mesh_.uvs[vertices[k]].y};
        s += sample.weights[k] * mesh_.s[vertices[k]];
        t += sample.weights[k] * mesh_.t[vertices[k]];
    }
    sample.texel = texelAt(u, v);
    ExactFrame frame = mesh_.frames[vertices[0]];
    if (mesh_.surface != nullptr) {
        const int side = mesh_.sides[vertices[0]];
        findUv(*mesh_.surface, u, v, side, s, t);
        frame = exactFrame(*mesh_.surface, s, t, side);
    } else {
        frame.normal = {0, 0, 1};
    }
    const DVec3 tangent = frame.tangentAcross(frame.normal);
    sample.exact = sample.texel.x * tangent + (sample.texel.y * frame.sign) * cross(frame.normal, tangent) +
                   sample.texel.z * frame.normal;
    sample.normal = frame.normal;
    samples_.push_back(sample);
}

DVec3 Shading::normalAt(const Sample& sample, const std::vector<Vec3>& normals) const {
    const std::uint32_t* v = mesh_.indices.data() + 3 * std::size_t{sample.triangle};
    return mix(sample.weights, toDouble(normals[v[0]]), toDouble(normals[v[1]]), toDouble(normals[v[2]]));
}

DVec3 Shading::shade(const Sample& sample, const Frames& frames, const std::vector<Vec3>& normals) const {
    const std::size_t c = 3 * std::size_t{sample.triangle};
    const DVec3 n = normalAt(sample, normals);
    const DVec3 t = mix(sample.weights, tangentOf(frames, c), tangentOf(frames, c + 1), tangentOf(frames, c + 2));
    const double sign = frames.tangents[c].w;
    return sample.texel.x * t + (sample.texel.y * sign) * cross(n, t) + sample.texel.z * n;
}

double Shading::meanError(const Frames& frames, const std::vector<Vec3>& normals) const {
    double sum = 0;
    for (const Sample& sample : samples_) sum += angleDeg(shade(sample, frames, normals), sample.exact);
    return sum / static_cast<double>(samples_.size());
}

double Shading::meanNormalError(const std::vector<Vec3>& normals) const {
    double sum = 0;
    for (const Sample& sample : samples_) sum += angleDeg(normalAt(sample, normals), sample.normal);
    return sum / static_cast<double>(samples_.size());
}

double Shading::meanDifference(const Frames& frames, const Frames& baked) const {
    double sum = 0;
    for (const Sample& sample : samples_) {
        sum += angleDeg(shade(sample, frames, mesh_.normals), shade(sample, baked, mesh_.normals));
    }
    return sum / static_cast<double>(samples_.size());
}

}  // namespace tspace::accuracy
