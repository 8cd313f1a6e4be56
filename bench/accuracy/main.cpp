// SPDX-License-Identifier: MIT
// tspace_accuracy: measures every method against exact frames. scripts/accuracy builds and starts it.
#include <CLI/CLI.hpp>

#include <cstdio>

#include "plots.h"
#include "report.h"
#include "study.h"

int main(int argc, char** argv) {
    CLI::App app("Measures how far frames are from exact ones.");
    tspace::accuracy::StudyOptions options;
    std::string json, plots;
    app.add_flag("--quick", options.quick, "8, 32 and 64 cells only, and fewer points");
    bool kinds = false;
    app.add_flag("--kinds", kinds, "Normals of grids, scans, decimated and CAD meshes, and nothing else");
    app.add_option("--seed", options.seed, "Other random meshes");
    app.add_option("--json", json, "Write the figures as JSON to a file, or - for stdout");
    app.add_option("--plots", plots, "Write pictures (SVG) into a folder");
    CLI11_PARSE(app, argc, argv);

    if (kinds) {
        printKinds(options);
        return 0;
    }
    const tspace::accuracy::Study study = tspace::accuracy::runStudy(options);
    if (json != "-") {
        printTables(study);
        printScans(options);
    }
    if (!json.empty() && !writeJson(study, json)) {
        std::fprintf(stderr, "accuracy: cannot write %s\n", json.c_str());
        return 4;
    }
    if (!plots.empty() && !writePlots(study, plots)) {
        std::fprintf(stderr, "accuracy: cannot write into %s\n", plots.c_str());
        return 4;
    }
    return 0;
}
