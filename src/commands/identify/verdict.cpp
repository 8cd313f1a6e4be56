// SPDX-License-Identifier: MIT
// Which method made the tangents, with which signs, along which UVs.
#include "commands/identify/verdict.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "commands/identify/explain.h"

namespace tspace {

namespace {

/// A method that explains this share of the corners made them.
constexpr double kSureShare = 0.95;
/// A method that explains this share is the likely one.
constexpr double kLikelyShare = 0.5;
/// By this much another UV set, or another method in a part of the file, must explain more to be named.
constexpr double kClearlyMore = 0.25;

std::string percent(double share) {
    const auto tenths = static_cast<int>(std::nearbyint(share * 1000));
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
}

std::string primitivesText(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " primitive" : " primitives");
}

std::string makerOf(const Explanation& entry) {
    return std::string(methodName(entry.method)) + (entry.faces == Faces::quads ? " on quads" : "");
}

const Explanation* bestOf(const PrimitiveIdentity& primitive) {
    return primitive.explanations.empty() ? nullptr : &primitive.explanations.front();
}

/// Counts by name, in the order in which names were first seen.
class NameCounts {
  public:
    void add(const std::string& name) {
        const auto entry =
            std::find_if(counts_.begin(), counts_.end(), [&](const auto& known) { return known.first == name; });
        if (entry == counts_.end()) {
            counts_.emplace_back(name, 1);
        } else {
            ++entry->second;
        }
    }
    [[nodiscard]] std::size_t size() const { return counts_.size(); }

    /// "A in 3 primitives, B in 1"
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const auto& [name, count] : counts_) {
            const std::string number = text.empty() ? primitivesText(count) : std::to_string(count);
            text += (text.empty() ? "" : ", ") + name + " in " + number;
        }
        return text;
    }

  private:
    std::vector<std::pair<std::string, std::size_t>> counts_ = {};
};

/// The methods of single primitives, where no method explains the file but each primitive has one that explains it. Empty
/// otherwise.
std::string differentMakers(const Identification& result) {
    if (result.explanations.front().nearShare() >= kSureShare) return "";
    NameCounts makers;
    std::uint64_t sure = 0, all = 0;
    for (const PrimitiveIdentity& primitive : result.primitives) {
        const Explanation* best = bestOf(primitive);
        if (best == nullptr) continue;
        all += best->corner_count;
        if (best->nearShare() < kSureShare) continue;
        sure += best->corner_count;
        makers.add(makerOf(*best));
    }
    const bool covers = static_cast<double>(sure) >= kSureShare * static_cast<double>(all);
    return covers && makers.size() > 1 ? makers.text() : "";
}

/// Methods that explain about as much as the best. On quads and on triangles they may differ in few corners.
std::string tiesOf(const std::vector<Explanation>& explanations) {
    const Explanation& best = explanations.front();
    std::string ties;
    for (const Explanation& other : explanations) {
        if (&other == &best || other.nearShare() + kTieShare < best.nearShare() || isCloser(best, other)) continue;
        ties += (ties.empty() ? "" : ", ") + makerOf(other);
    }
    return ties.empty() ? "" : " (so do " + ties + ")";
}

/// Whether one of the tangents that it gives to a vertex's corners is there nearly everywhere.
bool keptOnePerVertex(const Explanation& entry) {
    return entry.nearAnyShare() >= kSureShare && entry.method != Method::flat;
}

std::string makerSentence(const Identification& result) {
    const Explanation& best = result.explanations.front();
    const std::string makers = differentMakers(result);
    if (!makers.empty()) return "Made by different methods: " + makers + ".";
    const std::string name = makerOf(best), ties = tiesOf(result.explanations);
    if (best.nearShare() >= kSureShare)
        return "Made by " + name + ": it explains " + percent(best.nearShare()) + " of the corners" + ties + ".";
    if (keptOnePerVertex(best)) {
        return "Made by " + name +
               ", but one tangent per vertex was kept where corners differ: " + percent(best.nearShare()) +
               " of the corners fit, " + percent(best.nearAnyShare()) + " at some corner of their vertex" +
               (best.nearShare() >= kLikelyShare ? ties : "") + ".";
    }
    if (best.nearShare() >= kLikelyShare) {
        return "Probably made by " + name + ", with something changed or averaged afterwards: it explains " +
               percent(best.nearShare()) + " of the corners" + ties + ".";
    }
    return "Made by no method that tspace knows: the nearest, " + name + ", explains " + percent(best.nearShare()) +
           " of the corners.";
}

/// Single primitives that a method explains which is not the file's.
std::string exceptionsSentence(const Identification& result) {
    if (!differentMakers(result).empty()) return "";
    const Explanation& best = result.explanations.front();
    NameCounts others;
    for (const PrimitiveIdentity& primitive : result.primitives) {
        const Explanation* own = bestOf(primitive);
        if (own == nullptr || own->nearShare() < kSureShare || own->method == best.method) continue;
        const auto files =
            std::find_if(primitive.explanations.begin(), primitive.explanations.end(), [&](const Explanation& entry) {
                return entry.method == best.method && entry.uv_set == own->uv_set &&
                       entry.is_transformed == own->is_transformed;
            });
        if (files == primitive.explanations.end() || files->nearShare() + kClearlyMore < own->nearShare())
            others.add(makerOf(*own));
    }
    return others.size() == 0 ? "" : " But clearly " + others.text() + ".";
}

std::string signSentence(const Identification& result) {
    const Explanation& best = result.explanations.front();
    // The meaning of signs depends on how the tangents were made.
    if (best.nearShare() < kLikelyShare && !keptOnePerVertex(best) && differentMakers(result).empty()) return "";
    switch (best.signs()) {
        case SignReading::gltf:
            return " The signs are as glTF wants them.";
        case SignReading::inverted:
            return " Every sign is inverted: the method was fed raw glTF UVs (v not flipped) and its sign was stored "
                   "as it came, so B points the wrong way.";
        case SignReading::none:
            return "";
        case SignReading::mixed:
            break;
    }
    std::size_t right = 0, inverted = 0, mixed = 0;
    for (const PrimitiveIdentity& primitive : result.primitives) {
        const Explanation* own = bestOf(primitive);
        if (own == nullptr) continue;
        right += own->signs() == SignReading::gltf ? 1 : 0;
        inverted += own->signs() == SignReading::inverted ? 1 : 0;
        mixed += own->signs() == SignReading::mixed ? 1 : 0;
    }
    if (mixed == 0 && right != 0 && inverted != 0) {
        return " The signs are as glTF wants them in " + primitivesText(right) + ", and inverted in " +
               std::to_string(inverted) + ".";
    }
    return " The signs fit neither reading: " +
           percent(static_cast<double>(best.gltf_sign_count) / static_cast<double>(best.corner_count)) +
           " of the corners are as glTF wants them.";
}

/// Other UV sets that explain a primitive better than the texture's by far.
std::string uvSetSentence(const std::vector<PrimitiveIdentity>& primitives) {
    std::size_t count = 0;
    for (const PrimitiveIdentity& primitive : primitives) {
        const Explanation* best = bestOf(primitive);
        if (best == nullptr || best->is_textures_set || best->nearShare() < kLikelyShare) continue;
        double share = 0;
        std::uint64_t corner_count = 0;
        for (const Explanation& entry : primitive.explanations) {
            if (!entry.is_textures_set) continue;
            share = std::max(share, entry.nearShare());
            corner_count = entry.corner_count;
        }
        // A set with an area on a few triangles only is no rival to one that covers the mesh.
        if (2 * best->corner_count < corner_count) continue;
        count += share + kClearlyMore < best->nearShare() ? 1 : 0;
    }
    if (count == 0) return "";
    return " In " + primitivesText(count) + " the tangents follow another UV set than the texture does.";
}

/// Which reading of texture transforms the tangents follow.
std::string transformSentence(const std::vector<PrimitiveIdentity>& primitives) {
    std::size_t after = 0, before = 0;
    for (const PrimitiveIdentity& primitive : primitives) {
        if (!primitive.has_two_readings || primitive.explanations.front().nearShare() < kLikelyShare) continue;
        ++(followsTransform(primitive) ? after : before);
    }
    const auto sentence = [](std::size_t count, const char* words) {
        if (count == 0) return std::string();
        return " In " + primitivesText(count) + " the tangents follow the UVs " + words + " KHR_texture_transform.";
    };
    return sentence(after, "after") + sentence(before, "as they are stored, before");
}

std::string whyNothing(const Identification& result) {
    const bool none = std::all_of(result.primitives.begin(), result.primitives.end(), [](const PrimitiveIdentity& p) {
        return p.skipped == "it has no tangents" || p.skipped == "it has no triangles";
    });
    if (none) return "There are no tangents in this file.";
    const bool not_read = std::any_of(result.primitives.begin(), result.primitives.end(),
                                      [](const PrimitiveIdentity& p) { return p.skipped == kNotRead; });
    return not_read ? "The tangents of this file, if it has any, were not read: the importer cannot give them."
                    : "No primitive has all that is needed to tell.";
}

}  // namespace

std::string verdictOf(const Identification& result) {
    if (result.explanations.empty()) return whyNothing(result);
    return makerSentence(result) + exceptionsSentence(result) + signSentence(result) +
           uvSetSentence(result.primitives) + transformSentence(result.primitives);
}

}  // namespace tspace
