// SPDX-License-Identifier: MIT
// The command line, parsed: one struct per command.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "commands/shared/exit_code.h"
#include "commands/shared/request.h"

namespace tspace::tool {

using report::ExitCode;
using report::exitCodeOf;
using report::worse;

/// The file format of outputs whose name does not say it.
enum class Container { sameAsInput, glb, gltf };

/// Share `index` (from 1) of `count`.
struct Shard {
    unsigned index = 1;
    unsigned count = 1;
};

/// When severities are coloured. automatic: on a terminal, unless the user said no by NO_COLOR.
enum class Color { automatic, always, never };

/// How many files are worked through.
struct BatchArguments {
    unsigned jobs = 1;  ///< files at one time; 0: as many as there are cores
    Shard shard = {};
    std::string manifest = {};  ///< empty: none
    bool resume = false;        ///< leave out what the manifest says is done and unchanged
    bool verbose = false;       ///< the details of every file, also where there are several
};

struct GenerateArguments {
    std::vector<std::string> inputs = {};
    std::string output = {};
    bool in_place = false;
    Container container = Container::sameAsInput;
    GenerateOptions options = {};
    std::string option_text = {};  ///< the options given that decide about results, in one spelling
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

struct InspectArguments {
    std::vector<std::string> inputs = {};
    FileOptions file = {};
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

struct CheckArguments {
    std::vector<std::string> inputs = {};
    options::CheckRequest request = {};
    std::string sarif = {};  ///< a file for the findings in SARIF; empty: none
    std::string html = {};   ///< a file for the findings as a page; empty: none
    Color color = Color::automatic;
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

struct DiffArguments {
    std::string a = {};
    std::string b = {};
    options::DiffRequest request = {};
    std::string html = {};  ///< a file for the comparison as a page; empty: none
    bool json = false;
    bool quiet = false;
};

struct IdentifyArguments {
    std::vector<std::string> inputs = {};
    IdentifyOptions options = {};
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

struct FlipGreenArguments {
    std::string input = {};
    std::string output = {};  ///< the input, where it is written over
    bool in_place = false;
    FlipGreenOptions options = {};
    bool json = false;
    bool quiet = false;
};

struct RenderArguments {
    std::string input = {};
    std::string output = {};
    RenderOptions options = {};
    bool json = false;
    bool quiet = false;
};

struct ConvertMapArguments {
    std::string input = {};
    std::string output = {};
    ConvertMapFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

struct HeightToNormalArguments {
    std::string input = {};
    std::string output = {};
    HeightToNormalFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

struct ViewArguments {
    std::string input = {};
    std::string output = {};
    FileOptions file = {};
    bool json = false;
    bool quiet = false;
};

struct BakeArguments {
    std::string low = {}, high = {}, output = {};
    std::string report = {};  ///< a file for the JSON; empty: none
    BakeFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

struct MapErrorArguments {
    std::string map = {}, low = {}, high = {};
    MapErrorFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

/// Nothing to run: help was printed, or the command line is wrong and the error line was printed.
using Arguments = std::variant<ExitCode, GenerateArguments, InspectArguments, CheckArguments, DiffArguments,
                               IdentifyArguments, FlipGreenArguments, RenderArguments, ConvertMapArguments,
                               HeightToNormalArguments, ViewArguments, BakeArguments, MapErrorArguments>;

Arguments parseArguments(int argc, char** argv);

}  // namespace tspace::tool
