// SPDX-License-Identifier: MIT
// The commands' parts of the table of options. Each fills the struct that it is given when its options are taken; the
// struct must outlive the command.
#pragma once

#include "arguments.h"
#include "command_table.h"

namespace tspace::tool {

/// What every command is asked to do, until it is known which one it is.
struct AllArguments {
    GenerateArguments generate = {};
    InspectArguments inspect = {};
    CheckArguments check = {};
    DiffArguments diff = {};
    IdentifyArguments identify = {};
    FlipGreenArguments flip_green = {};
    RenderArguments render = {};
    ConvertMapArguments convert_map = {};
    HeightToNormalArguments height_to_normal = {};
    ViewArguments view = {};
    BakeArguments bake = {};
    MapErrorArguments map_error = {};
    std::string help_topic = {};  ///< of `tspace help`
};

Command generateCommand(GenerateArguments& arguments);
Command inspectCommand(InspectArguments& arguments);
Command checkCommand(CheckArguments& arguments);
Command diffCommand(DiffArguments& arguments);
Command identifyCommand(IdentifyArguments& arguments);
Command bakeCommand(BakeArguments& arguments);
Command mapErrorCommand(MapErrorArguments& arguments);
Command flipGreenCommand(FlipGreenArguments& arguments);
Command renderCommand(RenderArguments& arguments);
Command convertMapCommand(ConvertMapArguments& arguments);
Command heightToNormalCommand(HeightToNormalArguments& arguments);
Command viewCommand(ViewArguments& arguments);

/// All commands, in the order in which help lists them.
ToolTable toolTable(AllArguments& arguments);

}  // namespace tspace::tool
