// SPDX-License-Identifier: MIT
// Report of a baked map as text.
#include <fmt/format.h>

#include "commands/bake/bake_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

std::string degreesText(double degrees) { return fmt::format("{:.4f}", degrees); }

std::string raysText(const BakedFile& file) {
    const MapError& error = file.map.error;
    if (file.rays.has_cage) return fmt::format("from the cage to {:.4g} units below the low poly", error.reach);
    const std::string directions = directionsWord(file.rays);
    if (file.rays.target == RayTarget::nearest)
        return fmt::format("nearest front face within {:.4g} units; directions: {}", error.reach, directions);
    return fmt::format(
        "outermost front face, from a cage {:.4g} units above the low poly to {:.4g} units below it; directions: {}",
        error.cage_offset, error.reach, directions);
}

/// Returns the values mapped to black and white, or "" if the name of the layer implies them.
std::string rangeText(const BakedLayerFile& layer) {
    const auto& least = layer.least;
    const auto& most = layer.most;
    switch (layer.layer) {
        case MapLayer::height:
        case MapLayer::thickness: return fmt::format(", {:.4g} to {:.4g}", least[0], most[0]);
        case MapLayer::curvature: return fmt::format(", {:.4g} to {:.4g} per model unit", least[0], most[0]);
        case MapLayer::position:
            return fmt::format(", from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})", least[0], least[1],
                               least[2], most[0], most[1], most[2]);
        case MapLayer::id: return fmt::format(", {}", counted(layer.id_count, "id"));
        default: return layer.is_srgb ? ", sRGB" : "";
    }
}

void addFile(const BakedFile& file, Table& table) {
    const BakedMap& map = file.map;
    if (!file.path.empty())
        table.addRow(
            {"map", fmt::format("{}, {} x {}, {} bits", unbroken(file.path), map.width, map.height, map.bits)});
    for (const BakedLayerFile& layer : file.layers)
        table.addRow({layerName(layer.layer), fmt::format("{}, {} x {}, {} bits{}", unbroken(layer.path), map.width,
                                                          map.height, layer.bits, rangeText(layer))});
    table.addRow({"texels", fmt::format("{} baked, {} padding", map.hit_count, map.padding_count)});
    if (!file.path.empty())
        table.addRow({"error", fmt::format("mean {} degrees, 99th percentile {}, maximum {}; at seams mean {}",
                                           degreesText(map.error.mean_deg), degreesText(map.error.p99_deg),
                                           degreesText(map.error.max_deg), degreesText(map.error.seam_mean_deg))});
    if (map.own_error.point_count > 0)
        table.addRow({"", fmt::format("mean {} degrees, measured with the rays of the bake",
                                      degreesText(map.own_error.mean_deg))});
    table.addRow({"rays", raysText(file)});
    if (map.error.missed_count > 0)
        table.addRow({"note", fmt::format("the rays of {} of {} error samples did not hit the high poly; each counts "
                                          "as {:.0f} degrees, and the mean error of the others is {} degrees",
                                          map.error.missed_count, map.error.missed_count + map.error.point_count,
                                          kMissedDeg, degreesText(map.error.met_mean_deg))});
    if (map.missed_count > 0)
        table.addRow(
            {"warning", fmt::format("{} whose ray did not hit the high poly {} filled from neighbors; use a larger "
                                    "--reach to search farther, or --misses to write a picture that shows these texels",
                                    counted(map.missed_count, "texel"), map.missed_count == 1 ? "is" : "are")});
    if (map.overlap_count > 0)
        table.addRow({map.conflict_count > 0 ? "warning" : "note",
                      fmt::format("{} shared by several triangles{}", counted(map.overlap_count, "texel"),
                                  map.conflict_count > 0
                                      ? fmt::format(", which need different normals in {} of them: mean difference "
                                                    "{:.1f} degrees, maximum {:.1f}; --overlap selects the normal",
                                                    map.conflict_count, map.conflict_mean_deg, map.conflict_max_deg)
                                      : std::string())});
    if (map.degenerate_uv_count > 0)
        table.addRow({"note", fmt::format("{} without UV area, or with UVs that are not finite, ignored",
                                          counted(map.degenerate_uv_count, "triangle"))});
}

}  // namespace

std::string highMapText(const BakedHighMap& map) {
    return fmt::format("{}, scale {:.4g}, green {} ({})", unbroken(map.image), map.scale,
                       map.green == Green::down ? "down" : "up", greenSourceWord(map.green_is));
}

void addBakedRows(const BakeFileReport& done, const std::string& out_mesh, Table& table) {
    for (const BakedFile& file : done.files) {
        if (file.map.hit_count > 0) addFile(file, table);
    }
    for (const BakedHighMap& map : done.high_maps) table.addRow({"high map", highMapText(map)});
    for (const std::string& finding : done.findings) table.addRow({"finding", printable(finding)});
    if (!out_mesh.empty() && !done.output_files.empty())
        table.addRow({"model", fmt::format("{}, with its frames and maps", unbroken(out_mesh))});
    if (done.frames_made)
        table.addRow({"note", "missing tangent frames of the low poly were computed, as by tspace generate"});
    if (done.matched_by_name) table.addRow({"note", "low-poly and high-poly meshes were matched by name"});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
}

std::string bakeText(const Outcome<BakeFileReport>& outcome, const std::string& out_mesh) {
    Table table;
    addBakedRows(*outcome.result, out_mesh, table);
    return fmt::format("{} -> {}\n{}", unbroken(outcome.input), unbroken(outcome.output), table.text("  "));
}

std::string bakeLine(const Outcome<BakeFileReport>& outcome) {
    std::string line = fmt::format("{} -> {}: ", unbroken(outcome.input), unbroken(outcome.output));
    if (outcome.was_done_before) return line + "skipped: already done, and nothing has changed\n";
    const BakeFileReport& done = *outcome.result;
    if (done.output_files.empty()) return line + "nothing was written\n";
    line += counted(done.output_files.size(), "file");
    if (!done.files.empty() && !done.files.front().path.empty())
        line += fmt::format(", error mean {} degrees", degreesText(done.files.front().map.error.mean_deg));
    if (!done.findings.empty()) line += "; " + counted(done.findings.size(), "finding");
    if (!done.warnings.empty()) line += "; " + counted(done.warnings.size(), "warning");
    return line + (done.findings.empty() && done.warnings.empty() ? "\n" : " (--verbose shows them)\n");
}

}  // namespace tspace::report
