// SPDX-License-Identifier: MIT
// Reports on outputs that are in place.
#pragma once

#include <new>

#include "console.h"

namespace tspace::tool {

/// Calls report(), which composes and prints what a command reports. Where `has_outputs`, the outputs are in place: a
/// report for which memory ends is tried once more, then replaced by a line that needs no memory, with the exit code of a
/// report that cannot be printed. Otherwise std::bad_alloc is passed on.
template <class Report>
ExitCode reportOutputs(bool has_outputs, const Report& report) {
    if (!has_outputs) return report();
    for (int tries = 0; tries < 2; ++tries) {
        try {
            return report();
        } catch (const std::bad_alloc&) {
        }
    }
    printPlain("tspace: standard output: cannot write the report for lack of memory; the outputs are complete\n");
    return ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
