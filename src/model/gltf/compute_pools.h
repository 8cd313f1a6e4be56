// SPDX-License-Identifier: MIT
// Frames for pools of a glTF file, several pools at the same time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "model/gltf/decoded_arrays.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/pool_elements.h"

namespace tspace::gltf {

/// Computes pools of one document, several at the same time. Scratch memory serves one after the other.
class PoolComputer {
  public:
    /// All must outlive it. `arrays`: of the document.
    PoolComputer(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                 const GenerateOptions& options);
    ~PoolComputer();

    /// Frames of each pool, in their order. Fills normals, tangents and sanitize of the reports of their primitives.
    /// Throws what the first pool with an error throws. Which threads work on what changes no bit.
    std::vector<PoolElements> compute(std::span<const Pool> pools, std::span<PrimitiveReport> reports);

  private:
    class Arenas;
    PoolElements computeOne(const Pool& pool, const Execution& execution, std::span<PrimitiveReport> reports);

    const Document& document_;
    DecodedArrays& arrays_;
    std::span<const Primitive> primitives_;
    const GenerateOptions& options_;
    std::unique_ptr<Arenas> arenas_;
};

}  // namespace tspace::gltf
