// SPDX-License-Identifier: MIT
// Which axes of a map are those of a mesh: the rotation or exchange of channels that brings directions to normals.
#pragma once

#include <array>

#include "tspace/map_layout.h"

namespace tspace {

/// The mean of n v^T over the surface; n is the mesh's normal, v the direction in the map.
struct Moments {
    std::array<std::array<double, 3>, 3> sum = {};
    double weight = 0;
};

/// The largest mean cosine that any rotation or reflection of the map's axes gives: the sum of the singular values.
double bestAgreement(const Moments& moments);

/// Which signed channels the mesh's x, y and z are in, and the mean cosine between its normals and the map's then.
struct Axes {
    MapLayout layout = {};
    double agreement = -1;
};

Axes bestAxes(const Moments& moments);

}  // namespace tspace
