// SPDX-License-Identifier: MIT
// Computes the frames of pools of a glTF file, several pools in parallel.
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

// Finds vertices that differ only in their frames.

struct WeldedVertices {
    std::vector<std::uint32_t> kept = {};       ///< first vertex of each class of equal vertices, ascending
    std::vector<std::uint32_t> number_of = {};  ///< index in `kept` of each vertex's class
};

/// Finds classes of vertices that are equal in all attributes, including those of morph targets, except NORMAL,
/// TANGENT, _BITANGENT and packed frames. Floats are compared by bits, with -0 equal to 0. Keeps all vertices of
/// primitives with CESIUM_primitive_outline, because its lists contain vertex indices. Linear time.
WeldedVertices weldVertices(const Document& document, const Primitive& primitive);

/// Number of corners whose frames have been computed, and of all corners; reported to GenerateOptions::progress.
struct PoolProgress {
    std::uint64_t done = 0, total = 0;
};

/// Computes pools of one document, several in parallel. Pools that are computed one after the other share scratch
/// memory.
class PoolComputer {
  public:
    /// The arguments must outlive the object. `arrays`: decoded arrays of `document`.
    PoolComputer(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                 const GenerateOptions& options);
    ~PoolComputer();

    /// Returns the elements of each pool, in the order of `pools`. Fills normals, tangents and sanitize of the reports
    /// of their primitives. Rethrows the error of the first pool that failed. The result does not depend on the thread
    /// count. Reports `progress` between the steps of pools that use all threads, so that a caller can cancel.
    std::vector<PoolElements> compute(std::span<const PoolPlan> pools, const PoolProgress& progress,
                                      std::span<PrimitiveReport> reports);

  private:
    class Arenas;
    /// Computes one pool. `progress`: null if this is not the calling thread.
    PoolElements computeOne(const PoolPlan& pool, const Execution& execution, const PoolProgress* progress,
                            std::span<PrimitiveReport> reports);
    void reportProgress(const PoolProgress* progress) const;

    const Document& document_;
    DecodedArrays& arrays_;
    std::span<const Primitive> primitives_;
    const GenerateOptions& options_;
    std::unique_ptr<Arenas> arenas_;
};

}  // namespace tspace::gltf
