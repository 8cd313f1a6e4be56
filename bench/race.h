// SPDX-License-Identifier: MIT
// Several pieces of work timed in turns, so that a change of the machine's pace meets all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace tspace::bench {

/// Time on the processor leaves out the waiting for one, so it is the quieter clock where one thread works.
/// Where two do, only the clock on the wall tells whether they worked at once.
enum class Clock { processor, wall };

class Race {
  public:
    /// Returns the number of this runner. `body` is called once now, to warm up and to see how long it takes:
    /// short ones run several times a round.
    std::size_t add(std::function<void()> body);
    void run(int rounds);

    /// Seconds for one call in the best round, which other load on the machine disturbs least.
    [[nodiscard]] double best(std::size_t runner, Clock clock = Clock::processor) const;

    /// Quartiles of the ratios inside each round. On a shared machine the pace changes from second to second, by half
    /// and more; what runs in one round meets the same pace, the best rounds of two runners need not.
    struct Ratio {
        double median = 0, low = 0, high = 0;
    };
    [[nodiscard]] Ratio ratio(std::size_t runner, std::size_t base, Clock clock = Clock::processor) const;

  private:
    struct Runner {
        std::function<void()> body;
        int calls_per_round = 1;
        std::vector<double> processor_seconds = {}, wall_seconds = {};  ///< one per round, for one call

        [[nodiscard]] const std::vector<double>& seconds(Clock clock) const {
            return clock == Clock::wall ? wall_seconds : processor_seconds;
        }
    };
    std::vector<Runner> runners_;
};

}  // namespace tspace::bench
