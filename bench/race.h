// SPDX-License-Identifier: MIT
// Alternating measurement of several tasks, so that changes of the machine's speed affect all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace tspace::bench {

/// Processor time excludes waiting for a processor, so it is less noisy for a single thread. For two threads, only
/// wall-clock time shows whether they ran at the same time.
enum class Clock { processor, wall };

class Race {
  public:
    /// Adds a runner and returns its number. Calls `body` once immediately, to warm up and to measure its duration: a
    /// short body is called several times per round.
    std::size_t add(std::function<void()> body);
    void run(int rounds);

    /// Returns the seconds per call in the best round, which is disturbed least by other load.
    [[nodiscard]] double best(std::size_t runner, Clock clock = Clock::processor) const;

    /// Quartiles of the ratios within each round. On a shared machine the speed can change by half and more from second
    /// to second. Measurements of one round are made at the same speed, but the best rounds of two runners need not be.
    struct Ratio {
        double median = 0, low = 0, high = 0;
    };
    [[nodiscard]] Ratio ratio(std::size_t runner, std::size_t base, Clock clock = Clock::processor) const;

  private:
    struct Runner {
        std::function<void()> body;
        int calls_per_round = 1;
        std::vector<double> processor_seconds = {}, wall_seconds = {};  ///< one entry per round: seconds per call

        [[nodiscard]] const std::vector<double>& seconds(Clock clock) const {
            return clock == Clock::wall ? wall_seconds : processor_seconds;
        }
    };
    std::vector<Runner> runners_;
};

}  // namespace tspace::bench
