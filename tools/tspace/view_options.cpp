// SPDX-License-Identifier: MIT
// The options of tspace view.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {

Command viewCommand(ViewArguments& arguments) {
    Command command{
        .name = "view",
        .summary = "write a page that shows a model, its frames and what is wrong",
        .operands = "IN -o OUT.html",
        .description =
            "Makes one HTML file of the model, with everything it needs inside: it opens from disk in any browser, "
            "asks no network, shows what tspace check finds, lights the model with the frames of the file and with "
            "right ones, and mends it. The page itself is built by scripts/web and installed with the tool.",
        .examples = {"tspace view helmet.glb -o helmet.html"},
        .finish =
            [&arguments](const Given&) {
                return arguments.output.empty() ? std::string("say where to write: -o OUT.html") : std::string();
            },
    };
    const char* group = kInputAndOutput;
    command.add(group,
                operand("IN", arguments.input, "A model: .glb, .vrm, .gltf or .obj; what it names goes in too."));
    command.add(group, text("-o, --output", "OUT", arguments.output, "Where to write the page.")).is_file = true;
    command.add(inspectOptions(arguments.file));
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
