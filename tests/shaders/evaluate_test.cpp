// SPDX-License-Identifier: MIT
// Compares the results of a plan's buffers with those of evaluateTangents and generateNormals.
// shaders/tspace_evaluate.metal is compiled as C++ (metal_shim) and called in a simple loop.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/vec_math.h"
#include "core/pack/random_frames.h"
#include "evaluate_by_loop.h"
#include "evaluate_expectations.h"
#include "tspace/pack.h"

// Included last because it defines macros.
#include <metal_stdlib>

namespace tspace::shaders {

namespace {

namespace by_hand {
using metal::as_type;
#include "tspace_evaluate.metal"
}  // namespace by_hand

}  // namespace

std::string evaluateByLoop(EvaluateBuffers& in) {
    auto& [plan, settings, positions, deform, normals, tangents] = in.arrays;
    for (uint i = 0; i < in.result_count; ++i) {
        by_hand::tspace_evaluate(plan.data(), settings.data(), positions.data(), deform.data(), normals.data(),
                                 tangents.data(), {i, 0, 0});
    }
    return {};
}

namespace {

TEST(PlanBuffers, GiveTheTangentsOfThePlan) { expectTangents(generatedMeshes(), evaluateByLoop); }
TEST(PlanBuffers, GiveTheFramesOfVertices) { expectFrames(generatedMeshes(), evaluateByLoop); }
TEST(PlanBuffers, GiveTheTangentsOfSharedMeshes) {
    const std::vector<PosedMesh> meshes = sharedMeshes();
    if (meshes.empty()) GTEST_SKIP() << "the shared test data are missing";
    for (const Method method : kMethods)
        expectNear(evaluateAll(meshes, {.method = method}, evaluateByLoop).tangents, methodName(method));
}

/// A grid with computed normals, and the shader's input buffers with the positions that the plan was made from.
struct Grid {
    PosedMesh posed = generatedMeshes()[0];
    PlanBuffers plan;
    EvaluateBuffers in;

    explicit Grid(Method method = Method::mikktspace) {
        const MeshView mesh = posed.mesh.view();
        const auto made = planTangents(mesh, {.method = method, .convention = conventions::gltf});
        plan = *planBuffers(*made, {.mesh = mesh});
        in.result_count = plan[PlanBuffers::result_count];
        std::vector<std::uint32_t> positions;
        for (const Vec3& p : posed.mesh.positions) append(positions, p);
        in.arrays = {plan.words,
                     plainSettings(true),
                     positions,
                     {0},
                     std::vector<std::uint32_t>(3 * in.result_count),
                     std::vector<std::uint32_t>(4 * in.result_count)};
    }
    static void append(std::vector<std::uint32_t>& words, const Vec3& v) {
        for (const float x : {v.x, v.y, v.z}) words.push_back(std::bit_cast<std::uint32_t>(x));
    }
    static float number(const std::vector<std::uint32_t>& words, std::size_t i) {
        return std::bit_cast<float>(words[i]);
    }
};

void expectSameFrames(const EvaluateBuffers& a, const EvaluateBuffers& b) {
    for (const std::size_t which : {EvaluateBuffers::normals, EvaluateBuffers::tangents}) {
        ASSERT_EQ(a.arrays[which].size(), b.arrays[which].size());
        for (std::size_t i = 0; i < a.arrays[which].size(); ++i)
            ASSERT_NEAR(Grid::number(a.arrays[which], i), Grid::number(b.arrays[which], i), 2e-6f) << which << " " << i;
    }
}

TEST(PlanBuffers, TakeAtMost48BytesPerTriangle) {
    for (const PosedMesh& mesh : {generatedMeshes()[0], generatedMeshes()[1]}) {
        for (const Method method : kMethods) {
            Outcome outcome = evaluateAll({mesh}, {.method = method, .makes_normals = true}, evaluateByLoop);
            const double bytes = 4.0 * static_cast<double>(outcome.plan_words) / static_cast<double>(outcome.triangles);
            std::cout << mesh.name << ", " << methodName(method) << ": " << bytes << " bytes per triangle\n";
            EXPECT_LE(bytes, 48) << mesh.name << " " << methodName(method);
        }
    }
}

TEST(PlanBuffers, ReadShortsOfAnyStride) {
    Grid floats, shorts;
    const float scale = 30;
    auto& words = shorts.in.arrays[EvaluateBuffers::positions];
    const std::size_t count = floats.posed.mesh.positions.size(), stride = 10, offset = 2;
    std::vector<std::int16_t> halves(5 * count + 2);
    std::vector<std::uint32_t> exact;
    for (std::size_t v = 0; v < count; ++v) {
        const Vec3& p = floats.posed.mesh.positions[v];
        Vec3 rounded;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto code = static_cast<std::int16_t>(std::lround((&p.x)[i] / scale * 32767));
            halves[1 + 5 * v + i] = code;
            (&rounded.x)[i] = scale * (static_cast<float>(code) / 32767.0f);
        }
        Grid::append(exact, rounded);
    }
    floats.in.arrays[EvaluateBuffers::positions] = exact;
    words.assign(halves.size() / 2 + 1, 0);
    std::memcpy(words.data(), halves.data(), 2 * halves.size());
    auto& settings = shorts.in.arrays[EvaluateBuffers::settings];
    settings[position_format] = 1;
    settings[position_offset] = offset;
    settings[position_stride] = stride;
    for (std::size_t i = 0; i < 3; ++i) settings[position_scale + i] = std::bit_cast<std::uint32_t>(scale);
    evaluateByLoop(floats.in);
    evaluateByLoop(shorts.in);
    expectSameFrames(floats.in, shorts.in);
}

TEST(PlanBuffers, MorphAndSkinPositions) {
    Grid deformed, plain;
    const std::vector<Vec3>& positions = plain.posed.mesh.positions;
    const std::size_t count = positions.size();
    // One morph target with weight 0.5, and two joints, the second of which rotates about x and moves.
    const float matrices[2][12] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                                   {1, 0, 0, 2, 0, 0.6f, -0.8f, 1, 0, 0.8f, 0.6f, 0}};
    std::vector<std::uint32_t> deform{std::bit_cast<std::uint32_t>(0.5f)}, moved;
    std::vector<Vec3> deltas;
    for (const Vec3& p : positions) deltas.push_back({0, 0.2f * p.z, 0.1f * p.x * p.x});
    for (const Vec3& d : deltas) Grid::append(deform, d);
    auto& settings = deformed.in.arrays[EvaluateBuffers::settings];
    settings[morph_count] = 1;
    settings[morph_deltas] = 1;
    settings[vertex_count] = static_cast<std::uint32_t>(count);
    settings[skin] = 1;
    settings[skin_joints] = static_cast<std::uint32_t>(deform.size());
    for (std::size_t v = 0; v < count; ++v) deform.insert(deform.end(), {0u, 1u, 0u, 0u});
    settings[skin_weights] = static_cast<std::uint32_t>(deform.size());
    const auto shareOf = [&](std::size_t v) { return positions[v].x / 24; };
    for (std::size_t v = 0; v < count; ++v) {
        for (const float w : {1 - shareOf(v), shareOf(v), 0.0f, 0.0f})
            deform.push_back(std::bit_cast<std::uint32_t>(w));
    }
    settings[skin_matrices] = static_cast<std::uint32_t>(deform.size());
    for (const auto& matrix : matrices) {
        for (const float x : matrix) deform.push_back(std::bit_cast<std::uint32_t>(x));
    }
    deformed.in.arrays[EvaluateBuffers::deform] = deform;
    for (std::size_t v = 0; v < count; ++v) {
        const Vec3 p = positions[v] + 0.5f * deltas[v];
        Vec3 sum;
        for (std::size_t j = 0; j < 2; ++j) {
            const float* const m = matrices[j];
            const auto row = [&](std::size_t r) {
                return m[4 * r] * p.x + m[4 * r + 1] * p.y + m[4 * r + 2] * p.z + m[4 * r + 3];
            };
            sum = sum + (j == 0 ? 1 - shareOf(v) : shareOf(v)) * Vec3{row(0), row(1), row(2)};
        }
        Grid::append(moved, sum);
    }
    plain.in.arrays[EvaluateBuffers::positions] = moved;
    evaluateByLoop(plain.in);
    evaluateByLoop(deformed.in);
    expectSameFrames(plain.in, deformed.in);
}

TEST(PlanBuffers, WriteBytesOfBothVectors) {
    Grid floats, bytes;
    auto& settings = bytes.in.arrays[EvaluateBuffers::settings];
    settings[tangent_format] = 3;
    settings[tangent_stride] = 8;
    evaluateByLoop(floats.in);
    evaluateByLoop(bytes.in);
    std::vector<Vec3> normals(floats.in.result_count);
    std::vector<Vec4> tangents(floats.in.result_count);
    const auto* const packed = reinterpret_cast<const std::byte*>(bytes.in.arrays[EvaluateBuffers::tangents].data());
    ASSERT_TRUE(unpackFrames({packed, 8 * floats.in.result_count}, FrameFormat::snorm8Pair, normals, tangents));
    for (std::size_t r = 0; r < floats.in.result_count; ++r) {
        for (std::size_t i = 0; i < 3; ++i) {
            ASSERT_NEAR((&normals[r].x)[i], Grid::number(floats.in.arrays[EvaluateBuffers::normals], 3 * r + i),
                        0.007f);
            ASSERT_NEAR((&tangents[r].x)[i], Grid::number(floats.in.arrays[EvaluateBuffers::tangents], 4 * r + i),
                        0.007f);
        }
        ASSERT_EQ(tangents[r].w, Grid::number(floats.in.arrays[EvaluateBuffers::tangents], 4 * r + 3));
    }
}

/// Returns the larger of two angles in degrees: between the normals, and between the tangents.
float frameErrorDeg(const Vec3& n, const Vec4& t, const Vec3& to_n, const Vec4& to_t) {
    return std::max(test::angleDeg(n, to_n), test::angleDeg({t.x, t.y, t.z}, {to_t.x, to_t.y, to_t.z}));
}

/// Compares packed words with those of packFrames: errors are within the bounds of the format, and nearly all words are
/// equal.
void expectWords(FrameFormat format, std::span<const Vec3> n, std::span<const Vec4> t,
                 std::span<const std::uint32_t> found) {
    std::vector<std::uint32_t> expected(n.size());
    ASSERT_TRUE(packFrames(n, t, format, std::as_writable_bytes(std::span(expected))));
    std::vector<Vec3> normals(n.size());
    std::vector<Vec4> tangents(n.size());
    ASSERT_TRUE(unpackFrames(std::as_bytes(found), format, normals, tangents));
    const FrameErrorBound bound = frameErrorBound(format);
    std::size_t others = 0;
    for (std::size_t r = 0; r < n.size(); ++r) {
        ASSERT_LE(test::angleDeg(normals[r], n[r]), bound.normal_deg) << r;
        ASSERT_LE(test::angleDeg({tangents[r].x, tangents[r].y, tangents[r].z}, {t[r].x, t[r].y, t[r].z}),
                  bound.tangent_deg);
        ASSERT_EQ(tangents[r].w, t[r].w);
        if (found[r] == expected[r]) continue;
        ++others;
        Vec3 normal;
        Vec4 tangent;
        ASSERT_TRUE(unpackFrames(std::as_bytes(std::span(&expected[r], 1)), format, {&normal, 1}, {&tangent, 1}));
        ASSERT_NEAR(frameErrorDeg(normals[r], tangents[r], n[r], t[r]), frameErrorDeg(normal, tangent, n[r], t[r]),
                    0.0002);
    }
    std::cout << others << " of " << n.size() << " words differ\n";
    EXPECT_LE(others, n.size() / 1000);  // if two points of the lattice are equally near, rounding decides
}

/// The formats that consist of one word, and their numbers in the settings.
constexpr struct {
    FrameFormat format;
    std::uint32_t number;
} kWordFormats[] = {{FrameFormat::frame32, 1}, {FrameFormat::oct32, 2}};

TEST(PlanBuffers, WriteTheWordsOfPackFrames) {
    for (const auto& [format, number] : kWordFormats) {
        Grid floats, words;
        auto& settings = words.in.arrays[EvaluateBuffers::settings];
        settings[tangent_format] = number;
        settings[tangent_stride] = 12;
        settings[tangent_offset] = 4;
        evaluateByLoop(floats.in);
        evaluateByLoop(words.in);
        const std::size_t count = floats.in.result_count;
        std::vector<std::uint32_t> found;
        for (std::size_t r = 0; r < count; ++r) found.push_back(words.in.arrays[EvaluateBuffers::tangents][3 * r + 1]);
        expectWords(format, {reinterpret_cast<const Vec3*>(floats.in.arrays[EvaluateBuffers::normals].data()), count},
                    {reinterpret_cast<const Vec4*>(floats.in.arrays[EvaluateBuffers::tangents].data()), count}, found);
    }
}

TEST(PlanBuffers, PackFramesOfAnyDirection) {
    test::RandomBits random(7);
    test::FrameList frames = test::randomFrames(random, 20000);
    for (const float z : {1.0f, -1.0f}) {
        frames.add({0, 0, z}, {1, 0, 0, z});
        frames.add({0, z, 0}, {0, 0, 1, -z});
        frames.add({z, 0, 0}, {0, -1, 0, z});
    }
    by_hand::tspace_Evaluator shader{};
    const auto pack = [&](FrameFormat format, const Vec3& n, const Vec4& t) {
        return format == FrameFormat::frame32 ? shader.tspace_encodeFrame32({n.x, n.y, n.z}, {t.x, t.y, t.z, t.w})
                                              : shader.tspace_encodeOct32({n.x, n.y, n.z}, {t.x, t.y, t.z, t.w});
    };
    for (const auto& [format, number] : kWordFormats) {
        std::vector<std::uint32_t> found;
        for (std::size_t r = 0; r < frames.size(); ++r)
            found.push_back(pack(format, frames.normals[r], frames.tangents[r]));
        expectWords(format, frames.normals, frames.tangents, found);
        // Frames without a normal or a tangent are completed: a missing normal is (0, 0, 1), and a missing tangent is
        // perpendicular to the normal.
        for (const float z : {0.0f, 1.0f, -1.0f}) {
            const std::uint32_t word = pack(format, {0, 0, z}, {});
            Vec3 normal;
            Vec4 tangent;
            ASSERT_TRUE(unpackFrames(std::as_bytes(std::span(&word, 1)), format, {&normal, 1}, {&tangent, 1}));
            EXPECT_NEAR(normal.z, z < 0 ? -1.0f : 1.0f, 1e-5f) << z;
        }
    }
}

/// Returns a double with random bits, an exponent of -200 to 200 and, often, few digits: sums are exact, or ties.
double randomDouble(test::RandomBits& random) {
    const std::uint64_t digits = random.next() << random.next() % 53 & ((std::uint64_t{1} << 52) - 1);
    const std::uint64_t exponent = 1023 - 200 + random.next() % 401;
    return std::bit_cast<double>((random.next() & 1) << 63 | exponent << 52 | digits);
}

TEST(PlanBuffers, ComputeInDoublePrecisionWithTheBitsOfTheCpu) {
    using Double = by_hand::tspace_Evaluator::tspace_Double;
    test::RandomBits random(11);
    by_hand::tspace_Evaluator shader{};
    std::uint32_t words[2];
    const auto stored = [&](double x) {
        words[0] = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x) >> 32);
        words[1] = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x));
        shader.tspace_plan = words;
        return shader.tspace_storedDouble(0);
    };
    const auto expectEqual = [&](const Double& found, double expected, double a, double b) {
        const Double wanted = stored(expected);
        ASSERT_TRUE(found.high == wanted.high && found.low == wanted.low) << a << ' ' << b;
        if (expected == 0) return;
        ASSERT_TRUE(found.sign == wanted.sign && found.exponent == wanted.exponent) << a << ' ' << b;
    };
    for (int i = 0; i < 300'000; ++i) {
        const double a = randomDouble(random);
        double b = randomDouble(random);
        if (i % 3 != 0) b = std::ldexp(b, std::ilogb(a) - std::ilogb(b) + static_cast<int>(random.next() % 120) - 60);
        if (i % 5 == 0) b = -std::nextafter(a, b);
        if (i % 1000 == 0) b = i % 2000 == 0 ? 0 : -a;
        const Double x = stored(a), y = stored(b);
        expectEqual(shader.tspace_product(x, y), a * b, a, b);
        expectEqual(shader.tspace_total(x, y), a + b, a, b);
        expectEqual(shader.tspace_difference(x, y), a - b, a, b);
        const auto narrow = static_cast<float>(a);
        ASSERT_EQ(shader.tspace_narrowed(x, 0), narrow) << a;
        ASSERT_EQ(shader.tspace_narrowed(x, 3), static_cast<float>(8 * a)) << a;
        if (std::isfinite(narrow)) expectEqual(shader.tspace_widened(narrow), double{narrow}, a, b);
    }
}

TEST(PlanBuffers, RejectOptionsThatShadersLack) {
    const PosedMesh posed = generatedMeshes()[0];
    const MeshView mesh = posed.mesh.view();
    for (const Method method : {Method::flat, Method::basis, Method::best}) {
        const auto plan = planTangents(mesh, {.method = method, .convention = conventions::gltf});
        EXPECT_EQ(planBuffers(*plan).error().code, ErrorCode::invalidOption) << methodName(method);
    }
    const auto plan = planTangents(mesh, {.convention = conventions::gltf});
    EXPECT_EQ(planBuffers(*plan, {.mesh = mesh, .normals = {.weighting = NormalWeighting::best}}).error().code,
              ErrorCode::invalidOption);
    const std::uint32_t few[] = {0, 1, 2}, beyond[] = {1u << 30};
    EXPECT_EQ(planBuffers(*plan, {.indices = few}).error().code, ErrorCode::countMismatch);
    EXPECT_EQ(planBuffers(*plan, {.source_corners = beyond}).error().code, ErrorCode::indexOutOfRange);
}

}  // namespace

}  // namespace tspace::shaders
