// SPDX-License-Identifier: MIT
// Time grows linearly with the number of triangles, on meshes that make the reference take quadratic time or recurse
// deeply. The bound is generous: ten times the triangles may take forty times the processor time, whereas quadratic
// time would take a hundred times.
#include <gtest/gtest.h>
#include <pthread.h>

#include <ctime>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"

namespace tspace::test {
namespace {

struct Case {
    const char* name;
    SimpleMesh (*make)(std::size_t triangles);
};

constexpr Case kCases[] = {
    {"grid", gridOf},
    {"fan", fan},
    {"unrolledFan", unrolledFan},
    {"cone", cone},
    {"collapsed", collapsed},
    {"bookOneWay", [](std::size_t n) { return book(n, false); }},
    {"bookBothWays", [](std::size_t n) { return book(n, true); }},
    {"duplicatesWithOtherNormals", duplicatesWithOtherNormals},
    {"someDegenerate", someDegenerate},
    {"checkerboard", checkerboard},
    {"notFinite", notFinite},
    {"someWithoutUvArea", someWithoutUvArea},
};

/// Returns the processor time of a call in seconds: the best of several calls.
double seconds(const SimpleMesh& shape, Method method, int tries) {
    double best = 1e9;
    for (int i = 0; i < tries; ++i) {
        Outputs outputs(shape.cornerCount());
        const std::clock_t start = std::clock();
        const auto result = generateTangents(shape.view(), {.method = method, .convention = conventions::opengl},
                                             outputs.view(), {.thread_count = 1});
        best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        EXPECT_TRUE(result);
    }
    return best;
}

struct Scaling : testing::TestWithParam<Case> {};

TEST_P(Scaling, TimePerTriangleStaysBounded) {
    const SimpleMesh few = GetParam().make(20000), many = GetParam().make(200000);
    for (const Method method : {Method::mikktspace, Method::fast, Method::best}) {
        const double small = seconds(few, method, 5), large = seconds(many, method, 2);
        RecordProperty("ratio_per_triangle_" + std::to_string(static_cast<int>(method)),
                       std::to_string(large / small / 10));
        EXPECT_LT(large, 40 * small) << "method " << static_cast<int>(method);
    }
}

TEST_P(Scaling, AStackOf64KilobytesIsEnough) {
#ifdef TSPACE_SANITIZED
    constexpr std::size_t kStack = 1 << 20;  // sanitizers enlarge every stack frame
#else
    constexpr std::size_t kStack = 64 << 10;
#endif
    const SimpleMesh shape = GetParam().make(20000);
    pthread_attr_t attributes;
    ASSERT_EQ(pthread_attr_init(&attributes), 0);
    ASSERT_EQ(pthread_attr_setstacksize(&attributes, kStack), 0);
    pthread_t thread;
    const auto run = [](void* data) -> void* {
        const SimpleMesh& mesh = *static_cast<const SimpleMesh*>(data);
        Outputs outputs(mesh.cornerCount());
        for (const Method method : {Method::mikktspace, Method::fast, Method::best}) {
            const TangentOptions options{.method = method, .convention = conventions::opengl};
            EXPECT_TRUE(generateTangents(mesh.view(), options, outputs.view()));
        }
        return nullptr;
    };
    ASSERT_EQ(pthread_create(&thread, &attributes, run, const_cast<SimpleMesh*>(&shape)), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Scaling, testing::ValuesIn(kCases),
                         [](const auto& scaling) { return std::string(scaling.param.name); });

TEST(SortBudget, AnOrderMadeAgainstTheReferencesSortFallsBackToCorrectedPairing) {
    const SimpleMesh shape = sortKiller(20000);
    Outputs reference(shape.cornerCount()), corrected(shape.cornerCount());
    const auto report = generateTangents(shape.view(), {.convention = conventions::opengl}, reference.view());
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->reference_order_abandoned);
    ASSERT_TRUE(generateTangents(shape.view(), {.convention = conventions::opengl, .pairing = Pairing::corrected},
                                 corrected.view()));
    EXPECT_TRUE(sameBits(reference, corrected));
}

}  // namespace
}  // namespace tspace::test
