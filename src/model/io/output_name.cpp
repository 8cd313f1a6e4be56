// SPDX-License-Identifier: MIT
#include "model/io/output_name.h"

#include <algorithm>
#include <string>

#include "model/io/file_error.h"

namespace tspace {

void failEnding(const Path& output, std::initializer_list<std::string_view> endings) {
    std::string message = "the output " + pathInQuotes(output) + " must end in ";
    for (const std::string_view* ending = endings.begin(); ending != endings.end(); ++ending) {
        if (ending != endings.begin()) message += ending + 1 == endings.end() ? " or " : ", ";
        message += *ending;
    }
    failFile(ErrorCode::invalidOption, message);
}

void requireEnding(const Path& output, std::initializer_list<std::string_view> endings) {
    if (std::find(endings.begin(), endings.end(), lowerExtension(output)) == endings.end()) failEnding(output, endings);
}

void requireEndingIfAny(const Path& output, std::initializer_list<std::string_view> endings) {
    if (!lowerExtension(output).empty()) requireEnding(output, endings);
}

}  // namespace tspace
