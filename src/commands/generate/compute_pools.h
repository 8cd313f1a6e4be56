// SPDX-License-Identifier: MIT
// Frames for pools of a glTF file, several pools at the same time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "commands/generate/generate_plan.h"
#include "commands/generate/pool_elements.h"
#include "core/mesh/pools/primitive.h"
#include "model/gltf/document.h"
#include "model/gltf/model.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

// Finds vertices that differ in their frames alone.

struct WeldedVertices {
    std::vector<std::uint32_t> kept = {};       ///< the first vertex of each class of equal ones, ascending
    std::vector<std::uint32_t> number_of = {};  ///< per vertex: its index in `kept`
};

/// Vertices are equal where all attributes are, those of morph targets too, except NORMAL, TANGENT, _BITANGENT and packed
/// frames. Floats are compared by bits, with -0 equal to 0. Primitives with CESIUM_primitive_outline, whose lists name
/// vertices, keep all. Linear.
WeldedVertices weldVertices(const Document& document, const Primitive& primitive);

/// Corners whose frames are done, of all: what GenerateOptions::progress is told.
struct PoolProgress {
    std::uint64_t done = 0, total = 0;
};

/// Computes pools of one document, several at the same time. Scratch memory serves one after the other.
class PoolComputer {
  public:
    /// All must outlive it. `arrays`: of the document.
    PoolComputer(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                 const GenerateOptions& options);
    ~PoolComputer();

    /// Frames of each pool, in their order. Fills normals, tangents and sanitize of the reports of their primitives.
    /// Throws what the first pool with an error throws. Which threads work on what changes no bit. Tells `progress` between
    /// the steps of pools that all threads compute together, so that a caller can end them.
    std::vector<PoolElements> compute(std::span<const PoolPlan> pools, const PoolProgress& progress,
                                      std::span<PrimitiveReport> reports);

  private:
    class Arenas;
    /// `progress`: null off the thread of the call.
    PoolElements computeOne(const PoolPlan& pool, const Execution& execution, const PoolProgress* progress,
                            std::span<PrimitiveReport> reports);
    void tell(const PoolProgress* progress) const;

    const Document& document_;
    DecodedArrays& arrays_;
    std::span<const Primitive> primitives_;
    const GenerateOptions& options_;
    std::unique_ptr<Arenas> arenas_;
};

}  // namespace tspace::gltf
