// SPDX-License-Identifier: MIT
// Implements the common parts of the JSON of all commands.
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

Json mapMeshJson(const MapMeshReport& mesh) {
    if (mesh.triangle_count == 0) return nullptr;
    return {{"primitives", mesh.primitive_count},
            {"triangles", mesh.triangle_count},
            {"materials", mesh.materials},
            {"tangentsMade", mesh.tangents_made},
            {"scale", mesh.scale}};
}

std::string jsonText(const Json& document) { return document.dump(2, ' ', BadUtf8::replace) + "\n"; }

std::string counted(std::uint64_t count, const char* noun) {
    std::string plural = noun;
    if (count != 1) {
        if (plural == "vertex") {
            plural = "vertices";
        } else {
            plural += plural.ends_with("sh") ? "es" : "s";
        }
    }
    return std::to_string(count) + " " + plural;
}

}  // namespace tspace::report
