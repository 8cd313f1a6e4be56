// SPDX-License-Identifier: MIT
// What tspace finish reports: as JSON, as text, and as a page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "commands/pages/page_parts.h"
#include "commands/shared/report.h"
#include "tspace/bake_file.h"

namespace tspace {

/// One HTML file that needs nothing else: pictures before and after, what was done, and what check finds in the output.
/// `output`: its bytes; pictures of the models as they were are drawn of their files, which are read once more. Throws FileError.
std::string finishPage(const FinishReport& report, const std::string& output_path, std::span<const std::uint8_t> output,
                       const FileOptions& file, const PageOrigin& origin);

/// The files that finishFile() writes, for a comparison with `others` as in outputsBeside(), but for the page.
std::vector<std::string> finishOutputs(const std::vector<std::string>& others, const std::string& output,
                                       const FinishOptions& options);

}  // namespace tspace

namespace tspace::report {

/// Exit code of a finished model.
inline ExitCode exitCodeOf(const FinishReport& report) {
    const bool has_findings = report.check.error_count != 0 || (report.bake && !report.bake->findings.empty());
    return has_findings ? ExitCode::findings : ExitCode::done;
}
std::string finishJson(const Outcome<FinishReport>& outcome, const std::string& low, ExitCode exit_code);
std::string finishText(const Outcome<FinishReport>& outcome);

/// "2 errors, 1 warning, 3 notes".
std::string findingCounts(const CheckReport& report);
/// Lists the changes to a model, in sentences without a full stop.
std::vector<std::string> doneTo(const FinishedModel& model);

}  // namespace tspace::report
