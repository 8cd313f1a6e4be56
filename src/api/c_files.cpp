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

template <class Options>
using ListOf = options::OptionList(Options&);

/// Reads the options of a call, and applies the rules that involve several of them.
template <class Options>
void readOptionsOf(ListOf<Options>* listOf, const char* text, Options& to) {
    const options::OptionList list = listOf(to);  // the parsed options point into it
    options::Given given;
    readOptions(list, text, given);
    if constexpr (requires { options::finish(given, to); }) {
        const std::string wrong = options::finish(given, to);
        if (!wrong.empty()) failFile(ErrorCode::invalidOption, wrong);
    }
}

FileOptions& fileOf(FileOptions& options) { return options; }
FileOptions& fileOf(IdentifyOptions& options) { return options.file; }
FileOptions& fileOf(options::CheckRequest& request) { return request.options.file; }

/// Calls call(input, options, report), which returns only a report.
template <class Options, class Call>
tspace_ErrorCode reportOnFile(ListOf<Options>* listOf, const Call& call, const char* input, const char* text,
                              tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input");
        Options chosen;
        readOptionsOf(listOf, text, chosen);
        call(from, chosen, report);
    });
}

/// Calls call(name of the model, options, report), which returns only a report.
template <class Options, class Call>
tspace_ErrorCode reportOnModel(ListOf<Options>* listOf, const Call& call, const tspace_Model* model, const char* text,
                               tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        Options chosen;
        openModel(model, fileOf(chosen));
        readOptionsOf(listOf, text, chosen);
        call(nameOf(*model), chosen, report);
    });
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

/// Creates a file with makeFile, from the arguments of a C function.
template <class Report, class Options>
tspace_ErrorCode makeFile(ListOf<Options>* listOf,
                          Result<Report> (*make)(const std::string&, const std::string&, const Options&),
                          std::string (*toJson)(const report::Outcome<Report>&, ExitCode), const char* input,
                          const char* output, const char* text, tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        Options chosen;
        readOptionsOf(listOf, text, chosen);
        makeFile(make, toJson, from, to, chosen, report);
    });
}

/// Calls make(), whose output is returned in `output` instead of a file.
template <class Options, class Make>
void makeBytes(Options& options, const Make& make, tspace_Bytes* output) {
    GrowingBytes bytes;
    options.sink = [&](std::span<const std::uint8_t> part) {
        bytes.append(part);
        return true;
    };
    make();
    bytes.giveTo(output);
}

void requirePointer(const void* pointer, const char* name) {
    if (pointer == nullptr) failFile(ErrorCode::nullData, std::string(name) + " is null");
}

void generate(const std::string& input, const std::string& output, const GenerateOptions& options, tspace_Bytes* json) {
    report::GenerateOutcome outcome{.input = input, .output = output, .is_dry_run = options.dry_run};
    giveOutcome(
        outcome, [&] { return generateFile(input, output, options); },
        [&] { return report::generateJson({outcome}, ExitCode::done, outcome.seconds); }, json);
}

void check(const std::string& input, const options::CheckRequest& request, tspace_Bytes* json) {
    report::CheckOutcome outcome{.input = input, .result = checkFile(input, request.options)};
    throwError(outcome.result);
    options::removeOmitted(request, *outcome.result);
    const ExitCode exit_code = options::makesCheckFail(request, *outcome.result) ? ExitCode::findings : ExitCode::done;
    giveReport(report::checkJson({outcome}, exit_code, request.fail_on), json);
}

void inspect(const std::string& input, const FileOptions& options, tspace_Bytes* json) {
    const report::InspectOutcome outcome{.input = input, .result = inspectFile(input, options)};
    throwError(outcome.result);
    giveReport(report::inspectJson({outcome}, ExitCode::done), json);
}

void identify(const std::string& input, const IdentifyOptions& options, tspace_Bytes* json) {
    const report::IdentifyOutcome outcome{.input = input, .result = identifyFile(input, options)};
    throwError(outcome.result);
    giveReport(report::identifyJson({outcome}, ExitCode::done), json);
}

void diff(const std::string& a, const std::string& b, const options::DiffRequest& request, tspace_Bytes* json) {
    const Result<FrameDiff> result = diffFiles(a, b, request.options);
    throwError(result);
    const ExitCode exit_code = result->isWithin(request.tolerance_deg) ? ExitCode::done : ExitCode::findings;
    giveReport(report::diffJson(a, b, request.tolerance_deg, result, exit_code), json);
}

}  // namespace

tspace_ErrorCode tspace_generateFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(input, "input"), to = requiredText(output, "output");
        GenerateOptions chosen;
        readOptionsOf(options::generateOptions, options, chosen);
        generate(from, to, chosen, report);
    });
}

tspace_ErrorCode tspace::c_files::generateBytes(const tspace_Model* model, const char* options,
                                                const Progress& progress, tspace_Bytes* output, tspace_Bytes* report,
                                                tspace_Error* error) noexcept {
    return atCallBorder(error, {output, report}, [&] {
        requirePointer(output, "output");
        GenerateOptions chosen;
        openModel(model, chosen.file);
        readOptionsOf(options::generateOptions, options, chosen);
        chosen.progress = progress;
        const std::string name = nameOf(*model);
        makeBytes(
            chosen, [&] { generate(name, withoutEnding(name) + ".glb", chosen, report); }, output);
    });
}

tspace_ErrorCode tspace_generateBytes(const tspace_Model* model, const char* options, tspace_Bytes* output,
                                      tspace_Bytes* report, tspace_Error* error) noexcept {
    return generateBytes(model, options, {}, output, report, error);
}

tspace_ErrorCode tspace_checkFile(const char* input, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) noexcept {
    return reportOnFile(options::checkOptions, check, input, options, report, error);
}

tspace_ErrorCode tspace::c_files::checkBytes(const tspace_Model* model, const char* options, const Progress& progress,
                                             tspace_Bytes* report, tspace_Error* error) noexcept {
    const auto call = [&](const std::string& name, options::CheckRequest& request, tspace_Bytes* json) {
        request.options.progress = progress;
        check(name, request, json);
    };
    return reportOnModel(options::checkOptions, call, model, options, report, error);
}

tspace_ErrorCode tspace_checkBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                   tspace_Error* error) noexcept {
    return checkBytes(model, options, {}, report, error);
}

tspace_ErrorCode tspace_inspectFile(const char* input, const char* options, tspace_Bytes* report,
                                    tspace_Error* error) noexcept {
    return reportOnFile(options::inspectOptions, inspect, input, options, report, error);
}

tspace_ErrorCode tspace_inspectBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) noexcept {
    return reportOnModel(options::inspectOptions, inspect, model, options, report, error);
}

tspace_ErrorCode tspace_identifyFile(const char* input, const char* options, tspace_Bytes* report,
                                     tspace_Error* error) noexcept {
    return reportOnFile(options::identifyOptions, identify, input, options, report, error);
}

tspace_ErrorCode tspace_identifyBytes(const tspace_Model* model, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) noexcept {
    return reportOnModel(options::identifyOptions, identify, model, options, report, error);
}

tspace_ErrorCode tspace_diffFiles(const char* a, const char* b, const char* options, tspace_Bytes* report,
                                  tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from_a = requiredText(a, "a"), from_b = requiredText(b, "b");
        options::DiffRequest request;
        readOptionsOf(options::diffOptions, options, request);
        diff(from_a, from_b, request, report);
    });
}

tspace_ErrorCode tspace_diffBytes(const tspace_Model* a, const tspace_Model* b, const char* options,
                                  tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        options::DiffRequest request;
        readOptionsOf(options::diffOptions, options, request);
        FileOptions& file = request.options.file;
        FileOptions& file_b = request.options.file_b.emplace(file);
        openModel(a, file);
        openModel(b, file_b);
        diff(nameOf(*a), nameOf(*b), request, report);
    });
}

tspace_ErrorCode tspace_flipGreenFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                      tspace_Error* error) noexcept {
    return makeFile(options::flipGreenOptions, flipGreenFile, report::flipGreenJson, input, output, options, report,
                    error);
}

tspace_ErrorCode tspace_convertMapFile(const char* input, const char* output, const char* options, tspace_Bytes* report,
                                       tspace_Error* error) noexcept {
    return makeFile(options::convertMapOptions, convertMapFile, report::convertMapJson, input, output, options, report,
                    error);
}

tspace_ErrorCode tspace_heightToNormalFile(const char* input, const char* output, const char* options,
                                           tspace_Bytes* report, tspace_Error* error) noexcept {
    return makeFile(options::heightToNormalOptions, heightToNormalFile, report::heightToNormalJson, input, output,
                    options, report, error);
}

tspace_ErrorCode tspace_compressMapFile(const char* input, const char* output, const char* options,
                                        tspace_Bytes* report, tspace_Error* error) noexcept {
    return makeFile(options::compressMapOptions, compressMapFile, report::compressMapJson, input, output, options,
                    report, error);
}

tspace_ErrorCode tspace_compressMapBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                         tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {output, report}, [&] {
        requirePointer(data, "data");
        requirePointer(output, "output");
        CompressMapFileOptions chosen;
        readOptionsOf(options::compressMapOptions, options, chosen);
        chosen.content = {data, size};
        const auto make = [&] {
            makeFile(compressMapFile, report::compressMapJson, "map", "map.ktx2", chosen, report);
        };
        makeBytes(chosen, make, output);
    });
}

tspace_ErrorCode tspace_bakeFile(const char* low, const char* high, const char* output, const char* options,
                                 tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {report}, [&] {
        const std::string from = requiredText(low, "low"), seen = requiredText(high, "high");
        const std::string to = requiredText(output, "output");
        BakeFileOptions chosen;
        readOptionsOf(options::bakeOptions, options, chosen);
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
        readOptionsOf(options::finishOptions, options, chosen);
        report::Outcome<FinishReport> outcome{.input = from, .output = to};
        giveOutcome(
            outcome, [&] { return finishFile(from, to, chosen); },
            [&] { return report::finishJson(outcome, chosen.low, report::exitCodeOf(*outcome.result)); }, report);
    });
}

tspace_ErrorCode tspace_flipGreenBytes(const uint8_t* data, size_t size, const char* options, tspace_Bytes* output,
                                       tspace_Bytes* report, tspace_Error* error) noexcept {
    return atCallBorder(error, {output, report}, [&] {
        requirePointer(data, "data");
        requirePointer(output, "output");
        FlipGreenOptions chosen;
        readOptionsOf(options::flipGreenOptions, options, chosen);
        FlippedImage flipped = valueOrThrow(flipGreen({data, size}, chosen));
        report::Outcome<FlipGreenReport> outcome{.is_dry_run = chosen.dry_run};
        outcome.result = std::move(flipped.report);
        if (report != nullptr) giveReport(report::flipGreenJson(outcome, ExitCode::done), report);
        if (!chosen.dry_run) GrowingBytes(flipped.bytes).giveTo(output);
    });
}
