// SPDX-License-Identifier: MIT
// The files that a run writes: the rules for all commands, and reports that go to files of their own.
#pragma once

#include <string>
#include <vector>

#include "model/io/atomic_output.h"
#include "tspace/result.h"

namespace tspace::tool {

/// Call it before anything is written. An output that is one of `inputs`, or another output, is an error, under whatever
/// name; the message is for a wrong command line. Empty paths and "-" are none. Removes what killed runs left beside the
/// outputs, but in a dry run.
Result<Done> prepareOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                            bool is_dry_run = false);

/// The file appears whole or not at all, with its folder where that is missing; it may be none of `inputs`, which are what was
/// read. Throws std::bad_alloc, so that the outputs that are held beside it do not appear either.
Result<Done> writeTextFile(const std::string& path, const std::string& text, const InputFiles* inputs = nullptr);

}  // namespace tspace::tool
