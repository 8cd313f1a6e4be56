// SPDX-License-Identifier: MIT
// What tspace diff reports. As a page it is in shared/page/diff_page.h.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/diff.h"

namespace tspace::report {

/// Of the models `a` and `b`.
std::string diffJson(const std::string& a, const std::string& b, double tolerance_deg, const Result<FrameDiff>& diff,
                     ExitCode exit_code);
std::string diffText(const std::string& a, const std::string& b, const FrameDiff& diff);

}  // namespace tspace::report
