// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "commands/view/view_page.h"

namespace tspace::report {

std::string viewJson(const Outcome<ViewReport>& outcome, ExitCode exit_code);

}  // namespace tspace::report
