// SPDX-License-Identifier: MIT
// Normals, tangents, sanitize and split for all primitives of one vertex pool.
#include <utility>

#include "core/border.h"
#include "generate/primitive.h"
#include "tspace/frame.h"
#include "tspace/triangulate.h"

namespace tspace {

namespace {

constexpr std::uint32_t kNoSlot = 0xffffffffu;

std::span<const std::uint32_t> spanOf(const std::vector<std::uint32_t>& values) { return values; }

/// One primitive as a mesh of its own. Its arrays are those of the pool, or own ones: a pool is often shared by many
/// primitives that each use a small part of it, and what the methods do per vertex should cost in proportion to that
/// part.
struct LocalMesh {
    std::span<const Vec3> positions, normals;
    std::span<const Vec2> uvs;
    std::span<const std::uint32_t> indices;
    std::span<const std::uint32_t> face_sizes;

    std::vector<Vec3> own_positions, own_normals;
    std::vector<Vec2> own_uvs;
    std::vector<std::uint32_t> own_indices;

    void useOwnIndices() { indices = own_indices; }
    void useOwnVertices() {
        positions = own_positions;
        normals = own_normals;
        uvs = own_uvs;
    }

    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = StridedSpan<const Vec3>(positions);
        mesh.normals = StridedSpan<const Vec3>(normals);
        mesh.uvs = StridedSpan<const Vec2>(uvs);
        mesh.indices = IndexView(indices);
        mesh.face_sizes = face_sizes;
        return mesh;
    }
};

MeshView viewInPool(const VertexPool& pool, const PrimitiveGeometry& primitive) {
    MeshView mesh;
    mesh.positions = pool.positions;
    mesh.normals = pool.normals;
    mesh.uvs = pool.uvs;
    mesh.indices = IndexView(spanOf(primitive.indices));
    mesh.face_sizes = primitive.face_sizes;
    return mesh;
}

template <class T>
std::vector<T> gather(std::span<const T> values, const std::vector<std::uint32_t>& sources) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(sources.size());
    for (const std::uint32_t source : sources) result.push_back(values[source]);
    return result;
}

/// The normals of corners; any, where no corner uses the vertex.
std::vector<Vec3> gatherNormals(const std::vector<Vec3>& normals, const std::vector<std::uint32_t>& corners) {
    std::vector<Vec3> result;
    result.reserve(corners.size());
    for (const std::uint32_t corner : corners) {
        result.push_back(corner == kNoCorner ? Vec3{0, 0, 1} : normals[corner]);
    }
    return result;
}

/// A convention may be asked for by an engine's name, but the geometry stays the file's: right-handed, faces
/// counter-clockwise, in every format that is read.
GenerateOptions inFileCoordinates(GenerateOptions options) {
    for (Convention* convention : {&options.tangents.convention, &options.normals.convention}) {
        convention->handedness = Handedness::right;
        convention->winding = Winding::counterClockwise;
    }
    return options;
}

class FrameComputer {
  public:
    FrameComputer(const VertexPool& pool, std::span<const PrimitiveGeometry> primitives,
                  const GenerateOptions& options, std::span<PrimitiveReport> reports)
        : pool_(pool),
          primitives_(primitives),
          options_(inFileCoordinates(options)),
          reports_(reports),
          generates_normals_(pool.normals.empty()),
          generates_tangents_(options.tangents.method == Method::basis || !pool.uvs.empty()) {}

    Result<PoolFrames> compute() {
        for (std::size_t p = 0; p < primitives_.size(); ++p) {
            if (Result<Done> done = computePrimitive(primitives_[p], reports_[p]); !done) {
                return std::move(done).error();
            }
        }
        return splitPool();
    }

  private:
    /// Frames of one primitive, appended to what the split works on. Polygons are cut after the normals, which want
    /// whole faces, and before the tangents: whoever reads the result sees triangles, and would compute with these.
    Result<Done> computePrimitive(const PrimitiveGeometry& primitive, PrimitiveReport& report) {
        if (Result<Done> valid = validate(viewInPool(pool_, primitive)); !valid) return valid;
        if (primitive.indices.empty()) {
            corner_counts_.push_back(0);
            return Done{};
        }
        LocalMesh mesh = localMesh(primitive);
        std::vector<std::uint32_t> cut_vertices;
        std::vector<Vec3> normals;
        if (generates_normals_) {
            if (Result<Done> done = computeNormals(primitive, mesh, normals, report); !done) return done;
        }
        if (!mesh.face_sizes.empty()) {
            Result<Triangulation> triangles = triangulate(mesh.view());
            if (!triangles) return std::move(triangles).error();
            mesh.own_indices = gather(mesh.indices, triangles->corners);
            mesh.useOwnIndices();
            cut_vertices = gather(spanOf(primitive.indices), triangles->corners);
            normals = gather(std::span<const Vec3>(normals), triangles->corners);
            mesh.face_sizes = {};
        }
        std::vector<Vec4> tangents;
        if (generates_tangents_) {
            if (Result<Done> done = computeTangents(mesh, tangents, report); !done) return done;
        }
        const bool is_cut = !primitive.face_sizes.empty();
        const std::vector<std::uint32_t>& vertices = is_cut ? cut_vertices : primitive.indices;
        report.triangle_count = vertices.size() / 3;
        return append(vertices, std::move(normals), std::move(tangents));
    }

    LocalMesh localMesh(const PrimitiveGeometry& primitive) {
        LocalMesh mesh;
        mesh.face_sizes = primitive.face_sizes;
        if (primitives_.size() > 1 || pool_.positions.size() > primitive.indices.size()) {
            takeUsedPart(primitive, mesh);
            return mesh;
        }
        mesh.positions = pool_.positions;
        mesh.normals = pool_.normals;
        mesh.uvs = pool_.uvs;
        mesh.indices = primitive.indices;
        return mesh;
    }

    /// The used part of the pool, vertices in order of first use.
    void takeUsedPart(const PrimitiveGeometry& primitive, LocalMesh& mesh) {
        local_of_vertex_.resize(pool_.positions.size(), kNoSlot);
        std::vector<std::uint32_t> sources;
        mesh.own_indices.reserve(primitive.indices.size());
        for (const std::uint32_t vertex : primitive.indices) {
            std::uint32_t& local = local_of_vertex_[vertex];
            if (local == kNoSlot) {
                local = static_cast<std::uint32_t>(sources.size());
                sources.push_back(vertex);
            }
            mesh.own_indices.push_back(local);
        }
        for (const std::uint32_t vertex : sources) local_of_vertex_[vertex] = kNoSlot;
        mesh.own_positions = gather(std::span<const Vec3>(pool_.positions), sources);
        mesh.own_normals = gather(std::span<const Vec3>(pool_.normals), sources);
        mesh.own_uvs = gather(std::span<const Vec2>(pool_.uvs), sources);
        mesh.useOwnIndices();
        mesh.useOwnVertices();
    }

    /// Normals per corner, and in the mesh one per vertex: vertices with several normals are split first, so
    /// that a method that works per vertex sees the mesh that will be written.
    Result<Done> computeNormals(const PrimitiveGeometry& primitive, LocalMesh& mesh,
                                std::vector<Vec3>& normals, PrimitiveReport& report) const {
        NormalOptions options = options_.normals;
        options.smoothing_groups = primitive.smoothing_groups;
        normals.resize(mesh.indices.size());
        Result<NormalReport> made = generateNormals(mesh.view(), options, normals);
        if (!made) return std::move(made).error();
        report.normals = *made;
        report.normals_generated = true;

        const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec3>(normals));
        Result<SplitResult> split =
            splitVertices(mesh.view().indices, mesh.positions.size(), mesh.indices.size(), {&attribute, 1},
                          options_.normals.execution);
        if (!split) return std::move(split).error();
        mesh.own_positions = gather(mesh.positions, split->source_vertices);
        mesh.own_uvs = gather(mesh.uvs, split->source_vertices);
        mesh.own_normals = gatherNormals(normals, split->source_corners);
        mesh.own_indices = std::move(split->indices);
        mesh.useOwnIndices();
        mesh.useOwnVertices();
        return Done{};
    }

    Result<Done> computeTangents(const LocalMesh& mesh, std::vector<Vec4>& tangents,
                                 PrimitiveReport& report) const {
        tangents.resize(mesh.indices.size());
        Result<TangentReport> made = generateTangents(mesh.view(), options_.tangents, {.tangents = tangents});
        if (!made) return std::move(made).error();
        report.tangents = *made;
        if (!options_.sanitize) return Done{};
        Result<SanitizeReport> mended = sanitizeTangents(mesh.view(), tangents, options_.sanitize_options);
        if (!mended) return std::move(mended).error();
        report.sanitize = *mended;
        return Done{};
    }

    Result<Done> append(const std::vector<std::uint32_t>& vertices, std::vector<Vec3>&& normals,
                        std::vector<Vec4>&& tangents) {
        if (indices_.size() + vertices.size() > kMaxCorners) {
            return Error{ErrorCode::tooLarge,
                         "the primitives that share these vertices have more than 2^31-1 corners"};
        }
        indices_.insert(indices_.end(), vertices.begin(), vertices.end());
        if (normals_.empty()) {
            normals_ = std::move(normals);
        } else {
            normals_.insert(normals_.end(), normals.begin(), normals.end());
        }
        if (tangents_.empty()) {
            tangents_ = std::move(tangents);
        } else {
            tangents_.insert(tangents_.end(), tangents.begin(), tangents.end());
        }
        corner_counts_.push_back(vertices.size());
        return Done{};
    }

    Result<PoolFrames> splitPool() {
        std::vector<CornerAttribute> attributes;
        if (!normals_.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec3>(normals_)));
        if (!tangents_.empty()) attributes.push_back(cornerAttribute(StridedSpan<const Vec4>(tangents_)));
        Result<SplitResult> split = splitVertices(IndexView(spanOf(indices_)), pool_.positions.size(), indices_.size(),
                                                  attributes, options_.tangents.execution);
        if (!split) return std::move(split).error();

        PoolFrames frames;
        frames.normals_generated = generates_normals_;
        cutIndices(std::move(split->indices), frames);
        if (generates_normals_) frames.normals = gatherNormals(normals_, split->source_corners);
        if (generates_tangents_) writeTangents(*split, frames);
        for (PrimitiveReport& report : reports_) {
            report.vertices_before = pool_.positions.size();
            report.vertices_after = split->vertexCount();
        }
        frames.source_vertices = std::move(split->source_vertices);
        return frames;
    }

    /// To each primitive its own.
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

    void writeTangents(const SplitResult& split, PoolFrames& frames) const {
        const float unused_sign = signFactor(options_.tangents.convention);
        frames.tangents.reserve(split.vertexCount());
        for (std::size_t v = 0; v < split.vertexCount(); ++v) {
            if (const std::uint32_t corner = split.source_corners[v]; corner != kNoCorner) {
                frames.tangents.push_back(tangents_[corner]);
                continue;
            }
            const Vec3 normal = generates_normals_ ? Vec3{0, 0, 1} : pool_.normals[split.source_vertices[v]];
            const Vec3 t = orthonormalize({.tangent = {}, .bitangent = {}, .normal = normal}).tangent;
            frames.tangents.push_back({t.x, t.y, t.z, unused_sign});
        }
    }

    const VertexPool& pool_;
    std::span<const PrimitiveGeometry> primitives_;
    const GenerateOptions options_;
    std::span<PrimitiveReport> reports_;
    bool generates_normals_;
    bool generates_tangents_;
    std::vector<std::uint32_t> local_of_vertex_;  ///< all kNoSlot between primitives

    // All corners of all primitives, what was computed for them, and how many of them each primitive has.
    std::vector<std::uint32_t> indices_;
    std::vector<Vec3> normals_;
    std::vector<Vec4> tangents_;
    std::vector<std::size_t> corner_counts_;
};

Error checkPool(const VertexPool& pool, std::span<const PrimitiveGeometry> primitives,
                std::span<const PrimitiveReport> reports) {
    const std::size_t count = pool.positions.size();
    if (count > kMaxCorners) return {ErrorCode::tooLarge, "more than 2^31-1 vertices"};
    if (reports.size() != primitives.size()) {
        return {ErrorCode::countMismatch, std::to_string(primitives.size()) + " primitives but " +
                                              std::to_string(reports.size()) + " reports"};
    }
    if (!pool.normals.empty() && pool.normals.size() != count) {
        return {ErrorCode::countMismatch, "the pool's normals and positions differ in number"};
    }
    if (!pool.uvs.empty() && pool.uvs.size() != count) {
        return {ErrorCode::countMismatch, "the pool's UVs and positions differ in number"};
    }
    return {ErrorCode::ok, {}};
}

}  // namespace

Result<PoolFrames> computeFrames(const VertexPool& pool, std::span<const PrimitiveGeometry> primitives,
                                 const GenerateOptions& options, std::span<PrimitiveReport> reports) {
    return atBorder([&]() -> Result<PoolFrames> {
        if (Error e = checkPool(pool, primitives, reports); e.code != ErrorCode::ok) return e;
        return FrameComputer(pool, primitives, options, reports).compute();
    });
}

}  // namespace tspace
