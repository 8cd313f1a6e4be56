// SPDX-License-Identifier: MIT
#include "commands/bake/map_pictures.h"

#include <algorithm>
#include <array>

namespace tspace {

std::vector<Vec3> pictureOfOrigins(const BakedMap& map) {
    constexpr Vec3 kBackground{0, 0, 0}, kPadding{0.1F, 0.25F, 0.15F}, kHit{0.2F, 0.6F, 0.3F}, kMissed{1, 0.1F, 0.1F},
        kOverlap{1, 0.85F, 0.1F};
    std::vector<Vec3> picture;
    picture.reserve(map.origins.size());
    for (std::size_t i = 0; i < map.origins.size(); ++i) {
        switch (map.origins[i]) {
            case TexelOrigin::background:
                picture.push_back(kBackground);
                break;
            case TexelOrigin::padding:
                picture.push_back(kPadding);
                break;
            case TexelOrigin::hit:
                picture.push_back(map.overlaps[i] ? kOverlap : kHit);
                break;
            case TexelOrigin::missed:
                picture.push_back(kMissed);
                break;
        }
    }
    return picture;
}

std::vector<Vec3> pictureOfHeat(const std::vector<float>& heat, double top_deg) {
    constexpr std::array<Vec3, 5> kRamp{
        {{0, 0, 0}, {0.2F, 0.1F, 0.6F}, {0.85F, 0.15F, 0.3F}, {1, 0.75F, 0.1F}, {1, 1, 1}}};
    constexpr Vec3 kNothing{0.2F, 0.2F, 0.2F};
    std::vector<Vec3> picture;
    picture.reserve(heat.size());
    for (const float degrees : heat) {
        if (degrees < 0) {
            picture.push_back(kNothing);
            continue;
        }
        const double part = top_deg > 0 ? std::clamp(static_cast<double>(degrees) / top_deg, 0.0, 1.0) : 0;
        const double place = part * (kRamp.size() - 1);
        const std::size_t step = std::min<std::size_t>(static_cast<std::size_t>(place), kRamp.size() - 2);
        const auto rest = static_cast<float>(place - static_cast<double>(step));
        const Vec3 &a = kRamp[step], &b = kRamp[step + 1];
        picture.push_back({a.x + rest * (b.x - a.x), a.y + rest * (b.y - a.y), a.z + rest * (b.z - a.z)});
    }
    return picture;
}

}  // namespace tspace
