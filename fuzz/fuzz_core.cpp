// SPDX-License-Identifier: MIT
// API boundary of the core: any mesh with any options. One thread with scalar code gives the same bits as three threads
// with the best SIMD target, and generate gives the same bits as plan and evaluate. sanitize leaves no invalid tangent.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "byte_reader.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/tangents.h"

namespace {

using namespace tspace;

class Reader : public ByteReader {
  public:
    using ByteReader::ByteReader;

    /// Returns one of few values, so that corners are welded and triangles collapse; sometimes a float with arbitrary
    /// bits.
    float value() {
        const std::uint8_t b = byte();
        return b == 255 ? any() : static_cast<float>(b % 7) - 3;
    }
};

struct Input {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> indices = {}, sizes = {};

    explicit Input(Reader& in) {
        const std::size_t vertex_count = 1 + in.byte() % 48;
        for (std::size_t i = 0; i < vertex_count; ++i) {
            positions.push_back({in.value(), in.value(), in.value()});
            normals.push_back({in.value(), in.value(), in.value()});
            uvs.push_back({in.value(), in.value()});
        }
        const std::size_t face_count = in.byte() % 64;
        for (std::size_t f = 0; f < face_count; ++f) {
            const std::uint8_t kind = in.byte();
            sizes.push_back(kind < 200 ? 3 + kind % 2 : kind % 8);
            for (std::uint32_t k = 0; k < sizes.back(); ++k)
                indices.push_back(in.byte() % static_cast<std::uint32_t>(vertex_count));
        }
    }

    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = std::span<const Vec3>(positions);
        mesh.normals = std::span<const Vec3>(normals);
        mesh.uvs = std::span<const Vec2>(uvs);
        mesh.indices = std::span<const std::uint32_t>(indices);
        mesh.face_sizes = sizes;
        return mesh;
    }
};

/// Separate index lists for normals and UVs, over the faces of the input.
struct Lists {
    std::vector<std::uint8_t> normals = {};
    std::vector<std::uint16_t> uvs = {};

    Lists(const Input& input, Reader& in) {
        for (std::size_t c = 0; c < input.indices.size(); ++c) {
            normals.push_back(static_cast<std::uint8_t>(in.byte() % input.normals.size()));
            uvs.push_back(static_cast<std::uint16_t>(in.byte() % input.uvs.size()));
        }
    }
    [[nodiscard]] MeshView in(MeshView mesh) const {
        mesh.normal_indices = std::span<const std::uint8_t>(normals);
        mesh.uv_indices = std::span<const std::uint16_t>(uvs);
        return mesh;
    }
};

/// All outputs of a call. Any two NaNs count as equal, because the processor chooses which NaN the sum of two NaNs is.
struct Outputs {
    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;

    explicit Outputs(std::size_t count) : tangents(count), bitangents(count) {}
    TangentOutput spans() { return {.tangents = std::span(tangents), .bitangents = std::span(bitangents)}; }

    static bool sameFloat(float a, float b) {
        return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
    }
    bool operator==(const Outputs& o) const {
        for (std::size_t i = 0; i < tangents.size(); ++i) {
            const Vec4 &a = tangents[i], &b = o.tangents[i];
            const Vec3 &c = bitangents[i], &d = o.bitangents[i];
            if (!sameFloat(a.x, b.x) || !sameFloat(a.y, b.y) || !sameFloat(a.z, b.z) || !sameFloat(a.w, b.w))
                return false;
            if (!sameFloat(c.x, d.x) || !sameFloat(c.y, d.y) || !sameFloat(c.z, d.z)) return false;
        }
        return true;
    }
};

void checkTangents(const MeshView& mesh, const TangentOptions& options) {
    Outputs one(mesh.cornerCount()), three(mesh.cornerCount()), evaluated(mesh.cornerCount());
    const Result<TangentReport> done = generateTangents(mesh, options, one.spans(), {.simd = SimdTarget::scalar});
    require(done.ok() || !done.error().message.empty(), "an error has a message");
    if (!done) return;
    require(generateTangents(mesh, options, three.spans(), {.thread_count = 3}).ok(),
            "threads do not decide about success");
    require(one == three, "threads and SIMD change no bit");
    const Result<TangentPlan> plan = planTangents(mesh, options);
    require(plan.ok(), "what can be generated can be planned");
    require(evaluateTangents(*plan, {mesh.positions, mesh.normals}, evaluated.spans()).ok(),
            "a plan fits its own pose");
    require(one == evaluated, "generate gives the bits of plan and evaluate");

    require(sanitizeTangents(mesh, {}, std::span(one.tangents)).ok(), "any tangents can be sanitized");
    std::size_t corner = 0;
    for (const std::uint32_t size : mesh.face_sizes) {
        for (std::uint32_t k = 0; k < size; ++k, ++corner) {
            const Vec4& t = one.tangents[corner];
            if (size < 3) continue;
            require(std::fabs(std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z) - 1) < 1e-3f, "a sanitized tangent is unit");
            require(t.w == 1 || t.w == -1, "a sanitized sign is +1 or -1");
        }
    }
    const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec4>(std::span<const Vec4>(one.tangents)));
    require(splitVertices(mesh.indices, mesh.vertexCount(), mesh.cornerCount(), {&attribute, 1}).ok(),
            "results can be split");
}

void checkIndexedFrames(const MeshView& mesh, const TangentOptions& tangents, const NormalOptions& normals,
                        bool make_normals) {
    const Result<IndexedFrames> frames =
        makeIndexedFrames(mesh, {.tangents = tangents, .normals = normals, .make_normals = make_normals});
    if (!frames) return require(!frames.error().message.empty(), "an error has a message");
    require(frames->indices.size() == mesh.cornerCount(), "every corner has a vertex");
    for (const std::uint32_t vertex : frames->indices)
        require(vertex < frames->vertexCount(), "no index is out of range");
    for (const std::uint32_t vertex : frames->source_vertices)
        require(vertex < mesh.vertexCount(), "every vertex has a source");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Reader in(data, size);
    TangentOptions options{.convention = conventions::opengl};
    options.method = static_cast<Method>(in.byte() % 10);
    options.pairing = static_cast<Pairing>(in.byte() % 2);
    options.ngons = static_cast<Ngons>(in.byte() % 2);
    const std::uint8_t threshold = in.byte();
    options.angular_threshold_deg = threshold == 255 ? in.any() : static_cast<float>(threshold) * 1.5f;
    NormalOptions normals;
    normals.weighting = static_cast<NormalWeighting>(in.byte() % 8);
    normals.crease_angle_deg = static_cast<float>(in.byte());
    const Input input(in);
    const MeshView mesh = input.view();
    checkTangents(mesh, options);
    std::vector<Vec3> result(mesh.cornerCount());
    (void)generateNormals(mesh, normals, std::span(result));
    (void)triangulate(mesh);
    checkIndexedFrames(mesh, options, normals, size % 2 != 0);
    const Lists lists(input, in);
    checkTangents(lists.in(mesh), options);
    checkIndexedFrames(lists.in(mesh), options, normals, size % 2 != 0);
    return 0;
}
