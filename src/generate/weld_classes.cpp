// SPDX-License-Identifier: MIT
#include "generate/weld_classes.h"

#include <array>

#include "asset/unique_index.h"

namespace tspace {

namespace {

/// By bits, so that a NaN is itself; both zeros are one value.
bool areOne(const Vec3& a, const Vec3& b) {
    return weldBits(a.x) == weldBits(b.x) && weldBits(a.y) == weldBits(b.y) && weldBits(a.z) == weldBits(b.z);
}

}  // namespace

WeldClasses::WeldClasses(const LocalMesh& mesh) {
    UniqueIndex<std::array<std::uint32_t, 8>> keys(mesh.positions.count);
    class_of_.reserve(mesh.positions.count);
    for (std::size_t v = 0; v < mesh.positions.count; ++v) {
        const Vec3 &p = mesh.positions[v], &n = mesh.normals[v];
        const Vec2 uv = mesh.uvs.empty() ? Vec2{} : mesh.uvs[v];
        class_of_.push_back(keys.indexOf({weldBits(p.x), weldBits(p.y), weldBits(p.z), weldBits(n.x), weldBits(n.y),
                                          weldBits(n.z), weldBits(uv.x), weldBits(uv.y)}));
    }
    count_ = keys.size();
}

bool WeldClasses::findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                            std::span<const Vec3> normals, std::vector<bool>& apart) const {
    apart.assign(count_, false);
    if (count_ == class_of_.size()) return false;
    constexpr std::uint32_t kNoVertex = 0xffffffffu;
    std::vector<std::uint32_t> first(count_, kNoVertex);
    bool any = false;
    for (const std::uint32_t v : corners) {
        std::uint32_t& other = first[class_of_[v]];
        if (other == kNoVertex) other = v;
        if (areOne(positions[v], positions[other]) && areOne(normals[v], normals[other])) continue;
        apart[class_of_[v]] = any = true;
    }
    return any;
}

}  // namespace tspace
