// SPDX-License-Identifier: MIT
// Options that several commands have. Included only by files that know CLI11, which takes seconds to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "arguments.h"

namespace tspace::tool {

inline constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  findings: a comparing or checking command found something\n"
    "  2  wrong usage\n"
    "  3  bad input: a file is broken, not supported, or leads outside its folder\n"
    "  4  cannot read or write a file\n"
    "  5  out of memory, or an internal error\n"
    "Of several files the worst decides. Every error is one line on stderr.\n";

/// One of the names.
template <class Value>
CLI::Validator oneOf(const std::map<std::string, Value>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    return CLI::IsMember(names).description("");
}

/// A number of degrees from 0 to `most`.
CLI::Validator degrees(double most);
CLI::Validator conventionName();

void addInputs(CLI::App* command, std::vector<std::string>& inputs);
void addBatch(CLI::App* command, BatchArguments& batch, bool with_manifest);
void addReporting(CLI::App* command, bool& json, bool& quiet);
void addAllowExternal(CLI::App* command, bool& allow_external);
void addThreads(CLI::App* command, Execution& execution);
void addMemoryLimit(CLI::App* command, FileOptions& file);

/// The options given that decide about results: "--all --method=angle", in the order of their names, so that the
/// manifest of another command line with the same meaning fits.
std::string resultOptions(const CLI::App* command);

}  // namespace tspace::tool
