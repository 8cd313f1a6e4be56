// SPDX-License-Identifier: MIT
// A comparison as a page for people.
#pragma once

#include <string>

#include "tspace/diff.h"

namespace tspace {

/// One HTML file that needs nothing else: the summary, a heat map of the largest angle between the frames on the surface of
/// A, the tables of the text, and the worst places in A and in B. Both files are read once more for the pictures, as
/// `options` says; where one cannot be, or is not drawn, they are missing and a sentence says why. All text from files is
/// escaped. Pictures take 1.5 MB at most.
std::string diffPage(const std::string& a, const std::string& b, const FrameDiff& diff, const DiffOptions& options);

}  // namespace tspace
