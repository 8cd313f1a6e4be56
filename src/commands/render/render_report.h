// SPDX-License-Identifier: MIT
// Reports of tspace render.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/render.h"

namespace tspace::report {

std::string renderJson(const Outcome<RenderReport>& outcome, ExitCode exit_code);
/// Returns the report as text. `method`: the requested method of tangents.
std::string renderText(const Outcome<RenderReport>& outcome, Method method);

}  // namespace tspace::report
