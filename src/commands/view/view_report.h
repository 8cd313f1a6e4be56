// SPDX-License-Identifier: MIT
// What tspace view reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "commands/view/view_page.h"

namespace tspace::report {

std::string viewJson(const Outcome<ViewReport>& outcome, ExitCode exit_code);
std::string viewText(const Outcome<ViewReport>& outcome);

}  // namespace tspace::report
