// SPDX-License-Identifier: MIT
// Rule for output names, whose extension selects the format.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "model/io/path.h"

namespace tspace {

/// Throws a FileError (invalidOption, an invalid command line) that lists the allowed endings of the output's name.
[[noreturn]] void failEnding(const Path& output, const std::vector<std::string_view>& endings);

/// Calls failEnding() unless the name ends in one of `endings` (".png", in lower case), ignoring case.
void requireEnding(const Path& output, std::initializer_list<std::string_view> endings);

/// Calls requireEnding() unless the name is empty (no output) or has no extension, such as that of a pipe.
void requireEndingIfAny(const Path& output, std::initializer_list<std::string_view> endings);

}  // namespace tspace
