// SPDX-License-Identifier: MIT
// Many bakes in one run, as a table names them.
#pragma once

#include <string>

#include "batch.h"
#include "commands/shared/exit_code.h"
#include "tspace/bake_file.h"

namespace tspace::tool {

struct BakePairsArguments {
    std::string table = {};   ///< lines LOW = HIGH, or LOW = HIGH = NAME, with paths from its folder
    std::string output = {};  ///< a folder: NAME, or that of LOW as a .png
    std::string report = {};  ///< a file for the JSON; empty: none
    /// `out_mesh`: a folder, or empty.
    BakeFileOptions options = {};
    std::string option_text = {};  ///< the options that affect results
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

report::ExitCode runBakePairs(const BakePairsArguments& arguments);

}  // namespace tspace::tool
