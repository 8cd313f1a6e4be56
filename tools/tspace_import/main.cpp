// SPDX-License-Identifier: MIT
// tspace-import IN OUT.glb MAX_BYTES MAX_SECONDS: reads FBX, PLY, STL, DAE, 3DS and what else Assimp knows, and writes
// a GLB that tspace goes on with. A program of its own, because Assimp's parsers may crash or run away on broken files:
// memory and time are limited, and whatever happens ends with this process. Not meant to be called by hand.
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "import_scene.h"

namespace {

constexpr int kBadInput = 3;
constexpr int kCannotWrite = 4;
constexpr int kOutOfMemory = 5;

void limit(int resource, rlim_t value) {
    const rlimit limits = {value, value};
    setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

int run(const char* input, const char* output) {
    const tspace::import::Imported imported = tspace::import::importScene(input);
    if (!imported.error.empty()) {
        std::fprintf(stderr, "%s\n", imported.error.c_str());
        return kBadInput;
    }
    std::FILE* file = std::fopen(output, "wb");
    const bool written =
        file != nullptr && std::fwrite(imported.glb.data(), 1, imported.glb.size(), file) == imported.glb.size();
    if (file == nullptr || std::fclose(file) != 0 || !written) {
        std::fprintf(stderr, "cannot write the temporary file\n");
        return kCannotWrite;
    }
    // importDocument takes these lines from others that a library may print.
    for (const std::string& warning : imported.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fprintf(stderr, "usage: tspace-import IN OUT.glb MAX_BYTES MAX_SECONDS (a helper of tspace)\n");
        return 2;
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, std::strtoull(argv[4], nullptr, 10));
#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes of addresses
    limit(RLIMIT_AS, std::strtoull(argv[3], nullptr, 10));
#endif
    try {
        return run(argv[1], argv[2]);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "reading it takes more memory than is allowed (--memory-limit allows more)\n");
        return kOutOfMemory;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return kBadInput;
    }
}
