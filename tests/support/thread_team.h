// SPDX-License-Identifier: MIT
// Executors for tests of threads with meshes so small that the library would start none. With an executor, work of any
// size is divided.
#pragma once

#include <atomic>
#include <map>
#include <thread>
#include <vector>

#include "tspace/execution.h"

namespace tspace::test {

/// Returns an executor that runs each loop on this number of threads. The executor lives until the program ends.
inline const Executor* threadTeam(unsigned threads) {
    static std::map<unsigned, Executor> teams;
    Executor& team = teams[threads];
    team.user = &team;
    team.concurrency = threads;
    team.run = [](void* user, std::size_t count, void (*task)(void*, std::size_t), void* context) {
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            for (std::size_t i; (i = next.fetch_add(1)) < count;) task(context, i);
        };
        std::vector<std::thread> helpers;
        for (unsigned i = 1; i < static_cast<const Executor*>(user)->concurrency; ++i) helpers.emplace_back(work);
        work();
        for (std::thread& helper : helpers) helper.join();
    };
    return &team;
}

}  // namespace tspace::test
