// SPDX-License-Identifier: MIT
#include "commands/check/other_reading.h"

namespace tspace {

namespace {

/// All shares are of the surface with UV area.
constexpr double kClearlyWrong = 0.2;
/// Wrong signs without wrong directions can be explained only by the own transform, which mirrors or does not.
constexpr double kSomeSigns = 0.1;
constexpr double kExplained = 0.02;
/// Share of the surface with own UV area on which the other UVs must have area too.
constexpr double kCovered = 0.95;

struct Faults {
    double directions = 0, signs = 0;
};

double shareOf(const Tally& tally, const Surface& surface) {
    return surface.known_area > 0 ? tally.area / surface.known_area : 0;
}

Faults faultsOf(const FrameHealth& health, const Surface& surface) {
    return {shareOf(health.directions_wrong, surface) + shareOf(health.uv_seams, surface) +
                shareOf(health.mirrored_seams, surface),
            health.wrong_sign_share};
}

/// How much of the surface on which `own` has UV area `other` has, too.
double coverage(const Surface& own, const Surface& other) {
    double covered = 0;
    for (std::size_t f = 0; f < own.faces.size(); ++f) {
        if (own.faces[f].orientation != 0 && other.faces[f].orientation != 0) covered += own.faces[f].area;
    }
    return own.known_area > 0 ? covered / own.known_area : 0;
}

bool readsLike(const UvReading& reading, const ScenePrimitive& primitive, const TangentUse& use) {
    return !reading.transformed && reading.uv_set == use.uv_set && !readingOf(primitive, use).transformed;
}

class Search {
  public:
    Search(const PrimitiveFacts& facts, const Faults& now) : facts_(facts), now_(now) {}

    /// Whether the reading explains it; then `found` is filled.
    Result<bool> test(UvReading&& reading, bool is_own_set, OtherReading& found) const {
        if (reading.uvs.empty()) return false;
        TangentView mesh = facts_.mesh;
        mesh.uvs = reading.uvs;
        Surface surface = describeSurface(mesh);
        if (coverage(facts_.surface, surface) < kCovered) return false;
        Result<FrameHealth> health = examineTangents(mesh, surface, facts_.options);
        if (!health) return health.error();
        const Faults with_other = faultsOf(*health, surface);
        const bool signs_fit = with_other.signs <= kExplained || (!is_own_set && health->all_signs_wrong);
        if (with_other.directions > kExplained || !signs_fit) return false;
        if (now_.directions <= kClearlyWrong && !(is_own_set && now_.signs > kSomeSigns)) return false;
        found.reading = std::move(reading);
        found.surface = std::move(surface);
        found.health = *std::move(health);
        return true;
    }

  private:
    const PrimitiveFacts& facts_;
    Faults now_;
};

}  // namespace

bool areDirectionsWrong(const FrameHealth& health, const Surface& surface) {
    return faultsOf(health, surface).directions > kClearlyWrong;
}

Result<std::optional<OtherReading>> findOtherReading(const PrimitiveFacts& facts, const FrameHealth& health) {
    const ScenePrimitive& primitive = facts.primitive;
    const Faults now = faultsOf(health, facts.surface);
    std::optional<OtherReading> none;
    const bool signs_matter = facts.reading.transformed && now.signs > kSomeSigns;
    if (now.directions <= kClearlyWrong && !signs_matter) return none;
    const Search search(facts, now);
    OtherReading found;
    for (std::size_t i = 0; i <= primitive.uv_sets.size(); ++i) {
        const std::size_t set = i == 0 ? facts.reading.uv_set : i - 1;
        const bool is_own = set == facts.reading.uv_set;
        if (is_own && (i > 0 || !facts.reading.transformed)) continue;
        UvReading reading = plainReading(primitive, set);
        std::optional<std::size_t> use;
        for (std::size_t u = 1; u < primitive.uses.size() && !use; ++u) {
            if (readsLike(reading, primitive, primitive.uses[u])) use = u;
        }
        found.use = use;
        const Result<bool> fits = search.test(std::move(reading), is_own, found);
        if (!fits) return fits.error();
        if (*fits) return std::optional<OtherReading>(std::move(found));
    }
    for (std::size_t u = 1; u < primitive.uses.size(); ++u) {
        UvReading reading = readingOf(primitive, primitive.uses[u]);
        if (!reading.transformed) continue;
        const bool is_own = reading.uv_set == facts.reading.uv_set;
        found.use = u;
        const Result<bool> fits = search.test(std::move(reading), is_own, found);
        if (!fits) return fits.error();
        if (*fits) return std::optional<OtherReading>(std::move(found));
    }
    return none;
}

}  // namespace tspace
