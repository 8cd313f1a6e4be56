// SPDX-License-Identifier: MIT
// Runs the built tool through the shell and captures its output.
#pragma once

#include <sys/wait.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>

#include "support/report_schema.h"
#include "support/temp_folder.h"

namespace tspace::test {

struct ToolRun {
    int exit_code = -1;
    std::string out = {};
    std::string err = {};
    [[nodiscard]] long errorLines() const { return std::count(err.begin(), err.end(), '\n'); }
};

/// Runs the tool in `folder`. `arguments`: shell text. `runner`: a command that starts the tool. The test fails if a
/// report does not conform to docs/schema.
inline ToolRun runTool(const TempFolder& folder, const std::string& arguments, const std::string& runner = "") {
    const TempFolder output;
    const std::string command = "cd '" + folder.path().string() + "' && " + runner + " '" TSPACE_TOOL "' " + arguments +
                                " > '" + (output.path() / "out").string() + "' 2> '" +
                                (output.path() / "err").string() + "'";
    const int status = std::system(command.c_str());
    ToolRun run = {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output.read("out"),
                   output.read("err")};
    EXPECT_EQ(reportFaults(run.out), "") << arguments;
    return run;
}

/// A runner with a standard output to which nothing can be written.
inline constexpr const char* kIntoFullDisk = R"(sh -c '"$0" "$@" > /dev/full')";

/// Returns the options that the help of a command lists, without their values.
inline std::set<std::string> optionsInHelp(const std::string& command) {
    std::set<std::string> names;
    std::istringstream lines(runTool(TempFolder(), command + " --help").out);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t begin = line.find("--");
        if (line.rfind("  -", 0) == 0 && begin != std::string::npos)
            names.insert(line.substr(begin, line.find(' ', begin) - begin));
    }
    return names;
}

/// A PNG of one pixel: a flat normal map.
inline constexpr std::uint8_t kFlatPng[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
    0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x68, 0xf8, 0x0f, 0x00, 0x03, 0x83, 0x02, 0x00, 0x00,
    0xa5, 0xfb, 0x89, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

/// Writes the normal map that the folded model references.
inline void writeBumpMap(const TempFolder& folder) { folder.write("bump.png", kFlatPng); }

/// Writes two quads that meet at an edge, with UVs and a material that has a normal map.
inline std::string writeFoldedObj(const TempFolder& folder, const std::string& name) {
    folder.write((std::filesystem::path(name).parent_path() / "folded.mtl").string(),
                 "newmtl skin\nmap_Bump bump.png\n");
    return folder.write(name,
                        "mtllib folded.mtl\no folded\n"
                        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n"
                        "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\n"
                        "usemtl skin\nf 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n");
}

}  // namespace tspace::test
