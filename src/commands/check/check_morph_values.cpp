// SPDX-License-Identifier: MIT
// Morph targets: whether what they add is finite, and leaves normals a length. A single vertex counts.
#include <map>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {

namespace {

/// The first target that has a fault, and how many more do.
struct FaultyTargets {
    Tally vertices = {};  ///< of the first
    std::size_t first = 0, count = 0;
    bool all_move = true;  ///< positions, so that the surface says how normals turn
};

class MorphValues {
  public:
    explicit MorphValues(PrimitiveFacts& facts) : facts_(facts), used_(facts.mesh.positions.size(), false) {
        for (const std::uint32_t vertex : facts.mesh.corners) used_[vertex] = true;
    }

    /// Used vertices of whose offset in one array of the targets `is_faulty` says so.
    template <class Test>
    FaultyTargets find(SharedArray<Vec3> SceneMorphTarget::*array, const Test& is_faulty) const {
        FaultyTargets result;
        // A file may name the same array any number of times.
        std::map<const Vec3*, bool> known;
        const auto& targets = facts_.primitive.morph_targets;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const SharedArray<Vec3>& offsets = targets[i].*array;
            if (offsets.empty()) continue;
            const auto [entry, is_new] = known.try_emplace(offsets.data(), false);
            if (is_new) {
                const Tally tally = tallyOf(offsets, is_faulty);
                entry->second = tally.count != 0;
                if (entry->second && result.count == 0) result = {.vertices = tally, .first = i};
            }
            if (!entry->second) continue;
            ++result.count;
            result.all_move = result.all_move && !targets[i].positions.empty();
        }
        return result;
    }

    /// "what target 2 adds to the normals of 1 of 525 vertices <what>; so it is in 3 more targets"
    void report(FindingCode code, const FaultyTargets& faulty, const char* attribute, const std::string& what) {
        if (faulty.count == 0) return;
        const std::size_t more = faulty.count - 1;
        std::string message = "what target " + std::to_string(faulty.first) + " adds to the " + attribute + " of " +
                              countText(faulty.vertices, "vertices") + " " + what;
        if (more != 0) message += "; so it is in " + std::to_string(more) + " more target" + (more == 1 ? "" : "s");
        facts_.add(code, Severity::error, faulty.vertices, "vertices", std::move(message));
        Finding& finding = facts_.findings.back();
        finding.place = facts_.primitive.place + "/targets/" + std::to_string(faulty.first);
        if (code == FindingCode::positionsNotFinite) return;
        finding.remedy = faulty.all_move ? findingRemedy(FindingCode::morphNormalsWrong)
                                         : "Export the normals of the targets again.";
    }

  private:
    template <class Test>
    Tally tallyOf(const SharedArray<Vec3>& offsets, const Test& is_faulty) const {
        Tally tally;
        for (std::uint32_t v = 0; v < used_.size(); ++v) {
            if (!used_[v]) continue;
            ++tally.total;
            if (is_faulty(v, offsets[v])) tally.add(v, facts_.surface.vertex_areas[v]);
        }
        tally.finish(facts_.surface.area);
        return tally;
    }

    PrimitiveFacts& facts_;
    std::vector<bool> used_;
};

}  // namespace

void checkMorphValues(PrimitiveFacts& facts) {
    if (facts.primitive.morph_targets.empty()) return;
    MorphValues values(facts);
    const auto not_finite = [](std::uint32_t, const Vec3& offset) { return !isFinite(offset); };
    values.report(FindingCode::positionsNotFinite, values.find(&SceneMorphTarget::positions, not_finite), "positions",
                  "is NaN or infinite");
    if (facts.mesh.normals.empty() || facts.primitive.is_unlit) return;
    values.report(FindingCode::normalsNotFinite, values.find(&SceneMorphTarget::normals, not_finite), "normals",
                  "is NaN or infinite");
    const auto vanishes = [&](std::uint32_t v, const Vec3& offset) {
        const Vec3& base = facts.mesh.normals[v];
        return isDirection(base) && isFinite(offset) && length(toDouble(base + offset)) < kShortest;
    };
    values.report(FindingCode::morphNormalsWrong, values.find(&SceneMorphTarget::normals, vanishes), "normals",
                  "leaves them without length, so shaders get NaN at full weight");
}

}  // namespace tspace
