// SPDX-License-Identifier: MIT
// Scratch memory beside inputs and outputs, counted by the allocator hook, and page faults of a second call.
#include <sys/resource.h>

#include <new>

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
                    return static_cast<double>(allocator.peakBytes()) /
                           static_cast<double>(mesh.triangleCount());
                };
                row.one_thread.value = measure(1);
                row.two_threads.value = measure(2);
                row.one_thread.asked = row.two_threads.asked = asked;
                row.note = name;
                return row;
            }};
}

/// Memory that is handed out from its start again after reuse(): what an engine does between two frames.
class ReusedMemory {
  public:
    explicit ReusedMemory(std::size_t bytes)
        : memory_(new (std::align_val_t(kAlignment)) std::byte[bytes]), bytes_(bytes) {}
    ~ReusedMemory() { ::operator delete[](memory_, std::align_val_t(kAlignment)); }
    ReusedMemory(const ReusedMemory&) = delete;
    ReusedMemory& operator=(const ReusedMemory&) = delete;

    [[nodiscard]] const Allocator* hook() const { return &hook_; }
    void reuse() { used_ = 0; }

  private:
    static constexpr std::size_t kAlignment = 64;

    static void* allocate(void* user, std::size_t bytes, std::size_t) {
        auto& self = *static_cast<ReusedMemory*>(user);
        const std::size_t begin = self.used_;
        self.used_ += (bytes + kAlignment - 1) / kAlignment * kAlignment;
        return self.used_ <= self.bytes_ ? self.memory_ + begin : nullptr;
    }
    static void release(void*, void*, std::size_t, std::size_t) {}

    std::byte* memory_;
    std::size_t bytes_, used_ = 0;
    Allocator hook_{allocate, release, this};
};

std::int64_t pageFaults() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt + usage.ru_majflt;
}

Row secondCallFaults(const std::string& title, const std::string& job_name) {
    return {title, [=](Lab& lab) {
                constexpr std::size_t kBytesPerTriangle = 1000;  // of all that a call ever asks for
                const Mesh& mesh = lab.mesh("torus_" + lab.size());
                const Job job = makeJob(job_name, mesh);
                ReusedMemory memory(kBytesPerTriangle * mesh.triangleCount());
                const Execution execution{.thread_count = 1, .allocator = memory.hook()};
                job.call(execution);
                memory.reuse();
                const std::int64_t before = pageFaults();
                job.call(execution);
                RowResult row{.title = title, .unit = " faults"};
                row.one_thread.value = static_cast<double>(pageFaults() - before);
                row.one_thread.asked = 0;
                return row;
            }};
}

}  // namespace

std::vector<Row> memoryRows() {
    return {
        peak("`mikktspace`, memory", "mikktspace", "torus", 32),
        peak("`mikktspace`, unindexed corners, memory", "mikktspace", "soup", 32),
        peak("`mikktspace`, input already welded (no two vertices are equal), memory", "mikktspace", "grid",
             20),
        peak("`evaluate`, memory", "evaluate", "torus", 8),
        peak("`lengyel`, memory", "lengyel", "torus", 12),
        secondCallFaults("`mikktspace`, page faults of a second call in reused memory", "mikktspace"),
        secondCallFaults("`evaluate`, page faults of a second call in reused memory", "evaluate"),
    };
}

}  // namespace tspace::bench
