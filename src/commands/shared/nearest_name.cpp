// SPDX-License-Identifier: MIT
// Edit distance with swaps of neighbours (optimal string alignment).
#include "commands/shared/nearest_name.h"

#include <algorithm>

namespace tspace::options {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool is_equal = a[i - 1] == b[j - 1];
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (is_equal ? 0 : 1)});
            const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = last;
        last = row;
    }
    return last[b.size()];
}

}  // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t kShortest = 3, kLongest = 64;  // "-q" is no mistyped "-h"
    if (word.size() < kShortest || word.size() > kLongest) return {};
    // One mistake in three letters, so that short words are not taken for each other.
    const std::size_t most = word.size() / 3;
    std::size_t least = 2 * most + 2;
    std::string nearest;
    for (const std::string& name : names) {
        std::size_t distance = 2 * editDistance(word, name);
        // A name that goes on is behind those that are as near as may be.
        if (name.starts_with(word)) distance = std::min(distance, 2 * most + 1);
        if (distance < least) {
            least = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& names) {
    const std::string nearest = nearestName(word, names);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace tspace::options
