// SPDX-License-Identifier: MIT
// makeIndexedFrames: computes normals and tangents, sanitizes the tangents, and splits vertices, in this order.
#include "tspace/indexed_frames.h"

#include <utility>

#include "core/base/border.h"
#include "core/base/parallel.h"
#include "core/base/unit_normals.h"
#include "core/base/weld.h"
#include "core/frames/one_list.h"
#include "tspace/frame.h"

namespace tspace {
namespace {

class FramesMaker {
  public:
    FramesMaker(const MeshView& mesh, const IndexedFramesOptions& options, const Execution& execution)
        : mesh_(mesh), options_(options), execution_(execution) {}

    Result<IndexedFrames> make() {
        if (options_.tangents.domain != OutputDomain::corner) {
            return Error{ErrorCode::invalidOption,
                         "frames of an indexed mesh can only be computed per corner; set domain to corner"};
        }
        if (Result<Done> valid = validate(mesh_); !valid) return std::move(valid).error();
        const bool keeps_places = mesh_.indices.type != IndexType::none && !mesh_.hasOwnLists();
        if (mesh_.normals.empty() || options_.make_normals) {
            if (Result<Done> done = makeNormals(); !done) return std::move(done).error();
        }
        Parallel parallel(execution_, mesh_.normals.count);
        const UnitNormals normals(mesh_.normals, options_.tangents.normalize_normals, execution_.allocator, parallel);
        mesh_.normals = normals.view();
        if (!keeps_places || mesh_.hasOwnLists() || !options_.keep_apart.empty()) {
            if (Result<Done> done = useOneList(mesh_, execution_, one_list_, weld(), options_.keep_apart); !done)
                return std::move(done).error();
            mesh_ = one_list_.view;
        }
        if (Result<Done> done = makeTangents(); !done) return std::move(done).error();
        if (Result<Done> done = split(); !done) return std::move(done).error();
        if (!keeps_places) numberByFirstUse();
        gather();
        return std::move(frames_);
    }

  private:
    Result<Done> makeNormals() {
        NormalOptions options = options_.normals;
        options.convention = options_.tangents.convention;
        corner_normals_.resize(mesh_.cornerCount());
        Result<NormalReport> made = generateNormals(mesh_, options, corner_normals_, execution_);
        if (!made) return std::move(made).error();
        frames_.report.normals = *made;
        frames_.report.normals_made = true;
        mesh_.normals = corner_normals_;
        mesh_.normal_indices = {nullptr, 0, IndexType::corners};
        return Done{};
    }

    /// Returns, for a mesh without indices, the first vertex at the position of each vertex; otherwise empty.
    std::span<const std::uint32_t> weld() {
        if (mesh_.indices.type != IndexType::none) return {};
        Parallel parallel(execution_, mesh_.cornerCount());
        const Buffer<std::uint32_t> points = weldPositions(mesh_, execution_.allocator, parallel);
        points_.assign(points.begin(), points.end());
        return points_;
    }

    Result<Done> makeTangents() {
        tangents_.resize(mesh_.cornerCount());
        TangentOptions options = options_.tangents;
        options.normalize_normals = false;  // the normals of mesh_ are already normalized
        Result<TangentReport> made = generateTangents(mesh_, options, {.tangents = tangents_}, execution_);
        if (!made) return std::move(made).error();
        frames_.report.tangents = *made;
        if (!options_.sanitize) return Done{};
        Result<SanitizeReport> repaired = sanitizeTangents(mesh_, {options_.orthogonalize_all}, tangents_, execution_);
        if (!repaired) return std::move(repaired).error();
        frames_.report.sanitize = *repaired;
        return Done{};
    }

    Result<Done> split() {
        const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec4>(tangents_));
        Result<SplitResult> made =
            splitVertices(mesh_.indices, mesh_.vertexCount(), tangents_.size(), {&attribute, 1}, execution_);
        if (!made) return std::move(made).error();
        frames_.indices = std::move(made->indices);
        frames_.source_vertices = std::move(made->source_vertices);
        frames_.source_corners = std::move(made->source_corners);
        return Done{};
    }

    /// Renumbers vertices by first use; removes unused ones.
    void numberByFirstUse() {
        std::vector<std::uint32_t> number(frames_.vertexCount(), kNoCorner), vertices, corners;
        for (std::uint32_t& vertex : frames_.indices) {
            if (number[vertex] == kNoCorner) {
                number[vertex] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(frames_.source_vertices[vertex]);
                corners.push_back(frames_.source_corners[vertex]);
            }
            vertex = number[vertex];
        }
        frames_.source_vertices = std::move(vertices);
        frames_.source_corners = std::move(corners);
    }

    void gather() {
        frames_.normals.resize(frames_.vertexCount());
        frames_.tangents.resize(frames_.vertexCount());
        for (std::size_t v = 0; v < frames_.vertexCount(); ++v) {
            const std::uint32_t corner = frames_.source_corners[v];
            std::uint32_t& vertex = frames_.source_vertices[v];
            frames_.normals[v] = mesh_.normals[vertex];
            if (corner == kNoCorner) {
                if (frames_.report.normals_made) frames_.normals[v] = {0, 0, 1};
                frames_.tangents[v] = anyTangent(frames_.normals[v]);
            } else {
                frames_.tangents[v] = tangents_[corner];
            }
            if (!one_list_.source_vertices.empty()) vertex = one_list_.source_vertices[vertex];
        }
    }

    /// Returns the tangent of an arbitrary orthonormal frame, for an unused vertex.
    [[nodiscard]] Vec4 anyTangent(const Vec3& normal) const {
        const Vec3 t = orthonormalize({.tangent = {}, .bitangent = {}, .normal = normal}).tangent;
        return {t.x, t.y, t.z, signFactor(options_.tangents.convention)};
    }

    MeshView mesh_;  ///< the input mesh, first as given, then with generated normals, then with one index list
    const IndexedFramesOptions& options_;
    const Execution& execution_;
    std::vector<Vec3> corner_normals_;
    std::vector<std::uint32_t> points_;
    OneListMesh one_list_;
    std::vector<Vec4> tangents_;
    IndexedFrames frames_;
};

}  // namespace

Result<IndexedFrames> makeIndexedFrames(const MeshView& mesh, const IndexedFramesOptions& options,
                                        const Execution& execution) {
    return atBorder([&] { return FramesMaker(mesh, options, execution).make(); });
}

}  // namespace tspace
