// SPDX-License-Identifier: MIT
// Large pools one after the other, each on all threads; then the others, each on one thread.
#include "asset/gltf/compute_pools.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>

#include "asset/file_error.h"
#include "core/parallel.h"
#include "surface/position_rounding.h"
#include "tspace/arena.h"

namespace tspace::gltf {

namespace {

/// Fewer corners are done sooner than threads are started.
constexpr std::size_t kCornersForThreads = 3000;

/// Deltas are made where vertices move, and wait in memory for those of the last target.
void takeDeltas(const Document& document, const Primitive& first, const MorphOffsets& offsets) {
    constexpr std::uint64_t kDeltaBytes = 32;
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < std::max(offsets.positions.size(), offsets.normals.size()); ++v) {
        const auto moves = [v](const std::vector<Vec3>& list) { return v < list.size() && !(list[v] == Vec3{}); };
        count += moves(offsets.positions) || moves(offsets.normals);
    }
    document.memory->take(kDeltaBytes * count, first.place() + "/targets");
}

/// Targets of a pool are those of each of its primitives. `first` must outlive the result.
MorphTargets targetsOf(const Document& document, const Primitive& first, bool with_tangents) {
    // A target is read once more where normals are made.
    auto is_taken = std::make_shared<std::vector<bool>>(first.targets.size(), false);
    return {first.targets.size(), [&document, &first, is_taken, with_tangents](std::size_t target) {
                return atFileBorder([&]() -> Result<MorphOffsets> {
                    MorphOffsets offsets{.positions = readOffsets(document, first, target, "POSITION"),
                                         .normals = readOffsets(document, first, target, "NORMAL")};
                    if (with_tangents) offsets.tangents = readOffsets(document, first, target, "TANGENT");
                    if (!(*is_taken)[target]) takeDeltas(document, first, offsets);
                    (*is_taken)[target] = true;
                    return offsets;
                });
            }};
}

void copyReport(const PrimitiveReport& computed, bool keeps_tangents, PrimitiveReport& report) {
    report.morph_sign_flip_count = computed.morph_sign_flip_count;
    if (keeps_tangents) return;
    report.normals = computed.normals;
    report.tangents = computed.tangents;
    report.sanitize = computed.sanitize;
    report.faces = computed.faces;
    report.quad_count = computed.quad_count;
}

void setExecution(GenerateOptions& options, const Execution& execution) {
    options.tangents.execution = options.normals.execution = options.sanitize_options.execution = execution;
}

/// What the tangents of a pool are computed from, without copies where that is possible. `copies` must outlive the
/// result, and get what cannot be lent. `first`: any primitive of the pool.
PoolView lendVertices(const Document& document, const Primitive& first, const Pool& pool, VertexPool& copies) {
    const auto vec3 = [&](const char* attribute, std::vector<Vec3>& copy) {
        if (const auto lent = lendVec3(document, first, attribute)) return *lent;
        copy = readVec3(document, first, attribute);
        return StridedSpan<const Vec3>(copy);
    };
    PoolView vertices;
    vertices.positions = vec3("POSITION", copies.positions);
    if (pool.has_normals) vertices.normals = vec3("NORMAL", copies.normals);
    if (pool.uses_uvs) {
        if (const auto lent = lendUvs(document, first, pool.uv_set)) {
            vertices.uvs = *lent;
        } else {
            copies.uvs = readUvs(document, first, pool.uv_set);
            vertices.uvs = copies.uvs;
        }
    }
    vertices.uv_matrix = pool.uv_matrix;
    return vertices;
}

/// Where frames are made from positions that rounding has moved too far. Half a sentence; empty: they are fine enough.
std::string warnOfRounding(const PoolView& vertices, std::span<const PrimitiveGeometry> geometries) {
    constexpr double kLimit = 10;
    const PositionRounding rounding = roundingOf(vertices.positions);
    if (rounding.error == 0) return {};
    for (const PrimitiveGeometry& geometry : geometries) {
        const TurnedTriangles turned = turnedBy(rounding, vertices.positions, geometry.indices, kLimit);
        if (turned.share < kSomeTurned) continue;
        return std::string(vertices.normals.empty() ? "normals and tangents" : "tangents") +
               " were made over positions that are rounded too coarsely for it: at their distance from the origin "
               "floats "
               "are so far apart that triangles may be turned by over 10 degrees. Store positions relative to a point "
               "near "
               "the mesh, and put that point into the node";
    }
    return {};
}

/// The triangles of each geometry of a pool.
std::vector<PrimitiveGeometry> readGeometries(const Document& document, std::span<const Primitive> primitives,
                                              const Pool& pool) {
    std::vector<PrimitiveGeometry> geometries;
    for (const PoolGeometry& geometry : pool.geometries)
        geometries.push_back(
            {.indices = readTriangleCorners(document, primitives[geometry.primitives[0]]), .mends = geometry.mends});
    return geometries;
}

}  // namespace

/// As many arenas as pools are computed at one time.
class PoolComputer::Arenas {
  public:
    std::unique_ptr<Arena> take() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty()) return std::make_unique<Arena>();
        std::unique_ptr<Arena> arena = std::move(idle_.back());
        idle_.pop_back();
        return arena;
    }
    void giveBack(std::unique_ptr<Arena> arena) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(arena));
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Arena>> idle_;
};

PoolComputer::PoolComputer(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options)
    : document_(document), primitives_(primitives), options_(options), arenas_(std::make_unique<Arenas>()) {}

PoolComputer::~PoolComputer() = default;

PoolElements PoolComputer::computeOne(const Pool& pool, const Execution& execution,
                                      std::span<PrimitiveReport> reports) {
    GenerateOptions options = options_;
    setExecution(options, execution);
    const Primitive& first = primitives_[pool.primitives[0]];
    VertexPool copies;
    PoolView vertices = lendVertices(document_, first, pool, copies);
    vertices.targets = targetsOf(document_, first, pool.mendsTangents());
    vertices.mends_tangents = pool.mendsTangents();
    if (pool.keeps_tangents || pool.mendsTangents()) copies.kept_tangents = readTangents(document_, first);
    vertices.kept_tangents = copies.kept_tangents;
    std::vector<Vec4> old_tangents;
    if (pool.tries_quads && pool.has_tangents && !pool.keeps_tangents) {
        if (readAccessor(document_, *first.find("TANGENT")).component_count == 4)
            old_tangents = readTangents(document_, first);
    }
    vertices.old_tangents = old_tangents;
    vertices.is_blenders = pool.is_blenders;
    const std::vector<PrimitiveGeometry> geometries = readGeometries(document_, primitives_, pool);
    std::vector<PrimitiveReport> computed;
    for (const PoolGeometry& geometry : pool.geometries) computed.push_back(reports[geometry.primitives[0]]);
    PoolFrames frames = valueOrThrow(computeFrames(vertices, geometries, options, computed));
    if (frames.tangents.size() != frames.source_vertices.size()) {
        failFile(ErrorCode::internal, "no tangents were computed", first.place());
    }
    for (std::size_t i = 0; i < pool.geometries.size(); ++i) {
        for (const std::size_t number : pool.geometries[i].primitives) {
            copyReport(computed[i], pool.keeps_tangents, reports[number]);
        }
    }
    PoolElements elements = packFrames(document_, primitives_, pool, std::move(frames), options.format);
    if (!pool.keeps_tangents && !pool.mendsTangents()) elements.warning = warnOfRounding(vertices, geometries);
    return elements;
}

std::vector<PoolElements> PoolComputer::compute(std::span<const Pool> pools, std::span<PrimitiveReport> reports) {
    std::vector<PoolElements> elements(pools.size());
    std::vector<std::exception_ptr> failures(pools.size());
    const Execution& execution = options_.tangents.execution;
    const auto compute = [&](std::size_t i, const Execution& given) noexcept {
        try {
            if (given.allocator != nullptr) {
                elements[i] = computeOne(pools[i], given, reports);
                return;
            }
            std::unique_ptr<Arena> arena = arenas_->take();
            Execution with_memory = given;
            with_memory.allocator = arena->allocator();
            elements[i] = computeOne(pools[i], with_memory, reports);
            arenas_->giveBack(std::move(arena));
        } catch (...) {
            failures[i] = std::current_exception();
        }
    };

    Parallel parallel(execution);
    std::uint64_t total = 0;
    for (const Pool& pool : pools) total += pool.corner_count;
    // A caller's allocator is called from one thread only.
    const bool one_by_one = execution.allocator != nullptr || total < kCornersForThreads;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < pools.size(); ++i) {
        if (one_by_one || pools[i].corner_count > total / parallel.width()) {
            compute(i, execution);
        } else {
            others.push_back(i);
        }
    }
    // The largest first, so that no thread is left alone with one at the end.
    std::stable_sort(others.begin(), others.end(),
                     [&](std::size_t a, std::size_t b) { return pools[a].corner_count > pools[b].corner_count; });
    parallel.forTasks(others.size(), [&](std::size_t task) { compute(others[task], Execution{.thread_count = 1}); });
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
    return elements;
}

}  // namespace tspace::gltf
