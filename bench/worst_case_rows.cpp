// SPDX-License-Identifier: MIT
// Rows for meshes that make naive implementations quadratic or recursive: time with ten times the triangles, and
// whether a stack of 64 KB suffices.
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include "job.h"
#include "race.h"
#include "rows.h"

namespace tspace::bench {

namespace {

/// Runs the job in a separate process, because a stack overflow would crash it.
bool runsOnSmallStack(const Job& job) {
    const pid_t child = fork();
    if (child == 0) {
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        pthread_attr_setstacksize(&attributes, 64 << 10);
        pthread_t thread;
        const auto run = [](void* data) -> void* {
            static_cast<const Job*>(data)->call({.thread_count = 1});
            return nullptr;
        };
        const bool started = pthread_create(&thread, &attributes, run, const_cast<Job*>(&job)) == 0;
        if (started) pthread_join(thread, nullptr);
        _exit(started ? 0 : 1);
    }
    int status = 1;
    return waitpid(child, &status, 0) == child && status == 0;
}

RowResult measureGrowth(const std::string& name, Lab& lab) {
    constexpr std::size_t kSmall = 20000, kLarge = 200000;
    const Mesh small = hardMesh(name, kSmall), large = hardMesh(name, kLarge);
    RowResult row{.title = name};
    for (const Mesh* mesh : {&small, &large}) {
        if (const std::string error = findError("mikktspace", *mesh); !error.empty()) {
            return row.wrong = true, row.note = error, row;
        }
    }
    const Job small_job = makeJob("mikktspace", small), large_job = makeJob("mikktspace", large);
    const Execution one{.thread_count = 1};
    Race race;
    const std::size_t base = race.add([&] { small_job.call(one); });
    const std::size_t grown = race.add([&] { large_job.call(one); });
    race.run(lab.rounds());
    const double times_larger = static_cast<double>(large.triangleCount()) / static_cast<double>(small.triangleCount());
    const Race::Ratio ratio = race.ratio(grown, base);
    row.one_thread = {ratio.median / times_larger, ratio.low / times_larger, ratio.high / times_larger, 1.5,
                      1e9 * race.best(grown) / static_cast<double>(large.triangleCount())};
    row.wrong = !runsOnSmallStack(large_job);
    row.note = row.wrong ? "64 KB of stack are not enough" : "64 KB of stack are enough";
    return row;
}

}  // namespace

std::vector<Row> worstCaseRows() {
    std::vector<Row> rows;
    for (const std::string& name : hardMeshNames()) {
        rows.push_back({name, [=](Lab& lab) { return measureGrowth(name, lab); }});
    }
    return rows;
}

}  // namespace tspace::bench
