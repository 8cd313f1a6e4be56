// SPDX-License-Identifier: MIT
// Report of tspace view as text.
#include <fmt/format.h>

#include "commands/shared/text.h"
#include "commands/view/view_report.h"

namespace tspace::report {

std::string viewText(const Outcome<ViewReport>& outcome) {
    return fmt::format("{} -> {}: {}, {}\n", unbroken(outcome.input), unbroken(outcome.output),
                       counted(outcome.result->files.size(), "file"), byteText(outcome.result->output_bytes));
}

}  // namespace tspace::report
