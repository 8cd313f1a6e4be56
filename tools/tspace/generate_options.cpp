// SPDX-License-Identifier: MIT
// The options of tspace generate that are about command lines.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {
namespace {

constexpr Named<Container> kContainers[] = {
    {"glb", Container::glb},
    {"gltf", Container::gltf},
};

void addOutputOptions(Command& command, GenerateArguments& arguments) {
    const char* group = kInputAndOutput;
    addInputs(command, arguments.inputs);
    command
        .add(group,
             text("-o, --output", "OUT", arguments.output,
                  "Where to write: a file that ends in .glb, .vrm or .gltf, or a folder. With several inputs, or a "
                  "folder as input, it is a folder: it is made if it is not there, and files keep their paths "
                  "relative to the input folder. Where a.glb and a.obj would both become a.glb, the later one "
                  "becomes a.obj.glb. '-': the model, a GLB, goes to stdout, and the report to stderr."))
        .is_file = true;
    command.add(group, flag("--in-place", arguments.in_place,
                            "Write over the input files. Each is replaced only when its result is complete. Without "
                            "this, an output that is an input is refused."));
    command.add(group, choice("--container", "FORMAT", kContainers, arguments.container,
                              "File format of outputs whose name does not say it: glb or gltf. Default: that of the "
                              "input; glb for OBJ."));
}

/// What options mean together. Returns what makes no sense.
std::string finish(const Given& given, GenerateArguments& arguments) {
    arguments.option_text = resultOptions(given);
    return options::finish(given, arguments.options);
}

}  // namespace

Command generateCommand(GenerateArguments& arguments) {
    Command command{
        .name = "generate",
        .summary = "add the tangents that normal maps need",
        .operands = "IN... -o OUT",
        .description =
            "Reads model files, adds tangents where a material needs them (a normal map, clearcoat normal map or "
            "anisotropy) and none are there, makes missing normals first, and writes glTF. Vertices are split where "
            "their corners disagree, and all their attributes, skin weights and morph targets go along. Morph targets "
            "that move the surface get tangent deltas. Everything else in a file stays as it is. A failed run leaves "
            "the old output untouched.",
        .examples = {"tspace generate helmet.glb -o out/helmet.glb",
                     "tspace generate --all --overwrite models/ -o out/",
                     "tspace generate scan.obj -o scan.glb --all --normals angle --crease 60",
                     "tspace generate --json *.glb -o out/ > report.json", "cat a.glb | tspace generate - -o - > b.glb",
                     "tspace generate models/ -o out/ --jobs 8 --manifest done.jsonl --resume"},
        .finish = [&arguments](const Given& given) { return finish(given, arguments); },
    };
    addOutputOptions(command, arguments);
    command.add(generateOptions(arguments.options));
    addBatch(command, arguments.batch, true);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
