// SPDX-License-Identifier: MIT
// Makes findings: what was counted becomes sentences.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sort.h"
#include "tspace/check.h"

namespace tspace {

struct ScenePrimitive;

// How often something was met, on how much of the surface, and where first.

struct Tally {
    static constexpr std::size_t kMostVertices = 8;

    std::uint64_t count = 0;
    std::uint64_t total = 0;  ///< of how many
    double area = 0;
    double surface_share = 0;  ///< of the mesh's area, once finish() was called
    double worst_deg = 0;
    std::vector<std::uint32_t> vertices = {};  ///< the first, each once

    void add(std::uint32_t vertex, double its_area, double deg = 0) {
        ++count;
        area += its_area;
        worst_deg = std::max(worst_deg, deg);
        if (vertices.size() < kMostVertices && std::find(vertices.begin(), vertices.end(), vertex) == vertices.end())
            vertices.push_back(vertex);
    }
    /// Adds a tally of the same total.
    void include(const Tally& other) {
        count += other.count;
        area += other.area;
        surface_share = std::min(1.0, surface_share + other.surface_share);
        worst_deg = std::max(worst_deg, other.worst_deg);
        vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
        sortList(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        if (vertices.size() > kMostVertices) vertices.resize(kMostVertices);
    }
    [[nodiscard]] double share() const {
        return total == 0 ? 0 : static_cast<double>(count) / static_cast<double>(total);
    }
    void finish(double whole_area) { surface_share = whole_area > 0 ? std::min(1.0, area / whole_area) : 0; }
};

/// The remedy of inverted signs and green that points down, which cancel out.
inline constexpr const char* kBothOrNeither =
    "Nothing needs to be done: the two cancel out, so correct both or neither. For both: tspace generate --overwrite "
    "--flip-green.";

/// The remedy of green that points down where the convention that is asked for has it so.
inline constexpr const char* kNothingToDo = "Nothing needs to be done; a reader of plain glTF wants green to point up.";

/// The remedy of green that points down where the signs of some meshes, but not of all, are made for that.
inline constexpr const char* kSignsFirst =
    "Correct the green channel and the inverted signs together: tspace generate --overwrite --flip-green.";

/// The view of tspace render that shows what a finding is about ("sign"), or an empty text.
const char* findingLook(FindingCode code);

/// A finding with the tally's numbers, without a place.
Finding makeFinding(FindingCode code, Severity severity, const Tally& tally, const char* unit, std::string message);

/// Says where the finding is: `place`, in that primitive.
void placeAt(const ScenePrimitive& primitive, const std::string& place, Finding& finding);

/// `severity`, but a warning where an error concerns less than `options.error_share` of the surface.
Severity onShare(Severity severity, double surface_share, const CheckOptions& options);

/// "12 of 345 vertices"; "all 345 vertices".
std::string countText(const Tally& tally, const char* unit);
/// "34.5 %", "less than 0.1 %".
std::string shareText(double share);
/// A length with two digits, or all before the point: "0.5", "0.00012", "4659477".
std::string stepText(double value);
/// "12.3".
std::string decimalText(double value);

}  // namespace tspace
