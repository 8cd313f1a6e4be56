// SPDX-License-Identifier: MIT
// Computes large pools one by one, each with all threads, and then the other pools in parallel, one thread each.
#include "commands/generate/compute_pools.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "commands/generate/frames_call.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/sort.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/morph_frames.h"
#include "core/mesh/surface/surface.h"
#include "model/gltf/packed_layout.h"
#include "model/io/file_error.h"
#include "tspace/execution.h"

namespace tspace::gltf {

// Refines classes of equal vertices, attribute by attribute and 16 bytes at a time.

namespace {

bool isOfFrames(const std::string& name) {
    return name == "NORMAL" || name == "TANGENT" || name == "_BITANGENT" || isPackedAttribute(name);
}

void refine(const Document& document, const Accessor& accessor, std::vector<std::uint32_t>& class_of) {
    const Bytes bytes = copyElements(document, accessor);
    for (std::size_t begin = 0; begin < accessor.element_bytes; begin += 16) {
        const std::size_t size = std::min<std::size_t>(16, accessor.element_bytes - begin);
        UniqueIndex<std::array<std::uint32_t, 5>> keys(class_of.size());
        for (std::size_t v = 0; v < class_of.size(); ++v) {
            std::array<std::uint32_t, 5> key = {};
            std::memcpy(key.data(), bytes.data() + v * accessor.element_bytes + begin, size);
            if (accessor.component == ComponentType::f32) {
                for (std::uint32_t& word : key)
                    word = weldBits(loadLittleEndian<float>(reinterpret_cast<const std::uint8_t*>(&word)));
            }
            key[4] = class_of[v];
            class_of[v] = keys.indexOf(key);
        }
    }
}

}  // namespace

WeldedVertices weldVertices(const Document& document, const Primitive& primitive) {
    std::set<std::size_t> accessors;
    const auto addAll = [&](const AttributeList& list) {
        for (const auto& [name, accessor] : list) {
            if (!isOfFrames(name)) accessors.insert(accessor);
        }
    };
    addAll(primitive.attributes);
    for (const AttributeList& target : primitive.targets) addAll(target);

    WeldedVertices welded;
    welded.number_of.resize(primitive.vertex_count);
    const Json& object = document.json["meshes"][primitive.mesh]["primitives"][primitive.index];
    if (findExtension(object, "CESIUM_primitive_outline") != nullptr) {
        std::iota(welded.number_of.begin(), welded.number_of.end(), 0u);
    } else {
        for (const std::size_t accessor : accessors)
            refine(document, readAccessor(document, accessor), welded.number_of);
    }
    for (std::uint32_t v = 0; v < welded.number_of.size(); ++v) {
        if (welded.number_of[v] == welded.kept.size()) welded.kept.push_back(v);
    }
    return welded;
}

namespace {

/// Number of corners below which one thread is faster, because starting threads takes time.
constexpr std::size_t kCornersForThreads = 3000;

/// Charges the deltas of a target to the memory budget: one for each vertex that moves, kept until the last target is
/// done.
void takeDeltas(const Document& document, const Primitive& first, const MorphOffsets& offsets) {
    constexpr std::uint64_t kDeltaBytes = 32;
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < std::max(offsets.positions.size(), offsets.normals.size()); ++v) {
        const auto moves = [v](const std::vector<Vec3>& list) { return v < list.size() && !(list[v] == Vec3{}); };
        count += moves(offsets.positions) || moves(offsets.normals);
    }
    document.memory->take(kDeltaBytes * count, first.place() + "/targets");
}

/// Returns the morph targets of a pool, which are equal in all of its primitives. `first` must outlive the result.
MorphTargets targetsOf(const Document& document, const Primitive& first, bool with_tangents) {
    // If normals are computed, a target is read twice, but its memory is charged only once.
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

/// Vertex data of a pool that the file does not store as uncompressed floats.
struct DecodedVertices {
    SharedArray<Vec3> positions = {}, normals = {};
    SharedArray<Vec2> uvs = {};
    SharedArray<Vec4> kept_tangents = {}, old_tangents = {};
};

/// Returns the input arrays for the tangents of a pool, without copies if possible. `decoded` receives the arrays that
/// cannot be borrowed, and must outlive the result. `first`: any primitive of the pool.
PoolView lendVertices(const Document& document, DecodedArrays& arrays, const Primitive& first, const PoolPlan& pool,
                      DecodedVertices& decoded) {
    const auto vec3 = [&](const char* attribute, SharedArray<Vec3>& array) {
        if (const auto lent = lendVec3(document, first, attribute)) return *lent;
        array = arrays.borrowVec3(first, attribute);
        return StridedSpan<const Vec3>(array.span());
    };
    PoolView vertices;
    vertices.positions = vec3("POSITION", decoded.positions);
    if (pool.has_normals) vertices.normals = vec3("NORMAL", decoded.normals);
    if (pool.uses_uvs) {
        if (const auto lent = lendUvs(document, first, pool.uv_set)) {
            vertices.uvs = *lent;
        } else {
            decoded.uvs = arrays.borrowUvs(first, pool.uv_set);
            vertices.uvs = decoded.uvs.span();
        }
    }
    vertices.uv_matrix = pool.uv_matrix;
    return vertices;
}

/// Returns a warning (a clause) if frames are computed from positions whose rounding error is too large;
/// otherwise empty.
std::string warnOfRounding(const PoolView& vertices, std::span<const PrimitiveGeometry> geometries,
                           const Allocator* allocator) {
    constexpr double kLimit = 10;
    std::vector<std::span<const std::uint32_t>> corner_lists;
    for (const PrimitiveGeometry& geometry : geometries) corner_lists.emplace_back(geometry.indices);
    const PositionRounding rounding = roundingOf(vertices.positions, vertices.uvs, corner_lists, 0, allocator);
    if (rounding.error == 0) return {};
    for (const PrimitiveGeometry& geometry : geometries) {
        const RotatedTriangles turned = rotatedBy(rounding, vertices.positions, geometry.indices, kLimit);
        if (turned.share < kLeastRotatedShare) continue;
        return std::string(!vertices.normals.empty() ? "tangents"
                           : vertices.makes_tangents ? "normals and tangents"
                                                     : "normals") +
               " were computed from positions that are rounded too coarsely: " +
               (rounding.was_before
                    ? "the rounding steps may rotate triangles by more than 10 degrees. Use the model from before it "
                      "was rounded, or keep its original tangents and normals"
                    : "at their distance from the origin the float spacing may rotate triangles by more than 10 "
                      "degrees. Store positions relative to a point near the mesh, and move the node to that point");
    }
    return {};
}

/// Keeps the first of the vertices that differ only in their frames. `copies` receives the kept vertices, and must
/// outlive `vertices`.
void weld(const WeldedVertices& welded, std::vector<PrimitiveGeometry>& geometries, PoolView& vertices,
          OwnedMesh& copies) {
    copies.positions = gather(vertices.positions, welded.kept);
    copies.uvs = gather(vertices.uvs, welded.kept);
    vertices.positions = copies.positions;
    vertices.uvs = copies.uvs;
    for (PrimitiveGeometry& geometry : geometries) {
        for (std::uint32_t& vertex : geometry.indices) vertex = welded.number_of[vertex];
    }
    vertices.targets.read = [read = vertices.targets.read, &welded](std::size_t target) -> Result<MorphOffsets> {
        Result<MorphOffsets> offsets = read(target);
        if (!offsets) return offsets;
        offsets->positions = gather(std::span<const Vec3>(offsets->positions), welded.kept);
        offsets->normals = {};
        offsets->tangents = {};
        return offsets;
    };
}

/// Computes the normal offsets of morph targets whose base normals are kept, each when it is first used.
class NewMorphNormals {
  public:
    /// Replaces the target reader of `vertices`, so that it returns the new offsets. `vertices` and `geometries` must
    /// outlive this object. `keeps_finite`: in a target with at least one usable offset, replaces only offsets that are
    /// NaN or infinite.
    NewMorphNormals(const std::vector<bool>& targets, bool keeps_finite, PoolView& vertices,
                    std::span<const PrimitiveGeometry> geometries)
        : targets_(targets), keeps_finite_(keeps_finite), turned_(vertices, geometries), made_(targets.size()) {
        vertices.targets.read = [read = vertices.targets.read, this](std::size_t target) -> Result<MorphOffsets> {
            Result<MorphOffsets> offsets = read(target);
            if (!offsets || !targets_[target]) return offsets;
            std::vector<Vec3> offsets_of_normals = turned_.offsets(offsets->positions);
            if (keeps_finite_) keepFinite(offsets->normals, offsets_of_normals);
            offsets->normals = std::move(offsets_of_normals);
            made_[target] = sparse(offsets->normals);
            return offsets;
        };
    }

    /// Writes the new offsets into `frames`, for the vertices after a split.
    void write(const PoolView& vertices, PoolFrames& frames) {
        frames.morphs.resize(targets_.size());
        for (std::size_t target = 0; target < targets_.size(); ++target) {
            if (!targets_[target]) continue;
            if (!made_[target]) valueOrThrow(vertices.targets.read(target));
            frames.morphs[target].normals = spread(*made_[target], frames.source_vertices, vertices.positions.count);
        }
    }

  private:
    static void keepFinite(std::span<const Vec3> old, std::span<Vec3> made) {
        if (std::none_of(old.begin(), old.end(), isDirection)) return;
        for (std::size_t v = 0; v < old.size(); ++v) {
            if (isFinite(old[v])) made[v] = old[v];
        }
    }

    const std::vector<bool>& targets_;
    bool keeps_finite_;
    RotatedNormals turned_;
    std::vector<std::optional<VertexOffsets>> made_;
};

/// Returns for each vertex whether UVs determine its sign: whether it belongs to a triangle with UV area.
std::vector<bool> findVerticesWithSign(const PoolView& vertices, std::span<const PrimitiveGeometry> geometries) {
    std::vector<bool> found(vertices.positions.count, false);
    for (const PrimitiveGeometry& geometry : geometries) {
        const std::vector<std::uint8_t> votes =
            uvVotes({.positions = vertices.positions, .uvs = vertices.uvs, .indices = geometry.indices});
        for (std::size_t corner = 0; corner < 3 * votes.size(); ++corner) {
            if (votes[corner / 3] != 0) found[geometry.indices[corner]] = true;
        }
    }
    return found;
}

/// Returns whether at least two thirds of the existing tangents have the opposite sign, as in files whose green points
/// down. Tangents more than 45 degrees from the new ones follow other UVs, for example those before a mirroring
/// KHR_texture_transform, and are not counted as inverted. `have_signs`: for each new vertex, whether UVs determine its
/// sign; others do not count.
bool haveInvertedSigns(std::span<const Vec4> old, std::span<const Vec3> old_normals, const PoolFrames& frames,
                       const std::vector<bool>& have_signs) {
    if (old.empty()) return false;
    constexpr float kCos45 = 0.70710678f;
    std::size_t inverted = 0, count = 0;
    for (std::size_t v = 0; v < frames.tangents.size(); ++v) {
        if (!have_signs[v]) continue;
        ++count;
        const Vec4 &now = frames.tangents[v], &before = old[frames.source_vertices[v]];
        const bool has_its_direction = dot(xyz(now), xyz(before)) > kCos45 * length(xyz(before));
        // Where the winding is wrong, the new normal points to the other side, for which w has the opposite sign.
        const bool is_other_side =
            !old_normals.empty() && dot(frames.normals[v], old_normals[frames.source_vertices[v]]) < 0;
        inverted += has_its_direction && (now.w * before.w < 0) != is_other_side ? 1U : 0U;
    }
    return count != 0 && 3 * inverted >= 2 * count;
}

/// Returns frames that keep all vertices unchanged.
PoolFrames unchangedFrames(const PoolView& vertices) {
    PoolFrames frames;
    frames.source_vertices.resize(vertices.positions.count);
    std::iota(frames.source_vertices.begin(), frames.source_vertices.end(), 0u);
    return frames;
}

/// Returns the triangles of each geometry of a pool.
std::vector<PrimitiveGeometry> readGeometries(DecodedArrays& arrays, std::span<const Primitive> primitives,
                                              const PoolPlan& pool) {
    std::vector<PrimitiveGeometry> geometries;
    for (const GeometryPlan& geometry : pool.geometries)
        geometries.push_back({.indices = arrays.copyCorners(primitives[geometry.primitives[0]]),
                              .repairs = geometry.repairs,
                              .around = geometry.around});
    return geometries;
}

}  // namespace

/// Arenas for reuse, one for each pool that is being computed.
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

PoolComputer::PoolComputer(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                           const GenerateOptions& options)
    : document_(document), arrays_(arrays), primitives_(primitives), options_(options),
      arenas_(std::make_unique<Arenas>()) {}

PoolComputer::~PoolComputer() = default;

void PoolComputer::reportProgress(const PoolProgress* progress) const {
    if (progress != nullptr && options_.progress)
        options_.progress("computing tangents", progress->done, progress->total);
}

PoolElements PoolComputer::computeOne(const PoolPlan& pool, const Execution& execution, const PoolProgress* progress,
                                      std::span<PrimitiveReport> reports) {
    FramesOptions options = framesOptions(options_);
    options.execution = execution;
    if (progress != nullptr && options_.progress)
        options.progress = [this, progress](const char*, std::uint64_t, std::uint64_t) { reportProgress(progress); };
    const Primitive& first = primitives_[pool.primitives[0]];
    DecodedVertices decoded;
    PoolView vertices = lendVertices(document_, arrays_, first, pool, decoded);
    vertices.targets = targetsOf(document_, first, pool.repairsTangents());
    vertices.repairs_tangents = pool.repairsTangents();
    if (pool.keeps_tangents || pool.repairsTangents()) decoded.kept_tangents = arrays_.borrowTangents(first);
    vertices.kept_tangents = decoded.kept_tangents.span();
    const bool keeps_signs = pool.overwrites_normals && options_.selection.existing == ExistingTangents::keep;
    if ((pool.tries_quads || keeps_signs) && pool.has_tangents && !pool.keeps_tangents) {
        if (readAccessor(document_, *first.find("TANGENT")).component_count == 4)
            decoded.old_tangents = arrays_.borrowTangents(first);
    }
    vertices.old_tangents = decoded.old_tangents.span();
    SharedArray<Vec3> old_normals;
    if (keeps_signs && !decoded.old_tangents.empty() && first.find("NORMAL"))
        old_normals = arrays_.borrowVec3(first, "NORMAL");
    vertices.is_from_blender = pool.is_from_blender;
    vertices.makes_tangents = pool.makes_tangents;
    std::vector<PrimitiveGeometry> geometries = readGeometries(arrays_, primitives_, pool);
    WeldedVertices welded;
    OwnedMesh copies;
    if (pool.overwrites_normals) welded = weldVertices(document_, first);
    const bool was_welded = welded.kept.size() != welded.number_of.size();
    if (was_welded) weld(welded, geometries, vertices, copies);
    std::optional<NewMorphNormals> morph_normals;
    if (!pool.morph_normals.empty())
        morph_normals.emplace(pool.morph_normals, options_.normals.morphs == MorphNormals::missing, vertices,
                              geometries);
    std::vector<FramesReport> computed(pool.geometries.size());
    const bool computes = pool.makes_tangents || !pool.has_normals;
    reportProgress(progress);
    PoolFrames frames =
        computes ? valueOrThrow(computeFrames(vertices, geometries, options, computed)) : unchangedFrames(vertices);
    if (pool.makes_tangents && frames.tangents.size() != frames.source_vertices.size())
        failFile(ErrorCode::internal, "no tangents were computed", first.place());
    reportProgress(progress);
    for (std::size_t i = 0; i < pool.geometries.size(); ++i) {
        for (const std::size_t number : pool.geometries[i].primitives)
            (pool.keeps_tangents ? copyReportOfKept : copyReport)(computed[i], reports[number]);
    }
    const bool has_tangent_deltas = pool.makes_tangents && !frames.morphs.empty();
    if (morph_normals) morph_normals->write(vertices, frames);
    std::vector<bool> have_signs;
    if (keeps_signs && !vertices.old_tangents.empty()) {
        const std::vector<bool> sources = findVerticesWithSign(vertices, geometries);
        for (const std::uint32_t source : frames.source_vertices) have_signs.push_back(sources[source]);
    }
    if (was_welded) {
        for (std::uint32_t& source : frames.source_vertices) source = welded.kept[source];
    }
    if (keeps_signs && haveInvertedSigns(vertices.old_tangents, old_normals.span(), frames, have_signs)) {
        for (Vec4& tangent : frames.tangents) tangent.w = -tangent.w;
        for (const std::size_t number : pool.primitives) {
            reports[number].notes.emplace_back(
                "most tangent signs of the file were inverted, so all new signs were inverted too, because the normal "
                "map may rely on this; use --overwrite to write the signs that the UVs require");
        }
    }
    PoolElements elements = packFrames(document_, primitives_, pool, std::move(frames),
                                       {.format = options.format, .is_welded = was_welded});
    elements.has_tangent_deltas = has_tangent_deltas;
    if (computes && !pool.keeps_tangents && !pool.repairsTangents())
        elements.warning = warnOfRounding(vertices, geometries, options.execution.allocator);
    return elements;
}

std::vector<PoolElements> PoolComputer::compute(std::span<const PoolPlan> pools, const PoolProgress& progress,
                                                std::span<PrimitiveReport> reports) {
    std::vector<PoolElements> elements(pools.size());
    std::vector<std::exception_ptr> failures(pools.size());
    const Execution& execution = options_.execution;
    const auto compute = [&](std::size_t i, const Execution& given, const PoolProgress* told) noexcept {
        try {
            if (given.allocator != nullptr) {
                elements[i] = computeOne(pools[i], given, told, reports);
                return;
            }
            std::unique_ptr<Arena> arena = arenas_->take();
            Execution with_memory = given;
            with_memory.allocator = arena->allocator();
            elements[i] = computeOne(pools[i], with_memory, told, reports);
            arenas_->giveBack(std::move(arena));
        } catch (...) {
            failures[i] = std::current_exception();
        }
    };

    Parallel parallel(execution);
    std::uint64_t total = 0;
    for (const PoolPlan& pool : pools) total += pool.corner_count;
    // A caller's allocator must only be called from one thread.
    const bool one_by_one =
        execution.allocator != nullptr || total < kCornersForThreads || parallel.width() == 1 || pools.size() == 1;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < pools.size(); ++i) {
        if (one_by_one || pools[i].corner_count > total / parallel.width()) {
            compute(i, execution, &progress);
            if (one_by_one && failures[i]) break;
        } else {
            others.push_back(i);
        }
    }
    // Sorts by size, largest first, so that the threads finish at about the same time.
    sortStably(others.begin(), others.end(),
               [&](std::size_t a, std::size_t b) { return pools[a].corner_count > pools[b].corner_count; });
    parallel.forTasks(others.size(),
                      [&](std::size_t task) { compute(others[task], Execution{.thread_count = 1}, nullptr); });
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
    return elements;
}

}  // namespace tspace::gltf
