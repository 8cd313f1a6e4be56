// SPDX-License-Identifier: MIT
#include "commands/diff/diff_report.h"

#include <algorithm>
#include <charconv>

#include "commands/shared/report.h"

namespace tspace::report {
namespace {

std::string spelled(double value, std::chars_format format, int digits) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, format, digits);
    return end.ec == std::errc() ? std::string(text, end.ptr) : std::string("?");
}

/// Formats an angle with two decimals, or four if it is below 0.1.
std::string degrees(double value) {
    return spelled(value, std::chars_format::fixed, value != 0 && value < 0.1 ? 4 : 2);
}

/// Returns a sentence on files whose tangents the importer cannot read, or "" if there are none.
std::string notReadText(const std::string& a, const std::string& b, const FrameDiff& diff) {
    const auto any = [&](bool PrimitiveDiff::*not_read) {
        return std::any_of(diff.primitives.begin(), diff.primitives.end(), [&](const auto& p) { return p.*not_read; });
    };
    const bool in_a = any(&PrimitiveDiff::tangents_not_read_a), in_b = any(&PrimitiveDiff::tangents_not_read_b);
    if (!in_a && !in_b) return "";
    const std::string files = in_a && in_b ? "either file" : in_a ? a : b;
    return "the tangents of " + files +
           ", if any, were not read, because the importer does not support them in this format";
}

void addSentences(const std::string& a, const std::string& b, const FrameDiff& diff, DiffWords& words) {
    words.summary = a + " against " + b + ": ";
    const std::string not_read = notReadText(a, b, diff);
    if (diff.corner_count == 0) {
        words.summary += "no triangle of one model matches a triangle of the other";
    } else if (diff.tangents.count + diff.tangents.unusable_count == 0) {
        words.summary += not_read.empty() ? "no primitive has tangents in both models" : not_read;
    } else if (diff.isWithin(0)) {
        words.summary += "equal frames at all " + counted(diff.corner_count, "corner");
    } else {
        words.summary += "tangents differ by " + degrees(diff.tangents.median_deg) + " degrees at the median corner, " +
                         degrees(diff.tangents.max_deg) + " at most";
        if (diff.sign_change_count != 0) {
            words.summary += "; " + std::to_string(diff.sign_change_count) + " of " +
                             std::to_string(diff.tangents.count) + " signs differ";
        }
        if (!not_read.empty()) words.remarks.push_back(not_read);
    }
    if (diff.unpaired_triangle_count != 0)
        words.remarks.push_back(counted(diff.unpaired_triangle_count, "triangle") + " without a match");
    if (diff.missing_count != 0 && not_read.empty())
        words.remarks.push_back(counted(diff.missing_count, "primitive") + " with tangents in only one file");
    for (const std::string& warning : diff.warnings) words.remarks.push_back("warning: " + warning);
}

void addAngles(TextTable& table, const char* name, const AngleStatistics& angles) {
    if (angles.count == 0) return;
    table.push_back({name, std::to_string(angles.count), degrees(angles.mean_deg), degrees(angles.median_deg),
                     degrees(angles.p95_deg), degrees(angles.max_deg), std::to_string(angles.unusable_count)});
}

std::string placeText(const PrimitiveDiff& primitive) {
    const bool in_a = !primitive.place_a.empty();
    const auto place = [](std::uint32_t mesh, std::uint32_t number) {
        return std::to_string(mesh) + ":" + std::to_string(number);
    };
    const std::string a = place(primitive.mesh_a, primitive.primitive_a),
                      b = place(primitive.mesh_b, primitive.primitive_b);
    if (!in_a) return "only in B " + b;
    return primitive.place_b.empty() ? "only in A " + a : a + " = " + b;
}

TextTable primitiveTable(const FrameDiff& diff) {
    TextTable table{{"primitive", "name", "paired by", "triangles", "paired", "T median", "T 95 %", "T max", "signs",
                     "N max", "B max"}};
    for (const PrimitiveDiff& primitive : diff.primitives) {
        const bool both = primitive.has_tangents_a && primitive.has_tangents_b;
        const auto angle = [&](bool there, double value) { return there ? degrees(value) : std::string("-"); };
        const bool normals = primitive.normals.count != 0;
        table.push_back(
            {placeText(primitive), primitive.mesh_name.empty() ? "-" : primitive.mesh_name, primitive.paired_by,
             std::to_string(std::max(primitive.triangle_count_a, primitive.triangle_count_b)),
             std::to_string(primitive.paired_triangle_count), angle(both, primitive.tangents.median_deg),
             angle(both, primitive.tangents.p95_deg), angle(both, primitive.tangents.max_deg),
             both ? std::to_string(primitive.sign_change_count) : "-", angle(normals, primitive.normals.max_deg),
             angle(both && normals, primitive.bitangents.max_deg)});
    }
    return table;
}

TextTable worstTable(const FrameDiff& diff) {
    if (diff.worst.empty()) return {};
    TextTable table{{"worst", "vertex A", "vertex B", "T", "N", "B", "sign", "position"}};
    for (const FrameDifference& place : diff.worst) {
        const auto coordinate = [](float value) { return spelled(value, std::chars_format::general, 4); };
        table.push_back(
            {std::to_string(place.mesh_a) + ":" + std::to_string(place.primitive_a), std::to_string(place.vertex_a),
             std::to_string(place.vertex_b), degrees(place.tangent_deg), degrees(place.normal_deg),
             degrees(place.bitangent_deg), place.sign_differs ? "differs" : "same",
             coordinate(place.position.x) + " " + coordinate(place.position.y) + " " + coordinate(place.position.z)});
    }
    return table;
}

}  // namespace

std::string binText(std::size_t bin) {
    return (bin + 1 == kAngleBins.size() ? "to " : "up to ") + spelled(kAngleBins[bin], std::chars_format::general, 6);
}

DiffWords diffWords(const std::string& a, const std::string& b, const FrameDiff& diff) {
    DiffWords words;
    addSentences(a, b, diff, words);
    words.angles.push_back({"angles", "corners", "mean", "median", "95 %", "max", "unusable"});
    addAngles(words.angles, "T", diff.tangents);
    addAngles(words.angles, "N", diff.normals);
    addAngles(words.angles, "B", diff.bitangents);
    words.primitives = primitiveTable(diff);
    words.worst = worstTable(diff);
    return words;
}

}  // namespace tspace::report
