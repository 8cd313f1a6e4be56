// SPDX-License-Identifier: MIT
// Reports of tspace generate as text.
#include <fmt/format.h>

#include <map>

#include "commands/generate/generate_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

const char* actionWords(PrimitiveAction action) {
    switch (action) {
        case PrimitiveAction::generated: return "generated";
        case PrimitiveAction::replaced: return "replaced";
        case PrimitiveAction::unchanged: return "same as before";
        case PrimitiveAction::kept: return "kept";
        case PrimitiveAction::notNeeded: return "not needed";
        case PrimitiveAction::notTriangles: return "no triangles";
        case PrimitiveAction::impossible: return "impossible";
        case PrimitiveAction::removed: return "removed";
    }
    return "unknown";
}

std::string actionsText(const Totals& totals) {
    std::string text;
    for (const PrimitiveAction action : kActions) {
        const std::uint64_t count = totals.actions[static_cast<std::size_t>(action)];
        if (count != 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, actionWords(action));
    }
    return fmt::format("{}{}{}", counted(totals.primitive_count, "primitive"), text.empty() ? "" : ": ", text);
}

std::string repairedText(const SanitizeReport& report) {
    std::string text;
    for (const NamedCount& cause : kCauses) {
        const std::uint64_t count = report.*cause.count;
        if (count != 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, cause.words);
    }
    return counted(report.mendedCount(), "corner") + (text.empty() ? "" : ": " + text);
}

std::string inputFaultsText(const Totals& totals) {
    std::string text;
    const auto add = [&text](std::uint64_t count, const char* words) {
        if (count != 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counted(count, "triangle"), words);
    };
    add(totals.degenerate_uv_count, "without UV area");
    add(totals.degenerate_triangle_count, "with two corners at one position");
    return text;
}

bool nothingNeeded(const Totals& totals) {
    return totals.primitive_count != 0 &&
           totals.actions[static_cast<std::size_t>(PrimitiveAction::notNeeded)] +
                   totals.actions[static_cast<std::size_t>(PrimitiveAction::notTriangles)] ==
               totals.primitive_count &&
           totals.actions[static_cast<std::size_t>(PrimitiveAction::notNeeded)] != 0;
}

std::vector<std::string> warningsOf(const GenerateReport& report, const Totals& totals) {
    std::vector<std::string> warnings = report.warnings;
    if (totals.morph_sign_flip_count != 0) {
        warnings.push_back(fmt::format("morph targets reverse the sign of the frame at {}, which glTF cannot express",
                                       counted(totals.morph_sign_flip_count, "corner")));
    }
    if (totals.reference_order_abandoned) {
        warnings.emplace_back(
            "the reference neighbor search would take quadratic time on this mesh, so the corrected search was used "
            "for the remaining part");
    }
    return warnings;
}

std::string imageText(std::uint32_t image, const std::string& name) {
    return name.empty() ? fmt::format("image {}", image) : fmt::format("'{}'", printable(name));
}

std::string convertedMapText(const ConvertedMapReport& map) {
    const std::string name =
        fmt::format("{} in {}", imageText(map.image, map.name), counted(map.primitive_count, "primitive"));
    if (!map.converted) return fmt::format("{}: unchanged: {}", name, printable(map.reason));
    return fmt::format("{}: converted with {} bits, mean error {:.2g} degrees (without conversion {:.2g})", name,
                       map.bits, map.mean_error_deg, map.mean_error_unconverted_deg);
}

std::string normalMapText(const NormalMapReport& map) {
    const std::string name = imageText(map.image, map.name);
    if (map.mended)
        return fmt::format("{}: rewritten: {}{}", name, printable(map.reason), map.flipped ? "; green inverted" : "");
    if (map.flipped) return name + ": green inverted";
    return fmt::format("{}: unchanged: {}", name, printable(map.reason));
}

std::string packedText(const Totals& totals) {
    std::string text = "frames of " + counted(totals.frames_packed, "primitive");
    if (totals.packed_repaired != 0) text += fmt::format(", {} repaired first", totals.packed_repaired);
    if (totals.tangents_dropped != 0) text += fmt::format("; TANGENT removed from {}", totals.tangents_dropped);
    if (totals.normals_dropped != 0) text += fmt::format(", NORMAL from {}", totals.normals_dropped);
    return text;
}

std::string windingText(const std::vector<MendedWindingReport>& windings) {
    WindingReport sum;
    for (const MendedWindingReport& mended : windings) {
        sum.face_count += mended.winding.face_count;
        sum.turned_count += mended.winding.turned_count;
        sum.turned_component_count += mended.winding.turned_component_count;
        sum.conflict_count_before += mended.winding.conflict_count_before;
        sum.conflict_count_after += mended.winding.conflict_count_after;
        sum.small_count += mended.winding.small_count;
        sum.one_sided_count += mended.winding.one_sided_count;
    }
    std::string text = fmt::format("{} of {} flipped", sum.turned_count, counted(sum.face_count, "face"));
    if (sum.turned_component_count != 0)
        text += fmt::format(", including most or all faces of {}", counted(sum.turned_component_count, "part"));
    text += fmt::format("; edges with inconsistent winding: {} before, {} after", sum.conflict_count_before,
                        sum.conflict_count_after);
    if (sum.one_sided_count != 0) text += fmt::format("; {} not orientable", counted(sum.one_sided_count, "part"));
    if (sum.conflict_count_after != 0 && sum.small_count != 0)
        text += fmt::format("; {} with fewer than 4 faces not flipped", counted(sum.small_count, "part"));
    return text;
}

std::string summaryRows(const GenerateOutcome& outcome, const Totals& totals) {
    const GenerateReport& report = *outcome.result;
    Table table;
    table.addRow({"tangents", actionsText(totals)});
    if (nothingNeeded(totals)) table.addRow({"hint", "no material needs tangents; use --all to add them anyway"});
    if (totals.triangle_count != 0) {
        table.addRow({"computed", "tangents on " + counted(totals.triangle_count, "triangle")});
        if (totals.on_quads != 0) {
            table.addRow({"faces", fmt::format("{} in {}, triangles elsewhere", counted(totals.quad_count, "quad"),
                                               counted(totals.on_quads, "primitive"))});
        }
        const std::uint64_t before = totals.vertices.before(), after = totals.vertices.after();
        const std::string change =
            before <= after ? fmt::format("{} split", after - before) : fmt::format("{} merged", before - after);
        table.addRow({"vertices", fmt::format("{} -> {} ({})", before, after, change)});
        const std::string faults = inputFaultsText(totals);
        if (!faults.empty()) table.addRow({"in the input", faults});
        table.addRow({"repaired", repairedText(totals.sanitize)});
    }
    if (!report.windings.empty()) table.addRow({"winding", windingText(report.windings)});
    if (totals.normals_generated != 0) {
        const std::string replaced =
            totals.normals_replaced == 0 ? "" : fmt::format(", {} of them recomputed", totals.normals_replaced);
        table.addRow({"normals", "generated for " + counted(totals.normals_generated, "primitive") + replaced});
    }
    if (totals.morph_normals_computed != 0)
        table.addRow({"morph targets", "normal deltas computed for " + std::to_string(totals.morph_normals_computed)});
    if (totals.bitangents_generated != 0)
        table.addRow({"bitangents", "written for " + counted(totals.bitangents_generated, "primitive")});
    if (totals.frames_packed != 0) table.addRow({"packed", packedText(totals)});
    if (totals.morph_deltas_computed != 0)
        table.addRow({"morph targets", "tangent deltas computed for " + std::to_string(totals.morph_deltas_computed)});
    for (const NormalMapReport& map : report.normal_maps) table.addRow({"normal map", normalMapText(map)});
    for (const ConvertedMapReport& map : report.converted_maps) table.addRow({"normal map", convertedMapText(map)});
    for (const std::string& warning : warningsOf(report, totals)) table.addRow({"warning", printable(warning)});
    table.addRow({"time", fmt::format("{:.2f} s", outcome.seconds)});
    const std::string first = report.output_files.empty() ? outcome.output : report.output_files.front();
    const std::string others = report.output_files.size() > 1
                                   ? fmt::format(" and {}", counted(report.output_files.size() - 1, "other file"))
                                   : "";
    table.addRow({outcome.is_dry_run ? "not written" : "written",
                  fmt::format("{}{} ({}){}", unbroken(first), others, byteText(report.output_bytes),
                              report.changed ? "" : ", a copy of the input")});
    return table.text("  ");
}

/// Returns the notes, which are printed below the table because they are long. Primitives with equal notes share one
/// line.
std::string notesText(const GenerateReport& report) {
    constexpr std::size_t kMaxNotes = 20;
    std::vector<std::pair<std::string, std::string>> notes;  // note, and the first primitive that has it
    std::map<std::string, std::size_t> line_of, others;
    for (const PrimitiveReport& primitive : report.primitives) {
        for (const std::string& note : primitive.notes) {
            const auto [line, is_new] = line_of.try_emplace(note, notes.size());
            if (is_new) {
                notes.emplace_back(note, fmt::format("mesh {}, primitive {}", primitive.mesh, primitive.primitive));
            } else {
                ++others[note];
            }
        }
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(notes.size(), kMaxNotes); ++i) {
        const auto& [note, who] = notes[i];
        const std::size_t more = others.count(note) == 0 ? 0 : others[note];
        text +=
            fmt::format("  note: {}{}: {}\n", who, more == 0 ? "" : fmt::format(" and {} more", more), printable(note));
    }
    for (const ConvertedMapReport& map : report.converted_maps) {
        for (const std::string& note : map.notes)
            text += fmt::format("  note: {}: {}\n", imageText(map.image, map.name), printable(note));
    }
    if (notes.size() > kMaxNotes)
        text += fmt::format("  note: {} (--json lists all)\n", counted(notes.size() - kMaxNotes, "more note"));
    return text.empty() ? text : "\n" + text;
}

/// Returns the number of triangles, and the number of quads that they were paired into.
std::string trianglesText(const PrimitiveReport& primitive) {
    const std::string count = std::to_string(primitive.triangle_count);
    return primitive.faces == Faces::quads ? fmt::format("{} ({} quads)", count, primitive.quad_count) : count;
}

std::string primitiveRows(const GenerateReport& report) {
    Table table;
    table.addRow({"mesh", "prim", "name", "material", "tangents", "UV set", "triangles", "vertices", "why"});
    for (const PrimitiveReport& primitive : report.primitives) {
        std::string vertices = std::to_string(primitive.vertices_before);
        const bool may_differ = wasComputed(primitive.action) || primitive.normals_generated;
        if (primitive.vertices_after != primitive.vertices_before && may_differ)
            vertices += fmt::format(" -> {}", primitive.vertices_after);
        table.addRow({std::to_string(primitive.mesh), std::to_string(primitive.primitive),
                      primitive.mesh_name.empty() ? "-" : printable(primitive.mesh_name),
                      primitive.material_name.empty() ? "-" : printable(primitive.material_name),
                      actionWords(primitive.action), primitive.uv_set < 0 ? "-" : std::to_string(primitive.uv_set),
                      trianglesText(primitive), vertices, printable(primitive.reason)});
    }
    return table.text("  ") + notesText(report);
}

}  // namespace

std::string generateText(const GenerateOutcome& outcome) {
    if (outcome.was_done_before) {
        return fmt::format("{} -> {}\n  skipped: already done, and nothing has changed\n\n", unbroken(outcome.input),
                           unbroken(outcome.output));
    }
    const Totals totals = totalsOf(*outcome.result);
    return fmt::format("{} -> {}\n{}\n{}\n", unbroken(outcome.input), unbroken(outcome.output),
                       summaryRows(outcome, totals), primitiveRows(*outcome.result));
}

std::string generateLine(const GenerateOutcome& outcome) {
    std::string line = fmt::format("{} -> {}: ", unbroken(outcome.input), unbroken(outcome.output));
    if (outcome.was_done_before) return line + "skipped: already done, and nothing has changed\n";
    const Totals totals = totalsOf(*outcome.result);
    line += actionsText(totals);
    if (outcome.is_dry_run) line += " (not written)";
    if (totals.sanitize.mendedCount() != 0) line += fmt::format("; repaired {}", repairedText(totals.sanitize));
    const std::size_t warnings = warningsOf(*outcome.result, totals).size();
    if (warnings != 0) line += fmt::format("; {} (--verbose shows them)", counted(warnings, "warning"));
    return line + "\n";
}

std::string generateSummary(const std::vector<GenerateOutcome>& outcomes, double seconds) {
    std::uint64_t done = 0;
    std::uint64_t skipped = 0;
    std::uint64_t triangles = 0;
    std::uint64_t mended = 0;
    Totals all;
    for (const GenerateOutcome& outcome : outcomes) {
        if (!outcome.result) continue;
        if (outcome.was_done_before) {
            ++skipped;
            continue;
        }
        const Totals totals = totalsOf(*outcome.result);
        ++done;
        triangles += totals.triangle_count;
        mended += totals.sanitize.mendedCount();
        all.primitive_count += totals.primitive_count;
        for (std::size_t i = 0; i < std::size(kActions); ++i) all.actions[i] += totals.actions[i];
    }
    const char* written = !outcomes.empty() && outcomes.front().is_dry_run ? "would be written" : "written";
    const std::string before = skipped == 0 ? "" : fmt::format("{} done before, ", skipped);
    return fmt::format("{} of {} {}, {}{} failed; {}, {} repaired, {:.2f} s\n  {}\n", done,
                       counted(outcomes.size(), "file"), written, before, outcomes.size() - done - skipped,
                       counted(triangles, "triangle"), counted(mended, "corner"), seconds, actionsText(all));
}

}  // namespace tspace::report
