// SPDX-License-Identifier: MIT
// tspace view: writes a page with an embedded model.
#include <filesystem>
#include <memory>

#include "command_table.h"
#include "commands/shared/request.h"
#include "commands/view/view_report.h"
#include "common_options.h"
#include "console.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "output_files.h"
#include "page_origin.h"
#include "report_outputs.h"

namespace tspace::tool {
namespace {

struct ViewArguments {
    std::string input = {};
    std::string output = {};
    FileOptions file = {};
    bool json = false;
    bool quiet = false;
};

namespace fs = std::filesystem;

/// Returns the path of the page: next to an installed tool, or in the build folder. Empty if the page was not built.
std::string pagePath() {
    const Path own = ownProgram();
    if (own.empty()) return {};
    for (const char* place : {"../share/tspace/view.html", "../../web/view.html"}) {
        const Path page = fs::path(folderOf(own) / place).lexically_normal();
        if (isThere(page)) return page.string();
    }
    return {};
}

}  // namespace

bool hasViewPage() { return !pagePath().empty(); }

namespace {

Result<ViewReport> view(const ViewArguments& arguments, const PageOrigin& origin) {
    const std::string page = pagePath();
    if (page.empty())
        return Error{ErrorCode::cannotRead,
                     "this build of tspace does not include the template of the page; run scripts/web to build it"};
    progressLine().update(arguments.input, "checking", 0, 0);
    return writeViewPage(arguments.input, arguments.output, page, arguments.file, origin);
}

ExitCode runView(const ViewArguments& arguments) {
    if (const Result<Done> fit = prepareOutputs({arguments.output}, {arguments.input}); !fit)
        return printUsageError(fit.error().message);
    const Result<PageOrigin> origin = pageOrigin();
    if (!origin) return printUsageError(origin.error().message);
    HeldOutputs outputs;
    report::Outcome<ViewReport> outcome{
        .input = arguments.input, .output = arguments.output, .result = view(arguments, *origin)};
    return commitAndPrint(outputs, [&](const Error* failure) {
        if (failure != nullptr) outcome.result = *failure;
        PreparedReport report;
        if (!outcome.result) report.exit_code = printError(arguments.input, outcome.result.error());
        if (arguments.json) {
            report.text = report::viewJson(outcome, report.exit_code);
        } else if (!arguments.quiet && outcome.result) {
            report.text = fitted(report::viewText(outcome));
        }
        return report;
    });
}

}  // namespace

Command viewCommand() {
    const auto owned = std::make_shared<ViewArguments>();
    ViewArguments& arguments = *owned;
    Command command{
        .summary = "write a web page that shows a model, its tangent frames and its findings",
        .operands = "IN -o OUT.html",
        .description =
            "Writes one self-contained HTML file of the model. It opens from disk in any browser and needs no network. "
            "The page shows the findings of tspace check and the model lit with its own frames and with recomputed "
            "ones. It can also repair the model. The template of the page is installed with tspace.",
        .examples = {"tspace view helmet.glb -o helmet.html"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input, InputKind::model,
                               "A model: .glb, .vrm, .gltf or .obj. The files that it references are embedded."));
    command.add(group, htmlOutput("-o, --output", "OUT", arguments.output, "Output file: .html or .htm.")).is_required =
        true;
    OptionList limits;
    options::addAllowExternal(limits, arguments.file);
    options::addMemoryLimit(limits, arguments.file.memory_limit_bytes);
    command.add(std::move(limits));
    addReporting(command, arguments.json, arguments.quiet);
    command.run = [owned] { return runView(*owned); };
    return command;
}

}  // namespace tspace::tool
