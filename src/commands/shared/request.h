// SPDX-License-Identifier: MIT
// Requests of calls on files, and their options. Setting values (giveValue, readJsonOptions) of an option list writes
// to the request for which the list was made; the request must outlive the list.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/option_table.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"
#include "tspace/map_files.h"
#include "tspace/render.h"

namespace tspace::options {

struct CheckRequest {
    CheckOptions options = {};
    Severity fail_on = Severity::error;      ///< findings of at least this severity make a check fail
    Severity min_severity = Severity::note;  ///< findings below this severity are omitted
    std::vector<FindingCode> ignored = {};   ///< findings with these codes are omitted
};

struct DiffRequest {
    DiffOptions options = {};
    double tolerance_deg = 1;
};

OptionList generateOptions(GenerateOptions& options);
OptionList checkOptions(CheckRequest& request);
OptionList diffOptions(DiffRequest& request);
OptionList identifyOptions(IdentifyOptions& options);
OptionList inspectOptions(FileOptions& options);
OptionList flipGreenOptions(FlipGreenOptions& options);
OptionList renderOptions(RenderOptions& options);
OptionList bakeOptions(BakeFileOptions& options);
OptionList finishOptions(FinishOptions& options);
OptionList mapErrorOptions(MapErrorFileOptions& options);
OptionList convertMapOptions(ConvertMapFileOptions& options);
OptionList heightToNormalOptions(HeightToNormalFileOptions& options);
OptionList compressMapOptions(CompressMapFileOptions& options);

/// Applies rules that involve several options, after all options are set. Returns an error message or an empty string.
std::string finish(const Given& given, GenerateOptions& options);
std::string finish(const Given& given, ConvertMapFileOptions& options);

/// Removes the findings that the request omits, and recomputes the counts.
void removeOmitted(const CheckRequest& request, CheckReport& report);
/// Returns whether a finding makes the check fail.
bool makesCheckFail(const CheckRequest& request, const CheckReport& report);

}  // namespace tspace::options
