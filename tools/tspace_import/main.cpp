// SPDX-License-Identifier: MIT
// tspace-import IN MAX_BYTES MAX_PROCESSOR_SECONDS MAX_SECONDS PARENT WHERE COORDINATES: reads FBX, PLY, STL, DAE, 3DS
// and other formats of Assimp, and writes a GLB to stdout, which tspace processes. It is a separate program, because
// Assimp's parsers may crash, hang or be exploited by corrupt files: memory and time are limited, and so are its
// privileges (confine.h). WHERE: "folder" (only files in the model's folder may be read) or "anywhere". COORDINATES:
// "near-origin" (an offset may be subtracted) or "as-they-are". It ends when the process PARENT does. Not intended for
// users.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "confine.h"
#include "import_scene.h"
#include "number_text.h"

namespace {

constexpr int kBadInput = 3;
constexpr int kCannotWrite = 4;
constexpr int kOutOfMemory = 5;

/// Sets a resource limit. The type of `resource` differs between systems.
template <class Resource>
void limit(Resource resource, rlim_t soft, rlim_t hard) {
    const rlimit limits = {soft, hard};
    setrlimit(resource, &limits);
}

void limitAll(rlim_t bytes, rlim_t processor_seconds, unsigned seconds) {
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);  // the output pipe is not limited by this
    // The soft limit sends a signal, by which the parent detects the cause. The hard limit ends the process if it
    // ignores the signal.
    limit(RLIMIT_CPU, processor_seconds, processor_seconds + 1);
    // The timer expires one second after the parent's limit, in case the parent no longer exists.
    alarm(seconds + 1);
#if defined(RLIMIT_AS) && !defined(TSPACE_SANITIZED)  // sanitizers reserve terabytes of address space
    limit(RLIMIT_AS, bytes, bytes);
#else
    static_cast<void>(bytes);
#endif
}

/// Makes this process end when the thread that started it does; in tspace that thread waits for this process. Returns
/// false if it has already ended.
bool endWithParent([[maybe_unused]] pid_t parent) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    return getppid() == parent;
}

/// Closes files that the parent had open, because a parser must not access them.
void closeOtherFiles() {
    constexpr unsigned kFirst = 3;
#if defined(__linux__) && defined(SYS_close_range)
    if (syscall(SYS_close_range, kFirst, ~0U, 0U) == 0) return;
#endif
    constexpr long kMax = 65536;
    for (long i = kFirst; i < std::min(sysconf(_SC_OPEN_MAX), kMax); ++i) close(static_cast<int>(i));
}

/// Ensures that no opened file gets the descriptor of stdin, stdout or stderr, which may be closed.
void openStandardStreams() {
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
        if (fcntl(number, F_GETFD) == -1) static_cast<void>(open("/dev/null", number == 0 ? O_WRONLY : O_RDONLY));
    }
}

/// Reserves stdout for the result, and discards other output of libraries.
int takeStdout() {
    const int result = dup(STDOUT_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
    return result;
}

int run(const char* input, const tspace::import::ImportRules& rules, std::FILE* output) {
    const std::string folder = std::filesystem::path(input).parent_path().string();
    tspace::import::confine({input, rules.anywhere ? "/" : folder.empty() ? "." : folder});
    const tspace::import::Imported imported = tspace::import::importScene(input, rules);
    if (!imported.error.empty()) {
        std::fprintf(stderr, "%s\n", imported.error.c_str());
        return kBadInput;
    }
    const bool written =
        output != nullptr && std::fwrite(imported.glb.data(), 1, imported.glb.size(), output) == imported.glb.size();
    if (output == nullptr || std::fclose(output) != 0 || !written) {
        std::fprintf(stderr, "cannot write the result\n");
        return kCannotWrite;
    }
    // importDocument recognizes these lines among other output of libraries.
    if (imported.has_no_tangents) std::fprintf(stderr, "tangents: none\n");
    if (imported.keeps_coordinates) std::fprintf(stderr, "coordinates: kept\n");
    const double* const offset = imported.offset;
    if (offset[0] != 0 || offset[1] != 0 || offset[2] != 0)
        std::fprintf(stderr, "offset: %s %s %s\n", tspace::import::numberText(offset[0]).c_str(),
                     tspace::import::numberText(offset[1]).c_str(), tspace::import::numberText(offset[2]).c_str());
    for (const std::string& warning : imported.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return 0;
}

}  // namespace

#ifdef TSPACE_SANITIZED
/// Disables the leak checker, which would fail because a confined process must not read /proc.
extern "C" const char* __lsan_default_options() { return "detect_leaks=0"; }
#endif

int main(int argc, char** argv) {
    openStandardStreams();
    if (argc != 8) {
        std::fprintf(stderr,
                     "usage: tspace-import IN MAX_BYTES MAX_PROCESSOR_SECONDS MAX_SECONDS PARENT folder|anywhere "
                     "near-origin|as-they-are (a helper of tspace)\n");
        return 2;
    }
    const auto number = [argv](int i) { return std::strtoull(argv[i], nullptr, 10); };
    if (!endWithParent(static_cast<pid_t>(number(5)))) return kCannotWrite;
    closeOtherFiles();
    limitAll(number(2), number(3), static_cast<unsigned>(number(4)));
    try {
        const tspace::import::ImportRules rules{.anywhere = std::string_view(argv[6]) == "anywhere",
                                                .keep_coordinates = std::string_view(argv[7]) == "as-they-are"};
        return run(argv[1], rules, fdopen(takeStdout(), "wb"));
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "reading the file would exceed the memory limit; use --memory-limit to raise it\n");
        return kOutOfMemory;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return kBadInput;
    }
}
