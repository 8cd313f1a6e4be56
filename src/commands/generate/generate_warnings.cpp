// SPDX-License-Identifier: MIT
// Totals over primitives, and warnings.
#include "commands/generate/generate_steps.h"

#include <algorithm>
#include <string>
#include <vector>

#include "commands/generate/generate_report.h"
#include "core/base/numbers.h"

namespace tspace {
namespace {

using report::counted;

bool wasComputed(const PrimitiveReport& primitive) { return report::wasComputed(primitive.action); }

}  // namespace

void warnOfWinding(const GenerateOptions& options, GenerateReport& report) {
    std::uint64_t turned = 0, two_sided = 0, behind = 0, triangles = 0;
    report::VertexTotals vertices;
    for (const PrimitiveReport& primitive : report.primitives) {
        turned += primitive.turned_triangle_count;
        two_sided += primitive.two_sided_triangle_count;
        behind += primitive.normals_behind_count;
        if (primitive.turned_triangle_count == 0) continue;
        triangles += primitive.triangle_count;
        vertices.add(primitive);
    }
    if (turned != 0) {
        std::string text =
            std::to_string(turned) + " of " + counted(triangles, "triangle") +
            (turned == 1 ? " is wound opposite to its neighbors" : " are wound opposite to their neighbors");
        if (vertices.after() > vertices.before())
            text += ", so vertices between them were split (" + std::to_string(vertices.before()) + " -> " +
                    std::to_string(vertices.after()) + ")";
        if (!options.mend_winding)
            text += std::string("; use --fix-winding to flip ") + (turned == 1 ? "this triangle" : "these triangles");
        report.warnings.push_back(text);
    }
    if (two_sided != 0) {
        const bool makes = std::any_of(report.primitives.begin(), report.primitives.end(),
                                       [](const PrimitiveReport& primitive) { return primitive.normals_generated; });
        report.warnings.push_back(counted(two_sided, "triangle") + (two_sided == 1 ? " coincides" : " coincide") +
                                  " with triangles of the opposite winding (two-sided sheets)" +
                                  (makes ? ", so smooth normals over both sides cancel out" : ""));
    }
    if (behind != 0) {
        report.warnings.push_back(counted(behind, "corner") + (behind == 1 ? " has" : " have") +
                                  " a new normal that points to the back of its triangle");
    }
}

namespace {

/// Adds a warning such as "--a has no effect: <why>" or "--a and --b have no effect: <why>".
void warn(const std::vector<std::string>& options, const std::string& why, GenerateReport& report) {
    if (options.empty()) return;
    std::string text;
    for (std::size_t i = 0; i < options.size(); ++i)
        text += (i == 0 ? "" : i + 1 == options.size() ? " and " : ", ") + options[i];
    report.warnings.push_back(text + (options.size() == 1 ? " has" : " have") + " no effect: " + why);
}

template <class Test>
bool any(const GenerateReport& report, const Test& test) {
    return std::any_of(report.primitives.begin(), report.primitives.end(), test);
}

/// Adds notes on the values that were chosen per mesh.
void noteFoundValues(const NormalOptions& options, GenerateReport& report) {
    for (PrimitiveReport& primitive : report.primitives) {
        if (!primitive.normals_generated) continue;
        const NormalReport& normals = primitive.normals;
        if (options.crease_angle_deg == NormalOptions::crease_auto && options.weighting != NormalWeighting::flat)
            primitive.notes.push_back("edges sharper than " + shortNumber(normals.crease_angle_deg) +
                                      " degrees are hard (--crease auto)");
        if (normals.noise > 0)
            primitive.notes.push_back("its positions are noisy (" + shortNumber(normals.noise) +
                                      " of an edge length), so normals were computed without the noise (--denoise)");
    }
}

void warnOfNoise(const GenerateOptions& options, bool any_made, GenerateReport& report) {
    if (options.normals.compute.denoise == 0 || !any_made) return;
    const bool any_denoised = any(report, [](const auto& primitive) { return primitive.normals.noise > 0; });
    if (options.normals.compute.weighting != NormalWeighting::best)
        warn({"--denoise"}, "it only applies to --normals best", report);
    else if (!any_denoised)
        warn({"--denoise"}, "no positions are noisy", report);
}

void warnOfIdleNormals(const GenerateOptions& options, GenerateReport& report) {
    const GenerateOptions plain;
    std::vector<std::string> idle;
    const bool any_made = any(report, [](const auto& primitive) { return primitive.normals_generated; });
    if (!any_made) {
        if (options.normals.overwrite) idle.emplace_back("--overwrite-normals");
        const bool has_crease = options.normals.compute.crease_angle_deg != plain.normals.compute.crease_angle_deg;
        // --crease without --normals implies --normals angle, unless smoothing groups are changed.
        const bool follows = has_crease && options.normals.compute.weighting == NormalWeighting::angle &&
                             options.normals.use_smoothing_groups == plain.normals.use_smoothing_groups;
        const bool is_weighted = options.normals.compute.weighting != plain.normals.compute.weighting && !follows;
        if (is_weighted && !options.normals.overwrite) idle.emplace_back("--normals");
        if (has_crease) idle.emplace_back("--crease");
        if (options.normals.compute.denoise != 0) idle.emplace_back("--denoise");
        if (options.normals.per_primitive) idle.emplace_back("--normals-per-primitive");
        warn(idle,
             options.normals.overwrite ? "the file has no primitive whose normals can be recomputed"
                                       : "no normals were computed; --overwrite-normals recomputes existing ones",
             report);
    }
    warnOfNoise(options, any_made, report);
    const bool morphs = any(report, [](const auto& primitive) { return primitive.morph_normals_computed != 0; });
    if (options.normals.morphs != MorphNormals::keep && !morphs) {
        const bool any_target = any(report, [](const auto& primitive) { return primitive.morph_target_count != 0; });
        warn({"--morph-normals"},
             any_target ? "no morph target without normal deltas moves a primitive whose normals were kept"
                        : "the file has no morph targets",
             report);
    }
}

void warnOfTangents(const GenerateOptions& options, GenerateReport& report) {
    const bool any_made = any(report, [](const auto& primitive) {
        return wasComputed(primitive) || primitive.morph_deltas_computed != 0 || primitive.mended_vertex_count != 0;
    });
    if (any(report, wasComputed) && options.tangents.compute.method == Method::basis) {
        report.warnings.emplace_back(
            "tangents of the method basis do not follow the UVs, so normal maps are shaded incorrectly, and check "
            "reports this");
    }
    const TangentOptions plain, &tangents = options.tangents.compute;
    const bool any_normals = any(report, [](const auto& primitive) { return primitive.normals_generated; });
    const bool refines_normals = any_normals && options.normals.compute.weighting == NormalWeighting::best;
    const bool has_refine = tangents.refine != plain.refine && !refines_normals;
    if (any_made) {
        if (has_refine && tangents.method != Method::best)
            warn({"--refine"}, "it only applies to --method best", report);
        return;
    }
    std::vector<std::string> idle;
    if (tangents.method != plain.method) idle.emplace_back("--method");
    if (tangents.frame != plain.frame) idle.emplace_back("--frame");
    if (tangents.pairing != plain.pairing) idle.emplace_back("--pairing");
    if (tangents.angular_threshold_deg != plain.angular_threshold_deg) idle.emplace_back("--threshold");
    if (options.tangents.faces == Faces::quads) idle.emplace_back("--faces");
    if (has_refine) idle.emplace_back("--refine");
    // A repair also judges the existing tangents by the convention, so the option has an effect.
    if (tangents.convention != GenerateOptions{}.tangents.compute.convention &&
        options.selection.existing != ExistingTangents::repair)
        idle.emplace_back("--convention");
    if (options.tangents.bitangents) idle.emplace_back("--bitangents");
    if (!options.tangents.sanitize) idle.emplace_back("--no-sanitize");
    if (options.tangents.sanitize_options.orthogonalize_all) idle.emplace_back("--orthogonalize");
    if (options.storage.format != GenerateOptions{}.storage.format && !any_normals) idle.emplace_back("--format");
    const bool any_kept = any(report, [](const auto& primitive) { return primitive.action == PrimitiveAction::kept; });
    warn(idle, any_kept ? "no tangents were computed, and existing ones were kept" : "no tangents were computed",
         report);
}

void warnOfFile(const GenerateOptions& options, const OptionEffects& effects, GenerateReport& report) {
    if (options.tangents.texture_transform != GenerateOptions{}.tangents.texture_transform &&
        !effects.texture_transforms)
        warn({"--texture-transform"}, "no computed tangents are used by a texture with KHR_texture_transform", report);
    if (options.storage.compression != Compression::keep && !effects.compression)
        warn({"--compress"},
             options.storage.compression == Compression::none
                 ? "no geometry is compressed"
                 : "the geometry already has this compression, or cannot be compressed",
             report);
    if (options.file.keep_coordinates && !effects.far_coordinates)
        warn({"--keep-coordinates"}, "the coordinates need no offset", report);
}

}  // namespace

void addWarnings(const GenerateOptions& options, const OptionEffects& effects, bool is_step, GenerateReport& report) {
    noteFoundValues(options.normals.compute, report);
    if (is_step) return;
    warnOfWinding(options, report);
    if (report.primitives.empty()) return;
    warnOfIdleNormals(options, report);
    warnOfTangents(options, report);
    warnOfFile(options, effects, report);
    if (options.maps.flip_green != FlipGreen::none && report.normal_maps.empty())
        warn({options.maps.flip_green == FlipGreen::all ? "--flip-green-all" : "--flip-green"},
             "the file has no normal map", report);
    if (options.maps.mend && report.normal_maps.empty()) warn({"--fix-maps"}, "the file has no normal map", report);
    if (!options.maps.read && options.selection.existing != ExistingTangents::repair)
        warn({"--no-images"}, "only --repair and options that change maps read the pixels of normal maps", report);
    const bool any_turned = any(report, [](const auto& primitive) { return primitive.winding_mended_count != 0; });
    if (options.mend_winding && !any_turned)
        warn({"--fix-winding"}, "no triangle with wrong winding was detected", report);
    const bool any_stripped =
        any(report, [](const auto& primitive) { return primitive.action == PrimitiveAction::removed; });
    if (options.selection.strip && !any_stripped)
        warn({"--strip"}, "the file has no tangents, or its materials need all of them", report);
    if (options.maps.convert && report.converted_maps.empty())
        warn({"--convert-maps"}, "no primitive with a normal map got different tangents", report);
}

}  // namespace tspace
