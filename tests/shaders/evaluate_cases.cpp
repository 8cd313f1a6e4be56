// SPDX-License-Identifier: MIT
#include "evaluate_cases.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "core/estimate/pose_normals.h"
#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"
#include "support/shared_data.h"
#include "tspace/indexed_frames.h"

namespace tspace::shaders {

namespace {

bool isFinite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::vector<std::uint32_t> wordsOf(std::span<const Vec3> vectors) {
    std::vector<std::uint32_t> words;
    for (const Vec3& v : vectors) {
        for (const float x : {v.x, v.y, v.z}) words.push_back(std::bit_cast<std::uint32_t>(x));
    }
    if (words.empty()) words.push_back(0);
    return words;
}

Vec3 vectorAt(const std::vector<std::uint32_t>& words, std::size_t at) {
    const auto number = [&](std::size_t i) { return std::bit_cast<float>(words[at + i]); };
    return {number(0), number(1), number(2)};
}

/// Returns positions rotated about y by an angle that grows with x, plus a wave, so that all triangles change their
/// shape.
std::vector<Vec3> bent(const std::vector<Vec3>& positions) {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    for (const Vec3& p : positions) {
        if (!isFinite(p) || std::fabs(p.x) > 1e6f) continue;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-6f});
    std::vector<Vec3> result;
    for (const Vec3& p : positions) {
        const float angle = 0.7f * (p.x - low.x) / size, c = std::cos(angle), s = std::sin(angle);
        result.push_back({c * p.x - s * p.z, p.y + 0.05f * size * std::sin(9 * p.x / size), s * p.x + c * p.z});
    }
    return result;
}

/// Returns a closed torus with UV seams and unit normals.
test::SimpleMesh torus(std::uint32_t rings, std::uint32_t sides) {
    test::SimpleMesh mesh;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        for (std::uint32_t j = 0; j <= sides; ++j) {
            const double a = 2 * std::numbers::pi * (i % rings) / rings, b = 2 * std::numbers::pi * (j % sides) / sides;
            const auto f = [](double x) { return static_cast<float>(x); };
            mesh.addVertex({f((2 + std::cos(b)) * std::cos(a)), f((2 + std::cos(b)) * std::sin(a)), f(std::sin(b))},
                           {f(std::cos(b) * std::cos(a)), f(std::cos(b) * std::sin(a)), f(std::sin(b))},
                           {f(double{1} * i / rings), f(double{1} * j / sides)});
        }
    }
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t a = i * (sides + 1) + j, b = a + sides + 1;
            mesh.addTriangle(a, b, b + 1);
            mesh.addTriangle(a, b + 1, a + 1);
        }
    }
    return mesh;
}

}  // namespace

PosedMesh withBentPose(std::string name, test::SimpleMesh mesh, float threshold_deg) {
    PosedMesh made{std::move(name), std::move(mesh), threshold_deg, {}};
    made.poses = {made.mesh.positions, bent(made.mesh.positions)};
    return made;
}

std::vector<PosedMesh> generatedMeshes() {
    std::vector<PosedMesh> meshes;
    meshes.push_back(withBentPose("grid", test::grid(24)));
    meshes.push_back(withBentPose("torus", torus(40, 20)));
    meshes.push_back(withBentPose("fan", test::fan(60)));
    meshes.push_back(withBentPose("unrolled fan", test::unrolledFan(50)));
    meshes.push_back(withBentPose("cone", test::cone(40)));
    test::SimpleMesh mirrored = test::grid(16);
    for (Vec2& uv : mirrored.uvs) uv.x = std::fabs(uv.x - 0.5f);
    meshes.push_back(withBentPose("mirrored", mirrored));
    test::SimpleMesh sheared = test::grid(10);  // UV areas are nearly lost in rounding, or lost
    for (Vec2& uv : sheared.uvs) uv.y = 0.37f * uv.x + 2e-7f * uv.y;
    for (std::size_t i = 0; i + 1 < sheared.indices.size(); i += 41) sheared.indices[i] = sheared.indices[i + 1];
    meshes.push_back(withBentPose("sheared", sheared));
    meshes.back().collapses = true;
    test::SimpleMesh collapsed = test::grid(12);
    for (std::size_t v = 0; v < collapsed.uvs.size(); v += 7) collapsed.uvs[v] = {0.5f, 0.5f};
    for (std::size_t i = 0; i + 1 < collapsed.indices.size(); i += 31) collapsed.indices[i] = collapsed.indices[i + 1];
    meshes.push_back(withBentPose("degenerate", collapsed));
    PosedMesh moving = withBentPose("folding", test::grid(10));
    for (std::size_t v = 0; v < moving.poses[1].size(); v += 5) moving.poses[1][v] = moving.poses[1][v / 2];
    meshes.push_back(moving);
    meshes.back().collapses = meshes[meshes.size() - 2].collapses = true;
    PosedMesh huge = withBentPose("huge", test::grid(10));
    huge.poses[1][40].x = std::numeric_limits<float>::quiet_NaN();
    huge.poses[1][80].y = std::numeric_limits<float>::infinity();
    huge.poses.push_back(huge.mesh.positions);
    for (Vec3& p : huge.poses.back()) p = {1e15f * p.x, 1e15f * p.y, 1e15f * p.z};
    huge.poses.push_back(huge.mesh.positions);
    for (Vec3& p : huge.poses.back()) p = {1e-12f * p.x, 1e-12f * p.y, 1e-12f * p.z};
    huge.collapses = true;
    meshes.push_back(huge);
    return meshes;
}

std::vector<PosedMesh> sharedMeshes() {
    std::vector<PosedMesh> meshes;
    const std::filesystem::path folder = test::shared("golden/mikktspace");
    if (!std::filesystem::exists(folder)) return meshes;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& path : files) {
        test::GoldenMesh golden;
        if (test::readGolden(path, golden))
            meshes.push_back(withBentPose(path.filename().string(), golden.shape, golden.angular_threshold_deg));
    }
    return meshes;
}

namespace {

double lengthOf(const Vec4& v) { return std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z); }
double degreesBetween(const Vec4& a, const Vec4& b) {
    const double cx = double{a.y} * b.z - double{a.z} * b.y, cy = double{a.z} * b.x - double{a.x} * b.z;
    const double cz = double{a.x} * b.y - double{a.y} * b.x,
                 along = double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
    return std::atan2(std::sqrt(cx * cx + cy * cy + cz * cz), along) * 180 / std::numbers::pi;
}

/// Returns the vectors with small random changes in the last bits of each number.
std::vector<Vec3> nudged(const std::vector<Vec3>& vectors, std::uint32_t seed) {
    std::vector<Vec3> result = vectors;
    for (Vec3& v : result) {
        for (float* x : {&v.x, &v.y, &v.z}) {
            seed = seed * 1664525u + 1013904223u;
            *x *= 1 + (static_cast<float>(seed >> 30) - 1.5f) * 1e-7f;
        }
    }
    return result;
}

}  // namespace

void Differences::add(const Vec4& expected, std::span<const Vec4> nearby, const Vec4& found, const std::string& place,
                      bool is_huge) {
    if (!isFinite(xyz(expected))) return;
    ++count;
    if (!isFinite(xyz(found))) {
        ++not_finite;
        return;
    }
    if (is_huge) {
        ++huge;
        return;
    }
    wrong_signs += found.w != expected.w ? 1 : 0;
    const bool is_zero = lengthOf(expected) < 0.5;
    for (const Vec4& other : nearby) {
        if (isFinite(xyz(other)) && other.w == expected.w && (lengthOf(other) < 0.5) == is_zero &&
            degreesBetween(expected, other) < kUnstable)
            continue;
        ++unstable;
        return;
    }
    if ((lengthOf(found) < 0.5) != is_zero) ++not_zero;
    if (lengthOf(found) < 0.5 || is_zero) return;
    degrees.push_back(static_cast<float>(degreesBetween(expected, found)));
    if (degrees.back() <= worst_deg) return;
    worst_deg = degrees.back();
    where = place;
}

float Differences::percentile(double share) {
    if (degrees.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(degrees.size() - 1));
    std::nth_element(degrees.begin(), degrees.begin() + at, degrees.end());
    return degrees[static_cast<std::size_t>(at)];
}

std::string Differences::text() {
    char line[300];
    std::snprintf(line, sizeof line,
                  "%zu results (%zu unstable, %zu huge), p99.99 %.6f deg, worst %.6f deg (%s), signs %zu, not finite "
                  "%zu, zeros %zu",
                  count, unstable, huge, static_cast<double>(percentile(0.9999)), static_cast<double>(worst_deg),
                  where.c_str(), wrong_signs, not_finite, not_zero);
    return line + failure;
}

std::vector<std::uint32_t> plainSettings(bool writes_normals) {
    std::vector<std::uint32_t> settings(setting_count);
    settings[position_stride] = settings[normal_stride] = 12;
    settings[tangent_stride] = 16;
    settings[normal_format] = writes_normals ? 1 : 0;
    for (std::size_t i = 0; i < 3; ++i) settings[position_scale + i] = std::bit_cast<std::uint32_t>(1.0f);
    return settings;
}

namespace {

/// Evaluates all poses of one mesh with one plan.
class MeshRun {
  public:
    MeshRun(const PosedMesh& posed, const EvaluateOptions& options, Outcome& outcome)
        : posed_(posed), options_(options), outcome_(outcome) {}

    /// Runs all poses. Returns an empty string, or a description of what failed.
    std::string run(const Evaluate& evaluate, const std::function<void(EvaluateBuffers&)>& spoil) {
        MeshView mesh = posed_.mesh.view();
        const TangentOptions tangents{.method = options_.method,
                                      .convention = conventions::gltf,
                                      .angular_threshold_deg = posed_.angular_threshold_deg};
        PlanBufferOptions buffers;
        IndexedFrames frames;
        if (options_.makes_normals) {
            if (std::string error = makeFrames(mesh, tangents, frames, buffers); !error.empty()) return error;
        }
        const Result<TangentPlan> plan = planTangents(mesh, tangents);
        if (!plan) return plan.error().message;
        Result<PlanBuffers> made = planBuffers(*plan, buffers);
        if (!made) return made.error().message;
        outcome_.plan_words += made->words.size();
        outcome_.triangles += (*made)[PlanBuffers::triangle_count];
        for (std::size_t pose = 0; pose < posed_.poses.size(); ++pose) {
            EvaluateBuffers in;
            in.arrays[EvaluateBuffers::plan] = made->words;
            in.result_count = (*made)[PlanBuffers::result_count];
            if (std::string error = runPose(*plan, frames, pose, in, evaluate, spoil); !error.empty()) return error;
        }
        return {};
    }

  private:
    /// Computes normals with the library and makes vertices as makeIndexedFrames does, with a vertex for each result.
    std::string makeFrames(MeshView& mesh, const TangentOptions& tangents, IndexedFrames& frames,
                           PlanBufferOptions& buffers) {
        corner_normals_.resize(mesh.cornerCount());
        normals_.weighting = options_.weighting;
        normals_.crease_angle_deg = options_.crease_angle_deg;
        normals_.convention = tangents.convention;
        if (const auto done = generateNormals(mesh, normals_, corner_normals_); !done) return done.error().message;
        unrolled_ = {};
        for (std::size_t c = 0; c < mesh.cornerCount(); ++c) {
            const std::uint32_t v = mesh.indices[c];
            unrolled_.indices.push_back(unrolled_.addVertex(mesh.positions[v], corner_normals_[c], mesh.uvs[v]));
        }
        mesh = unrolled_.view();
        mesh.indices = {};
        Result<IndexedFrames> made = makeIndexedFrames(mesh, {.tangents = tangents, .sanitize = false});
        if (!made) return made.error().message;
        frames = std::move(*made);
        // The plan is made for a mesh of these vertices.
        test::SimpleMesh split;
        for (std::size_t v = 0; v < frames.vertexCount(); ++v)
            split.addVertex(mesh.positions[frames.source_vertices[v]], frames.normals[v],
                            mesh.uvs[frames.source_vertices[v]]);
        split.indices = frames.indices;
        for (std::uint32_t& source : frames.source_vertices) source = posed_.mesh.indices[source];
        unrolled_ = std::move(split);
        mesh = unrolled_.view();
        buffers.source_corners = frames.source_corners;
        buffers.mesh = mesh;
        buffers.normals = normals_;
        return {};
    }

    std::string runPose(const TangentPlan& plan, const IndexedFrames& frames, std::size_t pose, EvaluateBuffers& in,
                        const Evaluate& evaluate, const std::function<void(EvaluateBuffers&)>& spoil) {
        const std::vector<Vec3>& posed = posed_.poses[pose];
        std::vector<Vec3> positions = posed, normals = posed_.mesh.normals;
        if (options_.makes_normals) {
            positions.clear();
            for (const std::uint32_t v : frames.source_vertices) positions.push_back(posed[v]);
        }
        auto& [plan_words, settings, position_words, deform, normal_words, tangent_words] = in.arrays;
        settings = plainSettings(options_.makes_normals);
        position_words = wordsOf(positions);
        deform = {0};
        normal_words = wordsOf(options_.makes_normals ? std::vector<Vec3>(in.result_count) : normals);
        tangent_words.assign(std::max<std::size_t>(4 * in.result_count, 1), 0);
        if (spoil) spoil(in);
        if (std::string error = evaluate(in); !error.empty()) return error;
        const auto placeOf = [&](std::size_t r) {
            return posed_.name + " pose " + std::to_string(pose) + " result " + std::to_string(r);
        };
        if (options_.makes_normals) {
            std::vector<std::vector<Vec3>> expected(kTries, std::vector<Vec3>(unrolled_.indices.size()));
            for (std::uint32_t i = 0; i < kTries; ++i) {
                const std::vector<Vec3> p = i == 0 ? positions : nudged(positions, i);
                const auto done = generatePoseNormals(unrolled_.view(), p, normals_, expected[i]);
                if (!done) return done.error().message;
            }
            normals.clear();
            for (std::size_t r = 0; r < in.result_count; ++r) {
                normals.push_back(vectorAt(normal_words, 3 * r));
                Vec4 tries[kTries];
                for (std::size_t i = 0; i < kTries; ++i) tries[i] = withSign(expected[i][frames.source_corners[r]], 1);
                outcome_.normals.add(tries[0], std::span(tries).subspan(1), withSign(normals[r], 1), placeOf(r));
            }
        }
        // The library gets the shader's normals: if a tangent is nearly parallel to the normal, the last bits of the
        // normal rotate the tangent by degrees.
        std::vector<std::vector<Vec4>> expected(kTries, std::vector<Vec4>(plan.outputCount()));
        for (std::uint32_t i = 0; i < kTries; ++i) {
            const std::vector<Vec3> p = i == 0 ? positions : nudged(positions, i),
                                    n = i == 0 ? normals : nudged(normals, 9 * i);
            if (const auto done = evaluateTangents(plan, {p, n}, {.tangents = expected[i]}); !done)
                return done.error().message;
        }
        for (std::size_t r = 0; r < in.result_count; ++r) {
            const std::size_t corner = options_.makes_normals ? frames.source_corners[r] : r;
            Vec4 tries[kTries];
            for (std::size_t i = 0; i < kTries; ++i) tries[i] = expected[i][corner];
            const Vec4 found = withSign(vectorAt(tangent_words, 4 * r), std::bit_cast<float>(tangent_words[4 * r + 3]));
            outcome_.tangents.add(tries[0], std::span(tries).subspan(1), found, placeOf(r),
                                  overflows(in.arrays[EvaluateBuffers::plan], r, positions));
        }
        return {};
    }

    /// Returns whether a result has coordinates that are so large that the library leaves their triangles out (fast),
    /// or computes them in double precision because floats overflow (lengyel). The shader knows only the size of the
    /// triangles around a result, and for lengyel only rounded coefficients, so such results may differ.
    [[nodiscard]] bool overflows(const std::vector<std::uint32_t>& plan, std::size_t result,
                                 const std::vector<Vec3>& positions) const {
        if (options_.makes_normals || (options_.method != Method::lengyel && options_.method != Method::fast))
            return false;
        const float most = options_.method == Method::lengyel ? 1e36f : 1e18f;
        const auto isAbove = [&](float x) { return std::isfinite(x) && std::fabs(x) > most; };
        const std::uint32_t* const row = plan.data() + plan[PlanBuffers::results] + 3 * result;
        for (std::uint32_t i = 0; i < (row[1] & PlanBuffers::count_mask); ++i) {
            const std::uint32_t entry = plan[plan[PlanBuffers::entries] + row[0] + i];
            if (entry == PlanBuffers::kNextPart) continue;
            const std::size_t triangle = (entry & PlanBuffers::corner_mask) / 4;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v =
                    plan[plan[PlanBuffers::triangles] + plan[PlanBuffers::triangle_words] * triangle + k];
                const Vec3& p = positions[v];
                const Vec2& uv = posed_.mesh.uvs[v];
                if (isAbove(p.x) || isAbove(p.y) || isAbove(p.z)) return true;
                if (options_.method == Method::fast && (isAbove(uv.x) || isAbove(uv.y))) return true;
            }
        }
        return false;
    }

    static constexpr std::uint32_t kTries = 4;  ///< the pose, and poses that differ in their last bits
    static Vec4 withSign(const Vec3& v, float sign) { return {v.x, v.y, v.z, sign}; }

    const PosedMesh& posed_;
    const EvaluateOptions& options_;
    Outcome& outcome_;
    NormalOptions normals_;
    std::vector<Vec3> corner_normals_;
    test::SimpleMesh unrolled_;
};

}  // namespace

Outcome evaluateAll(const std::vector<PosedMesh>& meshes, const EvaluateOptions& options, const Evaluate& evaluate,
                    const std::function<void(EvaluateBuffers&)>& spoil) {
    Outcome outcome;
    for (const PosedMesh& mesh : meshes) {
        const bool has_polygons =
            !mesh.mesh.face_sizes.empty() && std::any_of(mesh.mesh.face_sizes.begin(), mesh.mesh.face_sizes.end(),
                                                         [](std::uint32_t size) { return size != 3; });
        // At a degenerate triangle, the library uses all other triangles around the point, which the shader does not
        // know.
        const bool has_edges = options.crease_angle_deg < 180 || options.weighting == NormalWeighting::flat;
        if (options.makes_normals && has_edges && mesh.collapses) continue;
        if (has_polygons && (options.makes_normals || options.method == Method::lengyel)) continue;
        PosedMesh triangles = mesh;
        if (!has_polygons) triangles.mesh.face_sizes.clear();
        outcome.tangents.failure = MeshRun(triangles, options, outcome).run(evaluate, spoil);
        if (!outcome.tangents.failure.empty()) {
            outcome.tangents.failure = " FAILED on " + mesh.name + ": " + outcome.tangents.failure;
            break;
        }
    }
    return outcome;
}

}  // namespace tspace::shaders
