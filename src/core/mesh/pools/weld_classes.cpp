// SPDX-License-Identifier: MIT
#include "core/mesh/pools/weld_classes.h"

#include "core/base/unique_index.h"

namespace tspace {

namespace {

/// By bits, so that a NaN is itself; both zeros are one value.
bool areOne(const Vec3& a, const Vec3& b) {
    return weldBits(a.x) == weldBits(b.x) && weldBits(a.y) == weldBits(b.y) && weldBits(a.z) == weldBits(b.z);
}

}  // namespace

bool WeldClasses::findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                            std::span<const Vec3> normals, std::vector<bool>& apart) const {
    apart.assign(classes_.class_count, false);
    if (classes_.class_count == classes_.class_of.size()) return false;
    constexpr std::uint32_t kNoVertex = 0xffffffffu;
    std::vector<std::uint32_t> first(classes_.class_count, kNoVertex);
    bool any = false;
    for (const std::uint32_t v : corners) {
        std::uint32_t& other = first[of(v)];
        if (other == kNoVertex) other = v;
        if (areOne(positions[v], positions[other]) && areOne(normals[v], normals[other])) continue;
        apart[of(v)] = any = true;
    }
    return any;
}

void WeldClasses::spread(const LocalMesh& mesh, unsigned rounds, std::vector<bool>& apart) const {
    const auto classAt = [&](std::size_t c) {
        return of(mesh.indices[mesh.face_corners.empty() ? c : mesh.face_corners[c]]);
    };
    for (; rounds != 0; --rounds) {
        const std::vector<bool> before = apart;
        for (std::size_t c = 0; c < mesh.triangleCornerCount(); c += 3) {
            const std::uint32_t a = classAt(c), b = classAt(c + 1), d = classAt(c + 2);
            if (before[a] || before[b] || before[d]) apart[a] = apart[b] = apart[d] = true;
        }
    }
}

}  // namespace tspace
