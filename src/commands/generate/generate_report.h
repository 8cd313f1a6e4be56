// SPDX-License-Identifier: MIT
// Reports of tspace generate.
#pragma once

#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/generate.h"
#include "tspace/tangents.h"

namespace tspace::report {

using GenerateOutcome = Outcome<GenerateReport>;

std::string generateJson(const std::vector<GenerateOutcome>& outcomes, ExitCode exit_code, double seconds);

/// Returns the JSON of one file in the report.
Json generatedFileJson(const GenerateOutcome& outcome);

std::string generateText(const GenerateOutcome& outcome);
/// Returns a one-line report, for one of several files.
std::string generateLine(const GenerateOutcome& outcome);
/// Returns totals over several files.
std::string generateSummary(const std::vector<GenerateOutcome>& outcomes, double seconds);

// Totals over all primitives of a file.

struct NamedCount {
    const char* json_name;
    const char* words;
    std::uint64_t SanitizeReport::*count;
};
inline constexpr NamedCount kCauses[] = {
    {"notFinite", "not finite", &SanitizeReport::not_finite_count},
    {"zero", "zero", &SanitizeReport::zero_count},
    {"notUnit", "not of unit length", &SanitizeReport::not_unit_count},
    {"parallel", "parallel to the normal", &SanitizeReport::parallel_count},
    {"placeholder", "without a direction", &SanitizeReport::placeholder_count},
    {"badSign", "sign not +1 or -1", &SanitizeReport::bad_sign_count},
    {"mixedSign", "mixed signs in a face", &SanitizeReport::mixed_sign_count},
    {"orthogonalized", "made orthogonal on request", &SanitizeReport::orthogonalized_count},
};
inline constexpr NamedCount kCures[] = {
    {"normalized", "", &SanitizeReport::normalized_count},
    {"fromNeighbor", "", &SanitizeReport::from_neighbor_count},
    {"fromBasis", "", &SanitizeReport::from_basis_count},
};

inline constexpr PrimitiveAction kActions[] = {
    PrimitiveAction::generated, PrimitiveAction::replaced,     PrimitiveAction::unchanged,  PrimitiveAction::kept,
    PrimitiveAction::notNeeded, PrimitiveAction::notTriangles, PrimitiveAction::impossible, PrimitiveAction::removed,
};

/// Returns whether the action computed tangents.
bool wasComputed(PrimitiveAction action);

/// Sums vertices over primitives; shared vertices are counted once.
class VertexTotals {
  public:
    void add(const PrimitiveReport& primitive);

    [[nodiscard]] std::uint64_t before() const { return before_; }
    [[nodiscard]] std::uint64_t after() const { return before_ + split_; }

  private:
    std::uint64_t before_ = 0, split_ = 0;
    std::set<std::uint32_t> source_lists_ = {}, split_lists_ = {};
};

/// Sums over primitives. Vertices and triangles are those of primitives with computed tangents.
struct Totals {
    std::uint64_t actions[std::size(kActions)] = {};
    std::uint64_t primitive_count = 0;
    std::uint64_t triangle_count = 0;
    VertexTotals vertices = {};
    std::uint64_t normals_generated = 0, normals_replaced = 0;
    std::uint64_t morph_normals_computed = 0;
    std::uint64_t on_quads = 0, quad_count = 0;  ///< primitives whose tangents were computed on quads, and their quads
    std::uint64_t bitangents_generated = 0;
    std::uint64_t frames_packed = 0, packed_repaired = 0;  ///< primitives with packed frames, and their repaired frames
    std::uint64_t tangents_dropped = 0, normals_dropped = 0;
    std::uint64_t morph_deltas_computed = 0;
    std::uint64_t morph_sign_flip_count = 0;
    std::uint64_t degenerate_uv_count = 0;
    std::uint64_t degenerate_triangle_count = 0;
    SanitizeReport sanitize = {};
    bool reference_order_abandoned = false;
};

Totals totalsOf(const GenerateReport& report);

}  // namespace tspace::report
