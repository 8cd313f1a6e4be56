// SPDX-License-Identifier: MIT
// Results of tspace diff as text.
#include <fmt/format.h>

#include <algorithm>
#include "console.h"
#include "report.h"

namespace tspace::tool {
namespace {

/// Few digits, and as many as a small angle needs.
std::string degrees(double value) { return fmt::format("{:.{}f}", value, value != 0 && value < 0.1 ? 4 : 2); }

/// "" or a sentence on files whose importer cannot give tangents.
std::string notReadText(const DiffArguments& arguments, const FrameDiff& diff) {
    const auto any = [&](bool PrimitiveDiff::*not_read) {
        return std::any_of(diff.primitives.begin(), diff.primitives.end(), [&](const auto& p) { return p.*not_read; });
    };
    const bool in_a = any(&PrimitiveDiff::tangents_not_read_a), in_b = any(&PrimitiveDiff::tangents_not_read_b);
    if (!in_a && !in_b) return "";
    const std::string files = in_a && in_b ? "either file" : printable(in_a ? arguments.a : arguments.b);
    return "the tangents of " + files + ", if it has any, were not read: the importer cannot give them\n";
}

std::string summary(const DiffArguments& arguments, const FrameDiff& diff) {
    const bool has_tangents = diff.tangents.count + diff.tangents.unusable_count != 0;
    std::string text = fmt::format("{} against {}: ", printable(arguments.a), printable(arguments.b));
    if (diff.corner_count == 0) return text + "no triangle of one is in the other\n";
    const std::string not_read = notReadText(arguments, diff);
    if (!has_tangents) return text + (not_read.empty() ? "no primitive has tangents in both\n" : not_read);
    const bool equal = diff.isWithin(0);
    if (equal) return text + fmt::format("equal frames at all {}\n", counted(diff.corner_count, "corner"));
    text += fmt::format("tangents differ by {} degrees at half of the corners, {} at most",
                        degrees(diff.tangents.median_deg), degrees(diff.tangents.max_deg));
    if (diff.sign_change_count != 0) {
        text += fmt::format("; {} of {} signs differ", diff.sign_change_count, diff.tangents.count);
    }
    return text + "\n" + (not_read.empty() ? "" : "  " + not_read);
}

void addAngles(Table& table, const char* name, const AngleStatistics& angles) {
    if (angles.count == 0) return;
    table.addRow({name, std::to_string(angles.count), degrees(angles.mean_deg), degrees(angles.median_deg),
                  degrees(angles.p95_deg), degrees(angles.max_deg), std::to_string(angles.unusable_count)});
}

std::string angleTable(const FrameDiff& diff) {
    Table table;
    table.addRow({"angles", "corners", "mean", "median", "95 %", "max", "unusable"});
    addAngles(table, "T", diff.tangents);
    addAngles(table, "N", diff.normals);
    addAngles(table, "B", diff.bitangents);
    return table.text("  ");
}

std::string bar(std::uint64_t count, std::uint64_t most) {
    constexpr std::uint64_t kColumns = 40;
    if (count == 0) return "";
    return std::string(std::max<std::uint64_t>(1, count * kColumns / most), '#');
}

std::string histogramText(const AngleStatistics& tangents) {
    if (tangents.count == 0) return "";
    const std::uint64_t most = *std::max_element(tangents.histogram.begin(), tangents.histogram.end());
    Table table;
    for (std::size_t i = 0; i < kAngleBins.size(); ++i) {
        const std::string range = fmt::format("{} {:g}", i + 1 == kAngleBins.size() ? "to" : "up to", kAngleBins[i]);
        table.addRow({range, std::to_string(tangents.histogram[i]), bar(tangents.histogram[i], most)});
    }
    return "  T, degrees and corners\n" + table.text("    ");
}

std::string placeText(const PrimitiveDiff& primitive) {
    const bool in_a = !primitive.place_a.empty();
    const std::string place = fmt::format("{}:{}", in_a ? primitive.mesh_a : primitive.mesh_b,
                                          in_a ? primitive.primitive_a : primitive.primitive_b);
    if (!in_a) return "only in B " + place;
    return primitive.place_b.empty() ? "only in A " + place
                                     : fmt::format("{} = {}:{}", place, primitive.mesh_b, primitive.primitive_b);
}

std::string primitiveTable(const FrameDiff& diff) {
    Table table;
    table.addRow({"primitive", "name", "paired by", "triangles", "paired", "T median", "T 95 %", "T max", "signs",
                  "N max", "B max"});
    for (const PrimitiveDiff& primitive : diff.primitives) {
        const bool both = primitive.has_tangents_a && primitive.has_tangents_b;
        const auto angle = [&](bool there, double value) { return there ? degrees(value) : std::string("-"); };
        const bool normals = primitive.normals.count != 0;
        table.addRow({placeText(primitive), primitive.mesh_name.empty() ? "-" : printable(primitive.mesh_name),
                      primitive.paired_by,
                      std::to_string(std::max(primitive.triangle_count_a, primitive.triangle_count_b)),
                      std::to_string(primitive.paired_triangle_count), angle(both, primitive.tangents.median_deg),
                      angle(both, primitive.tangents.p95_deg), angle(both, primitive.tangents.max_deg),
                      both ? std::to_string(primitive.sign_change_count) : "-",
                      angle(normals, primitive.normals.max_deg), angle(both && normals, primitive.bitangents.max_deg)});
    }
    return table.text("  ");
}

std::string worstTable(const FrameDiff& diff) {
    if (diff.worst.empty()) return "";
    Table table;
    table.addRow({"worst", "vertex A", "vertex B", "T", "N", "B", "sign", "position"});
    for (const FrameDifference& place : diff.worst) {
        table.addRow({fmt::format("{}:{}", place.mesh_a, place.primitive_a), std::to_string(place.vertex_a),
                      std::to_string(place.vertex_b), degrees(place.tangent_deg), degrees(place.normal_deg),
                      degrees(place.bitangent_deg), place.sign_differs ? "differs" : "same",
                      fmt::format("{:.4g} {:.4g} {:.4g}", place.position.x, place.position.y, place.position.z)});
    }
    return table.text("  ");
}

}  // namespace

std::string diffText(const DiffArguments& arguments, const FrameDiff& diff) {
    std::string text = summary(arguments, diff);
    if (diff.unpaired_triangle_count != 0) {
        text += fmt::format("  {} without a partner\n", counted(diff.unpaired_triangle_count, "triangle"));
    }
    if (diff.missing_count != 0 && notReadText(arguments, diff).empty()) {
        text += fmt::format("  {} with tangents in one file only\n", counted(diff.missing_count, "primitive"));
    }
    for (const std::string& part :
         {angleTable(diff), histogramText(diff.tangents), primitiveTable(diff), worstTable(diff)}) {
        if (!part.empty()) text.append("\n").append(part);
    }
    return text;
}

}  // namespace tspace::tool
