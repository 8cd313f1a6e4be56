// SPDX-License-Identifier: MIT
// tspace view: a page with the model in it.
#include <fmt/core.h>

#include <filesystem>

#include "commands.h"
#include "commands/view/view_report.h"
#include "console.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "output_files.h"
#include "report.h"

namespace tspace::tool {
namespace {

namespace fs = std::filesystem;

/// Beside an installed tool, or in the build folder; empty: it was not built.
std::string pagePath() {
    const Path own = ownProgram();
    if (own.empty()) return {};
    for (const char* place : {"../share/tspace/view.html", "../../web/view.html"}) {
        const Path page = fs::path(folderOf(own) / place).lexically_normal();
        if (isThere(page)) return page.string();
    }
    return {};
}

Result<ViewReport> view(const ViewArguments& arguments) {
    const std::string page = pagePath();
    if (page.empty())
        return Error{ErrorCode::cannotRead, "the page was not built with this tool: scripts/web builds it"};
    return writeViewPage(arguments.input, arguments.output, page, arguments.file);
}

}  // namespace

ExitCode runView(const ViewArguments& arguments) {
    if (const Result<Done> fit = prepareOutputs({arguments.output}, {arguments.input}); !fit)
        return printUsageError(fit.error().message);
    const report::Outcome<ViewReport> outcome{
        .input = arguments.input, .output = arguments.output, .result = view(arguments)};
    const ExitCode exit_code = outcome.result ? ExitCode::done : printError(arguments.input, outcome.result.error());
    std::string text;
    if (arguments.json) {
        text = report::viewJson(outcome, exit_code);
    } else if (!arguments.quiet && outcome.result) {
        text = fmt::format("{} -> {}: {}, {}\n", printable(arguments.input), printable(arguments.output),
                           counted(outcome.result->files.size(), "file"), byteText(outcome.result->output_bytes));
    }
    return printResult(text) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
