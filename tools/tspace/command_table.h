// SPDX-License-Identifier: MIT
// Table of commands, used to parse the command line (read_command_line.h), and to generate --help (help.h), man pages
// and completions (pages/). Options that affect results are declared in the library (src/commands/NAME/), others in
// NAME_command.cpp here.
#pragma once

#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/shared/exit_code.h"
#include "commands/shared/option_table.h"
#include "tspace/file_options.h"

namespace tspace::tool {

using namespace tspace::options;  // NOLINT: the table consists of these names

/// A command with its arguments, which its copies share: options store them, and `run` reads them.
struct Command {
    std::string name = {};                   ///< set by the table
    std::string summary = {};                ///< such as "add the tangents that normal maps need"
    std::string operands = {};               ///< "IN... -o OUT", for the usage line
    std::string description = {};            ///< a paragraph of sentences
    std::vector<std::string> examples = {};  ///< complete command lines
    OptionList options = {};
    /// How the command reads models; null: it reads none. The importer is set before `run`.
    FileOptions* file = nullptr;
    /// Called after all options are parsed. Returns an error message for an invalid combination of options, or an empty
    /// string.
    std::function<std::string(const Given& given)> finish = {};
    /// Reads files named on the command line, before `run`. Returns `done`, or the exit code of the printed error.
    std::function<report::ExitCode()> prepare = {};
    /// Runs the command, prints the result, and returns the exit code.
    std::function<report::ExitCode()> run = {};
    bool keeps_freed_memory = false;  ///< freed memory is reused instead of returned to the system (main.cpp)

    Option& add(const char* group, Option option) { return options::add(options, group, std::move(option)); }
    /// Adds options shared with library calls.
    void add(OptionList more) { std::move(more.begin(), more.end(), std::back_inserter(options)); }
};

/// Description in `tspace --help`.
inline constexpr const char* kToolSummary = "computes and checks tangent frames for the normal maps of 3D models";

/// Returns whether the page needed by tspace view is installed with the tool.
bool hasViewPage();

/// All commands and options of the tool.
struct ToolTable {
    std::vector<Command> commands = {};
    std::vector<Option> options = {};  ///< options that can replace a command: --help, --version
};

// Each function is defined in NAME_command.cpp.
Command generateCommand();
Command diffCommand();
Command identifyCommand();
Command inspectCommand();
Command checkCommand();
Command flipGreenCommand();
Command renderCommand();
Command convertMapCommand();
Command heightToNormalCommand();
Command compressMapCommand();
Command viewCommand();
Command bakeCommand();
Command finishCommand();
Command mapErrorCommand();

/// Returns all commands of this build, in the order of the help.
ToolTable toolTable();

/// Returns a single command, without building the others, whose options take a fifth of the tool's start time. Returns
/// nullopt if there is no command of this name.
std::optional<Command> findCommand(const std::string& name);

/// Returns the error message for a word that is not a command. It names the command that the word suggests.
std::string unknownCommand(const std::string& word);

/// Returns an option for a file operand; for several if `target` is a list.
Option operand(const char* value_name, std::string& target, InputKind reads, HelpText help);
Option operand(const char* value_name, std::vector<std::string>& target, InputKind reads, HelpText help);

}  // namespace tspace::tool
