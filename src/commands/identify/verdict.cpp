// SPDX-License-Identifier: MIT
// Determines which method computed the tangents, with which signs and along which UVs, and describes the result in
// sentences.
#include "commands/identify/verdict.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "commands/shared/uv_reading.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/mesh/quads/quads.h"
#include "core/mesh/surface/surface.h"

namespace tspace {

// Runs a method on the data of the primitive and counts the stored tangents that it reproduces.

namespace {

/// Returns the UV set of the first texture, or the first existing set if there is no texture.
std::size_t uvSetOfTexture(const ScenePrimitive& primitive) {
    if (!primitive.uses.empty()) return primitive.uses.front().uv_set;
    std::size_t set = 0;
    while (set + 1 < primitive.uv_sets.size() && primitive.uv_sets[set].empty()) ++set;
    return set;
}

/// Returns every UV set as stored. If the texture transform changes frames, the transformed set of the texture precedes
/// its stored set.
std::vector<UvReading> readingsOf(const ScenePrimitive& primitive) {
    std::vector<UvReading> readings;
    for (std::size_t set = 0; set < primitive.uv_sets.size(); ++set) {
        if (primitive.uv_sets[set].empty()) continue;
        if (!primitive.uses.empty() && set == uvSetOfTexture(primitive)) {
            UvReading transformed = readingOf(primitive, primitive.uses.front());
            if (transformed.transformed) readings.push_back(std::move(transformed));
        }
        readings.push_back(plainReading(primitive, set));
    }
    return readings;
}

/// Returns whether all tangents can have been stored as integers of 8 or 16 bits.
bool areQuantized(std::span<const Vec4> tangents) {
    const auto areMultiples = [&](double steps) {
        const double slack = 1e-6 * steps;
        const auto isMultiple = [=](float part) {
            const double value = steps * static_cast<double>(part);
            return std::fabs(value - std::nearbyint(value)) <= slack;
        };
        return std::all_of(tangents.begin(), tangents.end(),
                           [&](const Vec4& t) { return isMultiple(t.x) && isMultiple(t.y) && isMultiple(t.z); });
    };
    return areMultiples(127) || areMultiples(32767);
}

/// Compares stored and computed tangents. `computed` has the raw sign, one entry per corner.
void compare(const ScenePrimitive& primitive, std::span<const std::uint8_t> votes, std::span<const Vec4> computed,
             double tolerance_deg, Explanation& explanation) {
    // The rounding error of a method in floats is negligible compared with an integer step.
    constexpr double kRoundingDeg = 1e-4;
    const double nothing_deg = areQuantized(primitive.tangents.span()) ? kRoundingDeg : 0;
    std::vector<char> is_near_at(primitive.positions.size(), 0);
    std::vector<std::uint32_t> counted;
    double sum_deg = 0;
    for (std::size_t c = 0; c < computed.size(); ++c) {
        const std::uint32_t vertex = primitive.corners[c];
        const Vec4& stored = primitive.tangents[vertex];
        if (!isDirection(xyz(stored))) continue;
        if (votes[c / 3] == 0) {
            ++explanation.undecided_count;
            continue;
        }
        counted.push_back(vertex);
        if (!isDirection(xyz(computed[c]))) {
            sum_deg += 180;
            continue;
        }
        const double angle = angleBetween(toDouble(xyz(stored)), toDouble(xyz(computed[c]))) * (180 / kPi);
        if (angle > nothing_deg) sum_deg += angle;
        if (angle <= tolerance_deg) {
            ++explanation.near_count;
            is_near_at[vertex] = 1;
        }
        // In glTF v increases downward, so the stored sign is the opposite of the raw orientation.
        explanation.gltf_sign_count += stored.w * computed[c].w < 0;
        explanation.inverted_sign_count += stored.w * computed[c].w > 0;
    }
    explanation.corner_count = counted.size();
    if (!counted.empty()) explanation.mean_deg = sum_deg / static_cast<double>(counted.size());
    for (const std::uint32_t vertex : counted)
        explanation.near_any_count += static_cast<unsigned char>(is_near_at[vertex]);
}

/// Computes the explanations along one interpretation of the UVs.
class Explainer {
  public:
    Explainer(const ScenePrimitive& primitive, const UvReading& reading, const IdentifyOptions& options)
        : primitive_(primitive), reading_(reading), options_(options), mesh_(primitive.view(reading.uvs)),
          votes_(uvVotes(mesh_)) {}

    /// Returns whether any triangle has UV area.
    [[nodiscard]] bool hasVotes() const { return std::find(votes_.begin(), votes_.end(), 1) != votes_.end(); }

    Result<Done> tryMethods(std::vector<Explanation>& explanations) const {
        std::vector<Vec4> computed(primitive_.corners.size());
        for (const Method method : knownMethods()) {
            if (const Result<Done> tried = tryMethod(method, computed, explanations); !tried) return tried;
            if (method != Method::mikktspace) continue;
            if (const Result<Done> tried = tryQuads(computed, explanations); !tried) return tried;
        }
        return Done{};
    }

  private:
    /// Tries `best` with each number of refinement steps, and keeps the one that explains most.
    Result<Done> tryMethod(Method method, std::span<Vec4> computed, std::vector<Explanation>& explanations) const {
        Explanation most;
        for (const std::uint32_t refine : {1u, 0u, 2u}) {
            const TangentOptions how{.method = method, .convention = conventions::opengl, .refine = refine};
            const Result<TangentReport> done = generateTangents(mesh_, how, {.tangents = computed}, options_.execution);
            if (!done) return done.error();
            const Explanation explanation = explainedBy(method, Faces::triangles, computed);
            if (refine == 1 || explanation.near_count > most.near_count) most = explanation;
            if (method != Method::best) break;
        }
        explanations.push_back(most);
        return Done{};
    }

    Result<Done> tryQuads(std::span<const Vec4> on_triangles, std::vector<Explanation>& explanations) const {
        const Result<QuadFit> fit =
            fitQuads(mesh_, primitive_.tangents.span(), options_.execution, options_.tolerance_deg, on_triangles);
        if (!fit) return fit.error();
        if (fit->wins()) explanations.push_back(explainedBy(Method::mikktspace, Faces::quads, fit->tangents));
        return Done{};
    }

    [[nodiscard]] Explanation explainedBy(Method method, Faces faces, std::span<const Vec4> computed) const {
        Explanation explanation;
        explanation.method = method;
        explanation.faces = faces;
        explanation.uv_set = static_cast<std::int32_t>(reading_.uv_set);
        explanation.is_textures_set = reading_.uv_set == uvSetOfTexture(primitive_);
        explanation.is_transformed = reading_.transformed;
        compare(primitive_, votes_, computed, options_.tolerance_deg, explanation);
        return explanation;
    }

    const ScenePrimitive& primitive_;
    const UvReading& reading_;
    const IdentifyOptions& options_;
    MeshView mesh_;
    std::vector<std::uint8_t> votes_;
};

/// Returns the score of a method: the number of near corners, minus a margin for methods that only tspace implements. A
/// corner that is near only to the result of another corner of its vertex counts half. It does not count for `flat`,
/// which has so many directions at a vertex that one is near by chance.
double scoreOf(const Explanation& entry) {
    constexpr double kOwnMethodsShare = 0.05;
    const bool is_own = entry.method == Method::fast || entry.method == Method::best;
    const std::uint64_t near_any = entry.method == Method::flat ? entry.near_count : entry.near_any_count;
    return 0.5 * static_cast<double>(entry.near_count + near_any) -
           (is_own ? kOwnMethodsShare * static_cast<double>(entry.corner_count) : 0.0);
}

std::size_t rankOf(const Explanation& entry) {
    const std::vector<Method> known = knownMethods();
    return static_cast<std::size_t>(std::find(known.begin(), known.end(), entry.method) - known.begin());
}

}  // namespace

std::vector<Method> knownMethods() {
    return {Method::mikktspace, Method::angle, Method::area, Method::uniform,
            Method::lengyel,    Method::flat,  Method::fast, Method::best};
}

Result<std::vector<Explanation>> explainTangents(const ScenePrimitive& primitive, const IdentifyOptions& options) {
    std::vector<Explanation> explanations;
    for (const UvReading& reading : readingsOf(primitive)) {
        const Explainer explainer(primitive, reading, options);
        if (!explainer.hasVotes()) continue;
        if (const Result<Done> done = explainer.tryMethods(explanations); !done) return done.error();
    }
    return explanations;
}

bool isCloser(const Explanation& a, const Explanation& b) {
    // A mean of 0 means equal bits at every corner.
    if (a.mean_deg == 0) return b.mean_deg > 0;
    constexpr double kRoundingDeg = 0.001;
    return b.mean_deg > 2 * a.mean_deg + kRoundingDeg;
}

void sortExplanations(std::vector<Explanation>& explanations) {
    if (explanations.empty()) return;
    sortStably(explanations.begin(), explanations.end(), [](const Explanation& a, const Explanation& b) {
        const double score_a = scoreOf(a), score_b = scoreOf(b);
        return score_a != score_b ? score_a > score_b : a.near_count > b.near_count;
    });
    // Among methods that are near at equally many corners, a clearly closer one comes first: results that equal the
    // stored bits are no coincidence.
    auto top = explanations.begin();
    for (auto entry = top + 1; entry != explanations.end(); ++entry) {
        const bool is_same_reading =
            entry->is_textures_set == top->is_textures_set && entry->is_transformed == top->is_transformed;
        const bool is_own = entry->method == Method::fast || entry->method == Method::best;
        if (!is_own && is_same_reading && entry->nearShare() + kTieShare >= top->nearShare() && isCloser(*entry, *top))
            top = entry;
    }
    std::rotate(explanations.begin(), top, top + 1);
    const Explanation best = explanations.front();
    const double least = scoreOf(best) - kTieShare * static_cast<double>(best.corner_count);
    auto first = explanations.begin();
    for (auto entry = first + 1; entry != explanations.end(); ++entry) {
        if (scoreOf(*entry) < least || entry->is_transformed != best.is_transformed || isCloser(best, *entry)) continue;
        if (entry->is_textures_set == first->is_textures_set ? rankOf(*entry) < rankOf(*first)
                                                             : entry->is_textures_set) {
            first = entry;
        }
    }
    std::rotate(explanations.begin(), first, first + 1);
}

const Explanation* bestReading(const PrimitiveIdentity& primitive, bool is_transformed) {
    const auto found = std::find_if(
        primitive.explanations.begin(), primitive.explanations.end(),
        [&](const Explanation& entry) { return entry.is_textures_set && entry.is_transformed == is_transformed; });
    return found == primitive.explanations.end() ? nullptr : &*found;
}

bool followsTransform(const PrimitiveIdentity& primitive) {
    const Explanation *with_transform = bestReading(primitive, true), *plain = bestReading(primitive, false);
    if (with_transform == nullptr || plain == nullptr) return with_transform != nullptr;
    if (with_transform->near_count != plain->near_count) return with_transform->near_count > plain->near_count;
    return with_transform->gltf_sign_count >= plain->gltf_sign_count;
}

namespace {

/// Minimum share of explained corners from which a method is reported as the origin of the tangents.
constexpr double kSureShare = 0.95;
/// Minimum share of explained corners from which a method is reported as the likely origin.
constexpr double kLikelyShare = 0.5;
/// Minimum share by which another UV set, or another method in a part of the file, must be better to be named.
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

    /// Returns a text such as "A in 3 primitives, B in 1".
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

/// Returns the methods of single primitives if no method explains the whole file but each primitive is explained by
/// one, and otherwise an empty string.
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

/// Lists the methods that explain about as much as the best. For example, mikktspace on quads and on triangles may
/// differ at only a few corners.
std::string tiesOf(const std::vector<Explanation>& explanations) {
    const Explanation& best = explanations.front();
    std::string ties;
    for (const Explanation& other : explanations) {
        if (&other == &best || other.nearShare() + kTieShare < best.nearShare() || isCloser(best, other)) continue;
        ties += (ties.empty() ? "" : ", ") + makerOf(other);
    }
    return ties.empty() ? "" : " (equally well: " + ties + ")";
}

/// Returns whether, at nearly every vertex, the stored tangent equals the computed tangent of one of its corners.
bool keepsOnePerVertex(const Explanation& entry) {
    return entry.nearAnyShare() >= kSureShare && entry.method != Method::flat;
}

std::string makerSentence(const Identification& result) {
    const Explanation& best = result.explanations.front();
    const std::string makers = differentMakers(result);
    if (!makers.empty()) return "Made by different methods: " + makers + ".";
    const std::string name = makerOf(best), ties = tiesOf(result.explanations);
    if (best.nearShare() >= kSureShare)
        return "Made by " + name + ": it explains the directions of " + percent(best.nearShare()) + " of the corners" +
               ties + ".";
    if (keepsOnePerVertex(best)) {
        return "Made by " + name +
               ", but only one tangent per vertex was kept where corners differ: " + percent(best.nearShare()) +
               " of the tangents match at their own corner, " + percent(best.nearAnyShare()) +
               " at some corner of their vertex" + (best.nearShare() >= kLikelyShare ? ties : "") + ".";
    }
    if (best.nearShare() >= kLikelyShare) {
        return "Probably made by " + name + ", and modified or averaged afterwards: it reproduces " +
               percent(best.nearShare()) + " of the corners" + ties + ".";
    }
    return "No known method made these tangents: the closest one, " + name + ", explains " + percent(best.nearShare()) +
           " of the corners.";
}

/// Describes single primitives that are explained by a method other than that of the file.
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
    return others.size() == 0 ? "" : " Some primitives clearly match another method: " + others.text() + ".";
}

std::string signSentence(const Identification& result) {
    const Explanation& best = result.explanations.front();
    // The meaning of signs depends on the method, so signs are not described if the method is unknown.
    if (best.nearShare() < kLikelyShare && !keepsOnePerVertex(best) && differentMakers(result).empty()) return "";
    switch (best.signs()) {
        case SignReading::gltf: return " The signs follow glTF.";
        case SignReading::inverted:
            return " Every sign is inverted: the method was given raw glTF UVs (v not flipped) and its sign was stored "
                   "unchanged, so the bitangent points the wrong way.";
        case SignReading::none: return "";
        case SignReading::mixed: break;
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
        return " The signs follow glTF in " + primitivesText(right) + ", and are inverted in " +
               std::to_string(inverted) + ".";
    }
    return " The signs match neither convention: " +
           percent(static_cast<double>(best.gltf_sign_count) / static_cast<double>(best.corner_count)) +
           " of the corners have the sign that glTF requires.";
}

/// Describes other UV sets that explain a primitive far better than the UV set of the texture.
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
        // A UV set with area on only a few triangles is not compared with one that covers the mesh.
        if (2 * best->corner_count < corner_count) continue;
        count += share + kClearlyMore < best->nearShare() ? 1 : 0;
    }
    if (count == 0) return "";
    return " In " + primitivesText(count) + " the tangents follow a different UV set than the texture uses.";
}

/// Names the interpretation of texture transforms that the tangents follow.
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
    return sentence(after, "after") + sentence(before, "as stored, before");
}

std::string whyNothing(const Identification& result) {
    const bool none = std::all_of(result.primitives.begin(), result.primitives.end(), [](const PrimitiveIdentity& p) {
        return p.skipped == "it has no tangents" || p.skipped == "it has no triangles";
    });
    if (none) return "This file contains no tangents.";
    const bool not_read = std::any_of(result.primitives.begin(), result.primitives.end(),
                                      [](const PrimitiveIdentity& p) { return p.skipped == kNotRead; });
    return not_read ? "The tangents of this file, if any, were not read, because the importer does not support them in "
                      "this format."
                    : "No primitive has all the data that is needed to identify the method.";
}

}  // namespace

std::string verdictOf(const Identification& result) {
    if (result.explanations.empty()) return whyNothing(result);
    return makerSentence(result) + exceptionsSentence(result) + signSentence(result) +
           uvSetSentence(result.primitives) + transformSentence(result.primitives);
}

}  // namespace tspace
