// SPDX-License-Identifier: MIT
// Normals, tangents, sanitizing and splitting for all primitives of one vertex pool. The steps, in the order of this
// file:
//
//   1. computePrimitive: normals and tangents of the corners of each primitive
//   2. computeMorphs: offsets that morph targets add to tangents
//   3. write: the vertices of the pool, their frames, and the reports
//   4. computePool: steps 1 to 3 for one pool; splitPool splits vertices, keepPool keeps all of them
//   5. computeFrames: computes a pool as given, or, if targets move generated normals, computes these first
#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/morph_frames.h"
#include "core/mesh/pools/primitive.h"
#include "core/mesh/pools/unit_lattice.h"
#include "core/mesh/quads/quads.h"
#include "core/tangents/mirrored_count.h"
#include "tspace/execution.h"
#include "tspace/frame.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

/// Returns the options for the file's coordinate system: a convention may be an engine's preset, but in every supported
/// format the geometry is right-handed, with counter-clockwise faces.
FramesOptions inFileCoordinates(FramesOptions options) {
    for (Convention* convention : {&options.tangents.convention, &options.normals.convention}) {
        convention->handedness = Handedness::right;
        convention->winding = Winding::counterClockwise;
    }
    return options;
}

/// Returns the number of corners after triangulation.
std::size_t cornersOfTriangles(const PrimitiveGeometry& primitive) {
    if (primitive.face_sizes.empty()) return primitive.indices.size();
    std::size_t triangle_count = 0;
    for (const std::uint32_t size : primitive.face_sizes) triangle_count += size < 3 ? 0 : size - 2;
    return 3 * triangle_count;
}

/// Lets the caller cancel a long call between its steps.
void callProgress(const FramesOptions& options) {
    if (options.progress) options.progress("computing tangents", 0, 0);
}

/// State that the steps of a call share.
struct PoolComputation {
    [[nodiscard]] bool usesQuads() const { return options.tangents.method == Method::mikktspace; }
    [[nodiscard]] std::span<Vec4> tangents() { return {tangent_buffer.data(), tangent_buffer.size()}; }
    [[nodiscard]] std::span<Vec3> bitangents() { return {bitangent_buffer.data(), bitangent_buffer.size()}; }

    const PoolView pool;
    std::span<const PrimitiveGeometry> primitives;
    const FramesOptions& options;
    std::span<FramesReport> reports;
    bool generates_normals = pool.normals.empty();
    bool generates_tangents = pool.makes_tangents && (options.tangents.method == Method::basis || !pool.uvs.empty());
    bool generates_bitangents =
        options.bitangents && generates_tangents && (pool.kept_tangents.empty() || pool.repairs_tangents);
    LocalMeshes local_meshes{pool, primitives.size()};
    MorphTangents morph_tangents{pool, options};

    // Vertices of all corners of all primitives, their computed frames, and the corner count of each primitive.
    std::span<const std::uint32_t> corners = {};
    std::vector<std::uint32_t> own_corners = {};
    std::vector<Vec3> normals = {};
    // Computed tangents and bitangents of all primitives, allocated at the start.
    Buffer<Vec4> tangent_buffer = {};
    Buffer<Vec3> bitangent_buffer = {};
    std::vector<std::size_t> corner_counts = {};
    // Results of repairing tangents: whether morph offsets are new, per corner, and the number of tangents that differ
    // from computed ones.
    std::vector<bool> has_new_offsets = {};
    std::uint64_t differing_count = 0;
};

// -- 1. frames of primitives --

/// Computes normals per corner, and one per vertex of the mesh: vertices with several normals are split first, so
/// that a per-vertex method uses the mesh that will be written.
Result<Done> computeNormals(const PoolComputation& state, const PrimitiveGeometry& primitive, LocalMesh& mesh,
                            std::vector<Vec3>& normals, FramesReport& report) {
    NormalOptions options = state.options.normals;
    options.smoothing_groups = primitive.smoothing_groups;
    normals.resize(mesh.indices.size());
    Result<NormalReport> made =
        BorderedNormals(mesh, primitive.around.get(), options, state.options.execution).base(normals);
    if (!made) return std::move(made).error();
    roundUnits(normals, state.options.format);
    report.normals = *made;
    report.normals_generated = true;

    const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec3>(normals));
    Result<SplitResult> split = splitVertices(mesh.view().indices, mesh.positions.count, mesh.indices.size(),
                                              {&attribute, 1}, state.options.execution);
    if (!split) return std::move(split).error();
    mesh.own.positions = gather(mesh.positions, split->source_vertices);
    mesh.own.uvs = gather(mesh.uvs, split->source_vertices);
    mesh.own.normals = gatherNormals(normals, split->source_corners);
    mesh.own.indices = std::move(split->indices);
    mesh.useOwnIndices();
    mesh.useOwnVertices();
    return Done{};
}

Result<QuadFaces> chooseFaces(const PoolComputation& state, const LocalMesh& mesh) {
    const bool keeps = !state.pool.kept_tangents.empty();
    const Faces faces = keeps ? Faces::automatic : state.options.faces;
    std::span<const Vec4> stored;
    std::vector<Vec4> own;
    if (faces != Faces::triangles && !state.generates_normals) {
        stored = keeps ? state.pool.kept_tangents : state.pool.old_tangents;
        if (!mesh.sources.empty()) stored = own = gather(stored, mesh.sources);
    }
    return tspace::chooseFaces(mesh.view(), stored, state.pool.is_from_blender, faces, state.options.execution);
}

/// Converts triangles to quads if requested and possible; `polygons` are the polygons of the file. Morph deltas of kept
/// tangents are computed on the faces that these tangents were computed on.
Result<Done> chooseQuads(const PoolComputation& state, QuadFaces&& polygons, LocalMesh& mesh, FramesReport& report) {
    if (!state.usesQuads()) return Done{};
    QuadFaces faces = std::move(polygons);
    if (faces.quad_count == 0) {
        Result<QuadFaces> chosen = chooseFaces(state, mesh);
        if (!chosen) return std::move(chosen).error();
        faces = *std::move(chosen);
    }
    if (faces.quad_count == 0) return Done{};
    report.faces = Faces::quads;
    report.quad_count = faces.quad_count;
    replaceFaces(std::move(faces), mesh);
    return Done{};
}

/// Computes the tangents of one primitive. `bitangents` may be empty.
Result<Done> computeTangents(const PoolComputation& state, const LocalMesh& mesh, std::span<Vec4> tangents,
                             std::span<Vec3> bitangents, FramesReport& report) {
    TangentOutput out{.tangents = tangents};
    if (state.generates_bitangents) {
        out.bitangents = bitangents;
        report.bitangents_generated = true;
    }
    Result<TangentReport> made = generateTangents(mesh.view(), state.options.tangents, out, state.options.execution);
    if (!made) return std::move(made).error();
    report.tangents = *made;
    report.negative_uv_count = positiveUvsAreMirrored(state.options.tangents.convention)
                                   ? notMirroredCount(*made, state.options.tangents.method)
                                   : made->mirrored_count;
    if (!state.options.sanitize) return Done{};
    std::vector<Vec4> computed;
    if (state.generates_bitangents) computed.assign(tangents.begin(), tangents.end());
    Result<SanitizeReport> repaired =
        sanitizeTangents(mesh.view(), state.options.sanitize_options, tangents, state.options.execution);
    if (!repaired) return std::move(repaired).error();
    report.sanitize = *repaired;
    if (state.generates_bitangents) repairBitangents(mesh.normals, mesh.indices, computed, tangents, bitangents);
    return Done{};
}

/// Computes the tangents of the next corners, into tangents() and bitangents().
Result<Done> computeTangents(PoolComputation& state, const LocalMesh& mesh, FramesReport& report) {
    const std::size_t first = state.corners.size(), count = mesh.triangleCornerCount();
    const std::span<Vec4> tangents = state.tangents().subspan(first, count);
    const std::span<Vec3> bitangents =
        state.generates_bitangents ? state.bitangents().subspan(first, count) : std::span<Vec3>();
    if (mesh.face_corners.empty()) return computeTangents(state, mesh, tangents, bitangents, report);
    std::vector<Vec4> of_faces(mesh.indices.size());
    std::vector<Vec3> bitangents_of_faces(bitangents.empty() ? 0 : mesh.indices.size());
    if (Result<Done> done = computeTangents(state, mesh, of_faces, bitangents_of_faces, report); !done) return done;
    toTriangles<Vec4>(mesh, of_faces, tangents);
    toTriangles<Vec3>(mesh, bitangents_of_faces, bitangents);
    return Done{};
}

/// Repairs the tangents of the mesh that was computed last, before its corners are appended.
void repairTangents(PoolComputation& state, std::span<const std::uint32_t> vertices, const Repairs& repairs) {
    const std::span<Vec4> tangents = state.tangents().subspan(state.corners.size(), vertices.size());
    const std::vector<Vec4> computed(tangents.begin(), tangents.end());
    const std::vector<bool> is_new = repairCorners(state.pool, vertices, repairs, tangents);
    state.has_new_offsets.insert(state.has_new_offsets.end(), is_new.begin(), is_new.end());
    state.differing_count += countDiffering(computed, tangents);
    if (!state.generates_bitangents) return;
    const std::span<Vec3> bitangents = state.bitangents().subspan(state.corners.size(), vertices.size());
    for (std::size_t c = 0; c < vertices.size(); ++c) {
        if (computed[c] == tangents[c]) continue;
        bitangents[c] = bitangentOf(tangents[c], state.pool.normals[vertices[c]]);
    }
}

/// Appends the corners of a primitive to those of the pool. `vertices`: vertices of these corners, which are not copied
/// if there is a single primitive.
void append(PoolComputation& state, std::span<const std::uint32_t> vertices, bool is_cut, std::vector<Vec3>&& normals) {
    if (state.primitives.size() == 1 && !is_cut) {
        state.corners = vertices;
    } else {
        state.own_corners.insert(state.own_corners.end(), vertices.begin(), vertices.end());
        state.corners = state.own_corners;
    }
    if (state.normals.empty()) {
        state.normals = std::move(normals);
    } else {
        state.normals.insert(state.normals.end(), normals.begin(), normals.end());
    }
    state.corner_counts.push_back(vertices.size());
}

/// Computes the frames of one primitive and appends them for the split. Polygons are triangulated after normals are
/// computed, because normals need whole faces, and before tangents are, because readers of the output get triangles and
/// would compute tangents on them.
Result<Done> computePrimitive(PoolComputation& state, const PrimitiveGeometry& primitive, FramesReport& report) {
    if (primitive.indices.empty()) {
        state.corner_counts.push_back(0);
        return Done{};
    }
    LocalMesh mesh = state.local_meshes.make(primitive);
    QuadFaces faces;
    std::vector<std::uint32_t> cut_vertices;
    std::vector<Vec3> normals;
    if (state.generates_normals) {
        if (Result<Done> done = computeNormals(state, primitive, mesh, normals, report); !done) return done;
        callProgress(state.options);
    }
    if (!mesh.face_sizes.empty()) {
        Result<Triangulation> triangles = triangulate(mesh.view());
        if (!triangles) return std::move(triangles).error();
        if (state.options.faces == Faces::quads && state.usesQuads())
            faces = facesOfPolygons(mesh.face_sizes, *triangles);
        mesh.own.indices = gather(mesh.indices, triangles->corners);
        mesh.useOwnIndices();
        cut_vertices = gather(spanOf(primitive.indices), triangles->corners);
        normals = gather(std::span<const Vec3>(normals), triangles->corners);
        mesh.face_sizes = {};
    }
    if (state.generates_tangents) {
        if (Result<Done> done = chooseQuads(state, std::move(faces), mesh, report); !done) return done;
        if (Result<Done> done = computeTangents(state, mesh, report); !done) return done;
        callProgress(state.options);
    }
    const bool is_cut = !primitive.face_sizes.empty();
    const std::vector<std::uint32_t>& vertices = is_cut ? cut_vertices : primitive.indices;
    report.triangle_count = vertices.size() / 3;
    if (state.pool.repairs_tangents) repairTangents(state, vertices, primitive.repairs);
    if (state.generates_tangents && state.pool.targets.count != 0) {
        if (Result<Done> done = state.morph_tangents.add(std::move(mesh), report); !done) return done;
    }
    append(state, vertices, is_cut, std::move(normals));
    return Done{};
}

// -- 2. frames of morph targets --

Result<Done> computeMorphs(PoolComputation& state, SplitResult& split, bool may_split, PoolFrames& frames) {
    frames.morphs.resize(state.pool.targets.count);
    if (!state.generates_tangents || state.pool.targets.count == 0) return Done{};
    MorphSplit morph_split(std::move(split), may_split);
    const KeptOffsets kept{state.corners, state.has_new_offsets};
    const KeptOffsets* const keeps = state.pool.repairs_tangents ? &kept : nullptr;
    if (Result<Done> done = state.morph_tangents.compute(state.tangents(), morph_split, keeps); !done) return done;
    std::vector<VertexOffsets> offsets = morph_split.finish();
    for (std::size_t i = 0; i < offsets.size(); ++i) frames.morphs[i].tangents = std::move(offsets[i]);
    split = std::move(morph_split.split());
    return Done{};
}

// -- 3. vertices after the split --

/// Splits the indices of all primitives into one list per primitive.
void cutIndices(const PoolComputation& state, std::vector<std::uint32_t>&& indices, PoolFrames& frames) {
    if (state.corner_counts.size() == 1) {
        frames.indices.push_back(std::move(indices));
        return;
    }
    auto begin = indices.begin();
    for (const std::size_t count : state.corner_counts) {
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        frames.indices.emplace_back(begin, end);
        begin = end;
    }
}

/// Writes the frame of an unused vertex: an arbitrary orthonormal frame.
void writeUnused(const PoolComputation& state, std::uint32_t vertex, PoolFrames& frames) {
    const Vec3 normal = state.generates_normals ? Vec3{0, 0, 1} : state.pool.normals[vertex];
    frames.tangents.push_back(tangentFromNormal(normal, signFactor(state.options.tangents.convention)));
    if (state.generates_bitangents) frames.bitangents.push_back(bitangentOf(frames.tangents.back(), normal));
}

void writeTangents(const PoolComputation& state, const SplitResult& split, PoolFrames& frames) {
    // Reserves memory first: while an array grows, fresh pages are mapped one by one.
    frames.tangents.reserve(split.vertexCount());
    populatePages(frames.tangents.data(), split.vertexCount() * sizeof(Vec4));
    if (state.generates_bitangents) frames.bitangents.reserve(split.vertexCount());
    for (std::size_t v = 0; v < split.vertexCount(); ++v) {
        const std::uint32_t corner = split.source_corners[v];
        if (corner == kNoCorner && state.pool.repairs_tangents) {
            const Vec3 normal = state.pool.normals[split.source_vertices[v]];
            frames.tangents.push_back(withValidValues(state.pool.kept_tangents[split.source_vertices[v]],
                                                      tangentFromNormal(normal, 1), normal));
            if (state.generates_bitangents) frames.bitangents.push_back(bitangentOf(frames.tangents.back(), normal));
            continue;
        }
        if (corner == kNoCorner) {
            writeUnused(state, split.source_vertices[v], frames);
            continue;
        }
        frames.tangents.push_back(state.tangent_buffer[corner]);
        if (state.generates_bitangents) frames.bitangents.push_back(state.bitangent_buffer[corner]);
    }
}

/// Counts repaired vertices whose tangent or morph offsets changed.
void countRepaired(PoolComputation& state, const SplitResult& split, std::span<const Vec4> tangents) {
    std::vector<bool> changed(state.pool.positions.count, false);
    for (std::size_t v = 0; v < split.vertexCount(); ++v) {
        const std::uint32_t source = split.source_vertices[v];
        if (std::memcmp(&tangents[v], &state.pool.kept_tangents[source], sizeof(Vec4)) != 0) changed[source] = true;
    }
    if (state.pool.targets.count != 0) {
        for (std::size_t c = 0; c < state.corners.size(); ++c) {
            if (state.has_new_offsets[c]) changed[state.corners[c]] = true;
        }
    }
    for (std::size_t p = 0; p < state.primitives.size(); ++p) {
        const std::vector<VertexRepair>& repairs = state.primitives[p].repairs.vertices;
        state.reports[p].mended_vertex_count = static_cast<std::uint64_t>(std::count_if(
            repairs.begin(), repairs.end(), [&](const VertexRepair& repair) { return changed[repair.vertex]; }));
    }
}

void write(PoolComputation& state, SplitResult&& split, PoolFrames& frames) {
    frames.normals_generated = state.generates_normals;
    cutIndices(state, std::move(split.indices), frames);
    if (state.generates_normals) frames.normals = gatherNormals(state.normals, split.source_corners);
    if (state.generates_tangents) writeTangents(state, split, frames);
    if (state.pool.repairs_tangents) countRepaired(state, split, frames.tangents);
    for (FramesReport& report : state.reports) {
        report.vertices_before = state.pool.positions.count;
        report.vertices_after = split.vertexCount();
    }
    frames.source_vertices = std::move(split.source_vertices);
}

// -- 4. frames of a pool --

Result<PoolFrames> splitPool(PoolComputation& state) {
    std::vector<CornerAttribute> attributes;
    if (!state.normals.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec3>(state.normals)));
    if (!state.tangent_buffer.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec4>(state.tangents())));
    if (!state.bitangent_buffer.empty())
        attributes.push_back(cornerAttribute(StridedSpan<const Vec3>(state.bitangents())));
    Result<SplitResult> split = splitVertices(IndexView(state.corners), state.pool.positions.count,
                                              state.corners.size(), attributes, state.options.execution);
    if (!split) return std::move(split).error();

    PoolFrames frames;
    frames.differing_count = state.differing_count;
    if (Result<Done> done = computeMorphs(state, *split, true, frames); !done) return std::move(done).error();
    write(state, *std::move(split), frames);
    return frames;
}

/// Keeps all vertices, and only compares kept tangents with computed ones.
Result<PoolFrames> keepPool(PoolComputation& state) {
    PoolFrames frames;
    frames.differing_count = countDiffering(state.tangents(), state.pool.kept_tangents, state.corners);
    SplitResult whole;
    whole.source_vertices.resize(state.pool.positions.count);
    std::iota(whole.source_vertices.begin(), whole.source_vertices.end(), 0u);
    whole.source_corners.assign(state.pool.positions.count, kNoCorner);
    for (std::size_t c = state.corners.size(); c-- > 0;)
        whole.source_corners[state.corners[c]] = static_cast<std::uint32_t>(c);
    whole.indices.assign(state.corners.begin(), state.corners.end());
    if (frames.differing_count == 0) {
        if (Result<Done> done = computeMorphs(state, whole, false, frames); !done) return std::move(done).error();
    }
    write(state, std::move(whole), frames);
    return frames;
}

Result<PoolFrames> computePool(PoolComputation& state) {
    std::size_t corner_count = 0;
    for (const PrimitiveGeometry& primitive : state.primitives) {
        if (Result<Done> valid = validate(viewInPool(state.pool, primitive)); !valid) return std::move(valid).error();
        corner_count += cornersOfTriangles(primitive);
    }
    if (corner_count > kMaxCorners) {
        return Error{ErrorCode::tooLarge,
                     "the primitives that share these vertices have more than 2^31-1 corners in total"};
    }
    const Allocator* allocator = state.options.execution.allocator;
    if (state.generates_tangents) state.tangent_buffer = Buffer<Vec4>(allocator, corner_count);
    if (state.generates_bitangents) state.bitangent_buffer = Buffer<Vec3>(allocator, corner_count);
    for (std::size_t p = 0; p < state.primitives.size(); ++p) {
        if (Result<Done> done = computePrimitive(state, state.primitives[p], state.reports[p]); !done)
            return std::move(done).error();
    }
    return state.pool.kept_tangents.empty() || state.pool.repairs_tangents ? splitPool(state) : keepPool(state);
}

Result<PoolFrames> computePool(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                               const FramesOptions& options, std::span<FramesReport> reports) {
    PoolComputation state{.pool = pool, .primitives = primitives, .options = options, .reports = reports};
    return computePool(state);
}

// -- 5. entry points --

Error checkPool(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                std::span<const FramesReport> reports) {
    const std::size_t count = pool.positions.count;
    if (count > kMaxCorners) return {ErrorCode::tooLarge, "the vertex pool has more than 2^31-1 vertices"};
    if (reports.size() != primitives.size()) {
        return {ErrorCode::countMismatch,
                std::to_string(primitives.size()) + " primitives, but " + std::to_string(reports.size()) + " reports"};
    }
    if (!pool.normals.empty() && pool.normals.count != count)
        return {ErrorCode::countMismatch, "the pool must have as many normals as positions"};
    if (!pool.uvs.empty() && pool.uvs.count != count)
        return {ErrorCode::countMismatch, "the pool must have as many UVs as positions"};
    if (!pool.kept_tangents.empty() && (pool.kept_tangents.size() != count || pool.normals.empty()))
        return {ErrorCode::countMismatch, "kept tangents require one normal and one tangent per position"};
    return {ErrorCode::ok, {}};
}

/// Computes normals first, as a separate pool, so that the tangents of every target are computed on the vertices of the
/// output.
Result<PoolFrames> computeWithMorphedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                             const FramesOptions& options, std::span<FramesReport> reports) {
    PoolWithNormals made;
    if (Result<Done> done = generatePoolNormals(pool, primitives, options, reports, made); !done)
        return std::move(done).error();
    PoolView with_normals = made.vertices;
    with_normals.targets = made.targets;
    with_normals.makes_tangents = pool.makes_tangents;
    Result<PoolFrames> frames = computePool(with_normals, made.primitives, options, reports);
    if (!frames) return frames;
    frames->normals_generated = true;
    frames->normals = gather(std::span<const Vec3>(made.vertices.normals), frames->source_vertices);
    for (std::size_t i = 0; i < pool.targets.count; ++i)
        frames->morphs[i].normals = spread(made.offsets[i], frames->source_vertices, made.source_vertices.size());
    for (std::uint32_t& source : frames->source_vertices) source = made.source_vertices[source];
    for (FramesReport& report : reports) report.vertices_before = pool.positions.count;
    return frames;
}

/// Winding faults are counted if splitting increases the number of vertices by more than 1 / kManySplit.
constexpr std::size_t kManySplit = 20;

void countFaults(const PoolView& pool, const PoolFrames& frames, float weld_distance, std::span<FramesReport> reports) {
    const std::size_t before = pool.positions.count, after = frames.source_vertices.size();
    const bool counts_winding =
        (after - before) * kManySplit > before || (frames.normals_generated && !frames.normals.empty());
    if (!counts_winding) return;
    countFaults(gather(pool.positions, frames.source_vertices), frames.normals, frames.indices, weld_distance, reports);
}

}  // namespace

Result<PoolFrames> computeFrames(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const FramesOptions& given, std::span<FramesReport> reports) {
    return atBorder([&]() -> Result<PoolFrames> {
        if (Error e = checkPool(pool, primitives, reports); e.code != ErrorCode::ok) return e;
        const FramesOptions options = inFileCoordinates(given);
        if (!pool.uv_matrix.isIdentity()) {
            const std::vector<Vec2> uvs = transformUvs(pool.uvs, pool.uv_matrix);
            PoolView turned = pool;
            turned.uvs = uvs;
            turned.uv_matrix = {};
            return computeFrames(turned, primitives, given, reports);
        }
        Result<PoolFrames> frames = pool.normals.empty() && pool.targets.count != 0
                                        ? computeWithMorphedNormals(pool, primitives, options, reports)
                                        : computePool(pool, primitives, options, reports);
        callProgress(options);
        if (frames) countFaults(pool, *frames, options.normals.weld_distance, reports);
        return frames;
    });
}

}  // namespace tspace
