// SPDX-License-Identifier: MIT
// One factory for each kind of call.
#include "job.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace tspace::bench {

namespace {

template <class T>
T orDie(Result<T> result) {
    if (!result) {
        std::fprintf(stderr, "bench: a call failed: %s\n", result.error().message.c_str());
        std::exit(1);
    }
    return *std::move(result);
}

/// Updates the hash by multiplying and rotating 32-bit words. The result depends on their order.
template <class T>
void mix(std::uint64_t& hash, const std::vector<T>& values) {
    static_assert(sizeof(T) % 4 == 0);
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); i += 4) {
        std::uint32_t word;
        std::memcpy(&word, bytes + i, 4);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    hash += values.size();
}

constexpr struct {
    const char* name;
    Method method;
} kMethods[] = {{"mikktspace", Method::mikktspace},
                {"uniform", Method::uniform},
                {"angle", Method::angle},
                {"area", Method::area},
                {"lengyel", Method::lengyel},
                {"flat", Method::flat},
                {"basis", Method::basis},
                {"fast", Method::fast},
                {"best", Method::best}};

Job tangentsJob(const Mesh& mesh, const TangentOptions& options) {
    auto outputs = std::make_shared<Outputs>();
    outputs->tangents.resize(mesh.cornerCount());
    return {outputs, [&mesh, outputs, options](const Execution& execution) {
                orDie(generateTangents(mesh.view(), options, {.tangents = outputs->tangents}, execution));
            }};
}

Job allFieldsJob(const Mesh& mesh) {
    auto outputs = std::make_shared<Outputs>();
    outputs->tangents.resize(mesh.cornerCount());
    outputs->bitangents.resize(mesh.cornerCount());
    outputs->magnitudes_s.resize(mesh.cornerCount());
    outputs->magnitudes_t.resize(mesh.cornerCount());
    return {outputs, [&mesh, outputs](const Execution& execution) {
                orDie(generateTangents(
                    mesh.view(), {.convention = conventions::opengl},
                    {outputs->tangents, outputs->bitangents, outputs->magnitudes_s, outputs->magnitudes_t}, execution));
            }};
}

Job evaluateJob(const Mesh& mesh, const TangentOptions& options) {
    auto outputs = std::make_shared<Outputs>();
    auto plan = std::make_shared<TangentPlan>(orDie(planTangents(mesh.view(), options)));
    outputs->tangents.resize(plan->outputCount());
    return {
        outputs, [&mesh, outputs, plan](const Execution& execution) {
            orDie(evaluateTangents(*plan, {mesh.positions, mesh.normals}, {.tangents = outputs->tangents}, execution));
        }};
}

/// Requests results per vertex, if the library supports that.
template <class Options>
bool askForVertexDomain(Options& options) {
    if constexpr (requires { options.domain; }) {
        options.domain = decltype(options.domain)::vertex;
        return true;
    }
    return false;
}

Job lengyelVertexJob(const Mesh& mesh) {
    TangentOptions options{.method = Method::lengyel, .convention = conventions::opengl};
    if (!askForVertexDomain(options)) return {};
    Job job = tangentsJob(mesh, options);
    job.outputs->tangents.resize(mesh.positions.size());
    return job;
}

Job normalsJob(const Mesh& mesh, NormalWeighting weighting = NormalWeighting::angle, float crease_deg = 180) {
    auto outputs = std::make_shared<Outputs>();
    outputs->normals.resize(mesh.cornerCount());
    return {outputs, [=, &mesh](const Execution& execution) {
                orDie(generateNormals(mesh.view(), {.weighting = weighting, .crease_angle_deg = crease_deg},
                                      outputs->normals, execution));
            }};
}

/// Splits vertices with the threads of `execution`, if the library supports that.
template <class Run>
Result<SplitResult> split(const Mesh& mesh, const Outputs& outputs, const Run& execution) {
    const CornerAttribute attributes[] = {cornerAttribute(outputs.tangents)};
    const std::span<const CornerAttribute> all(attributes);
    const MeshView view = mesh.view();
    if constexpr (requires { splitVertices(view.indices, 0, 0, all, execution); }) {
        return splitVertices(view.indices, view.vertexCount(), view.cornerCount(), all, execution);
    } else {
        return splitVertices(view.indices, view.vertexCount(), view.cornerCount(), all);
    }
}

Job splitJob(const Mesh& mesh) {
    const Job tangents = tangentsJob(mesh, {.convention = conventions::opengl});
    tangents.call({});
    auto outputs = tangents.outputs;
    return {outputs,
            [&mesh, outputs](const Execution& execution) { outputs->split = orDie(split(mesh, *outputs, execution)); }};
}

}  // namespace

std::uint64_t hashOf(const Outputs& outputs) {
    std::uint64_t hash = 0;
    mix(hash, outputs.tangents);
    mix(hash, outputs.bitangents);
    mix(hash, outputs.normals);
    mix(hash, outputs.magnitudes_s);
    mix(hash, outputs.magnitudes_t);
    mix(hash, outputs.split.indices);
    mix(hash, outputs.split.source_vertices);
    mix(hash, outputs.split.source_corners);
    return hash;
}

std::uint64_t hashOf(const Mesh& mesh) {
    std::uint64_t hash = mesh.face_size;
    mix(hash, mesh.positions);
    mix(hash, mesh.normals);
    mix(hash, mesh.uvs);
    mix(hash, mesh.indices);
    mix(hash, mesh.face_sizes);
    return hash;
}

Job makeJob(const std::string& name, const Mesh& mesh) {
    if (name == "normals_flat") return normalsJob(mesh, NormalWeighting::flat);
    if (name == "normals_crease") return normalsJob(mesh, NormalWeighting::angle, 30);
    if (name == "mikktspace_all") return allFieldsJob(mesh);
    if (name == "mikktspace_corrected")
        return tangentsJob(mesh, {.convention = conventions::opengl, .pairing = Pairing::corrected});
    if (name == "evaluate") return evaluateJob(mesh, {.convention = conventions::opengl});
    if (name == "evaluate_lengyel") {
        const TangentOptions options{
            .method = Method::lengyel, .convention = conventions::opengl, .domain = OutputDomain::vertex};
        return evaluateJob(mesh, options);
    }
    if (name == "lengyel_vertex") return lengyelVertexJob(mesh);
    if (name == "normals") return normalsJob(mesh);
    if (name == "normals_best") return normalsJob(mesh, NormalWeighting::best);
    if (name == "split") return splitJob(mesh);
    for (const auto& method : kMethods) {
        if (name == method.name) return tangentsJob(mesh, {.method = method.method, .convention = conventions::opengl});
    }
    std::fprintf(stderr, "bench: there is no job %s\n", name.c_str());
    std::exit(1);
}

const std::vector<std::string>& jobNames() {
    static const std::vector<std::string> names = {"mikktspace",   "mikktspace_all", "mikktspace_corrected",
                                                   "evaluate",     "uniform",        "angle",
                                                   "area",         "lengyel",        "lengyel_vertex",
                                                   "flat",         "basis",          "normals",
                                                   "split",        "fast",           "best",
                                                   "normals_best", "normals_crease", "normals_flat"};
    return names;
}

}  // namespace tspace::bench
