// SPDX-License-Identifier: MIT
// tspace-import IN MAX_BYTES MAX_PROCESSOR_SECONDS MAX_SECONDS PARENT WHERE COORDINATES: reads FBX, PLY, STL, DAE, 3DS and
// what else Assimp knows, and writes to stdout a GLB that tspace goes on with. A program of its own, because Assimp's
// parsers may crash, run away or do worse on broken files: memory and time are limited, and so is what it may do
// (confine.h). WHERE: "folder", the files that it may read are those in the model's folder, or "anywhere". COORDINATES:
// "near-origin", an offset may be taken out, or "as-they-are". It ends when the process PARENT does. Not meant to be called
// by hand.
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

/// The type of `resource` is another one on each system.
template <class Resource>
void limit(Resource resource, rlim_t soft, rlim_t hard) {
    const rlimit limits = {soft, hard};
    setrlimit(resource, &limits);
}

void limitAll(rlim_t bytes, rlim_t processor_seconds, unsigned seconds) {
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);  // pipes are no files
    // The signal of the soft limit tells the parent why. At the hard one there is no way around.
    limit(RLIMIT_CPU, processor_seconds, processor_seconds + 1);
    // One second after the parent would have ended it: for a parent that is not there to do it.
    alarm(seconds + 1);
#if defined(RLIMIT_AS) && !defined(TSPACE_SANITIZED)  // which reserves terabytes of addresses
    limit(RLIMIT_AS, bytes, bytes);
#else
    static_cast<void>(bytes);
#endif
}

/// From now on this process ends when the thread that started it does: in tspace that thread waits here for it. False:
/// it has ended before.
bool endWithParent([[maybe_unused]] pid_t parent) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    return getppid() == parent;
}

/// Closes files that the parent had open: a parser must not reach them.
void closeOtherFiles() {
    constexpr unsigned kFirst = 3;
#if defined(__linux__) && defined(SYS_close_range)
    if (syscall(SYS_close_range, kFirst, ~0U, 0U) == 0) return;
#endif
    constexpr long kMost = 65536;
    for (long i = kFirst; i < std::min(sysconf(_SC_OPEN_MAX), kMost); ++i) close(static_cast<int>(i));
}

/// No file that is opened takes the place of stdin, stdout or stderr, which may be closed.
void openStandardStreams() {
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
        if (fcntl(number, F_GETFD) == -1) static_cast<void>(open("/dev/null", number == 0 ? O_WRONLY : O_RDONLY));
    }
}

/// Keeps stdout for the result: output of libraries is dropped.
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
    // importDocument tells these lines from others that a library may print.
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
/// The leak checker reads /proc, which a confined process may not, and would end it with an error.
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
        std::fprintf(stderr, "reading it needs more memory than the limit (--memory-limit allows more)\n");
        return kOutOfMemory;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return kBadInput;
    }
}
