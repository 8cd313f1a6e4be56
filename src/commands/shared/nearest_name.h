// SPDX-License-Identifier: MIT
// "did you mean": the name that a mistyped word is nearest to.
#pragma once

#include <string>
#include <vector>

namespace tspace::options {

/// The name that `word` becomes by the fewest letters added, left out, changed or swapped with their neighbour, or that
/// it is the beginning of. Empty where none is near enough to be what was meant.
std::string nearestName(const std::string& word, const std::vector<std::string>& names);

/// "; did you mean '...'?", or nothing.
std::string didYouMean(const std::string& word, const std::vector<std::string>& names);

}  // namespace tspace::options
