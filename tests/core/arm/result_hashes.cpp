// SPDX-License-Identifier: MIT
// result_hashes scalar|sse2|neon|best: computes everything that has CPU-specific kernels, for meshes generated from
// integers, and prints a hash per kind of result. The output must be the same on all CPUs. All NaNs count as equal.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/simd/dispatch.h"
#include "tspace/tspace.hpp"

namespace tspace {
namespace {

class Hash {
  public:
    void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
    void add(float x) { add(x == x ? std::bit_cast<std::uint32_t>(x) : 0x7fc00000u); }
    void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
    void add(const Vec4& v) { add(xyz(v)), add(v.w); }
    template <class Element>
    void add(const std::vector<Element>& list) {
        for (const Element& element : list) add(element);
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

struct Mesh {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> indices, face_sizes;

    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.uvs = uvs;
        mesh.indices = IndexView(std::span(indices));
        mesh.face_sizes = face_sizes;
        return mesh;
    }
};

/// Generates meshes with integers only, because their results are defined by the C++ standard, and without functions of
/// the C library.
class Maker {
  public:
    explicit Maker(std::uint32_t seed) : random_(seed) {}

    /// Returns a mesh of few vertices with many faces, so that there are welded corners, edges with many faces, and
    /// faces without area.
    Mesh soup() {
        Mesh mesh;
        const std::uint32_t count = 3 + below(12), most_corners = 1 + below(3), faces = 1 + below(40);
        for (std::uint32_t v = 0; v < count; ++v) {
            mesh.positions.push_back({step(9), step(9), step(9)});
            mesh.normals.push_back({step(5) - 0.5f, step(5) - 0.5f, 1});
            mesh.uvs.push_back({step(5), step(5)});
        }
        for (std::uint32_t f = 0; f < faces; ++f) {
            mesh.face_sizes.push_back(3 + below(most_corners));
            for (std::uint32_t k = 0; k < mesh.face_sizes.back(); ++k) mesh.indices.push_back(below(count));
        }
        return mesh;
    }

    /// Returns a rough sheet of triangles and quads that is mirrored in bands. Its normals do not have unit length.
    Mesh sheet() {
        Mesh mesh;
        const std::uint32_t columns = 2 + below(14), rows = 1 + below(14), band = 1 + below(columns);
        for (std::uint32_t y = 0; y <= rows; ++y) {
            for (std::uint32_t x = 0; x <= columns; ++x) {
                const std::uint32_t along = x % (2 * band);
                mesh.positions.push_back({static_cast<float>(x) + noise(), static_cast<float>(y) + noise(), noise()});
                mesh.normals.push_back({noise(), noise(), 1 + noise()});
                mesh.uvs.push_back({0.1f * static_cast<float>(std::min(along, 2 * band - along)),
                                    0.1f * static_cast<float>(y) + 0.1f * noise()});
            }
        }
        for (std::uint32_t y = 0; y < rows; ++y) {
            for (std::uint32_t x = 0; x < columns; ++x) {
                const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = b + columns + 1, d = c - 1;
                const bool is_quad = below(4) == 0;
                mesh.face_sizes.insert(mesh.face_sizes.end(), is_quad ? 1 : 2, is_quad ? 4 : 3);
                if (is_quad) {
                    mesh.indices.insert(mesh.indices.end(), {a, b, c, d});
                } else {
                    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
                }
            }
        }
        return mesh;
    }

    void breakSome(Mesh& mesh) {
        constexpr float kBroken[] = {std::numeric_limits<float>::quiet_NaN(),
                                     std::numeric_limits<float>::infinity(),
                                     -3e38f,
                                     1e-45f,
                                     1e-30f,
                                     -0.0f};
        for (std::size_t v = 0; v < mesh.positions.size(); v += 1 + below(40)) {
            float* const numbers[] = {&mesh.positions[v].x, &mesh.positions[v].z, &mesh.normals[v].y, &mesh.uvs[v].x};
            *numbers[below(4)] = kBroken[below(6)];
        }
    }

  private:
    std::uint32_t below(std::uint32_t most) { return static_cast<std::uint32_t>(random_()) % most; }
    float step(std::uint32_t most) { return 0.25f * static_cast<float>(below(most)); }
    float noise() { return static_cast<float>(below(1u << 20)) / (1u << 21) - 0.25f; }

    std::mt19937 random_;
};

std::vector<Mesh> meshes() {
    std::vector<Mesh> list;
    for (std::uint32_t seed = 0; seed < 600; ++seed) {
        Maker maker(seed);
        list.push_back(seed % 2 == 0 ? maker.soup() : maker.sheet());
        if (seed % 5 == 0) maker.breakSome(list.back());
    }
    return list;
}

struct Results {
    std::map<std::string, Hash> hashes = {};
    bool all_worked = true;
};

/// Adds hashes of all outputs of a method, of the sanitized tangents, and of the evaluation of a plan.
void addTangents(const Mesh& mesh, Method method, const Execution& execution, Results& results) {
    const MeshView view = mesh.view();
    const std::size_t count = view.cornerCount();
    std::vector<Vec4> tangents(count);
    std::vector<Vec3> bitangents(count);
    std::vector<float> magnitudes_s(count), magnitudes_t(count);
    const TangentOutput out{tangents, bitangents, magnitudes_s, magnitudes_t};
    TangentOptions options{.convention = conventions::opengl};
    options.method = method;
    const std::string name = methodName(method);
    const auto addOutputs = [&](const std::string& way) {
        Hash& hash = results.hashes[name + " " + way];
        hash.add(tangents), hash.add(bitangents), hash.add(magnitudes_s), hash.add(magnitudes_t);
    };
    results.all_worked &= generateTangents(view, options, out, execution).ok();
    addOutputs("all");
    const auto plan = planTangents(view, options, execution);
    results.all_worked &= plan && evaluateTangents(*plan, {view.positions, view.normals}, out).ok();
    addOutputs("evaluated");
    results.all_worked &= generateTangents(view, options, {.tangents = tangents}, execution).ok();
    results.hashes[name + " tangents"].add(tangents);
    results.all_worked &= sanitizeTangents(view, {}, tangents, execution).ok();
    results.hashes[name + " sanitized"].add(tangents);
}

void addNormals(const Mesh& mesh, NormalWeighting weighting, const Execution& execution, Results& results) {
    std::vector<Vec3> normals(mesh.indices.size());
    results.all_worked &= generateNormals(mesh.view(), {.weighting = weighting}, normals, execution).ok();
    results.hashes["normals " + std::to_string(static_cast<unsigned>(weighting))].add(normals);
}

/// Adds the hash of packed frames that are built from the positions of a rough mesh. Most of these frames are invalid
/// and are repaired first.
void addPacked(const Mesh& mesh, FrameFormat format, Results& results) {
    const std::size_t count = mesh.normals.size();
    std::vector<Vec4> tangents;
    for (const Vec3& p : mesh.positions) tangents.push_back({p.y, p.z, p.x, p.x < p.y ? -1.0f : 1.0f});
    std::vector<std::byte> bytes(count * frameBytes(format));
    results.all_worked &= packFrames(mesh.normals, tangents, format, bytes).ok();
    std::vector<Vec3> normals(count);
    results.all_worked &= unpackFrames(bytes, format, normals, tangents).ok();
    Hash& hash = results.hashes["packed " + std::to_string(static_cast<unsigned>(format))];
    for (const std::byte byte : bytes) hash.add(std::to_integer<std::uint32_t>(byte));
    hash.add(normals), hash.add(tangents);
}

bool print(SimdTarget target) {
    Results results;
    Execution execution;
    execution.thread_count = 1;
    execution.simd = target;
    for (const Mesh& mesh : meshes()) {
        for (auto m = static_cast<std::uint32_t>(Method::mikktspace); m <= static_cast<std::uint32_t>(Method::best);
             ++m)
            addTangents(mesh, Method{m}, execution, results);
        for (auto w = static_cast<std::uint32_t>(NormalWeighting::flat);
             w <= static_cast<std::uint32_t>(NormalWeighting::best); ++w)
            addNormals(mesh, NormalWeighting{w}, execution, results);
        for (auto f = static_cast<std::uint32_t>(FrameFormat::frame32);
             f <= static_cast<std::uint32_t>(FrameFormat::gltfSnorm16); ++f)
            addPacked(mesh, FrameFormat{f}, results);
    }
    for (const auto& [name, hash] : results.hashes)
        std::printf("%-22s %016llx\n", name.c_str(), static_cast<unsigned long long>(hash.value()));
    return results.all_worked;
}

}  // namespace
}  // namespace tspace

int main(int argument_count, char** arguments) {
    using tspace::SimdTarget;
    const std::map<std::string, SimdTarget> targets = {{"scalar", SimdTarget::scalar},
                                                       {"sse2", SimdTarget::sse2},
                                                       {"neon", SimdTarget::neon},
                                                       {"best", SimdTarget::best}};
    const auto target = targets.find(argument_count == 2 ? arguments[1] : "");
    if (target == targets.end()) {
        std::fputs("usage: result_hashes scalar|sse2|neon|best\n", stderr);
        return 2;
    }
    if (target->second != SimdTarget::best && tspace::simd::resolve(target->second) != target->second) {
        std::fprintf(stderr, "this CPU or this build has no %s\n", arguments[1]);
        return 1;
    }
    return tspace::print(target->second) ? 0 : 1;
}
