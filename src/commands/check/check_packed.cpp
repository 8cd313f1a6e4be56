// SPDX-License-Identifier: MIT
// Compares packed frames with the normals and tangents that they were packed from. Because packing sanitizes frames,
// the normals and tangents are packed in the finest format for the comparison. Packing the frames again fixes every
// finding.
#include "commands/check/scene_checks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <tuple>

#include "commands/check/findings.h"
#include "commands/check/remedy.h"
#include "commands/check/scene_verdict.h"
#include "core/base/vec_math.h"
#include "model/io/file_error.h"
#include "model/io/memory_budget.h"
#include "tspace/pack.h"

namespace tspace {
namespace {

constexpr FrameFormat kFinest = FrameFormat::frame64;
/// Number of frames that are compared at a time.
constexpr std::size_t kChunk = 256;
/// Angle from which differences are visible; 8 bits per component cause errors of 0.4 degrees.
constexpr double kVisible_deg = 1;

struct PackedErrors {
    Tally beyond;  ///< vertices outside the format's error bound, or with a different sign
    double normal_deg = 0, tangent_deg = 0;
    std::uint64_t sign_count = 0;
};

struct FrameChunk {
    std::array<Vec3, kChunk> normals;
    std::array<Vec4, kChunk> tangents;
};

void unpackInto(FrameFormat format, std::span<const std::byte> words, std::size_t count, FrameChunk& chunk) {
    valueOrThrow(
        unpackFrames(words, format, std::span(chunk.normals).first(count), std::span(chunk.tangents).first(count)));
}

PackedErrors comparePacked(const ScenePrimitive& primitive, const ScenePacked& packed) {
    const FrameErrorBound bound = frameErrorBound(packed.format), finest = frameErrorBound(kFinest);
    const std::size_t total = primitive.normals.size(), word_bytes = frameBytes(packed.format);
    const auto words = std::as_bytes(packed.words.span());
    std::array<std::byte, kChunk * 8> buffer;
    FrameChunk stored, expected;
    PackedErrors errors;
    errors.beyond.total = total;
    for (std::size_t begin = 0; begin < total; begin += kChunk) {
        const std::size_t count = std::min(kChunk, total - begin);
        const auto fine = std::span(buffer).first(count * frameBytes(kFinest));
        valueOrThrow(packFrames(primitive.normals.span().subspan(begin, count),
                                primitive.tangents.span().subspan(begin, count), kFinest, fine));
        unpackInto(kFinest, fine, count, expected);
        unpackInto(packed.format, words.subspan(begin * word_bytes, count * word_bytes), count, stored);
        for (std::size_t i = 0; i < count; ++i) {
            constexpr double kDegrees = 180 / kPi;
            const double normal_deg =
                kDegrees * angleBetween(toDouble(stored.normals[i]), toDouble(expected.normals[i]));
            const double tangent_deg =
                kDegrees * angleBetween(toDouble(xyz(stored.tangents[i])), toDouble(xyz(expected.tangents[i])));
            const bool is_mirrored = stored.tangents[i].w != expected.tangents[i].w;
            errors.normal_deg = std::max(errors.normal_deg, normal_deg);
            errors.tangent_deg = std::max(errors.tangent_deg, tangent_deg);
            errors.sign_count += is_mirrored;
            const bool is_beyond = is_mirrored || normal_deg > bound.normal_deg + finest.normal_deg ||
                                   tangent_deg > bound.tangent_deg + finest.tangent_deg;
            if (is_beyond)
                errors.beyond.add(static_cast<std::uint32_t>(begin + i), 0, std::max(normal_deg, tangent_deg));
        }
    }
    return errors;
}

/// Formats degrees as in "0.135": at most four decimals, no trailing zeros, independent of the locale.
std::string degreesText(double degrees) {
    const auto parts = static_cast<std::uint64_t>(degrees * 10000 + 0.5);
    std::string digits = std::to_string(parts % 10000 + 10000).substr(1);
    digits.erase(digits.find_last_not_of('0') + 1);
    return std::to_string(parts / 10000) + (digits.empty() ? "" : "." + digits);
}

std::string differenceText(const ScenePacked& packed, const PackedErrors& errors) {
    const FrameErrorBound bound = frameErrorBound(packed.format);
    std::string text = packed.attribute + " differs from NORMAL and TANGENT at " +
                       countText(errors.beyond, "vertices") + ": N is off by up to " + degreesText(errors.normal_deg) +
                       " degrees, T by " + degreesText(errors.tangent_deg) + "; the format " +
                       frameFormatName(packed.format) + " guarantees at most " + degreesText(bound.normal_deg) +
                       " and " + degreesText(bound.tangent_deg) + " degrees";
    if (errors.sign_count != 0) text += "; the sign differs at " + std::to_string(errors.sign_count) + " of them";
    return text;
}

Remedy packAgain(FrameFormat format) {
    return {"Pack them again: {}.", {withOption(toCommand("generate"), "pack", frameFormatName(format))}};
}

/// Returns whether generate has frames to pack, or can compute them.
bool canPack(const ScenePrimitive& primitive) {
    if (!primitive.normals.empty() && !primitive.tangents.empty()) return true;
    return primitive.packedAlone() == nullptr && canCompute(primitive);
}

Finding unreadablePacking(const ScenePrimitive& primitive, const ScenePacked& packed) {
    Finding finding = makeFinding(FindingCode::packedFramesUnreadable, Severity::warning, Tally::all(1), "attributes",
                                  {.cause = packed.attribute + " " + packed.fault});
    setRemedy(finding,
              canPack(primitive)
                  ? packAgain(packed.format)
                  : Remedy{"Pack the frames again from a model with normals and tangents, or remove the attribute."});
    return finding;
}

Finding differingPacking(const ScenePacked& packed, const PackedErrors& errors) {
    const bool can_be_seen = errors.sign_count != 0 || errors.beyond.worst_deg > kVisible_deg;
    Finding finding = makeFinding(FindingCode::packedFramesDiffer, can_be_seen ? Severity::warning : Severity::note,
                                  errors.beyond, "vertices", {.cause = differenceText(packed, errors)});
    setRemedy(finding, packAgain(packed.format));
    return finding;
}

/// Packed frames of one primitive in one format.
struct PackedEntry {
    const ScenePrimitive* primitive = nullptr;
    const ScenePacked* packed = nullptr;
    std::size_t comparison = 0;  ///< index of the comparison, if the frames were compared

    [[nodiscard]] bool isCompared() const {
        return packed->fault.empty() && !primitive->normals.empty() && !primitive->tangents.empty();
    }
    [[nodiscard]] std::string place() const { return primitive->place + "/attributes/" + packed->attribute; }
};

/// Returns all packed frames of a scene. Entries with equal comparison numbers are compared once, for the first of
/// them.
std::vector<PackedEntry> packedEntries(const Scene& scene) {
    std::vector<PackedEntry> entries;
    std::map<std::tuple<const void*, const void*, const void*, FrameFormat>, std::size_t> known;
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const ScenePacked& packed : primitive.packed) {
            PackedEntry& entry = entries.emplace_back(PackedEntry{&primitive, &packed});
            if (!entry.isCompared()) continue;
            const auto key =
                std::tuple(packed.words.data(), primitive.normals.data(), primitive.tangents.data(), packed.format);
            entry.comparison = known.try_emplace(key, known.size()).first->second;
        }
    }
    return entries;
}

std::vector<PackedErrors> compareAll(const Scene& scene, std::span<const PackedEntry> entries,
                                     const Execution& execution) {
    std::vector<const PackedEntry*> firsts;
    for (const PackedEntry& entry : entries) {
        if (entry.isCompared() && entry.comparison == firsts.size()) firsts.push_back(&entry);
    }
    std::vector<PackedErrors> errors(firsts.size());
    Parallel parallel(execution);
    workTogether(
        scene.memory.get(), firsts.size(), parallel, [](std::size_t) { return std::uint64_t{0}; },
        [&](std::size_t i) { errors[i] = comparePacked(*firsts[i]->primitive, *firsts[i]->packed); });
    return errors;
}

PackedFramesInfo infoOf(const PackedEntry& entry, const PackedErrors& errors) {
    return {.place = entry.place(),
            .attribute = entry.packed->attribute,
            .format = entry.packed->format,
            .mesh = entry.primitive->mesh,
            .primitive = entry.primitive->primitive,
            .vertex_count = entry.primitive->positions.size(),
            .is_readable = entry.packed->fault.empty(),
            .is_compared = entry.isCompared(),
            .worst_normal_deg = errors.normal_deg,
            .worst_tangent_deg = errors.tangent_deg,
            .differing_sign_count = errors.sign_count};
}

}  // namespace

PackedFindings checkPacked(const Scene& scene, const CheckOptions& options) {
    PackedFindings result;
    const std::vector<PackedEntry> entries = packedEntries(scene);
    const std::vector<PackedErrors> compared = compareAll(scene, entries, options.execution);
    for (const PackedEntry& entry : entries) {
        const PackedErrors errors = entry.isCompared() ? compared[entry.comparison] : PackedErrors{};
        const PackedFramesInfo& info = result.infos.emplace_back(infoOf(entry, errors));
        if (info.is_readable && errors.beyond.count == 0) continue;
        Finding& finding =
            result.findings.emplace_back(info.is_readable ? differingPacking(*entry.packed, errors)
                                                          : unreadablePacking(*entry.primitive, *entry.packed));
        placeAt(*entry.primitive, info.place, finding);
    }
    return result;
}

}  // namespace tspace
