// SPDX-License-Identifier: MIT
// Starts the command that the command line asks for.
#include <exception>

#include "arguments.h"
#include "commands.h"
#include "console.h"

namespace {

using namespace tspace::tool;

ExitCode run(int argc, char** argv) {
    const Arguments arguments = parseArguments(argc, argv);
    if (const auto* generate = std::get_if<GenerateArguments>(&arguments)) return runGenerate(*generate);
    if (const auto* inspect = std::get_if<InspectArguments>(&arguments)) return runInspect(*inspect);
    return std::get<ExitCode>(arguments);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return static_cast<int>(run(argc, argv));
    } catch (const std::exception& defect) {
        printError("internal error", {tspace::ErrorCode::internal, defect.what()});
        return static_cast<int>(ExitCode::internal);
    }
}
