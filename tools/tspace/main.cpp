// SPDX-License-Identifier: MIT
// Starts the command given on the command line.
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "command_table.h"
#include "commands/shared/option_table.h"
#include "console.h"
#include "core/base/border.h"
#include "help.h"
#include "interrupt.h"
#include "model/io/atomic_output.h"
#include "model/io/path.h"
#include "page_origin.h"
#include "read_command_line.h"
#include "system.h"

namespace {

using namespace tspace::tool;

/// Makes freed memory of one primitive available to the next. By default large blocks are returned to the system
/// immediately, and each page of the next block has to be cleared again.
void keepFreedMemory() {
#ifdef __GLIBC__
    constexpr int kMostAllowed = 32 << 20;
    mallopt(M_MMAP_THRESHOLD, kMostAllowed);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

/// Returns large freed blocks to the system. All other commands keep small results between them: in one heap, freed
/// blocks would be fragmented, and files with many primitives would need a multiple of the memory.
void giveMemoryBack() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
#endif
}

constexpr const char* kOutOfMemory = "tspace: out of memory\n";

/// A common wrong command name, and the command line to suggest.
struct Synonym {
    std::string_view word;
    const char* command_line;
};
constexpr Synonym kSynonyms[] = {
    {"add", "generate IN -o OUT"},
    {"compare", "diff A B"},
    {"convert", "convert-map IN -o OUT"},
    {"fix", "generate --repair IN -o OUT"},
    {"flip", "flip-green IN -o OUT"},
    {"info", "inspect IN"},
    {"lint", "check IN"},
    {"repair", "generate --repair IN -o OUT"},
    {"tangents", "generate IN -o OUT"},
    {"validate", "check IN"},
    {"version", "--version"},
};

bool isModelName(const std::string& name) {
    const std::string extension = tspace::lowerExtension(name);
    return tspace::isGltfName(name) || extension == ".obj" || extension == ".fbx";
}

/// Returns a message if the names of all inputs show that a different command was intended.
std::string wrongKindOfInput(const Command& command, const Given& given) {
    if (command.reads == Reads::anything) return {};
    const bool reads_models = command.reads == Reads::models;
    std::string input;
    for (const Given::Item& item : given.items) {
        if (!item.option->names.empty()) continue;
        if (!(reads_models ? tspace::isImageName(item.value) : isModelName(item.value))) return {};
        if (input.empty()) input = item.value;
    }
    if (input.empty()) return {};
    if (reads_models)
        return command.name + " reads models, but '" + input + "' is an image; tspace check examines a normal map";
    return command.name + " reads images, but '" + input +
           "' is a model; tspace generate --flip-green and --convert-maps change the maps of a model";
}

/// Handles a first argument that is not a command.
ExitCode runWithoutCommand(const std::string& word) {
    const ToolTable tool = toolTable();
    if (word == "-h" || word == "--help") return printPage(helpPage(tool));
    if (word == "-V" || word == "--version") {
        return printResult("tspace " TSPACE_VERSION "\n" + leftOut()) ? ExitCode::done : ExitCode::cannotReadOrWrite;
    }
    const char* see = " (see tspace --help)";
    std::vector<std::string> names;
    if (!word.starts_with('-')) {
        for (const Command& command : tool.commands) names.push_back(command.name);
        for (const Synonym& synonym : kSynonyms) {
            if (word == synonym.word)
                return printUsageError("unknown command '" + word + "'; use tspace " + synonym.command_line + see);
        }
        return printUsageError("unknown command '" + word + "'" + didYouMean(word, names) + see);
    }
    for (const Option& option : tool.options) names.insert(names.end(), option.names.begin(), option.names.end());
    const std::string nearest = didYouMean(word, names);
    return printUsageError("expected a command, not '" + word + "'" + nearest + see);
}

ExitCode run(int argc, char** argv) {
    if (argc < 2)
        return printPage(helpPage(toolTable())) == ExitCode::done ? ExitCode::usage : ExitCode::cannotReadOrWrite;
    const std::optional<Command> command = findCommand(argv[1]);
    if (!command) return runWithoutCommand(argv[1]);
    Given given;
    const std::span<const char* const> arguments(argv + 2, static_cast<std::size_t>(argc - 2));
    const std::string wrong = readCommandLine(*command, arguments, given);
    if (!wrong.empty()) return printUsageError(wrong + " (see tspace " + command->name + " --help)");
    if (given.has("--help")) return printPage(helpPage(*command));
    const std::string wrong_kind = wrongKindOfInput(*command, given);
    if (!wrong_kind.empty()) return printUsageError(wrong_kind);
    command->keeps_freed_memory ? keepFreedMemory() : giveMemoryBack();
    if (!given.has("--quiet")) progressLine().start();
    ExitCode exit_code = command->prepare ? command->prepare() : ExitCode::done;
    if (exit_code == ExitCode::done) exit_code = command->run();
    progressLine().stop();
    return exit_code;
}

/// Called if an exception cannot be thrown because of a lack of memory, or would leave a noexcept function. As after a
/// signal, no temporary files remain.
[[noreturn]] void endWithoutUnwinding() {
    const bool is_out_of_memory =
        std::current_exception() == nullptr || tspace::caughtError().code == tspace::ErrorCode::outOfMemory;
    tspace::removeTemporaryFiles(true);
    printPlain(is_out_of_memory ? kOutOfMemory : "tspace: internal error\n");
    std::_Exit(static_cast<int>(ExitCode::internal));
}

}  // namespace

int main(int argc, char** argv) {
    openStandardStreams();
    endCleanlyBySignals();
    std::set_terminate(endWithoutUnwinding);
    try {
        std::vector<char*> words = commandLine(argc, argv);
        rememberCommandLine(words);
        return static_cast<int>(run(static_cast<int>(words.size()), words.data()));
    } catch (const std::bad_alloc&) {
        // Formatting a message would allocate.
        printPlain(kOutOfMemory);
    } catch (const tspace::OutOfMemory&) {
        printPlain(kOutOfMemory);
    } catch (const std::exception& defect) {
        printPlain("tspace: internal error: ");
        printPlain(defect.what());
        printPlain("\n");
    } catch (...) {
        printPlain("tspace: internal error\n");
    }
    return static_cast<int>(ExitCode::internal);
}
