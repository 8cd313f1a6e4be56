// SPDX-License-Identifier: MIT
// tspace_bench: the table of targets, or the sweep. scripts/bench builds and starts it.
#include <CLI/CLI.hpp>

#include "sweep.h"
#include "table.h"

int main(int argc, char** argv) {
    CLI::App app("Measures tspace.");
    bool quick = false;
    int rounds = 0;
    std::string pattern, json, shared_folder = TSPACE_SHARED_DIR, tool = TSPACE_BENCH_TOOL;
    app.add_flag("--quick", quick, "Smaller meshes and fewer rounds");
    app.add_option("--rounds", rounds, "How often each pair is timed; the more, the quieter")
        ->check(CLI::PositiveNumber);
    app.add_option("--json", json, "Write the figures as JSON to a file, or - for stdout");
    app.add_option("--shared", shared_folder, "Folder with the models");
    app.add_option("--tool", tool, "The built tspace");
    auto* sweep = app.add_subcommand("sweep", "Every mesh, method, thread count and SIMD target")->fallthrough();
    for (CLI::App* command : {&app, sweep}) {
        command->add_option("pattern", pattern, "Regular expression on the names of rows");
    }
    CLI11_PARSE(app, argc, argv);

    tspace::bench::Lab lab(quick, rounds, shared_folder, tool);
    if (!sweep->parsed()) return tspace::bench::printTable(lab, {pattern, json});
    if (quick && pattern.empty()) pattern = "_100k/";
    return tspace::bench::runSweep(lab, pattern, json);
}
