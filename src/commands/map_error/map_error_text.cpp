// SPDX-License-Identifier: MIT
// Formats the error of a normal map and its best interpretation as text.
#include <fmt/format.h>

#include <algorithm>

#include "commands/bake/bake_report.h"
#include "commands/map_error/map_error_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

std::string readingText(const ExplainedReading& reading) {
    if (reading.frames == "object")
        return reading.axes == MapAxes{}     ? "object space"
               : reading.axes == kMapAxesZUp ? "object space, z up"
                                             : "object space, other axes";
    const std::string frames = reading.frames == "file"    ? "tangents of the file"
                               : reading.frames == "quads" ? "mikktspace on quads"
                                                           : reading.frames;
    return fmt::format("{}, green {}{}{}", frames, reading.reading.green == Green::up ? "up" : "down",
                       reading.reading.bitangent == BitangentPlace::perVertex ? ", bitangent per vertex" : "",
                       reading.reading.two_channels ? ", two channels" : "");
}

std::string raysText(const ExplainedRays& rays) {
    if (rays.rays.has_cage) return "the given cage";
    return fmt::format("{}, directions: {}, within {:.4g}", raysWord(rays.rays), directionsWord(rays.rays),
                       rays.error.reach);
}

}  // namespace

std::string mapErrorText(const Outcome<MapErrorFileReport>& outcome) {
    const MapErrorFileReport& done = *outcome.result;
    constexpr std::size_t kShown = 4;
    Table table;
    const MapError& error = done.error;
    table.addRow(
        {"error", fmt::format("mean {:.4f} degrees, 99th percentile {:.4f}, maximum {:.4f}; at seams mean {:.4f}",
                              error.mean_deg, error.p99_deg, error.max_deg, error.seam_mean_deg)});
    for (std::size_t i = 0; i < std::min(kShown, done.readings.size()); ++i)
        table.addRow({i == 0 ? "readings" : "", fmt::format("{:.4f} degrees: {}", done.readings[i].error.mean_deg,
                                                            readingText(done.readings[i]))});
    for (std::size_t i = 0; i < std::min(kShown, done.rays.size()); ++i)
        table.addRow({i == 0 ? "rays" : "",
                      fmt::format("{:.4f} degrees: {}", done.rays[i].error.mean_deg, raysText(done.rays[i]))});
    if (error.hidden_count > 0)
        table.addRow({"note", fmt::format("at {} of {} samples, another front face of the high poly lies farther out",
                                          error.hidden_count, error.missed_count + error.point_count)});
    if (error.missed_count > 0)
        table.addRow(
            {"note", fmt::format("the rays of {} of {} samples did not hit the high poly within {:.4g} model units; "
                                 "each counts as {:.0f} degrees",
                                 error.missed_count, error.missed_count + error.point_count, error.reach, kMissedDeg)});
    for (const BakedHighMap& map : done.high_maps) table.addRow({"high map", highMapText(map)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{}: {}\n{}", unbroken(outcome.input), done.verdict, table.text("  "));
}

std::string textureErrorText(const Outcome<TextureErrorReport>& outcome) {
    const TextureErrorReport& done = *outcome.result;
    Table table;
    table.addRow({"texture",
                  fmt::format("{}, {} x {}", done.format.empty() ? "an image" : done.format, done.width, done.height)});
    table.addRow({"error", fmt::format("mean {:.3g} degrees, 99th percentile {:.3g}, maximum {:.3g} (at texel {:.1f}, "
                                       "{:.1f}), of the filtered texture",
                                       done.mean_error_deg, done.p99_error_deg, done.max_error_deg, done.max_error_x,
                                       done.max_error_y)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{}\n{}", unbroken(outcome.input), table.text("  "));
}

}  // namespace tspace::report
