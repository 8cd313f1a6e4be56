// SPDX-License-Identifier: MIT
// Reports of tspace identify as text.
#include <fmt/format.h>

#include "commands/identify/identify_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

std::string percent(std::uint64_t count, std::uint64_t total) {
    if (total == 0) return "-";
    return fmt::format("{:.1f} %", 100 * static_cast<double>(count) / static_cast<double>(total));
}

const char* signWords(SignReading reading) {
    switch (reading) {
        case SignReading::gltf: return "as in glTF";
        case SignReading::inverted: return "inverted";
        case SignReading::mixed: return "mixed";
        case SignReading::none: break;
    }
    return "-";
}

std::string methodWords(const Explanation& entry) {
    return std::string(methodName(entry.method)) + (entry.faces == Faces::quads ? " on quads" : "");
}

std::string methodTable(const Identification& result) {
    Table table;
    table.addRow({"method", "near", "near at vertex", "mean angle", "signs as glTF", "signs inverted"});
    for (const Explanation& entry : result.explanations) {
        table.addRow({methodWords(entry), percent(entry.near_count, entry.corner_count),
                      percent(entry.near_any_count, entry.corner_count), fmt::format("{:.2f}", entry.mean_deg),
                      percent(entry.gltf_sign_count, entry.corner_count),
                      percent(entry.inverted_sign_count, entry.corner_count)});
    }
    return table.text("  ");
}

std::string remarkOn(const PrimitiveIdentity& primitive) {
    const Explanation& best = primitive.explanations.front();
    if (!best.is_textures_set) return "not the texture's UV set";
    if (!primitive.has_two_readings) return "";
    return best.is_transformed ? "after the texture transform" : "before the texture transform";
}

std::string primitiveTable(const Identification& result) {
    Table table;
    table.addRow({"mesh", "prim", "name", "material", "best method", "UV set", "near", "at vertex", "signs", ""});
    for (const PrimitiveIdentity& primitive : result.primitives) {
        std::vector<std::string> row = {std::to_string(primitive.mesh), std::to_string(primitive.primitive),
                                        primitive.mesh_name.empty() ? "-" : printable(primitive.mesh_name),
                                        primitive.material_name.empty() ? "-" : printable(primitive.material_name)};
        if (primitive.explanations.empty()) {
            for (const char* cell : {"-", "-", "-", "-", "-"}) row.emplace_back(cell);
            row.push_back(primitive.skipped);
        } else {
            const Explanation& best = primitive.explanations.front();
            row.insert(row.end(),
                       {methodWords(best), std::to_string(best.uv_set), percent(best.near_count, best.corner_count),
                        percent(best.near_any_count, best.corner_count), signWords(best.signs()), remarkOn(primitive)});
        }
        table.addRow(std::move(row));
    }
    return table.text("  ");
}

}  // namespace

std::string identifyText(const IdentifyOutcome& outcome) {
    const Identification& result = *outcome.result;
    std::string text = fmt::format("{}: {}\n", unbroken(outcome.input), result.verdict);
    for (const std::string& warning : result.warnings) text += "  warning: " + printable(warning) + "\n";
    if (!result.explanations.empty()) text.append("\n").append(methodTable(result));
    if (!result.primitives.empty()) text.append("\n").append(primitiveTable(result));
    return text;
}

}  // namespace tspace::report
