// SPDX-License-Identifier: MIT
// The content of fresh memory does not affect any bit of a result.
#include <gtest/gtest.h>

#include "core/normals/normals_outcome.h"
#include "core/winding/bodies.h"
#include "scans.h"
#include "support/filled_memory.h"
#include "test_mesh.h"
#include "tspace/tangents.h"
#include "tspace/winding.h"

namespace tspace {
namespace {

using test::FilledMemory;
using test::kFillings;
using test::normalsOf;

const accuracy::Scan& noisyScan() {
    static const accuracy::Scan scan = accuracy::scan(test::shape("torus"), 24, 0.2, accuracy::Random({5}));
    return scan;
}

TEST(FreshMemory, ChangesNoNormal) {
    const NormalOptions all[] = {
        {.weighting = NormalWeighting::angle},
        {.weighting = NormalWeighting::best, .crease_angle_deg = 30},
        {.weighting = NormalWeighting::best, .crease_angle_deg = NormalOptions::crease_auto},
        {.weighting = NormalWeighting::best, .denoise = NormalOptions::denoise_auto},
        {.weighting = NormalWeighting::best, .denoise = 3},
    };
    for (const NormalOptions& options : all) {
        const test::Outcome expected = normalsOf(noisyScan().view(), options, {});
        for (const unsigned char byte : kFillings) {
            const FilledMemory memory(byte);
            EXPECT_TRUE(
                test::sameBits(expected.normals, normalsOf(noisyScan().view(), options, memory.execution(2)).normals));
        }
    }
}

TEST(FreshMemory, FlipsNoOtherFace) {
    test::Bodies bodies;
    test::addTorus(bodies, {}, 1, 0.4);
    test::addSphere(bodies, {1, 0, 0}, 0.1);
    test::shareVertices(bodies);
    const test::Bodies damaged = test::turnedByChance(bodies, 0.3, 7);
    std::vector<std::uint8_t> expected(damaged.faceCount()), turned(damaged.faceCount());
    ASSERT_TRUE(mendWinding(damaged.mesh.view(), {}, expected, {}));
    for (const unsigned char byte : kFillings) {
        const FilledMemory memory(byte);
        ASSERT_TRUE(mendWinding(damaged.mesh.view(), {}, turned, memory.execution(2)));
        EXPECT_EQ(expected, turned);
    }
}

}  // namespace
}  // namespace tspace
