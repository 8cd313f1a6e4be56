// SPDX-License-Identifier: MIT
// What tspace render reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/render.h"

namespace tspace::report {

std::string renderJson(const Outcome<RenderReport>& outcome, ExitCode exit_code);
/// `method`: whose tangents were asked for.
std::string renderText(const Outcome<RenderReport>& outcome, Method method);

}  // namespace tspace::report
