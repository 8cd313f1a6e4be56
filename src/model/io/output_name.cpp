// SPDX-License-Identifier: MIT
#include "model/io/output_name.h"

#include <algorithm>
#include <string>

#include "model/io/file_error.h"

namespace tspace {

void failEnding(const Path& output, const std::vector<std::string_view>& endings) {
    std::string message = "the output " + pathInQuotes(output) + " must end in ";
    for (std::size_t i = 0; i < endings.size(); ++i) {
        if (i != 0) message += i + 1 == endings.size() ? " or " : ", ";
        message += endings[i];
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
