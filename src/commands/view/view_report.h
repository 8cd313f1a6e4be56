// SPDX-License-Identifier: MIT
// One HTML file that shows a model: the page of web/, with the model and the files that it references embedded; and the
// reports of tspace view.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/pages/page_parts.h"
#include "commands/shared/report.h"
#include "model/io/path.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

// One HTML file that shows a model: the page of web/, with the model and the files that it references embedded.

struct ViewReport {
    std::vector<std::string> files = {};  ///< the embedded files: the model, then the files that it references
    std::uint64_t output_bytes = 0;
};

/// Writes `output` from the page that scripts/web builds and a model (GLB, glTF or OBJ), whose files are embedded
/// unchanged. Without scripts, the page shows a picture of the model and the findings of checkFile. `page` contains
/// "<!-- model -->" where the data is inserted. `options`: content and find_file must be empty. Errors: cannotRead (the
/// page or the model), invalidFile, unsupportedFile (another format, or `page` without the marker), tooLarge,
/// cannotWrite; then no file has changed.
Result<ViewReport> writeViewPage(const Path& input, const Path& output, const Path& page, const FileOptions& options,
                                 const PageOrigin& origin);

}  // namespace tspace

namespace tspace::report {

std::string viewJson(const Outcome<ViewReport>& outcome, ExitCode exit_code);
std::string viewText(const Outcome<ViewReport>& outcome);

}  // namespace tspace::report
