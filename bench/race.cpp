// SPDX-License-Identifier: MIT
// Rounds of all runners, and what can be said about them.
#include "race.h"

#include <algorithm>
#include <chrono>

namespace tspace::bench {

namespace {

double secondsOf(const std::function<void()>& body, int calls) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls;
}

}  // namespace

std::size_t Race::add(std::function<void()> body) {
    // Long enough for the clock, short enough to be disturbed seldom.
    constexpr double kSecondsPerRound = 2e-3;
    body();
    const double seconds = std::max(1e-9, secondsOf(body, 1));
    runners_.push_back({std::move(body), std::max(1, static_cast<int>(kSecondsPerRound / seconds))});
    return runners_.size() - 1;
}

void Race::run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
        for (Runner& runner : runners_)
            runner.seconds.push_back(secondsOf(runner.body, runner.calls_per_round));
    }
}

double Race::best(std::size_t runner) const { return *std::ranges::min_element(runners_[runner].seconds); }

Race::Ratio Race::ratio(std::size_t runner, std::size_t base) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < runners_[runner].seconds.size(); ++i) {
        ratios.push_back(runners_[runner].seconds[i] / runners_[base].seconds[i]);
    }
    std::ranges::sort(ratios);
    return {best(runner) / best(base), ratios[ratios.size() / 4],
            ratios[(ratios.size() - 1) - ratios.size() / 4]};
}

}  // namespace tspace::bench
