// SPDX-License-Identifier: MIT
// What the JSON of all calls has in common.
#include "commands/shared/report.h"
#include "tspace/version.h"

namespace tspace::report {

Json errorJson(const Error* error) {
    if (error == nullptr) return nullptr;
    return Json::object({
        {"code", errorName(error->code)},
        {"message", error->message},
        {"place", error->place},
        {"exitCode", static_cast<int>(exitCodeOf(error->code))},
    });
}

Json documentJson(const char* schema, bool is_ok, ExitCode exit_code) {
    return Json::object({{"schema", schema},
                         {"version", TSPACE_VERSION_STRING},
                         {"ok", is_ok},
                         {"exitCode", static_cast<int>(exit_code)}});
}

std::string jsonText(const Json& document) { return document.dump(2, ' ', BadUtf8::replace) + "\n"; }

}  // namespace tspace::report
