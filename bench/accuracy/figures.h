// SPDX-License-Identifier: MIT
// The figures that tables, JSON and plots show: each one a mean over many records of a study.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "study.h"

namespace tspace::accuracy {

/// One column of the wide table. NaN where a quick study did not measure it.
struct Figure {
    std::string key;    ///< for JSON
    std::string title;  ///< for people
    std::function<double(const Study&, const std::string& method, bool held_out)> value;
};

/// Tangents by method.
std::span<const Figure> tangentFigures();
/// Vertex normals by weighting.
std::span<const Figure> normalFigures();
/// The figure with that key, of the tangents.
const Figure& tangentFigure(const std::string& key);

/// The mean vertex error, or mean shading error, over the surfaces of one tessellation.
double tangentError(const Study& study, const std::string& method, const std::string& tessellation, int cells,
                    bool held_out);
double shadingError(const Study& study, const std::string& method, const std::string& tessellation, int cells,
                    bool held_out);
/// The same of vertex normals, borders included.
double normalError(const Study& study, const std::string& weighting, const std::string& tessellation, int cells,
                   bool held_out);

}  // namespace tspace::accuracy
