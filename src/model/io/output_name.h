// SPDX-License-Identifier: MIT
// The rule for names of outputs, whose extension selects the format.
#pragma once

#include <initializer_list>
#include <string_view>

#include "model/io/path.h"

namespace tspace {

/// Throws a FileError (invalidOption, a wrong command line) that lists the endings that the output's name may have.
[[noreturn]] void failEnding(const Path& output, std::initializer_list<std::string_view> endings);

/// Calls failEnding() unless the name ends in one of `endings` (".png", in lower case); upper case counts as lower case.
void requireEnding(const Path& output, std::initializer_list<std::string_view> endings);

}  // namespace tspace
