// SPDX-License-Identifier: MIT
// How a model is finished.
#include <algorithm>
#include <iterator>
#include <string_view>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<FinishNormals> kFinishNormals[] = {
    {"missing", FinishNormals::missing}, {"all", FinishNormals::all}, {"none", FinishNormals::none}};

/// Options of bake that mean something here.
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
    Option low = text("--low", "LOW", options.low,
                      "A low poly of the same shape, in the same place, with UVs. It is finished too, all maps are "
                      "baked onto it from IN, and OUT is the low poly with its maps.");
    low.is_file = true;
    add(list, kInputAndOutput, std::move(low));
    addAllowExternal(list, options.file);
    addKeepCoordinates(list, options.file);
    add(list, "Normals",
        choice("--normals", "WHICH", kFinishNormals, options.normals,
               "Normals to recompute, with the weights of best. missing: those that are missing or that check "
               "reports as errors; all: every normal; none: only those that tangents require."));
    add(list, "Normals",
        numberOrAuto("--crease", "DEG", "a number of degrees", options.crease_angle_deg, NormalOptions::crease_auto,
                     180,
                     "Crease angle for recomputed normals of IN: sharper edges stay hard. In degrees, 0 to 180; 180: "
                     "no hard edges. auto: an angle chosen per mesh, which the report states."));
    add(list, "Normals",
        numberOrAuto(
            "--denoise", "FACTOR", "a number", options.denoise, NormalOptions::denoise_auto, 4,
            "Denoising for recomputed normals on noisy positions, such as scans: uses a larger neighborhood. auto: as "
            "much as is measured, and none where that is shape; 0 to 4: this multiple of the measured noise."));
    add(list, "Normals",
        numberOrAuto("--weld-distance", "DISTANCE", "a distance", options.weld_distance, NormalOptions::weld_auto,
                     1000000000,
                     "Weld distance, in the unit of positions before node transforms: positions that differ by at most "
                     "this in each coordinate count as one when normals are computed, triangles are turned and borders "
                     "are compared. 0: only equal positions. auto: twice the float spacing at the largest coordinate "
                     "of the mesh. Tangents are always computed on the unwelded positions."));
    add(list, "Repair",
        setting("--keep-winding", options.mend_winding, false,
                "Keep the winding of triangles that disagree with their neighbors, and of parts that are inside out."));
    add(list, "Repair",
        setting("--no-images", options.images, false,
                "Do not read the pixels of normal maps. Inverted tangent signs are then kept, since the maps may be "
                "inverted too."));
    for (Option& option : bakeOptions(options.bake)) {
        if (std::find(std::begin(kBakes), std::end(kBakes), option.name()) == std::end(kBakes)) continue;
        option.needs = "--low";
        option.excludes.clear();
        if (option.name() == "--high-green") option.excludes = {"--ignore-high-maps"};
        list.push_back(std::move(option));
    }
    addRunning(list, options.execution, "Number of threads; 0: one per core. Every number gives identical output.",
               options.file);
    add(list, kReporting,
        htmlOutput(
            "--html", "PAGE", options.page,
            "Also write a self-contained HTML report with pictures before and after and the findings of check."));
    return list;
}

}  // namespace tspace::options
