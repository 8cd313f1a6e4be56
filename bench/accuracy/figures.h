// SPDX-License-Identifier: MIT
// Values shown by tables, JSON and plots: each one is a mean over many records of a study.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "study.h"

namespace tspace::accuracy {

/// A row of the table. `value` returns NaN if a quick study did not measure it.
struct Figure {
    std::string key;    ///< for JSON
    std::string title;  ///< for readers of the table
    std::function<double(const Study&, const std::string& method, bool held_out)> value;
};

/// Returns the figures of tangents, to be compared by method.
std::span<const Figure> tangentFigures();
/// Returns the figures of vertex normals, to be compared by weighting.
std::span<const Figure> normalFigures();
/// Returns the tangent figure with this key.
const Figure& tangentFigure(const std::string& key);

/// Return the mean vertex error, or the mean shading error, over the surfaces of one tessellation.
double tangentError(const Study& study, const std::string& method, const std::string& tessellation, int cells,
                    bool held_out);
double shadingError(const Study& study, const std::string& method, const std::string& tessellation, int cells,
                    bool held_out);
/// Returns the mean error of vertex normals, including borders.
double normalError(const Study& study, const std::string& weighting, const std::string& tessellation, int cells,
                   bool held_out);

}  // namespace tspace::accuracy
