// SPDX-License-Identifier: MIT
// Starts the command that the command line asks for.
#include <exception>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "system.h"

namespace {

using namespace tspace::tool;

/// Memory that one primitive gave back serves the next one. By default large blocks go back to the system at once, and
/// each page of the next one has to be cleared again.
void keepFreedMemory() {
#ifdef __GLIBC__
    constexpr int kMostAllowed = 32 << 20;
    mallopt(M_MMAP_THRESHOLD, kMostAllowed);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

/// The other commands keep what they found between large blocks that they let go of. Left in one heap, those would not
/// fit into each other's places, and files with many primitives would take a multiple of what they need.
void giveMemoryBack() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
#endif
}

ExitCode run(int argc, char** argv) {
    const Arguments arguments = parseArguments(argc, argv);
    if (const auto* generate = std::get_if<GenerateArguments>(&arguments)) {
        keepFreedMemory();
        return runGenerate(*generate);
    }
    giveMemoryBack();
    if (const auto* diff = std::get_if<DiffArguments>(&arguments)) return runDiff(*diff);
    if (const auto* identify = std::get_if<IdentifyArguments>(&arguments)) return runIdentify(*identify);
    if (const auto* inspect = std::get_if<InspectArguments>(&arguments)) return runInspect(*inspect);
    if (const auto* check = std::get_if<CheckArguments>(&arguments)) return runCheck(*check);
    if (const auto* flip = std::get_if<FlipGreenArguments>(&arguments)) return runFlipGreen(*flip);
    if (const auto* render = std::get_if<RenderArguments>(&arguments)) return runRender(*render);
    if (const auto* convert = std::get_if<ConvertMapArguments>(&arguments)) return runConvertMap(*convert);
    if (const auto* heights = std::get_if<HeightToNormalArguments>(&arguments)) return runHeightToNormal(*heights);
    if (const auto* view = std::get_if<ViewArguments>(&arguments)) return runView(*view);
    if (const auto* bake = std::get_if<BakeArguments>(&arguments)) return runBake(*bake);
    if (const auto* measure = std::get_if<MapErrorArguments>(&arguments)) return runMapError(*measure);
    return std::get<ExitCode>(arguments);
}

}  // namespace

int main(int argc, char** argv) {
    openStandardStreams();
    tidyUpAtSignals();
    try {
        std::vector<char*> words = commandLine(argc, argv);
        return static_cast<int>(run(static_cast<int>(words.size()), words.data()));
    } catch (const std::bad_alloc&) {
        // What is printed takes memory too.
        printPlain("tspace: out of memory\n");
    } catch (const std::exception& defect) {
        printPlain("tspace: internal error: ");
        printPlain(defect.what());
        printPlain("\n");
    } catch (...) {
        printPlain("tspace: internal error\n");
    }
    return static_cast<int>(ExitCode::internal);
}
