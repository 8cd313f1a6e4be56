// SPDX-License-Identifier: MIT
// Every primitive against every method, and what that says about the file.
#include <algorithm>
#include <array>
#include <cstdio>

#include "asset/file_error.h"
#include "identify/explain.h"
#include "tspace/identify.h"

namespace tspace {

namespace {

/// A method that explains this share of the corners made them.
constexpr double kSureShare = 0.9;
/// From this share on it is the likely one.
constexpr double kLikelyShare = 0.5;
/// Methods this near to the best cannot be told apart from it.
constexpr double kTieShare = 0.005;

/// An importer cannot give all that a file has.
constexpr const char* kNotRead = "its tangents were not read";

std::string percent(double share) {
    std::array<char, 16> text = {};
    std::snprintf(text.data(), text.size(), "%.1f %%", share * 100);
    return text.data();
}

std::string whyNot(const ScenePrimitive& primitive) {
    if (primitive.corners.empty()) return "it has no triangles";
    if (primitive.tangents.empty()) return primitive.tangents_not_read ? kNotRead : "it has no tangents";
    if (primitive.normals.empty()) return "it has no normals";
    const bool has_uvs = std::any_of(primitive.uv_sets.begin(), primitive.uv_sets.end(),
                                     [](const SharedArray<Vec2>& set) { return !set.empty(); });
    return has_uvs ? "" : "it has no UVs";
}

void addTo(Explanation& sum, const Explanation& part) {
    const double weight = static_cast<double>(sum.corner_count), more = static_cast<double>(part.corner_count);
    if (weight + more > 0) sum.mean_deg = (sum.mean_deg * weight + part.mean_deg * more) / (weight + more);
    sum.corner_count += part.corner_count;
    sum.near_count += part.near_count;
    sum.near_any_count += part.near_any_count;
    sum.gltf_sign_count += part.gltf_sign_count;
    sum.inverted_sign_count += part.inverted_sign_count;
}

/// The best explanation along the texture's set, in one of its two readings; null: there is none.
const Explanation* bestReading(const PrimitiveIdentity& primitive, bool is_transformed) {
    const auto found = std::find_if(
        primitive.explanations.begin(), primitive.explanations.end(),
        [&](const Explanation& entry) { return entry.is_textures_set && entry.is_transformed == is_transformed; });
    return found == primitive.explanations.end() ? nullptr : &*found;
}

/// Whether the texture's transform explains more corners than the UVs as they are. Signs count: a transform may mirror,
/// and leave every direction in place.
bool followsTransform(const PrimitiveIdentity& primitive) {
    const Explanation *turned = bestReading(primitive, true), *plain = bestReading(primitive, false);
    if (turned == nullptr || plain == nullptr) return turned != nullptr;
    if (turned->near_count != plain->near_count) return turned->near_count > plain->near_count;
    return turned->gltf_sign_count >= plain->gltf_sign_count;
}

bool hasTwoReadings(const PrimitiveIdentity& primitive) {
    const Explanation *turned = bestReading(primitive, true), *plain = bestReading(primitive, false);
    return turned != nullptr && plain != nullptr &&
           (turned->near_count != plain->near_count || turned->gltf_sign_count != plain->gltf_sign_count);
}

std::vector<Explanation> overAllPrimitives(const std::vector<PrimitiveIdentity>& primitives) {
    std::vector<Explanation> sums;
    for (const Method method : knownMethods()) sums.emplace_back().method = method;
    for (const PrimitiveIdentity& primitive : primitives) {
        for (const Explanation& part : primitive.explanations) {
            if (!part.is_textures_set || part.is_transformed != followsTransform(primitive)) continue;
            const auto sum = std::find_if(sums.begin(), sums.end(),
                                          [&](const Explanation& entry) { return entry.method == part.method; });
            addTo(*sum, part);
        }
    }
    std::erase_if(sums, [](const Explanation& sum) { return sum.corner_count == 0; });
    sortExplanations(sums);
    return sums;
}

std::string signSentence(const Explanation& best) {
    switch (best.signs()) {
        case SignReading::gltf:
            return " The signs are as glTF wants them.";
        case SignReading::inverted:
            return " Every sign is inverted: the method was fed raw glTF UVs (v not flipped) and its sign was stored "
                   "as it "
                   "came, so B points the wrong way.";
        case SignReading::mixed:
            return " The signs fit neither reading: " +
                   percent(static_cast<double>(best.gltf_sign_count) / static_cast<double>(best.corner_count)) +
                   " of the corners are as glTF wants them.";
        case SignReading::none:
            break;
    }
    return "";
}

/// Other UV sets that explain a primitive better than the texture's by far.
std::string uvSetSentence(const std::vector<PrimitiveIdentity>& primitives) {
    std::size_t count = 0;
    for (const PrimitiveIdentity& primitive : primitives) {
        if (primitive.explanations.empty()) continue;
        const Explanation& best = primitive.explanations.front();
        if (best.is_textures_set || best.nearShare() < kLikelyShare) continue;
        const auto textures = std::find_if(primitive.explanations.begin(), primitive.explanations.end(),
                                           [](const Explanation& entry) { return entry.is_textures_set; });
        const double share = textures == primitive.explanations.end() ? 0 : textures->nearShare();
        count += share + 0.25 < best.nearShare();
    }
    if (count == 0) return "";
    return " In " + std::to_string(count) + (count == 1 ? " primitive" : " primitives") +
           " the tangents follow another UV set than the texture does.";
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
        return " In " + std::to_string(count) + (count == 1 ? " primitive" : " primitives") +
               " the tangents follow the UVs " + words + " KHR_texture_transform.";
    };
    return sentence(after, "after") + sentence(before, "as they are stored, before");
}

std::string verdictOf(const Identification& result) {
    if (result.explanations.empty()) {
        const bool none =
            std::all_of(result.primitives.begin(), result.primitives.end(), [](const PrimitiveIdentity& p) {
                return p.skipped == "it has no tangents" || p.skipped == "it has no triangles";
            });
        if (none) return "There are no tangents in this file.";
        const bool not_read = std::any_of(result.primitives.begin(), result.primitives.end(),
                                          [](const PrimitiveIdentity& p) { return p.skipped == kNotRead; });
        return not_read ? "The tangents of this file, if it has any, were not read: the importer cannot give them."
                        : "No primitive has all that is needed to tell.";
    }
    const Explanation& best = result.explanations.front();
    const std::string name = methodName(best.method);
    std::string text;
    if (best.nearShare() >= kSureShare) {
        text = "Made by " + name + ": it explains " + percent(best.nearShare()) + " of the corners";
    } else if (best.nearAnyShare() >= kSureShare) {
        text = "Made by " + name +
               ", but one tangent per vertex was kept where corners differ: " + percent(best.nearShare()) +
               " of the corners fit, " + percent(best.nearAnyShare()) + " at some corner of their vertex";
    } else if (best.nearShare() >= kLikelyShare) {
        text = "Probably made by " + name + ", with something changed or averaged afterwards: it explains " +
               percent(best.nearShare()) + " of the corners";
    } else {
        text = "Made by no method that tspace knows: the nearest, " + name + ", explains " + percent(best.nearShare()) +
               " of the corners";
    }
    std::string ties;
    for (const Explanation& other : result.explanations) {
        if (&other == &best || other.nearShare() + kTieShare < best.nearShare()) continue;
        ties += (ties.empty() ? "" : ", ") + std::string(methodName(other.method));
    }
    if (!ties.empty() && best.nearShare() >= kLikelyShare) text += " (so do " + ties + ")";
    return text + "." + signSentence(best) + uvSetSentence(result.primitives) + transformSentence(result.primitives);
}

PrimitiveIdentity identify(const ScenePrimitive& primitive, const IdentifyOptions& options) {
    PrimitiveIdentity identity{.place = primitive.place,
                               .mesh = primitive.mesh,
                               .primitive = primitive.primitive,
                               .mesh_name = primitive.mesh_name,
                               .material_name = primitive.material_name,
                               .skipped = whyNot(primitive)};
    if (!identity.skipped.empty()) return identity;
    identity.explanations = valueOrThrow(explainTangents(primitive, options));
    sortExplanations(identity.explanations);
    identity.has_two_readings = hasTwoReadings(identity);
    // Of two readings with as many near corners the one whose signs fit stands first.
    const auto follows =
        std::find_if(identity.explanations.begin(), identity.explanations.end(), [&](const Explanation& entry) {
            return entry.is_textures_set && entry.is_transformed == followsTransform(identity);
        });
    if (follows != identity.explanations.end() && follows->near_count == identity.explanations.front().near_count)
        std::rotate(identity.explanations.begin(), follows, follows + 1);
    return identity;
}

}  // namespace

const char* signReadingName(SignReading reading) {
    switch (reading) {
        case SignReading::none:
            return "none";
        case SignReading::gltf:
            return "gltf";
        case SignReading::inverted:
            return "inverted";
        case SignReading::mixed:
            return "mixed";
    }
    return "none";
}

SignReading Explanation::signs() const {
    constexpr double kNearlyAll = 0.95;
    const double most = kNearlyAll * static_cast<double>(corner_count);
    if (gltf_sign_count + inverted_sign_count == 0) return SignReading::none;
    if (static_cast<double>(gltf_sign_count) >= most) return SignReading::gltf;
    if (static_cast<double>(inverted_sign_count) >= most) return SignReading::inverted;
    return SignReading::mixed;
}

Result<Identification> identifyFile(const std::string& input, const IdentifyOptions& options) {
    return atFileBorder([&]() -> Result<Identification> {
        const Scene scene = readScene(input, options.file, false);
        Identification result{.format = scene.format, .generator = scene.generator};
        for (const ScenePrimitive& primitive : scene.primitives) {
            result.primitives.push_back(identify(primitive, options));
        }
        result.explanations = overAllPrimitives(result.primitives);
        result.verdict = verdictOf(result);
        return result;
    });
}

}  // namespace tspace
