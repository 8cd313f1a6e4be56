// SPDX-License-Identifier: MIT
// Normals, tangents, sanitizing and splitting for all primitives of one vertex pool.
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

/// Keeps the file's coordinate system: a convention may be an engine's preset, but the geometry is right-handed with
/// counter-clockwise faces, in every supported format.
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

class FrameComputer {
  public:
    FrameComputer(const PoolView& pool, std::span<const PrimitiveGeometry> primitives, const FramesOptions& options,
                  std::span<FramesReport> reports)
        : pool_(pool),
          primitives_(primitives),
          options_(options),
          reports_(reports),
          generates_normals_(pool.normals.empty()),
          generates_tangents_(pool.makes_tangents && (options.tangents.method == Method::basis || !pool.uvs.empty())),
          generates_bitangents_(options.bitangents && generates_tangents_ &&
                                (pool.kept_tangents.empty() || pool.mends_tangents)),
          local_meshes_(pool_, primitives.size()),
          morph_tangents_(pool_, options) {}

    Result<PoolFrames> compute() {
        std::size_t corner_count = 0;
        for (const PrimitiveGeometry& primitive : primitives_) {
            if (Result<Done> valid = validate(viewInPool(pool_, primitive)); !valid) return std::move(valid).error();
            corner_count += cornersOfTriangles(primitive);
        }
        if (corner_count > kMaxCorners) {
            return Error{ErrorCode::tooLarge, "the primitives that share these vertices have more than 2^31-1 corners"};
        }
        const Allocator* allocator = options_.execution.allocator;
        if (generates_tangents_) tangents_ = Buffer<Vec4>(allocator, corner_count);
        if (generates_bitangents_) bitangents_ = Buffer<Vec3>(allocator, corner_count);
        for (std::size_t p = 0; p < primitives_.size(); ++p) {
            if (Result<Done> done = computePrimitive(primitives_[p], reports_[p]); !done) {
                return std::move(done).error();
            }
        }
        return pool_.kept_tangents.empty() || pool_.mends_tangents ? splitPool() : keepPool();
    }

  private:
    /// Computes the frames of one primitive and appends them for the split. Polygons are triangulated after the
    /// normals, which need whole faces, and before the tangents: readers of the result see triangles, and would compute
    /// with these.
    Result<Done> computePrimitive(const PrimitiveGeometry& primitive, FramesReport& report) {
        if (primitive.indices.empty()) {
            corner_counts_.push_back(0);
            return Done{};
        }
        LocalMesh mesh = local_meshes_.make(primitive);
        QuadFaces faces;
        std::vector<std::uint32_t> cut_vertices;
        std::vector<Vec3> normals;
        if (generates_normals_) {
            if (Result<Done> done = computeNormals(primitive, mesh, normals, report); !done) return done;
            callProgress(options_);
        }
        if (!mesh.face_sizes.empty()) {
            Result<Triangulation> triangles = triangulate(mesh.view());
            if (!triangles) return std::move(triangles).error();
            if (options_.faces == Faces::quads && takesQuads()) faces = facesOfPolygons(mesh.face_sizes, *triangles);
            mesh.own.indices = gather(mesh.indices, triangles->corners);
            mesh.useOwnIndices();
            cut_vertices = gather(spanOf(primitive.indices), triangles->corners);
            normals = gather(std::span<const Vec3>(normals), triangles->corners);
            mesh.face_sizes = {};
        }
        if (generates_tangents_) {
            if (Result<Done> done = chooseQuads(std::move(faces), mesh, report); !done) return done;
            if (Result<Done> done = computeTangents(mesh, report); !done) return done;
            callProgress(options_);
        }
        const bool is_cut = !primitive.face_sizes.empty();
        const std::vector<std::uint32_t>& vertices = is_cut ? cut_vertices : primitive.indices;
        report.triangle_count = vertices.size() / 3;
        if (pool_.mends_tangents) mendTangents(vertices, primitive.mends);
        if (generates_tangents_ && pool_.targets.count != 0) {
            if (Result<Done> done = morph_tangents_.add(std::move(mesh), report); !done) return done;
        }
        append(vertices, is_cut, std::move(normals));
        return Done{};
    }

    /// Computes normals per corner, and one per vertex of the mesh: vertices with several normals are split first, so
    /// that a per-vertex method uses the mesh that will be written.
    Result<Done> computeNormals(const PrimitiveGeometry& primitive, LocalMesh& mesh, std::vector<Vec3>& normals,
                                FramesReport& report) const {
        NormalOptions options = options_.normals;
        options.smoothing_groups = primitive.smoothing_groups;
        normals.resize(mesh.indices.size());
        Result<NormalReport> made =
            BorderedNormals(mesh, primitive.around.get(), options, options_.execution).base(normals);
        if (!made) return std::move(made).error();
        roundUnits(normals, options_.format);
        report.normals = *made;
        report.normals_generated = true;

        const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec3>(normals));
        Result<SplitResult> split = splitVertices(mesh.view().indices, mesh.positions.count, mesh.indices.size(),
                                                  {&attribute, 1}, options_.execution);
        if (!split) return std::move(split).error();
        mesh.own.positions = gather(mesh.positions, split->source_vertices);
        mesh.own.uvs = gather(mesh.uvs, split->source_vertices);
        mesh.own.normals = gatherNormals(normals, split->source_corners);
        mesh.own.indices = std::move(split->indices);
        mesh.useOwnIndices();
        mesh.useOwnVertices();
        return Done{};
    }

    [[nodiscard]] bool takesQuads() const { return options_.tangents.method == Method::mikktspace; }

    /// Converts triangles to quads if requested and possible; `polygons` are the file's own. Morph deltas of kept
    /// tangents are computed on the faces that these tangents were computed on.
    Result<Done> chooseQuads(QuadFaces&& polygons, LocalMesh& mesh, FramesReport& report) const {
        if (!takesQuads()) return Done{};
        QuadFaces faces = std::move(polygons);
        if (faces.quad_count == 0) {
            Result<QuadFaces> chosen = chooseFaces(mesh);
            if (!chosen) return std::move(chosen).error();
            faces = *std::move(chosen);
        }
        if (faces.quad_count == 0) return Done{};
        report.faces = Faces::quads;
        report.quad_count = faces.quad_count;
        takeFaces(std::move(faces), mesh);
        return Done{};
    }

    [[nodiscard]] Result<QuadFaces> chooseFaces(const LocalMesh& mesh) const {
        const bool keeps = !pool_.kept_tangents.empty();
        const Faces faces = keeps ? Faces::automatic : options_.faces;
        std::span<const Vec4> stored;
        std::vector<Vec4> own;
        if (faces != Faces::triangles && !generates_normals_) {
            stored = keeps ? pool_.kept_tangents : pool_.old_tangents;
            if (!mesh.sources.empty()) stored = own = gather(stored, mesh.sources);
        }
        return tspace::chooseFaces(mesh.view(), stored, pool_.is_blenders, faces, options_.execution);
    }

    /// Computes the tangents of the next corners, into tangents() and bitangents().
    Result<Done> computeTangents(const LocalMesh& mesh, FramesReport& report) {
        const std::size_t first = corners_.size(), count = mesh.triangleCornerCount();
        const std::span<Vec4> tangents = this->tangents().subspan(first, count);
        const std::span<Vec3> bitangents =
            generates_bitangents_ ? this->bitangents().subspan(first, count) : std::span<Vec3>();
        if (mesh.face_corners.empty()) return computeTangents(mesh, tangents, bitangents, report);
        std::vector<Vec4> of_faces(mesh.indices.size());
        std::vector<Vec3> bitangents_of_faces(bitangents.empty() ? 0 : mesh.indices.size());
        if (Result<Done> done = computeTangents(mesh, of_faces, bitangents_of_faces, report); !done) return done;
        toTriangles<Vec4>(mesh, of_faces, tangents);
        toTriangles<Vec3>(mesh, bitangents_of_faces, bitangents);
        return Done{};
    }

    /// `bitangents` may be empty.
    Result<Done> computeTangents(const LocalMesh& mesh, std::span<Vec4> tangents, std::span<Vec3> bitangents,
                                 FramesReport& report) const {
        TangentOutput out{.tangents = tangents};
        if (generates_bitangents_) {
            out.bitangents = bitangents;
            report.bitangents_generated = true;
        }
        Result<TangentReport> made = generateTangents(mesh.view(), options_.tangents, out, options_.execution);
        if (!made) return std::move(made).error();
        report.tangents = *made;
        report.negative_uv_count = positiveUvsAreMirrored(options_.tangents.convention)
                                       ? notMirroredCount(*made, options_.tangents.method)
                                       : made->mirrored_count;
        if (!options_.sanitize) return Done{};
        std::vector<Vec4> computed;
        if (generates_bitangents_) computed.assign(tangents.begin(), tangents.end());
        Result<SanitizeReport> mended =
            sanitizeTangents(mesh.view(), options_.sanitize_options, tangents, options_.execution);
        if (!mended) return std::move(mended).error();
        report.sanitize = *mended;
        if (generates_bitangents_) mendBitangents(mesh.normals, mesh.indices, computed, tangents, bitangents);
        return Done{};
    }

    /// Repairs the tangents of the mesh that was just computed, which is appended next.
    void mendTangents(std::span<const std::uint32_t> vertices, const Mends& mends) {
        const std::span<Vec4> tangents = this->tangents().subspan(corners_.size(), vertices.size());
        const std::vector<Vec4> computed(tangents.begin(), tangents.end());
        const std::vector<bool> is_new = mendCorners(pool_, vertices, mends, tangents);
        has_new_offsets_.insert(has_new_offsets_.end(), is_new.begin(), is_new.end());
        differing_count_ += countDiffering(computed, tangents);
        if (!generates_bitangents_) return;
        const std::span<Vec3> bitangents = this->bitangents().subspan(corners_.size(), vertices.size());
        for (std::size_t c = 0; c < vertices.size(); ++c) {
            if (computed[c] == tangents[c]) continue;
            bitangents[c] = bitangentOf(tangents[c], pool_.normals[vertices[c]]);
        }
    }

    /// `vertices`: vertices of the primitive's corners. For a single primitive they are not copied.
    void append(std::span<const std::uint32_t> vertices, bool is_cut, std::vector<Vec3>&& normals) {
        if (primitives_.size() == 1 && !is_cut) {
            corners_ = vertices;
        } else {
            own_corners_.insert(own_corners_.end(), vertices.begin(), vertices.end());
            corners_ = own_corners_;
        }
        if (normals_.empty()) {
            normals_ = std::move(normals);
        } else {
            normals_.insert(normals_.end(), normals.begin(), normals.end());
        }
        corner_counts_.push_back(vertices.size());
    }

    Result<PoolFrames> splitPool() {
        std::vector<CornerAttribute> attributes;
        if (!normals_.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec3>(normals_)));
        if (!tangents_.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec4>(tangents())));
        if (!bitangents_.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec3>(bitangents())));
        Result<SplitResult> split =
            splitVertices(IndexView(corners_), pool_.positions.count, corners_.size(), attributes, options_.execution);
        if (!split) return std::move(split).error();

        PoolFrames frames;
        frames.differing_count = differing_count_;
        if (Result<Done> done = computeMorphs(*split, true, frames); !done) return std::move(done).error();
        write(*std::move(split), frames);
        return frames;
    }

    /// Keeps all vertices, and only compares the tangents of the base.
    Result<PoolFrames> keepPool() {
        PoolFrames frames;
        frames.differing_count = countDiffering(tangents(), pool_.kept_tangents, corners_);
        SplitResult whole;
        whole.source_vertices.resize(pool_.positions.count);
        std::iota(whole.source_vertices.begin(), whole.source_vertices.end(), 0u);
        whole.source_corners.assign(pool_.positions.count, kNoCorner);
        for (std::size_t c = corners_.size(); c-- > 0;) {
            whole.source_corners[corners_[c]] = static_cast<std::uint32_t>(c);
        }
        whole.indices.assign(corners_.begin(), corners_.end());
        if (frames.differing_count == 0) {
            if (Result<Done> done = computeMorphs(whole, false, frames); !done) return std::move(done).error();
        }
        write(std::move(whole), frames);
        return frames;
    }

    Result<Done> computeMorphs(SplitResult& split, bool may_split, PoolFrames& frames) {
        frames.morphs.resize(pool_.targets.count);
        if (!generates_tangents_ || pool_.targets.count == 0) return Done{};
        MorphSplit morph_split(std::move(split), may_split);
        const KeptOffsets kept{corners_, has_new_offsets_};
        const KeptOffsets* const keeps = pool_.mends_tangents ? &kept : nullptr;
        if (Result<Done> done = morph_tangents_.compute(tangents(), morph_split, keeps); !done) return done;
        std::vector<VertexOffsets> offsets = morph_split.finish();
        for (std::size_t i = 0; i < offsets.size(); ++i) frames.morphs[i].tangents = std::move(offsets[i]);
        split = std::move(morph_split.split());
        return Done{};
    }

    void write(SplitResult&& split, PoolFrames& frames) {
        frames.normals_generated = generates_normals_;
        cutIndices(std::move(split.indices), frames);
        if (generates_normals_) frames.normals = gatherNormals(normals_, split.source_corners);
        if (generates_tangents_) writeTangents(split, frames);
        if (pool_.mends_tangents) countMended(split, frames.tangents);
        for (FramesReport& report : reports_) {
            report.vertices_before = pool_.positions.count;
            report.vertices_after = split.vertexCount();
        }
        frames.source_vertices = std::move(split.source_vertices);
    }

    /// Splits the indices of all primitives into one list per primitive.
    void cutIndices(std::vector<std::uint32_t>&& indices, PoolFrames& frames) const {
        if (corner_counts_.size() == 1) {
            frames.indices.push_back(std::move(indices));
            return;
        }
        auto begin = indices.begin();
        for (const std::size_t count : corner_counts_) {
            const auto end = begin + static_cast<std::ptrdiff_t>(count);
            frames.indices.emplace_back(begin, end);
            begin = end;
        }
    }

    /// Counts repaired vertices whose tangent or morph offsets changed.
    void countMended(const SplitResult& split, std::span<const Vec4> tangents) {
        std::vector<bool> changed(pool_.positions.count, false);
        for (std::size_t v = 0; v < split.vertexCount(); ++v) {
            const std::uint32_t source = split.source_vertices[v];
            if (std::memcmp(&tangents[v], &pool_.kept_tangents[source], sizeof(Vec4)) != 0) changed[source] = true;
        }
        if (pool_.targets.count != 0) {
            for (std::size_t c = 0; c < corners_.size(); ++c) {
                if (has_new_offsets_[c]) changed[corners_[c]] = true;
            }
        }
        for (std::size_t p = 0; p < primitives_.size(); ++p) {
            const std::vector<VertexMend>& mends = primitives_[p].mends.vertices;
            reports_[p].mended_vertex_count = static_cast<std::uint64_t>(std::count_if(
                mends.begin(), mends.end(), [&](const VertexMend& mend) { return changed[mend.vertex]; }));
        }
    }

    void writeTangents(const SplitResult& split, PoolFrames& frames) const {
        // Reserves first: growing would touch fresh pages one by one.
        frames.tangents.reserve(split.vertexCount());
        askForPages(frames.tangents.data(), split.vertexCount() * sizeof(Vec4));
        if (generates_bitangents_) frames.bitangents.reserve(split.vertexCount());
        for (std::size_t v = 0; v < split.vertexCount(); ++v) {
            const std::uint32_t corner = split.source_corners[v];
            if (corner == kNoCorner && pool_.mends_tangents) {
                const Vec3 normal = pool_.normals[split.source_vertices[v]];
                frames.tangents.push_back(withSoundValues(pool_.kept_tangents[split.source_vertices[v]],
                                                          tangentFromNormal(normal, 1), normal));
                if (generates_bitangents_) frames.bitangents.push_back(bitangentOf(frames.tangents.back(), normal));
                continue;
            }
            if (corner == kNoCorner) {
                writeUnused(split.source_vertices[v], frames);
                continue;
            }
            frames.tangents.push_back(tangents_[corner]);
            if (generates_bitangents_) frames.bitangents.push_back(bitangents_[corner]);
        }
    }

    /// Writes the frame of an unused vertex: an arbitrary orthonormal frame.
    void writeUnused(std::uint32_t vertex, PoolFrames& frames) const {
        const Vec3 normal = generates_normals_ ? Vec3{0, 0, 1} : pool_.normals[vertex];
        frames.tangents.push_back(tangentFromNormal(normal, signFactor(options_.tangents.convention)));
        if (generates_bitangents_) frames.bitangents.push_back(bitangentOf(frames.tangents.back(), normal));
    }

    [[nodiscard]] std::span<Vec4> tangents() { return {tangents_.data(), tangents_.size()}; }
    [[nodiscard]] std::span<Vec3> bitangents() { return {bitangents_.data(), bitangents_.size()}; }

    const PoolView pool_;
    std::span<const PrimitiveGeometry> primitives_;
    const FramesOptions& options_;
    std::span<FramesReport> reports_;
    bool generates_normals_;
    bool generates_tangents_;
    bool generates_bitangents_;
    LocalMeshes local_meshes_;
    MorphTangents morph_tangents_;

    // The vertices of all corners of all primitives, their computed frames, and the corner count of each primitive.
    std::span<const std::uint32_t> corners_;
    std::vector<std::uint32_t> own_corners_;
    std::vector<Vec3> normals_;
    // Allocated for all primitives from the start.
    Buffer<Vec4> tangents_;
    Buffer<Vec3> bitangents_;
    std::vector<std::size_t> corner_counts_;
    // For repaired tangents: whether morph offsets are new, per corner, and the number of tangents that differ from
    // computed ones.
    std::vector<bool> has_new_offsets_;
    std::uint64_t differing_count_ = 0;
};

Error checkPool(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                std::span<const FramesReport> reports) {
    const std::size_t count = pool.positions.count;
    if (count > kMaxCorners) return {ErrorCode::tooLarge, "more than 2^31-1 vertices"};
    if (reports.size() != primitives.size()) {
        return {ErrorCode::countMismatch,
                std::to_string(primitives.size()) + " primitives but " + std::to_string(reports.size()) + " reports"};
    }
    if (!pool.normals.empty() && pool.normals.count != count) {
        return {ErrorCode::countMismatch, "the pool's normals and positions differ in number"};
    }
    if (!pool.uvs.empty() && pool.uvs.count != count) {
        return {ErrorCode::countMismatch, "the pool's UVs and positions differ in number"};
    }
    if (!pool.kept_tangents.empty() && (pool.kept_tangents.size() != count || pool.normals.empty())) {
        return {ErrorCode::countMismatch, "tangents are kept only with as many normals and positions"};
    }
    return {ErrorCode::ok, {}};
}

/// Computes normals first, as a separate pool, so that tangents of every target use the vertices that will be written.
Result<PoolFrames> computeWithMorphedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                             const FramesOptions& options, std::span<FramesReport> reports) {
    PoolWithNormals made;
    if (Result<Done> done = generatePoolNormals(pool, primitives, options, reports, made); !done) {
        return std::move(done).error();
    }
    PoolView with_normals = made.vertices;
    with_normals.targets = made.targets;
    with_normals.makes_tangents = pool.makes_tangents;
    Result<PoolFrames> frames = FrameComputer(with_normals, made.primitives, options, reports).compute();
    if (!frames) return frames;
    frames->normals_generated = true;
    frames->normals = gather(std::span<const Vec3>(made.vertices.normals), frames->source_vertices);
    for (std::size_t i = 0; i < pool.targets.count; ++i) {
        frames->morphs[i].normals = spread(made.offsets[i], frames->source_vertices, made.source_vertices.size());
    }
    for (std::uint32_t& source : frames->source_vertices) source = made.source_vertices[source];
    for (FramesReport& report : reports) report.vertices_before = pool.positions.count;
    return frames;
}

/// If a split adds at least one in this many vertices, its causes are counted.
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
                                        : FrameComputer(pool, primitives, options, reports).compute();
        callProgress(options);
        if (frames) countFaults(pool, *frames, options.normals.weld_distance, reports);
        return frames;
    });
}

}  // namespace tspace
