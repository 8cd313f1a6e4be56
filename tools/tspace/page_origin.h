// SPDX-License-Identifier: MIT
// What pages say of the run that made them.
#pragma once

#include <span>

#include "commands/pages/page_parts.h"
#include "tspace/result.h"

namespace tspace::tool {

/// Call it once, first, with the words of the command line.
void rememberCommandLine(std::span<char* const> words);

/// The date is that of SOURCE_DATE_EPOCH, as reproducible-builds.org says, else now; both in UTC. An error where that variable is
/// no number of seconds: its message is for a wrong command line.
Result<PageOrigin> pageOrigin();

}  // namespace tspace::tool
