// SPDX-License-Identifier: MIT
// Calls whose instructions are counted by a test, which runs "tspace_counted_calls CASE" under callgrind. They use one
// thread, SSE2 where the library lets a caller choose, and meshes that are equal on every machine, so that the count
// depends only on the code and the compiler.
#include <cstdio>
#include <cstring>
#include <functional>

#include "core/pack/formats.h"
#include "core/pack/random_frames.h"
#include "job.h"

namespace tspace::bench {
namespace {

/// Function whose instructions callgrind counts. It has a fixed name and is never inlined.
extern "C" [[gnu::noinline]] void tspaceCountedCall(const Job& job, const Execution& execution) {
    job.call(execution);
    // prevents a tail call, which would leave the function too early
    asm volatile("" ::: "memory");
}

struct Case {
    const char* name;
    const char* job;
    Mesh (*mesh)();
};

constexpr Case kCases[] = {
    {"mikktspace_natural_20k", "mikktspace", [] { return torusOf(20000); }},
    {"mikktspace_box_12", "mikktspace", boxMesh},
    {"mikktspace_natural_200", "mikktspace", [] { return torusOf(200); }},
    {"mikktspace_shuffled_20k", "mikktspace", [] { return shuffled(torusOf(20000)); }},
    {"mikktspace_two_sweep_20k", "mikktspace", [] { return inOrder(torusOf(20000), "two_sweep"); }},
    {"mikktspace_unindexed_10k", "mikktspace", [] { return unindexed(torusOf(10000)); }},
    {"mikktspace_quads_all_10k", "mikktspace_all", [] { return quadsOf(10000); }},
    {"evaluate_20k", "evaluate", [] { return torusOf(20000); }},
    {"angle_20k", "angle", [] { return torusOf(20000); }},
    {"lengyel_20k", "lengyel", [] { return torusOf(20000); }},
    {"flat_20k", "flat", [] { return torusOf(20000); }},
    {"normals_20k", "normals", [] { return torusOf(20000); }},
    {"normals_flat_20k", "normals_flat", [] { return torusOf(20000); }},
    {"normals_crease_20k", "normals_crease", [] { return torusOf(20000); }},
    {"normals_best_20k", "normals_best", [] { return torusOf(20000); }},
    {"fast_20k", "fast", [] { return torusOf(20000); }},
    {"best_20k", "best", [] { return torusOf(20000); }},
    {"split_20k", "split", [] { return foldsOf(20000); }},
};

struct PackCase {
    const char* name;
    FrameFormat format;
    bool unpack;
};

constexpr PackCase kPackCases[] = {
    {"pack_frame32_20k", FrameFormat::frame32, false},
    {"pack_oct32_20k", FrameFormat::oct32, false},
    {"unpack_frame32_20k", FrameFormat::frame32, true},
    {"unpack_oct32_20k", FrameFormat::oct32, true},
};

/// Calls the internal functions, because callers of the API cannot choose the SIMD target of packing.
Job packJob(FrameFormat name, bool unpack) {
    const pack::Format& format = *pack::formatOf(name);
    test::RandomBits random(1);
    auto frames = std::make_shared<test::FrameList>(test::randomFrames(random, 20000));
    auto bytes = std::make_shared<std::vector<std::byte>>(frames->size() * format.bytes);
    const auto callPack = [=, &format](const Execution& execution) {
        pack::pack(format, execution.simd, {frames->normals.data(), frames->size()},
                   {frames->tangents.data(), frames->size()}, bytes->data());
    };
    if (!unpack) return {nullptr, callPack};
    callPack({});
    return {nullptr, [=, &format](const Execution& execution) {
                pack::unpack(format, execution.simd, bytes->data(), frames->normals, frames->tangents);
            }};
}

int count(const Job& job) {
    Execution execution{.thread_count = 1};
    forceSimd(execution, "sse2");
    tspaceCountedCall(job, execution);
    return 0;
}

int run(const char* name) {
    for (const PackCase& c : kPackCases) {
        if (std::strcmp(name, c.name) == 0) return count(packJob(c.format, c.unpack));
    }
    for (const Case& c : kCases) {
        if (std::strcmp(name, c.name) != 0) continue;
        const Mesh mesh = c.mesh();
        return count(makeJob(c.job, mesh));
    }
    return 2;
}

}  // namespace
}  // namespace tspace::bench

int main(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "--compiler") == 0) {
#ifndef __x86_64__
        std::fputs("not for x86-64: ", stdout);  // only the counts for x86-64 are recorded
#endif
#ifdef __clang__
        std::puts("clang " __clang_version__ " " TSPACE_BENCH_FLAGS);
#else
        std::puts("gcc " __VERSION__ " " TSPACE_BENCH_FLAGS);
#endif
        return 0;
    }
    if (argc == 2 && std::strcmp(argv[1], "--list") == 0) {
        for (const auto& c : tspace::bench::kCases) std::puts(c.name);
        for (const auto& c : tspace::bench::kPackCases) std::puts(c.name);
        return 0;
    }
    const int result = argc == 2 ? tspace::bench::run(argv[1]) : 2;
    if (result != 0) std::fputs("usage: tspace_counted_calls CASE|--list|--compiler\n", stderr);
    return result;
}
