// SPDX-License-Identifier: MIT
// The tool as a process: time to generate tangents relative to copying a file.
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>

#include "race.h"
#include "rows.h"

extern char** environ;

namespace tspace::bench {

namespace {

void runTool(const std::vector<std::string>& arguments) {
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    pid_t process = 0;
    int status = 1;
    if (posix_spawn(&process, pointers[0], nullptr, nullptr, pointers.data(), environ) != 0 ||
        waitpid(process, &status, 0) < 0 || status != 0) {
        std::fprintf(stderr, "bench: %s failed\n", pointers[0]);
        std::exit(1);
    }
}

/// Returns a folder in memory rather than on disk, if available.
std::string temporaryFolder() {
    const bool has_memory = std::filesystem::is_directory("/dev/shm");
    std::string name = (has_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path()) /
                       "tspace_bench_XXXXXX";
    return mkdtemp(name.data()) != nullptr ? name : std::string();
}

RowResult measureFile(const std::string& title, const std::string& model, Lab& lab) {
    RowResult row{.title = title};
    row.one_thread.asked = 1.5;
    const std::string input = lab.shared(model), folder = temporaryFolder();
    if (!std::filesystem::exists(input) || !std::filesystem::exists(lab.tool()) || folder.empty()) {
        return row.note = "not there: " + input + " or the tool", row;
    }
    // The model's materials need no tangents, so without --all the tool reads and examines the file, and writes its
    // bytes unchanged.
    const std::string copy = folder + "/copy.glb", result = folder + "/result.glb";
    const std::vector<std::string> unchanged = {lab.tool(), "generate", "--quiet", input, "-o", copy};
    const auto generate = [&](const char* threads) {
        runTool({lab.tool(), "generate", "--quiet", "--all", "--threads", threads, input, "-o", result});
    };
    Race race;
    const std::size_t base = race.add([&] { runTool(unchanged); });
    const std::size_t one = race.add([&] { generate("1"); });
    const std::size_t two = race.add([&] { generate("2"); });
    race.run(lab.rounds());
    const bool copied = std::filesystem::file_size(copy) == std::filesystem::file_size(input);
    const bool changed = std::filesystem::file_size(result) != std::filesystem::file_size(input);
    std::filesystem::remove_all(folder);
    if (!copied || !changed) return row.wrong = true, row.note = "the copy is none, or nothing was generated", row;

    const Race::Ratio single = race.ratio(one, base, Clock::wall), both = race.ratio(two, base, Clock::wall);
    row.one_thread = {single.median, single.low, single.high, 1.5, 0};
    row.two_threads = {both.median, both.low, both.high, {}, 0};
    const auto ms = [&](std::size_t runner) {
        return std::to_string(static_cast<int>(1e3 * race.best(runner, Clock::wall)));
    };
    row.note = "unchanged " + ms(base) + " ms; generate " + ms(one) + " and " + ms(two) + " ms";
    return row;
}

}  // namespace

std::vector<Row> fileRows() {
    const std::string title = "whole `tspace generate` of Market_495k.glb";
    return {{title, [=](Lab& lab) { return measureFile(title, "models/perf/Market_495k.glb", lab); }}};
}

}  // namespace tspace::bench
