// SPDX-License-Identifier: MIT
// Reports of tspace finish: as JSON, as text, and as an HTML page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "commands/pages/page_parts.h"
#include "commands/shared/report.h"
#include "model/read/read_scene.h"
#include "tspace/bake_file.h"

namespace tspace {

/// Returns pictures of a model from both sides, lit and in the colors of the shaded normals.
std::string viewsHtml(ModelFile& model, const std::string& caption);

/// Sections of a page with pictures of models.
struct FinishViews {
    std::string model = {}, low = {};  ///< pictures of the input models; `low`: empty without a low poly
    std::string now = {};
};

/// Returns a self-contained HTML page: pictures before and after, the changes, and the findings of check on the output.
/// `output`: bytes of the output. Throws FileError.
std::string finishPage(const FinishReport& report, const FinishViews& views, const std::string& output_path,
                       std::span<const std::uint8_t> output, const FileOptions& file, const PageOrigin& origin);

/// Returns the files that finishFile() writes, without the page, for a comparison with `others` as in
/// outputsToCompare().
std::vector<std::string> finishOutputs(const std::vector<std::string>& others, const std::string& output,
                                       const FinishOptions& options);

}  // namespace tspace

namespace tspace::report {

/// Returns the exit code for a finished model.
inline ExitCode exitCodeOf(const FinishReport& report) {
    const bool has_findings = report.check.error_count != 0 || (report.bake && !report.bake->findings.empty());
    return has_findings ? ExitCode::findings : ExitCode::done;
}
std::string finishJson(const Outcome<FinishReport>& outcome, const std::string& low, ExitCode exit_code);
std::string finishText(const Outcome<FinishReport>& outcome);

/// Returns a summary such as "2 errors, 1 warning, 3 notes".
std::string findingCounts(const CheckReport& report);
/// Lists the changes to a model, in sentences without a final period.
std::vector<std::string> doneTo(const FinishedModel& model);

}  // namespace tspace::report
