// SPDX-License-Identifier: MIT
// Correctness checks of everything that is timed.
// All jobs: the results have the same bits with 1, 2 and 3 threads, even if the outputs contain garbage before the
// call.
// mikktspace: the results have the same bits as those of the reference's interface, which reads and welds corner by
// corner, and equal recorded results of the reference itself.
// evaluate: the results equal those of mikktspace.
// lengyel: the directions agree with those of the plain loop.
// split: every corner has a vertex with the source vertex and the tangent of the corner.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "job.h"
#include "plain_loop.h"
#include "reference_results.h"
#include "tspace/compat/mikktspace.h"

namespace tspace::bench {

namespace {

template <class T>
void fillWithGarbage(std::vector<T>& values) {
    if (!values.empty()) std::memset(static_cast<void*>(values.data()), 0x7d, values.size() * sizeof(T));
}

std::uint64_t hashWithThreads(const Job& job, unsigned threads, bool keep_tangents) {
    if (!keep_tangents) fillWithGarbage(job.outputs->tangents);
    fillWithGarbage(job.outputs->bitangents);
    fillWithGarbage(job.outputs->normals);
    fillWithGarbage(job.outputs->magnitudes_s);
    fillWithGarbage(job.outputs->magnitudes_t);
    job.outputs->split = {};
    job.call({.thread_count = threads});
    return hashOf(*job.outputs);
}

/// Data for the callbacks of the reference's interface, corner by corner.
struct Callbacks {
    const Mesh* mesh;
    std::vector<std::size_t> first_corners;
    Outputs outputs;

    static Callbacks& of(const SMikkTSpaceContext* context) { return *static_cast<Callbacks*>(context->m_pUserData); }
    [[nodiscard]] std::size_t corner(int face, int local) const {
        return first_corners[static_cast<std::size_t>(face)] + static_cast<std::size_t>(local);
    }
    [[nodiscard]] std::size_t vertex(int face, int local) const { return mesh->view().indices[corner(face, local)]; }
};

std::uint64_t hashThroughCallbacks(const Mesh& mesh) {
    Callbacks data{&mesh, {0}, {}};
    const std::size_t faces = mesh.view().faceCount();
    for (std::size_t f = 0; f < faces; ++f) {
        data.first_corners.push_back(data.first_corners.back() +
                                     (mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[f]));
    }
    data.outputs.tangents.resize(mesh.cornerCount());
    SMikkTSpaceInterface calls = {};
    calls.m_getNumFaces = [](const SMikkTSpaceContext* c) {
        return static_cast<int>(Callbacks::of(c).first_corners.size() - 1);
    };
    calls.m_getNumVerticesOfFace = [](const SMikkTSpaceContext* c, const int face) {
        return static_cast<int>(Callbacks::of(c).corner(face + 1, 0) - Callbacks::of(c).corner(face, 0));
    };
    calls.m_getPosition = [](const SMikkTSpaceContext* c, float out[], const int face, const int local) {
        std::memcpy(out, &Callbacks::of(c).mesh->positions[Callbacks::of(c).vertex(face, local)], sizeof(Vec3));
    };
    calls.m_getNormal = [](const SMikkTSpaceContext* c, float out[], const int face, const int local) {
        std::memcpy(out, &Callbacks::of(c).mesh->normals[Callbacks::of(c).vertex(face, local)], sizeof(Vec3));
    };
    calls.m_getTexCoord = [](const SMikkTSpaceContext* c, float out[], const int face, const int local) {
        std::memcpy(out, &Callbacks::of(c).mesh->uvs[Callbacks::of(c).vertex(face, local)], sizeof(Vec2));
    };
    calls.m_setTSpaceBasic = [](const SMikkTSpaceContext* c, const float tangent[], const float sign, const int face,
                                const int local) {
        Callbacks::of(c).outputs.tangents[Callbacks::of(c).corner(face, local)] = {tangent[0], tangent[1], tangent[2],
                                                                                   sign};
    };
    const SMikkTSpaceContext context = {&calls, &data};
    return genTangSpaceDefault(&context) ? hashOf(data.outputs) : 0;
}

std::string mikktspaceError(const Mesh& mesh, const Outputs& outputs) {
    // The reference's interface ignores faces with more than four corners.
    const bool has_polygons = std::ranges::any_of(mesh.face_sizes, [](std::uint32_t n) { return n > 4; });
    if (!has_polygons && hashThroughCallbacks(mesh) != hashOf(outputs)) {
        return "the reference's interface gives other bits";
    }
    const std::uint64_t expected = referenceResult(hashOf(mesh));
    if (expected != 0 && expected != hashOf(outputs)) return "the reference gave other bits";
    return {};
}

std::string lengyelError(const Mesh& mesh, const Outputs& outputs) {
    constexpr float kNear = 0.9998f;  // cosine of about one degree
    // If UVs are nearly degenerate, different rounding may rotate a tangent: this is accepted at one of this many
    // corners.
    constexpr std::size_t kOneInSoMany = 50;
    const Mesh triangles = mesh.triangulated();
    std::vector<Vec4> expected(mesh.positions.size());
    plainLoop(triangles, expected);
    const bool per_vertex = outputs.tangents.size() != mesh.cornerCount();
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < mesh.cornerCount(); ++c) {
        const std::uint32_t v = mesh.view().indices[c];
        const Vec4 &a = outputs.tangents[per_vertex ? v : c], &b = expected[v];
        if (!(a.x * b.x + a.y * b.y + a.z * b.z > kNear && a.w == b.w)) ++wrong;
    }
    return wrong * kOneInSoMany > mesh.cornerCount() ? std::to_string(wrong) + " corners differ from the plain loop"
                                                     : std::string();
}

std::string splitError(const Mesh& mesh, const Outputs& outputs) {
    const SplitResult& split = outputs.split;
    for (std::size_t c = 0; c < mesh.cornerCount(); ++c) {
        const std::uint32_t v = split.indices[c];
        if (split.source_vertices[v] != mesh.view().indices[c]) return "a corner lost its vertex";
        if (std::memcmp(&outputs.tangents[split.source_corners[v]], &outputs.tangents[c], sizeof(Vec4)) != 0) {
            return "a corner lost its tangent";
        }
    }
    return {};
}

}  // namespace

std::string findError(const std::string& job_name, const Mesh& mesh) {
    const Job job = makeJob(job_name, mesh);
    const std::uint64_t expected = hashWithThreads(job, 1, job_name == "split");
    for (const unsigned threads : {2u, 3u}) {
        if (hashWithThreads(job, threads, job_name == "split") != expected) {
            return "other bits with " + std::to_string(threads) + " threads";
        }
    }
    for (const char* target : {"scalar", "sse2", "avx2", "avx512", "neon"}) {
        Execution execution{.thread_count = 1};
        if (!forceSimd(execution, target)) continue;
        if (job_name != "split") fillWithGarbage(job.outputs->tangents);
        job.call(execution);
        if (hashOf(*job.outputs) != expected) return std::string("other bits with ") + target;
    }
    if (job_name == "mikktspace") return mikktspaceError(mesh, *job.outputs);
    if (job_name.starts_with("lengyel")) return lengyelError(mesh, *job.outputs);
    if (job_name == "split") return splitError(mesh, *job.outputs);
    if (job_name == "evaluate" || job_name == "mikktspace_all") {
        const Job whole = makeJob("mikktspace", mesh);
        whole.call({});
        Outputs tangents{.tangents = job.outputs->tangents};
        if (hashOf(tangents) != hashOf(*whole.outputs)) return "other tangents than mikktspace";
    }
    return {};
}

}  // namespace tspace::bench
