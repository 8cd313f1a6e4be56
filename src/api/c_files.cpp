// SPDX-License-Identifier: MIT
// C API for files: each function reads its options, calls the C++ function of the same name, and returns its report as
// JSON.
#include <chrono>

#include "api/c_call.h"
#include "commands/bake/bake_report.h"
#include "commands/check/check_report.h"
#include "commands/compress_map/compress_map_report.h"
#include "commands/convert_map/convert_map_report.h"
#include "commands/diff/diff_report.h"
#include "commands/finish/finish_report.h"
#include "commands/flip_green/flip_green_report.h"
#include "commands/generate/generate_report.h"
#include "commands/height_to_normal/height_to_normal_report.h"
#include "commands/identify/identify_report.h"
#include "commands/inspect/inspect_report.h"
#include "commands/shared/request.h"
#include "model/io/atomic_output.h"

using namespace tspace;           // NOLINT: this file only forwards
using namespace tspace::c_files;  // NOLINT
using report::ExitCode;

namespace {

/// Throws the error of a Result if it has one.
template <class Value>
void throwError(const Result<Value>& result) {
    if (!result) throw FileError{result.error()};
}

/// Stores the result of call() and its duration in `outcome`, or throws its error.
template <class Outcome, class Call>
void timeCall(Outcome& outcome, const Call& call) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    outcome.result = call();
    throwError(outcome.result);
    outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
}

void giveReport(const std::string& json, tspace_Bytes* to) {
    if (to != nullptr) GrowingBytes(json).giveTo(to);
}

/// Calls call(), which writes files. Stores its result in `outcome`, and the report that toJson() returns in `to`.
/// Files are put in place once the report is complete.
template <class Outcome, class Call, class ToJson>
void giveOutcome(Outcome& outcome, const Call& call, const ToJson& toJson, tspace_Bytes* to) {
    HeldOutputs outputs;
    timeCall(outcome, call);
    if (to != nullptr) giveReport(toJson(), to);
    valueOrThrow(outputs.commit());
}

/// Returns a name without its file extension, such as "a.b/helmet" for "a.b/helmet.gltf".
std::string withoutEnding(const std::string& name) {
    const std::size_t dot = name.rfind('.'), slash = name.rfind('/');
    return dot == std::string::npos || (slash != std::string::npos && dot < slash) ? name : name.substr(0, dot);
}

/// Creates `output` from `input` with `make`, and returns its report.
template <class Report, class Options>
void makeFile(Result<Report> (*make)(const std::string&, const std::string&, const Options&),
              std::string (*toJson)(const report::Outcome<Report>&, ExitCode), const std::string& input,
              const std::string& output, const Options& options, tspace_Bytes* json) {
    report::Outcome<Report> outcome{.input = input, .output = output, .is_dry_run = options.dry_run};
    giveOutcome(
        outcome, [&] { return make(input, output, options); }, [&] { return toJson(outcome, ExitCode::done); }, json);
}

/// Reads options that depend on each other. `list` must exist until they are applied, because the parsed options point
/// into it.
template <class Options>
void readTogether(const options::OptionList& list, const char* text, Options& to) {
    options::Given given;
    readOptions(list, text, given);
    const std::string wrong = options::finish(given, to);
    if (!wrong.empty()) failFile(ErrorCode::invalidOption, wrong);
}

void readGenerateOptions(const char* text, GenerateOptions& options) {
    readTogether(options::generateOptions(options), text, options);
}

void generate(const std::string& input, const std::string& output, const GenerateOptions& options, tspace_Bytes* json) {
    report::GenerateOutcome outcome{.input = input, .output = output, .is_dry_run = options.dry_run};
    giveOutcome(
        outcome, [&] { return generateFile(input, output, options); },
        [&] { return report::generateJson({outcome}, ExitCode::done, outcome.seconds); }, json);
}

void readCheckOptions(const char* text, options::CheckRequest& request) {
    options::Given given;
    readOptions(options::checkOptions(request), text, given);
}

void check(const std::string& input, const options::CheckRequest& request, tspace_Bytes* json) {
    report::CheckOutcome outcome{.input = input, .result = checkFile(input, request.options)};
    throwError(outcome.result);
    options::removeOmitted(request, *outcome.result);
    const ExitCode exit_code = options::makesCheckFail(request, *outcome.result) ? ExitCode::findings : ExitCode::done;
    giveReport(report::checkJson({outcome}, exit_code, request.fail_on), json);
}

void readInspectOptions(const char* text, FileOptions& options) {
    options::Given given;
    readOptions(options::inspectOptions(options), text, given);
}

void inspect(const std::string& input, const FileOptions& options, tspace_Bytes* json) {
    const report::InspectOutcome outcome{.input = input, .result = inspectFile(input, options)};
    throwError(outcome.result);
    giveReport(report::inspectJson({outcome}, ExitCode::done), json);
}

void readIdentifyOptions(const char* text, IdentifyOptions& options) {
    options::Given given;
    readOptions(options::identifyOptions(options), text, given);
}

void identify(const std::string& input, const IdentifyOptions& options, tspace_Bytes* json) {
    const report::IdentifyOutcome outcome{.input = input, .result = identifyFile(input, options)};
    throwError(outcome.result);
    giveReport(report::identifyJson({outcome}, ExitCode::done), json);
}

void readDiffOptions(const char* text, options::DiffRequest& request) {
    options::Given given;
    readOptions(options::diffOptions(request), text, given);
}

void diff(const std::string& a, const std::string& b, const options::DiffRequest& request, tspace_Bytes* json) {
    const Result<FrameDiff> result = diffFiles(a, b, request.options);
    throwError(result);
    const ExitCode exit_code = result->isWithin(request.tolerance_deg) ? ExitCode::done : ExitCode::findings;
    giveReport(report::diffJson(a, b, request.tolerance_deg, result, exit_code), json);
}

void readConvertMapOptions(const char* text, ConvertMapFileOptions& options) {
    options.execution.thread_count = 1;
    readTogether(options::convertMapOptions(options), text, options);
}

void readHeightToNormalOptions(const char* text, HeightToNormalFileOptions& options) {
    options::Given given;
    options.execution.thread_count = 1;
    readOptions(options::heightToNormalOptions(options), text, given);
}

void readCompressMapOptions(const char* text, CompressMapFileOptions& options) {
    options::Given given;
    options.execution.thread_count = 1;
    readOptions(options::compressMapOptions(options), text, given);
}

void readFlipGreenOptions(const char* text, FlipGreenOptions& options) {
    options::Given given;
    readOptions(options::flipGreenOptions(options), text, given);
}

void readBakeOptions(const char* text, BakeFileOptions& options) {
    options::Given given;
    readOptions(options::bakeOptions(options), text, given);
}

void readFinishOptions(const char* text, FinishOptions& options) {
    options::Given given;
    readOptions(options::finishOptions(options), text, given);
}

}  // namespace

tspace_ErrorCode tspace_generateFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        GenerateOptions chosen;
        readGenerateOptions(options, chosen);
        generate(from, to, chosen, report);
    });
}

tspace_ErrorCode tspace::c_files::generateBytes(const tspace_Model* model, const char* options,
                                                const Progress& progress, tspace_Bytes* output, tspace_Bytes* report,
                                                tspace_Error* error) noexcept {
    return atCallBorder(error, {output, report}, [&] {
        if (output == nullptr) failFile(ErrorCode::nullData, "output is null");
        GenerateOptions chosen;
        openModel(model, chosen.file);
        readGenerateOptions(options, chosen);
        chosen.progress = progress;
        GrowingBytes bytes;
        chosen.sink = [&](std::span<const std::uint8_t> part) {
            bytes.append(part);
            return true;
        };
        const std::string name = nameOf(*model);
        generate(name, withoutEnding(name) + ".glb", chosen, report);
        bytes.giveTo(output);
    });
}

tspace_ErrorCode tspace_generateBytes(const tspace_Model* model, const char* options, tspace_Bytes* output,
                                      tspace_Bytes* report, tspace_Error* error) noexcept {
    return generateBytes(model, options, {}, output, report, error);
}

tspace_ErrorCode tspace_checkFile(const char* input, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input");
        options::CheckRequest request;
        readCheckOptions(options, request);
        check(from, request, report);
    });
}

tspace_ErrorCode tspace::c_files::checkBytes(const tspace_Model* model, const char* options, const Progress& progress,
                                             tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        options::CheckRequest request;
        openModel(model, request.options.file);
        readCheckOptions(options, request);
        request.options.progress = progress;
        check(nameOf(*model), request, report);
    });
}

tspace_ErrorCode tspace_checkBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) noexcept {
    return checkBytes(model, options, {}, report, error);
}

tspace_ErrorCode tspace_inspectFile(const char* input, const char* options, tspace_Bytes* report,
                                    tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input");
        FileOptions chosen;
        readInspectOptions(options, chosen);
        inspect(from, chosen, report);
    });
}

tspace_ErrorCode tspace_inspectBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        FileOptions chosen;
        openModel(model, chosen);
        readInspectOptions(options, chosen);
        inspect(nameOf(*model), chosen, report);
    });
}

tspace_ErrorCode tspace_identifyFile(const char* input, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input");
        IdentifyOptions chosen;
        readIdentifyOptions(options, chosen);
        identify(from, chosen, report);
    });
}

tspace_ErrorCode tspace_identifyBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        IdentifyOptions chosen;
        openModel(model, chosen.file);
        readIdentifyOptions(options, chosen);
        identify(nameOf(*model), chosen, report);
    });
}

tspace_ErrorCode tspace_diffFiles(const char* a, const char* b, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from_a = requiredText(a, "a"), from_b = requiredText(b, "b");
        options::DiffRequest request;
        readDiffOptions(options, request);
        diff(from_a, from_b, request, report);
    });
}

tspace_ErrorCode tspace_diffBytes(const tspace_Model* a, const tspace_Model* b, const char* options,
                                  tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        options::DiffRequest request;
        readDiffOptions(options, request);
        FileOptions& file = request.options.file;
        FileOptions& file_b = request.options.file_b.emplace(file);
        openModel(a, file);
        openModel(b, file_b);
        diff(nameOf(*a), nameOf(*b), request, report);
    });
}

tspace_ErrorCode tspace_flipGreenFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        FlipGreenOptions chosen;
        readFlipGreenOptions(options, chosen);
        makeFile(flipGreenFile, report::flipGreenJson, from, to, chosen, report);
    });
}

tspace_ErrorCode tspace_convertMapFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                       tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        ConvertMapFileOptions chosen;
        readConvertMapOptions(options, chosen);
        makeFile(convertMapFile, report::convertMapJson, from, to, chosen, report);
    });
}

tspace_ErrorCode tspace_heightToNormalFile(const char* input, const char* output, const char* options,
                                           tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        HeightToNormalFileOptions chosen;
        readHeightToNormalOptions(options, chosen);
        makeFile(heightToNormalFile, report::heightToNormalJson, from, to, chosen, report);
    });
}

tspace_ErrorCode tspace_compressMapFile(const char* input, const char* output, const char* options,
                                        tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        CompressMapFileOptions chosen;
        readCompressMapOptions(options, chosen);
        makeFile(compressMapFile, report::compressMapJson, from, to, chosen, report);
    });
}

tspace_ErrorCode tspace_compressMapBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                         tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {output, report}, [&] {
        if (data == nullptr) failFile(ErrorCode::nullData, "data is null");
        if (output == nullptr) failFile(ErrorCode::nullData, "output is null");
        CompressMapFileOptions chosen;
        readCompressMapOptions(options, chosen);
        chosen.content = {data, size};
        GrowingBytes bytes;
        chosen.sink = [&](std::span<const std::uint8_t> part) {
            bytes.append(part);
            return true;
        };
        makeFile(compressMapFile, report::compressMapJson, "map", "map.ktx2", chosen, report);
        bytes.giveTo(output);
    });
}

tspace_ErrorCode tspace_bakeFile(const char* low, const char* high, const char* output, const char* options,
                                 tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(low, "low"), seen = requiredText(high, "high");
        const std::string to = requiredText(output, "output");
        BakeFileOptions chosen;
        readBakeOptions(options, chosen);
        report::Outcome<BakeFileReport> outcome{.input = from, .output = to};
        giveOutcome(
            outcome, [&] { return bakeFile(from, seen, to, chosen); },
            [&] { return report::bakeJson(outcome, seen, report::exitCodeOf(*outcome.result)); }, report);
    });
}

tspace_ErrorCode tspace_finishFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        FinishOptions chosen;
        readFinishOptions(options, chosen);
        report::Outcome<FinishReport> outcome{.input = from, .output = to};
        giveOutcome(
            outcome, [&] { return finishFile(from, to, chosen); },
            [&] { return report::finishJson(outcome, chosen.low, report::exitCodeOf(*outcome.result)); }, report);
    });
}

tspace_ErrorCode tspace_flipGreenBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                       tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {output, report}, [&] {
        if (data == nullptr) failFile(ErrorCode::nullData, "data is null");
        if (output == nullptr) failFile(ErrorCode::nullData, "output is null");
        FlipGreenOptions chosen;
        readFlipGreenOptions(options, chosen);
        FlippedImage flipped = valueOrThrow(flipGreen({data, size}, chosen));
        report::Outcome<FlipGreenReport> outcome{.is_dry_run = chosen.dry_run};
        outcome.result = std::move(flipped.report);
        if (report != nullptr) giveReport(report::flipGreenJson(outcome, ExitCode::done), report);
        if (!chosen.dry_run) GrowingBytes(flipped.bytes).giveTo(output);
    });
}
