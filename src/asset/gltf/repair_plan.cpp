// SPDX-License-Identifier: MIT
// Judging the tangents of each pool.
#include "asset/gltf/repair_plan.h"

#include <utility>

#include "asset/file_error.h"
#include "asset/gltf/compute_pools.h"
#include "asset/work_together.h"
#include "generate/judge_tangents.h"

namespace tspace::gltf {

namespace {

std::string whyWrong(const Document& document, std::span<const Primitive> primitives, const Pool& pool,
                     const GenerateOptions& options) {
    const Primitive& first = primitives[pool.primitives[0]];
    if (readAccessor(document, *first.find("TANGENT")).component_count != 4) return "they do not have 4 components";
    document.memory->require(pool.workBytes(), first.place());
    const VertexPool vertices = readVertices(document, first, pool);
    const std::vector<Vec4> tangents = readTangents(document, first);
    return valueOrThrow(whyTangentsCannotStay(vertices, tangents, readGeometries(document, primitives, pool), options));
}

}  // namespace

void keepGoodPools(const Document& document, std::span<const Primitive> primitives, const GenerateOptions& options,
                   GeneratePlan& plan) {
    std::vector<std::string> reasons(plan.pools.size());
    GenerateOptions one_thread = options;
    one_thread.tangents.execution = {.thread_count = 1};
    Parallel parallel(options.tangents.execution);
    workTogether(
        document.memory.get(), plan.pools.size(), parallel, [&](std::size_t i) { return plan.pools[i].workBytes(); },
        [&](std::size_t i) {
            if (plan.pools[i].has_tangents) reasons[i] = whyWrong(document, primitives, plan.pools[i], one_thread);
        });
    std::vector<Pool> rest;
    for (std::size_t i = 0; i < plan.pools.size(); ++i) {
        Pool& pool = plan.pools[i];
        for (const std::size_t number : pool.primitives) {
            PrimitiveReport& report = plan.reports[number];
            if (!pool.has_tangents) continue;
            if (reasons[i].empty()) {
                report.action = PrimitiveAction::kept;
                report.reason = "its tangents are good";
            } else {
                report.notes.push_back("its tangents were wrong: " + reasons[i]);
            }
        }
        const bool stays = pool.has_tangents && reasons[i].empty();
        pool.keeps_tangents = stays;
        if (!stays || lacksDeltas(primitives[pool.primitives[0]])) rest.push_back(std::move(pool));
    }
    plan.pools = std::move(rest);
}

}  // namespace tspace::gltf
