// SPDX-License-Identifier: MIT
// Rows for memory: scratch memory, counted by the allocator (without inputs and outputs), and page faults of a second
// call.
#include <sys/resource.h>

#include "counting_allocator.h"
#include "job.h"
#include "rows.h"
#include "tspace/execution.h"

namespace tspace::bench {

namespace {

Row peak(const std::string& title, const std::string& job_name, const std::string& shape, double asked) {
    return {title, [=](Lab& lab) {
                RowResult row{.title = title, .unit = " B/triangle"};
                const std::string name = shape + "_" + lab.size();
                const Mesh& mesh = lab.mesh(name);
                const Job job = makeJob(job_name, mesh);
                const auto measure = [&](unsigned threads) {
                    CountingAllocator allocator;
                    job.call({.thread_count = threads, .allocator = allocator.hook()});
                    return static_cast<double>(allocator.peakBytes()) / static_cast<double>(mesh.triangleCount());
                };
                row.one_thread.value = measure(1);
                row.two_threads.value = measure(2);
                row.one_thread.asked = row.two_threads.asked = asked;
                row.note = name;
                return row;
            }};
}

std::int64_t pageFaults() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt + usage.ru_majflt;
}

void measureSecondCall(RowResult& row, const Job& job) {
    const auto measure = [&](unsigned threads) {
        Arena arena;
        const Execution execution{.thread_count = threads, .allocator = arena.allocator()};
        job.call(execution);
        const std::int64_t before = pageFaults();
        job.call(execution);
        return static_cast<double>(pageFaults() - before);
    };
    row.one_thread.value = measure(1);
    row.one_thread.asked = 0;
    row.two_threads.value = measure(2);  // not 0: the started thread touches its own stack
}

Row secondCallFaults(const std::string& title, const std::string& job_name) {
    return {title, [=](Lab& lab) {
                RowResult row{.title = title, .unit = " faults"};
                measureSecondCall(row, makeJob(job_name, lab.mesh("torus_" + lab.size())));
                return row;
            }};
}

}  // namespace

std::vector<Row> memoryRows() {
    return {
        peak("`mikktspace`, memory", "mikktspace", "torus", 32),
        peak("`mikktspace`, unindexed corners, memory", "mikktspace", "soup", 32),
        peak("`mikktspace`, input already welded (no two vertices are equal), memory", "mikktspace", "grid", 20),
        peak("`evaluate`, memory", "evaluate", "torus", 8),
        peak("normals with a crease angle, memory", "normals_crease", "torus", 48),
        peak("`lengyel`, memory", "lengyel", "torus", 12),
        secondCallFaults("`mikktspace`, page faults of a second call in an arena", "mikktspace"),
        secondCallFaults("`evaluate`, page faults of a second call in an arena", "evaluate"),
    };
}

}  // namespace tspace::bench
