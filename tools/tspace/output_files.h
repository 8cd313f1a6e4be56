// SPDX-License-Identifier: MIT
// Output files of a run: rules shared by all commands, and reports in separate files.
#pragma once

#include <string>
#include <vector>

#include "model/io/atomic_output.h"
#include "tspace/result.h"

namespace tspace::tool {

/// Checks the outputs of a run before anything is written. Fails if an output is one of `inputs`, or equals another
/// output under any name; the message describes a wrong command line. Empty paths and "-" are ignored. Removes
/// temporary files that killed runs left next to the outputs, except in a dry run.
Result<Done> prepareOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                            bool is_dry_run = false);

/// Writes a file atomically, creating its folder if necessary; it must not be one of `inputs`, the files that were
/// read. Throws std::bad_alloc, so that outputs held with it are not put in place either.
Result<Done> writeTextFile(const std::string& path, const std::string& text, const InputFiles* inputs = nullptr);

}  // namespace tspace::tool
