// SPDX-License-Identifier: MIT
// tspace check: reports faults of models as text, JSON, SARIF and HTML.
#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

#include "command_table.h"
#include "commands/check/check_report.h"
#include "commands/pages/check_page.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "core/base/ascii.h"
#include "model/io/path.h"
#include "output_files.h"
#include "page_origin.h"
#include "read_files.h"
#include "report_outputs.h"
#include "standard_input.h"

namespace tspace::tool {
namespace {

struct CheckArguments {
    std::vector<std::string> inputs = {};
    options::CheckRequest request = {};
    std::string sarif = {};  ///< path of the SARIF report; empty: none
    std::string html = {};   ///< path of the HTML report; empty: none
    Color color = Color::automatic;
    BatchArguments batch = {};
    bool json = false;
    bool pictures = false;
    bool quiet = false;
};

constexpr Named<Color> kColors[] = {
    {"auto", Color::automatic},
    {"always", Color::always},
    {"never", Color::never},
};

void addCheckReporting(Command& command, CheckArguments& arguments) {
    command.add(kReporting, fileOption("--sarif", "FILE", arguments.sarif,
                                       "Write the findings to this file as SARIF 2.1.0, which CI systems show as "
                                       "annotations; '-': to stdout, instead of the text.",
                                       InputKind::text));
    command.add(kReporting, htmlOutput("--html", "FILE", arguments.html,
                                       "Write a self-contained HTML report to this file, with pictures of each finding "
                                       "before and after its fix."));
    command.add(kReporting, flag("--pictures", arguments.pictures,
                                 "With --json: add the pictures of --html to the JSON, as PNG in base64."));
    command.add(kReporting, choice("--color", "WHEN", kColors, arguments.color,
                                   "Color the severities: always, never, or auto (on a terminal, unless the "
                                   "environment variable NO_COLOR is set)."));
}

/// Returns whether a file is named like a normal map: rock_normal.png, Rock-NRM.tga, rock_n.dds.
bool isNormalMapName(const std::string& file) {
    static constexpr std::array kWords = {"n", "nor", "norm", "normals", "nrm", "nrml", "nml", "ddn"};
    const std::string stem = lowerAscii(stemOf(Path(file)));
    if (stem.find("normal") != std::string::npos) return true;
    std::string word;
    for (const char c : stem + '.') {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            word += c;
            continue;
        }
        if (std::find(kWords.begin(), kWords.end(), word) != kWords.end()) return true;
        word.clear();
    }
    return false;
}

/// Returns whether the job is an image that a search found, and that is not a normal map according to its name and its
/// texels, such as a base color or roughness. An image named by the user is always reported.
bool isOtherImage(const Job& job, const CheckReport& report) {
    if (!job.is_found_image || !report.image || isNormalMapName(job.input)) return false;
    const std::string& content = report.image->content;
    return content == "picture" || content == "height" || content == "constant";
}

Result<CheckReport> check(const Job& job, CheckOptions options, const CheckArguments& arguments) {
    StandardInput standard_input;
    if (const Result<Done> opened = standard_input.open(job.input, options.file, true); !opened) return opened.error();
    options.progress = progressOf(job.input);
    Result<CheckReport> report = checkFile(job.input, options);
    if (!report) return report;
    if (isOtherImage(job, *report)) report->findings.clear();
    options::removeOmitted(arguments.request, *report);
    return report;
}

ExitCode runCheck(const CheckArguments& arguments) {
    const bool sarif_to_stdout = arguments.sarif == "-";
    const bool wants_text = !arguments.json && !arguments.quiet && !sarif_to_stdout;
    const bool in_color = wantsColor(arguments.color);
    std::vector<Job> jobs = inputJobs(arguments.inputs, SearchedFiles::modelsOrImages);
    std::vector<std::string> inputs;
    for (const Job& job : jobs) inputs.push_back(job.input);
    if (const Result<Done> fit = prepareOutputs({arguments.sarif, arguments.html}, inputs); !fit)
        return printUsageError(fit.error().message);
    const Result<PageOrigin> origin = pageOrigin();
    if (!arguments.html.empty() && !origin) return printUsageError(origin.error().message);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    CheckOptions options = arguments.request.options;
    InputFiles read;
    if (!arguments.sarif.empty() || !arguments.html.empty()) read.watch(options.file);
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    const auto files = readFiles<CheckReport>(
        jobs, arguments.batch, wants_text, [&](const Job& job) { return check(job, options, arguments); },
        [&](const report::CheckOutcome& outcome) { return report::checkText(outcome, in_color); });
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    ExitCode exit_code = files.exit_code;
    for (const report::CheckOutcome& outcome : files.outcomes) {
        if (outcome.result && options::makesCheckFail(arguments.request, *outcome.result))
            exit_code = worse(exit_code, ExitCode::findings);
    }
    // Reports are written even if files cannot be read, and list the errors. But if the only file did not fit into
    // memory, no report is written.
    const auto is_reported = [](const report::CheckOutcome& outcome) {
        return outcome.result || outcome.result.error().code != ErrorCode::outOfMemory;
    };
    const bool is_written =
        files.outcomes.size() > 1 || std::all_of(files.outcomes.begin(), files.outcomes.end(), is_reported);
    const auto write = [&](const std::string& path, const std::string& text) {
        const Result<Done> written = writeTextFile(path, text, &read);
        if (!written) exit_code = worse(exit_code, printError(path, written.error()));
    };
    HeldOutputs outputs;
    return commitAndPrint(outputs, [&](const Error* failure) {
        if (failure != nullptr) {
            exit_code =
                worse(exit_code, printError(arguments.html.empty() ? arguments.sarif : arguments.html, *failure));
        } else if (is_written) {
            if (!arguments.html.empty())
                write(arguments.html, checkPage(files.outcomes, options.file, *origin, progressOf(arguments.html)));
            if (!arguments.sarif.empty() && !sarif_to_stdout)
                write(arguments.sarif, report::checkSarif(files.outcomes, exit_code, TSPACE_DOCS_URL));
        }
        PreparedReport report{.exit_code = exit_code};
        if (sarif_to_stdout) {
            report.text = report::checkSarif(files.outcomes, exit_code, TSPACE_DOCS_URL);
        } else if (arguments.json) {
            const Json pictures =
                arguments.pictures ? picturesJson(files.outcomes, options.file, progressOf("pictures")) : Json();
            report.text = report::checkJson(files.outcomes, exit_code, arguments.request.fail_on, pictures);
        } else if (wants_text && files.outcomes.size() > 1) {
            report.text = fitted(report::checkSummary(files.outcomes, in_color));
        }
        return report;
    });
}

}  // namespace

Command checkCommand() {
    const auto owned = std::make_shared<CheckArguments>();
    CheckArguments& arguments = *owned;
    arguments.request.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "find errors in normals, tangents and UVs, or in a normal map",
        .operands = "IN...",
        .description =
            "Compares tangents with the UVs that the material's textures use: signs, directions, seams, UV sets and "
            "texture transforms. Also reports values that are not finite or not of unit length, wrong normals and "
            "morph targets, and normal maps with inverted green. Every finding states how to fix it. Severities: "
            "error: wrong shading in every renderer; warning: wrong shading in some renderers or in a small area, or "
            "uncertain; note: harmless. No input is changed. An image as input (PNG, JPEG, WebP, EXR, KTX2, DDS, "
            "TGA) is checked as a normal map, without a model: direction of green, channels, encoding, lengths. A "
            "folder or pattern without models is searched for images; images that neither look like a normal map nor "
            "are named like one get no findings.",
        .examples = {"tspace check helmet.glb", "tspace check normal.png", "tspace check textures/",
                     "tspace check --fail-on warning --jobs 0 models/", "tspace check --json models/ > findings.json",
                     "tspace check --quiet --sarif findings.sarif models/",
                     "tspace check --html report.html helmet.glb"},
        .finish = [&arguments](const Given&) -> std::string {
            if (arguments.pictures && !arguments.json) return "--pictures needs --json";
            return arguments.json && arguments.sarif == "-" ? "--json and --sarif - cannot both write to stdout" : "";
        },
    };
    addInputs(command, arguments.inputs, InputKind::any);
    command.add(checkOptions(arguments.request));
    addBatch(command, arguments.batch, false);
    addCheckReporting(command, arguments);
    addReporting(command, arguments.json, arguments.quiet);
    command.file = &owned->request.options.file;
    command.run = [owned] { return runCheck(*owned); };
    return command;
}

}  // namespace tspace::tool
