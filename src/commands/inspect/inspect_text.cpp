// SPDX-License-Identifier: MIT
// Reports of tspace inspect as text.
#include <fmt/format.h>

#include <set>

#include "commands/inspect/inspect_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::string listed(const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, ", ")); }

std::string needText(const PrimitiveInfo& primitive) {
    if (!primitive.needs_tangents) {
        return primitive.has_tangents        ? "not needed, but present"
               : primitive.tangents_not_read ? "not needed; not read"
                                             : "not needed";
    }
    return fmt::format("{} ({}{})",
                       primitive.has_tangents             ? "needed and present"
                       : !primitive.packed_frames.empty() ? "needed, only packed"
                       : primitive.tangents_not_read      ? "needed, not read"
                                                          : "needed, missing",
                       primitive.needed_by, primitive.tangent_uses[0].only_in_variant ? " of a variant" : "");
}

/// Describes a texture transform without its offset; empty: identity.
std::string transformText(const TangentUseInfo& use) {
    std::string text;
    if (use.uv_rotation_rad != 0) text += fmt::format(", rotated by {:.6g} degrees", use.uv_rotation_rad * 180 / kPi);
    if (use.uv_scale[0] != 1 || use.uv_scale[1] != 1)
        text += fmt::format(", scaled by ({:.6g}, {:.6g})", use.uv_scale[0], use.uv_scale[1]);
    return text;
}

/// Adds a row for each use, unless the row "tangents" already contains it.
void addUseRows(const PrimitiveInfo& primitive, Table& table) {
    const std::vector<TangentUseInfo>& uses = primitive.tangent_uses;
    if (uses.empty() || (uses.size() == 1 && transformText(uses[0]).empty())) return;
    for (const TangentUseInfo& use : uses) {
        table.addRow({&use == &uses[0] ? "needed for" : "",
                      fmt::format("{} of material {}{}: UV set {}{}{}", use.needed_by,
                                  use.material_name.empty() ? std::to_string(use.material)
                                                            : "'" + printable(use.material_name) + "'",
                                  use.only_in_variant ? " (a variant)" : "", use.uv_set, transformText(use),
                                  use.follows_first ? "" : "; needs different tangents than the first use")});
    }
}

std::string drawsText(const PrimitiveInfo& primitive) {
    std::string text = counted(primitive.node_count, "node");
    if (primitive.instance_count != primitive.node_count)
        text += fmt::format(", {}", counted(primitive.instance_count, "instance"));
    return text;
}

std::string summaryLine(const InspectOutcome& outcome) {
    const Inspection& file = *outcome.result;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t needed = 0;
    std::uint64_t missing = 0;
    std::set<std::uint32_t> lists;
    for (const PrimitiveInfo& primitive : file.primitives) {
        triangles += primitive.triangle_count;
        if (lists.insert(primitive.vertex_list).second) vertices += primitive.vertex_count;
        needed += primitive.needs_tangents;
        missing += primitive.needs_tangents && !primitive.has_tangents;
    }
    std::string tangents = "no primitive needs tangents";
    if (needed != 0) {
        tangents = fmt::format("{} {} tangents, {}", counted(needed, "primitive"), needed == 1 ? "needs" : "need",
                               missing == 0 ? "no primitive lacks them" : fmt::format("{} without", missing));
    }
    return fmt::format("{}: {}, {}, {}, {}; {}\n", unbroken(outcome.input),
                       counted(file.primitives.size(), "primitive"), counted(triangles, "triangle"),
                       counted(vertices, "vertex"), byteText(file.file_bytes), tangents);
}

std::string fileRows(const Inspection& file) {
    Table table;
    table.addRow({"format", file.generator.empty() ? file.format
                                                   : fmt::format("{}, by {}", file.format, printable(file.generator))});
    table.addRow({"contents", listed({counted(file.mesh_count, "mesh"), counted(file.material_count, "material"),
                                      counted(file.node_count, "node"), counted(file.animation_count, "animation"),
                                      counted(file.image_count, "image")})});
    if (!file.extensions_used.empty()) table.addRow({"extensions", printable(listed(file.extensions_used))});
    if (!file.variants.empty()) table.addRow({"variants", printable(listed(file.variants))});
    if (!file.extensions_required.empty()) table.addRow({"required", printable(listed(file.extensions_required))});
    for (const std::string& warning : file.warnings) table.addRow({"warning", printable(warning)});
    return table.text("  ");
}

std::string primitiveRows(const PrimitiveInfo& primitive) {
    Table table;
    const std::string name = primitive.mesh_name.empty() ? "" : fmt::format(" \"{}\"", printable(primitive.mesh_name));
    const std::string material =
        primitive.material_name.empty() ? "" : fmt::format(", material \"{}\"", printable(primitive.material_name));
    std::string geometry = fmt::format("{}, {}, indices {}", counted(primitive.triangle_count, "triangle"),
                                       counted(primitive.vertex_count, "vertex"), primitive.index_type);
    if (primitive.mode != "triangles") geometry += ", " + primitive.mode;
    if (primitive.skinned) geometry += ", skinned";
    if (primitive.compression != "none") geometry += ", compressed by " + primitive.compression;
    if (primitive.morph_target_count != 0) geometry += ", " + counted(primitive.morph_target_count, "morph target");
    table.addRow({"geometry", geometry});
    table.addRow({"attributes", printable(listed(primitive.attributes))});
    table.addRow({"tangents", needText(primitive)});
    if (!primitive.packed_frames.empty()) table.addRow({"packed", "frames as " + listed(packedNames(primitive))});
    addUseRows(primitive, table);
    if (primitive.variant_material_count != 0)
        table.addRow({"variants", counted(primitive.variant_material_count, "material")});
    if (primitive.node_count != 1 || primitive.instance_count != 1) table.addRow({"drawn by", drawsText(primitive)});
    if (primitive.uv_set >= 0) {
        std::string uvs = fmt::format("set {} of {}: {}", primitive.uv_set, primitive.uv_set_count,
                                      counted(primitive.uv_island_count, "island"));
        uvs += fmt::format(", {} mirrored", primitive.mirrored_island_count);
        uvs += fmt::format("; {} mirrored, {} without UV area", counted(primitive.mirrored_triangle_count, "triangle"),
                           primitive.degenerate_uv_count);
        table.addRow({"UVs", uvs});
    }
    if (primitive.degenerate_triangle_count != 0) {
        table.addRow(
            {"faults", counted(primitive.degenerate_triangle_count, "triangle") + " with two corners at one position"});
    }
    if (primitive.position_noise != 0) {
        table.addRow(
            {"positions", fmt::format("noisy ({:.2g} of an edge length); to compute normals without the noise: tspace "
                                      "generate --overwrite-normals --normals best --denoise auto",
                                      primitive.position_noise)});
    }
    return fmt::format("  mesh {}{}, primitive {}{}\n{}", primitive.mesh, name, primitive.primitive, material,
                       table.text("    "));
}

}  // namespace

std::string inspectText(const InspectOutcome& outcome) {
    std::string text = summaryLine(outcome) + fileRows(*outcome.result);
    for (const PrimitiveInfo& primitive : outcome.result->primitives)
        text += fmt::format("\n{}", primitiveRows(primitive));
    return text;
}

}  // namespace tspace::report
