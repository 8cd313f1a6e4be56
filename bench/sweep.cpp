// SPDX-License-Identifier: MIT
// All combinations, each next to the plain loop and the memory floor on the same mesh.
#include "sweep.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "counting_allocator.h"
#include "floor.h"
#include "job.h"
#include "plain_loop.h"

namespace tspace::bench {

namespace {

struct Combination {
    std::string mesh, job, target;
    unsigned threads;
};

double secondsOf(const std::function<void()>& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void measure(benchmark::State& state, Lab& lab, std::string& current_mesh, const Combination& c) {
    // Meshes are used one after the other, and are released because the largest need too much memory.
    if (current_mesh != c.mesh) lab.forgetMeshes();
    current_mesh = c.mesh;
    const Mesh &mesh = lab.mesh(c.mesh), &plain_mesh = lab.plainMesh(c.mesh);
    if (mesh.triangleCount() == 0) return state.SkipWithError("this mesh cannot be made");
    Execution execution{.thread_count = c.threads};
    if (c.target != "best" && !forceSimd(execution, c.target)) return state.SkipWithError("no such SIMD target here");
    const Job job = makeJob(c.job, mesh);
    if (!job.outputs) return state.SkipWithError("the library does not have this yet");
    if (const std::string& error = lab.error(c.job, c.mesh); !error.empty()) return state.SkipWithError(error.c_str());

    CountingAllocator allocator;
    Execution counted = execution;
    counted.allocator = allocator.hook();
    job.call(counted);
    std::vector<Vec4> plain_tangents(plain_mesh.positions.size()),
        floor_output(std::max(job.outputs->tangents.size(), job.outputs->normals.size()));
    double best = 1e9, plain = 1e9, floor = 1e9;
    for ([[maybe_unused]] auto round : state) {
        plain = std::min(plain, secondsOf([&] { plainLoop(plain_mesh, plain_tangents); }));
        floor = std::min(floor, secondsOf([&] { memoryFloor(mesh, floor_output); }));
        const double seconds = secondsOf([&] { job.call(execution); });
        best = std::min(best, seconds);
        state.SetIterationTime(seconds);
    }
    const auto triangles = static_cast<double>(plain_mesh.triangleCount());
    state.counters["ns/triangle"] = 1e9 * best / triangles;
    state.counters["x_plain"] = best / plain;
    state.counters["x_floor"] = best / floor;
    state.counters["bytes/triangle"] = static_cast<double>(allocator.peakBytes()) / triangles;
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * plain_mesh.triangleCount()));
}

std::vector<std::string> meshNames(const Lab& lab) {
    std::vector<std::string> names;
    for (const char* size : {"10k", "100k", "1M", "8M"}) {
        for (const char* shape : {"torus", "sphere", "grid", "quads", "soup"}) {
            names.push_back(std::string(shape) + "_" + size);
            names.push_back(names.back() + "_shuffled");
        }
    }
    const std::filesystem::path models = lab.shared("models/perf");
    if (std::filesystem::is_directory(models)) {
        for (const auto& entry : std::filesystem::directory_iterator(models)) names.push_back(entry.path());
    }
    return names;
}

}  // namespace

int runSweep(Lab& lab, const std::string& pattern, const std::string& json) {
    std::string current_mesh;
    for (const std::string& mesh : meshNames(lab)) {
        for (const std::string& job : jobNames()) {
            for (const unsigned threads : {1u, 2u}) {
                for (const std::string target : {"best", "scalar", "sse2", "avx2", "avx512", "neon"}) {
                    Execution probe;
                    if (target != "best" && !forceSimd(probe, target)) continue;
                    const std::string name = std::filesystem::path(mesh).filename().string() + "/" + job +
                                             "/threads:" + std::to_string(threads) + "/" + target;
                    benchmark::RegisterBenchmark(name.c_str(),
                                                 [&lab, &current_mesh, mesh, job, threads, target](auto& state) {
                                                     measure(state, lab, current_mesh, {mesh, job, target, threads});
                                                 })
                        ->UseManualTime()
                        ->Unit(benchmark::kMillisecond);
                }
            }
        }
    }
    std::vector<std::string> arguments = {"bench", "--benchmark_counters_tabular=true",
                                          "--benchmark_filter=" + (pattern.empty() ? "." : pattern)};
    if (json == "-") arguments.push_back("--benchmark_format=json");
    if (!json.empty() && json != "-") {
        arguments.push_back("--benchmark_out_format=json");
        arguments.push_back("--benchmark_out=" + json);
    }
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    auto count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    return benchmark::RunSpecifiedBenchmarks() == 0 ? 1 : 0;
}

}  // namespace tspace::bench
