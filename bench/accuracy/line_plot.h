// SPDX-License-Identifier: MIT
// A chart with logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace tspace::accuracy {

struct Line {
    std::string name;
    std::vector<double> x, y;
};

/// `x_ticks` are the places of the x axis that get a number. Values of y that are not positive are left out.
std::string linePlot(const std::string& title, const std::string& x_title, const std::string& y_title,
                     const std::vector<double>& x_ticks, const std::vector<Line>& lines);

/// The colour of a method or weighting, the same in every picture.
std::string colourOf(const std::string& name);

}  // namespace tspace::accuracy
