// SPDX-License-Identifier: MIT
// Runs rounds of all runners, and computes their statistics.
#include "race.h"

#include <time.h>

#include <algorithm>

namespace tspace::bench {

namespace {

double now(clockid_t clock) {
    timespec time = {};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::size_t Race::add(std::function<void()> body) {
    // long enough for the resolution of the clocks, and short enough to be rarely disturbed
    constexpr double kSecondsPerRound = 2e-3;
    body();
    const double start = now(CLOCK_MONOTONIC);
    body();
    const double seconds = std::max(1e-9, now(CLOCK_MONOTONIC) - start);
    runners_.push_back({std::move(body), std::max(1, static_cast<int>(kSecondsPerRound / seconds))});
    return runners_.size() - 1;
}

void Race::run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
        for (Runner& runner : runners_) {
            const double wall = now(CLOCK_MONOTONIC), processor = now(CLOCK_PROCESS_CPUTIME_ID);
            for (int i = 0; i < runner.calls_per_round; ++i) runner.body();
            runner.processor_seconds.push_back((now(CLOCK_PROCESS_CPUTIME_ID) - processor) / runner.calls_per_round);
            runner.wall_seconds.push_back((now(CLOCK_MONOTONIC) - wall) / runner.calls_per_round);
        }
    }
}

double Race::best(std::size_t runner, Clock clock) const {
    return *std::ranges::min_element(runners_[runner].seconds(clock));
}

Race::Ratio Race::ratio(std::size_t runner, std::size_t base, Clock clock) const {
    const std::vector<double>&above = runners_[runner].seconds(clock), &below = runners_[base].seconds(clock);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i] / below[i]);
    std::ranges::sort(ratios);
    const std::size_t last = ratios.size() - 1, quarter = ratios.size() / 4;
    return {(ratios[last / 2] + ratios[last - last / 2]) / 2, ratios[quarter], ratios[last - quarter]};
}

}  // namespace tspace::bench
