// SPDX-License-Identifier: MIT
// Options of tspace finish.
#include <algorithm>
#include <iterator>
#include <string_view>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<FinishNormals> kFinishNormals[] = {
    {"missing", FinishNormals::missing}, {"all", FinishNormals::all}, {"none", FinishNormals::none}};

/// Options of bake that finish also supports.
constexpr std::string_view kBakes[] = {"--match",
                                       "--maps",
                                       "--samples",
                                       "--ao-distance",
                                       "--height-range",
                                       "--curvature-range",
                                       "--thickness-range",
                                       "--id",
                                       "--size",
                                       "--bits",
                                       "--padding",
                                       "--overlap",
                                       "--wrap",
                                       "--high-green",
                                       "--ignore-high-maps",
                                       "--rays",
                                       "--directions",
                                       "--cage-offset",
                                       "--reach"};

}  // namespace

OptionList finishOptions(FinishOptions& options) {
    OptionList list;
    const auto add = adder(list, "Normals"), addRepair = adder(list, "Repair");
    options::add(list, kInputAndOutput,
                 fileOption("--low", "LOW", options.low,
                            "Low-poly model with UVs, aligned with IN. It is repaired in the same way, all maps are "
                            "baked onto it from IN, and OUT is the low poly with its maps.",
                            InputKind::model));
    addAllowExternal(list, options.file);
    addKeepCoordinates(list, options.file);
    add(choice("--normals", "WHICH", kFinishNormals, options.normals,
               "Normals to recompute, with the method of generate --normals best. missing: missing normals and normals "
               "that check reports as errors; all: every normal; none: keep all existing normals, and compute missing "
               "ones only if tangents require them."));
    add(numberOrAuto(
        "--crease", "DEG", "a number of degrees", options.crease_angle_deg, NormalOptions::crease_auto, 180,
        "Crease angle for recomputed normals of IN: edges whose faces meet at a larger angle stay hard. In "
        "degrees, 0 to 180; 180: no hard edges; auto: an angle chosen per mesh, which the report states."));
    add(numberOrAuto("--denoise", "FACTOR", "a number", options.denoise, NormalOptions::denoise_auto, 4,
                     "Denoising for recomputed normals on noisy positions, such as scans: normals are computed from a "
                     "larger neighborhood. auto: strength from the measured noise level, or off if the deviations look "
                     "like real detail; 0: off; up to 4: multiple of the measured noise level, applied even if the "
                     "deviations look like real detail."));
    add(weldOption(options.weld_distance,
                   "Weld distance, in mesh units (before node transforms): positions that differ by at most this "
                   "distance in each coordinate are welded when normals are computed, winding is fixed and borders "
                   "are compared. 0: only equal positions; auto: twice the float spacing at the largest coordinate "
                   "of the mesh. Tangents are always computed on the unwelded positions."));
    addRepair(setting("--keep-winding", options.mend_winding, false,
                      "Do not fix the winding: keep triangles that disagree with their neighbors, and components that "
                      "are inside out."));
    addRepair(setting("--no-images", options.images, false,
                      "Do not read the pixels of normal maps. Inverted tangent signs are then kept, because the maps "
                      "may be inverted too."));
    for (Option& option : bakeOptions(options.bake)) {
        if (std::find(std::begin(kBakes), std::end(kBakes), option.name()) == std::end(kBakes)) continue;
        option.needs = "--low";
        option.group += option.group == kInputAndOutput ? "" : " (only with --low)";
        option.excludes.clear();
        if (option.name() == "--maps")
            option.help =
                "Comma-separated list of maps to bake: normal, ao, bent, curvature, height, position, thickness, id, "
                "color, orm (occlusion, roughness, metalness) and emission. Each map is written to a file next to OUT: "
                "OUT_normal.png, OUT_ao.png etc. The maps color, orm and emission are transferred from the materials "
                "of IN.";
        if (option.name() == "--match")
            option.help =
                "Only with --low: pairing of low-poly with high-poly objects. names: Body_low is paired with Body, "
                "Body_high, Body_hp, Body_high_001 and Body_high_buckle, and an object without a match uses the whole "
                "high poly; all: every object uses the whole high poly; any other value: a text file with lines LOW = "
                "HIGH.";
        if (option.name() == "--high-green") option.excludes = {"--ignore-high-maps"};
        list.push_back(std::move(option));
    }
    addRunning(list, options.execution, options.file);
    options::add(list, kReporting,
                 htmlOutput("--html", "PAGE", options.page,
                            "Also write a self-contained HTML report to this file, with pictures before and after and "
                            "the findings of check."));
    return list;
}

}  // namespace tspace::options
