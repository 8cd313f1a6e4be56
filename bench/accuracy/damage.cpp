// SPDX-License-Identifier: MIT
#include "damage.h"

#include "methods.h"

namespace tspace::accuracy {

namespace {

// With this factor the results of MikkTSpace equal those of the study from which the targets were taken.
constexpr double kUvNoise = 0.915;

/// Returns a normally distributed number with mean 0 and standard deviation 1.
double normalDeviate(Random& random) {
    const double size = std::sqrt(-2 * std::log(1 - random.unit()));
    return size * std::cos(6.283185307179586 * random.unit());
}

DVec3 uvOf(const TestMesh& mesh, std::uint32_t v) { return {mesh.uvs[v].x, mesh.uvs[v].y, 0}; }

template <class At>
std::vector<double> meanEdges(const TestMesh& mesh, At at) {
    std::vector<double> sums(mesh.positions.size()), counts(mesh.positions.size());
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const std::uint32_t a = mesh.indices[c], b = mesh.indices[c % 3 == 2 ? c - 2 : c + 1];
        const double edge = length(at(a) - at(b));
        for (const std::uint32_t v : {a, b}) {
            sums[v] += edge;
            counts[v] += 1;
        }
    }
    for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= counts[v] > 0 ? counts[v] : 1;
    return sums;
}

/// Returns whether a vertex is the second copy of a vertex on the mirrored seam. The two copies are consecutive, and
/// must move together.
bool isSecondCopy(const TestMesh& mesh, std::size_t v) {
    return v > 0 && mesh.s[v] == mesh.s[v - 1] && mesh.t[v] == mesh.t[v - 1];
}

void moveVertices(TestMesh& mesh, bool uvs, double share, Random& random) {
    const std::vector<double> edges =
        uvs ? meanEdges(mesh, [&](std::uint32_t v) { return uvOf(mesh, v); })
            : meanEdges(mesh, [&](std::uint32_t v) { return toDouble(mesh.positions[v]); });
    for (std::size_t v = 0; v < edges.size(); ++v) {
        const double size = (uvs ? kUvNoise : 1) * share * edges[v];
        const double x = size * normalDeviate(random), y = size * normalDeviate(random);
        if (isSecondCopy(mesh, v)) {
            (uvs ? void(mesh.uvs[v] = mesh.uvs[v - 1]) : void(mesh.positions[v] = mesh.positions[v - 1]));
        } else if (uvs) {
            mesh.uvs[v].x += static_cast<float>(x);
            mesh.uvs[v].y += static_cast<float>(y);
        } else {
            const double z = size * normalDeviate(random);
            mesh.positions[v] = toFloat(toDouble(mesh.positions[v]) + DVec3{x, y, z});
        }
    }
}

void weldUvs(TestMesh& mesh, double share, Random& random) {
    for (std::size_t i = 0; i < mesh.triangleCount(); ++i) {
        if (random.unit() >= share) continue;
        const std::size_t k = random.below(3);
        mesh.uvs[mesh.indices[3 * i + k]] = mesh.uvs[mesh.indices[3 * i + (k + 1) % 3]];
    }
}

void estimateNormals(TestMesh& mesh) {
    const std::vector<Vec3> normals = normalsBy(NormalWeighting::angleArea, mesh);
    for (std::size_t c = 0; c < normals.size(); ++c) mesh.normals[mesh.indices[c]] = normals[c];
}

}  // namespace

const char* nameOf(Damage damage) {
    switch (damage) {
        case Damage::none: return "none";
        case Damage::position_noise: return "position-noise";
        case Damage::uv_noise: return "uv-noise";
        case Damage::welded_uvs: return "welded-uvs";
    }
    return "";
}

void damage(TestMesh& mesh, Damage kind, double share, Random random) {
    switch (kind) {
        case Damage::none: return;
        case Damage::position_noise: moveVertices(mesh, false, share, random); break;
        case Damage::uv_noise: moveVertices(mesh, true, share, random); break;
        case Damage::welded_uvs: weldUvs(mesh, share, random); break;
    }
    estimateNormals(mesh);
}

}  // namespace tspace::accuracy
