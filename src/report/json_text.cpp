// SPDX-License-Identifier: MIT
// What the JSON of all calls has in common.
#include "report/report.h"

namespace tspace::report {

Json errorJson(const Error* error) {
    if (error == nullptr) return nullptr;
    return {
        {"code", errorName(error->code)},
        {"message", error->message},
        {"place", error->place},
        {"exitCode", static_cast<int>(exitCodeOf(error->code))},
    };
}

std::string jsonText(const Json& document) { return document.dump(2, ' ', BadUtf8::replace) + "\n"; }

}  // namespace tspace::report
