// SPDX-License-Identifier: MIT
// Scratch memory beside inputs and outputs, counted by the allocator hook, and page faults of a second call.
#include "counting_allocator.h"
#include "job.h"
#include "rows.h"

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

}  // namespace

std::vector<Row> memoryRows() {
    std::vector<Row> rows = {
        peak("`mikktspace`, memory", "mikktspace", "torus", 32),
        peak("`mikktspace`, unindexed corners, memory", "mikktspace", "soup", 32),
        peak("`evaluate`, memory", "evaluate", "torus", 8),
        peak("`lengyel`, memory", "lengyel", "torus", 12),
    };
    for (const char* title : {"`mikktspace`, input already welded, memory", "page faults of a second call in an arena"}) {
        rows.push_back({title, [=](Lab&) { return RowResult{.title = title, .note = "not there yet"}; }});
    }
    return rows;
}

}  // namespace tspace::bench
