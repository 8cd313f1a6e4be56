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
                      "A low poly of the same shape, in the same place, with UVs: it is finished too, all maps are "
                      "baked onto it from IN, and OUT is this one, with its maps.");
    low.is_file = true;
    add(list, kInputAndOutput, std::move(low));
    addAllowExternal(list, options.file);
    addKeepCoordinates(list, options.file);
    add(list, "Normals",
        choice("--normals", "WHICH", kFinishNormals, options.normals,
               "Which normals are made, by the weights of best. missing: where there are none, and where check calls "
               "those that are there an error; all: everywhere; none: none, but those that tangents need."));
    add(list, "Normals",
        numberOrAuto("--crease", "DEG", "a number of degrees", options.crease_angle_deg, NormalOptions::crease_auto,
                     180,
                     "For normals of IN that are made: edges sharper than this stay hard. In degrees, 0 to 180; 180 "
                     "makes none hard. auto: an angle by the mesh, which the report says."));
    add(list, "Normals",
        numberOrAuto("--denoise", "FACTOR", "a number", options.denoise, NormalOptions::denoise_auto, 4,
                     "For normals that are made on noisy positions, such as scans: by more of the surface around. "
                     "auto: as much as is measured, and nothing where that is shape; 0 to 4: so many times the noise "
                     "that is measured."));
    add(list, "Normals",
        numberOrAuto("--weld-distance", "DISTANCE", "a distance", options.weld_distance, NormalOptions::weld_auto,
                     1000000000,
                     "Positions that differ by no more than this in each coordinate are one, where normals "
                     "are made, triangles turned and borders compared, in the unit of positions before "
                     "nodes move them. 0: only equal ones are. auto: twice the spacing of floats at the largest "
                     "coordinate of the mesh. Tangents are computed on positions as they are."));
    add(list, "Repair",
        setting(
            "--keep-winding", options.mend_winding, false,
            "Leave triangles that are wound against their neighbours, and parts that are inside out, as they are."));
    add(list, "Repair",
        setting("--no-images", options.images, false,
                "Do not read the pixels of normal maps. Inverted signs of tangents then stay, since the maps may be "
                "inverted "
                "too."));
    for (Option& option : bakeOptions(options.bake)) {
        if (std::find(std::begin(kBakes), std::end(kBakes), option.name()) == std::end(kBakes)) continue;
        option.needs = "--low";
        option.excludes.clear();
        if (option.name() == "--high-green") option.excludes = {"--ignore-high-maps"};
        list.push_back(std::move(option));
    }
    addRunning(list, options.execution,
               "Number of threads; 0: as many as there are cores. Changes no bit of the result.", options.file);
    add(list, kReporting,
        htmlOutput(
            "--html", "PAGE", options.page,
            "Also write a page for people, with pictures before and after, and what check finds. It needs no other "
            "file."));
    return list;
}

}  // namespace tspace::options
