// SPDX-License-Identifier: MIT
// Starts the command given on the command line.
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "command_table.h"
#include "commands/shared/option_table.h"
#include "console.h"
#include "core/base/border.h"
#include "help.h"
#include "input_kinds.h"
#include "interrupt.h"
#include "jobs.h"
#include "model/io/temporary_files.h"
#include "page_origin.h"
#include "read_command_line.h"
#include "system.h"

namespace {

using namespace tspace::tool;

/// Makes the allocator reuse the freed memory of one primitive for the next. By default, large blocks are returned to
/// the system immediately, and each page of the next block has to be cleared again.
void keepFreedMemory() {
#ifdef __GLIBC__
    constexpr int kMaxAllowed = 32 << 20;
    mallopt(M_MMAP_THRESHOLD, kMaxAllowed);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

/// Makes the allocator return freed blocks of 16 KB and more to the system, and use one heap for all threads. It is
/// used for commands that keep small results between large blocks: these results would fragment the heaps, and files
/// with many primitives would need a multiple of the memory. With 64 KB, checking 3,000 primitives of 400 vertices with
/// 8 threads took 118 MB instead of 51 MB. Linux limits the mappings of a process to 65,530, so half of them are used.
void returnFreedMemory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 16 << 10);
    mallopt(M_MMAP_MAX, 32 << 10);
    mallopt(M_ARENA_MAX, 1);
#endif
}

constexpr const char* kOutOfMemory = "tspace: out of memory\n";

/// Handles a first argument that is not a command.
ExitCode runWithoutCommand(const std::string& word) {
    const ToolTable tool = toolTable();
    if (word == "-h" || word == "--help") return printPage(helpPage(tool));
    if (word == "-V" || word == "--version") {
        return printResult("tspace " TSPACE_VERSION "\n" + missingFeatures()) ? ExitCode::done
                                                                              : ExitCode::cannotReadOrWrite;
    }
    const char* see = " (see tspace --help)";
    if (!word.starts_with('-')) return printUsageError(unknownCommand(word) + see);
    std::vector<std::string> names;
    for (const Option& option : tool.options) names.insert(names.end(), option.names.begin(), option.names.end());
    return printUsageError("expected a command, not '" + word + "'" + didYouMean(word, names) + see);
}

ExitCode run(int argc, char** argv) {
    if (argc < 2)
        return printPage(helpPage(toolTable())) == ExitCode::done ? ExitCode::usage : ExitCode::cannotReadOrWrite;
    const std::optional<Command> command = findCommand(argv[1]);
    if (!command) return runWithoutCommand(argv[1]);
    const bool has_topic = command->name == "help" && argc > 2 && argv[2][0] != '-' && argv[2][0] != 0;
    if (has_topic && !findCommand(argv[2])) return runWithoutCommand(argv[2]);
    Given given;
    const std::span<const char* const> arguments(argv + 2, static_cast<std::size_t>(argc - 2));
    const std::string wrong = readCommandLine(*command, arguments, given);
    if (!wrong.empty()) return printUsageError(wrong + " (see tspace " + command->name + " --help)");
    if (given.has("--help")) return printPage(helpPage(*command));
    const std::string wrong_kind = wrongKindOfInput(*command, given);
    if (!wrong_kind.empty()) return printUsageError(wrong_kind);
    command->keeps_freed_memory ? keepFreedMemory() : returnFreedMemory();
    if (!given.has("--quiet")) progressLine().start();
    ExitCode exit_code = command->prepare ? command->prepare() : ExitCode::done;
    if (command->file != nullptr) command->file->importer = importerPath();
    if (exit_code == ExitCode::done) exit_code = command->run();
    progressLine().stop();
    return exit_code;
}

/// Terminate handler: called if an exception cannot be thrown for lack of memory, or would leave a noexcept function.
/// It removes temporary files, as after a signal.
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
        // The message is a constant, because formatting a message would allocate memory.
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
