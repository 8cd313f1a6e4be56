// SPDX-License-Identifier: MIT
// Information in HTML pages about the run that wrote them.
#pragma once

#include <span>

#include "commands/pages/page_parts.h"
#include "tspace/result.h"

namespace tspace::tool {

/// Stores the command line for pageOrigin(). Must be called once, first, with the arguments of the program.
void rememberCommandLine(std::span<char* const> words);

/// Returns the origin. The date is SOURCE_DATE_EPOCH (see reproducible-builds.org) if set, otherwise the current time,
/// both in UTC. Fails if that variable is not a number of seconds; the message describes a wrong command line.
Result<PageOrigin> pageOrigin();

}  // namespace tspace::tool
