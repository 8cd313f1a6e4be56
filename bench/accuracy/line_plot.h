// SPDX-License-Identifier: MIT
// Line chart with logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace tspace::accuracy {

struct Line {
    std::string name;
    std::vector<double> x, y;
};

/// Returns the chart. `x_ticks`: labeled positions of the x axis. Values of y that are not positive are omitted.
std::string linePlot(const std::string& title, const std::string& x_title, const std::string& y_title,
                     const std::vector<double>& x_ticks, const std::vector<Line>& lines);

/// Returns the color of a method or weighting, equal in all plots.
std::string colorOf(const std::string& name);

}  // namespace tspace::accuracy
