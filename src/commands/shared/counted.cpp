// SPDX-License-Identifier: MIT
#include "commands/shared/counted.h"

namespace tspace::report {

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
