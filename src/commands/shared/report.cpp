// SPDX-License-Identifier: MIT
// Implements the common parts of the JSON of all commands.
#include "commands/shared/report.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "commands/shared/hidden_characters.h"
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

std::string jsonText(const Json& document) {
    // JSON allows DEL, C1 control characters and marks of text direction in strings, but a terminal obeys them.
    const std::string plain = document.dump(2, ' ', BadUtf8::replace) + "\n";
    std::string text;
    text.reserve(plain.size());
    for (std::string_view left = plain; !left.empty();) {
        const HiddenCharacter hidden = left.front() == '\n' ? HiddenCharacter{} : hiddenCharacter(left);
        char escaped[8] = {left.front()};
        if (hidden.length > 0) std::snprintf(escaped, sizeof escaped, "\\u%04x", hidden.code);
        text += escaped;
        left.remove_prefix(std::max<std::size_t>(hidden.length, 1));
    }
    return text;
}

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
