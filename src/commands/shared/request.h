// SPDX-License-Identifier: MIT
// The requests of calls on files, and their options. A list of options fills the request that it is made for as
// values are given (giveValue, readJsonOptions); the request must outlive the list.
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
    Severity fail_on = Severity::error;        ///< findings from here on make a check fail
    Severity least_severity = Severity::note;  ///< findings below are left out
    std::vector<FindingCode> ignored = {};     ///< these too
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

/// Applies what options mean together, once all are given. Returns what makes no sense, or nothing.
std::string finish(const Given& given, GenerateOptions& options);
std::string finish(const Given& given, ConvertMapFileOptions& options);

/// Removes the findings that the request leaves out, and counts anew.
void leaveOut(const CheckRequest& request, CheckReport& report);
/// Whether a finding makes the check fail.
bool failsBy(const CheckRequest& request, const CheckReport& report);

}  // namespace tspace::options
