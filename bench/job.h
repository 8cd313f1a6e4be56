// SPDX-License-Identifier: MIT
// Measured calls, by name.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh.h"
#include "tspace/indexed_frames.h"
#include "tspace/normals.h"
#include "tspace/tangents.h"

namespace tspace::bench {

/// Outputs of a call.
struct Outputs {
    std::vector<Vec4> tangents = {};
    std::vector<Vec3> bitangents = {}, normals = {};
    std::vector<float> magnitudes_s = {}, magnitudes_t = {};
    SplitResult split = {};
};

/// Returns a hash of all bits.
std::uint64_t hashOf(const Outputs& outputs);
std::uint64_t hashOf(const Mesh& mesh);

struct Job {
    std::shared_ptr<Outputs> outputs;
    /// Runs the call. Terminates the program if the library reports an error.
    std::function<void(const Execution&)> call;
};

/// Creates a job; `mesh` must outlive it. The job has no outputs if the library does not support it. Names:
/// "mikktspace", "mikktspace_all" (every output), "mikktspace_corrected", "evaluate" (on an existing plan),
/// "evaluate_lengyel" (on an existing plan, one result per vertex), "uniform", "angle", "area", "fast", "best",
/// "lengyel", "lengyel_vertex" (one result per vertex), "flat", "basis", "normals" (angle-weighted), "normals_crease"
/// (with a crease angle), "normals_flat", "split" (by the tangents of mikktspace).
Job makeJob(const std::string& name, const Mesh& mesh);
const std::vector<std::string>& jobNames();

/// Returns the reason why a result is wrong, or an empty string. Other thread counts, and alternative ways to compute
/// the same result, must give the same bits; see check.cpp.
std::string findError(const std::string& job_name, const Mesh& mesh);

/// Selects a target by name: "scalar", "sse2", "avx2", "avx512", "neon". Returns false if the library has no such
/// choice, or this machine does not support it.
template <class Any>
bool forceSimd(Any& execution, const std::string& target) {
    if constexpr (requires { execution.simd; }) {
        using Target = std::remove_reference_t<decltype(execution.simd)>;
        if (target == "scalar") return execution.simd = Target::scalar, true;
#if defined(__x86_64__)
        if (target == "sse2") return execution.simd = Target::sse2, true;
        if (target == "avx2" && __builtin_cpu_supports("avx2")) return execution.simd = Target::avx2, true;
        if (target == "avx512" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
            return execution.simd = Target::avx512, true;
        }
#elif defined(__aarch64__)
        if (target == "neon") return execution.simd = Target::neon, true;
#endif
    }
    return false;
}

}  // namespace tspace::bench
