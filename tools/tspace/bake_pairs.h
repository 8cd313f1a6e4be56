// SPDX-License-Identifier: MIT
// Many bakes in one run, listed in a table.
#pragma once

#include <string>

#include "batch.h"
#include "commands/shared/exit_code.h"
#include "tspace/bake_file.h"

namespace tspace::tool {

struct BakePairsArguments {
    std::string table = {};   ///< lines LOW = HIGH, or LOW = HIGH = NAME, with paths relative to the table's folder
    std::string output = {};  ///< output folder; a file is named NAME, or like LOW with the extension .png
    std::string report = {};  ///< path of the JSON report; empty: none
    /// Options of all bakes. `out_mesh`: a folder, or empty.
    BakeFileOptions options = {};
    std::string option_text = {};  ///< the options that affect results
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

report::ExitCode runBakePairs(const BakePairsArguments& arguments);

}  // namespace tspace::tool
