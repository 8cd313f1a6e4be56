// SPDX-License-Identifier: MIT
// The table of commands, from which the command line is read (read_command_line.h), and --help (help.h), man pages and
// completions (pages/) are made. Options that decide about results are described in the library (src/commands/NAME/), all others
// in NAME_command.cpp here.
#pragma once

#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/shared/exit_code.h"
#include "commands/shared/option_table.h"

namespace tspace::tool {

using namespace tspace::options;  // NOLINT: the words of the table

/// Kind of file that the first operand of a command must be, judging by its name.
enum class Reads { anything, models, images };

/// A command owns its arguments, and its copies share them: options write them, and `run` reads them.
struct Command {
    std::string name = {};                   ///< set by the table
    std::string summary = {};                ///< "add the tangents that normal maps need"
    std::string operands = {};               ///< "IN... -o OUT", for the usage line
    std::string description = {};            ///< a paragraph
    std::vector<std::string> examples = {};  ///< whole command lines
    OptionList options = {};
    /// Called when all options are taken. Returns what makes no sense together, or nothing.
    std::function<std::string(const Given& given)> finish = {};
    /// Reads what the command line names, before `run`; done, or the code of what it printed.
    std::function<report::ExitCode()> prepare = {};
    /// Does what the options ask for, prints, and says how it went.
    std::function<report::ExitCode()> run = {};
    Reads reads = Reads::anything;
    bool keeps_freed_memory = false;  ///< memory that one primitive gave back serves the next one (main.cpp)

    Option& add(const char* group, Option option) { return options::add(options, group, std::move(option)); }
    /// Options that calls of the library have too.
    void add(OptionList more) { std::move(more.begin(), more.end(), std::back_inserter(options)); }
};

/// The description in `tspace --help`.
inline constexpr const char* kToolSummary = "exact tangent frames for the normal maps of 3D models";

/// Whether the page that tspace view needs is installed with the tool.
bool hasViewPage();

/// The whole tool.
struct ToolTable {
    std::vector<Command> commands = {};
    std::vector<Option> options = {};  ///< options that can replace a command: --help, --version
};

// Each is in NAME_command.cpp.
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

/// All commands that this build has, in the order in which help lists them.
ToolTable toolTable();

/// One of these, without the others: their options take a fifth of the time in which the tool starts. Nothing: there is none of
/// this name.
std::optional<Command> findCommand(const std::string& name);

/// A file, or several where `target` is a list.
Option operand(const char* value_name, std::string& target, HelpText help);
Option operand(const char* value_name, std::vector<std::string>& target, HelpText help);

}  // namespace tspace::tool
