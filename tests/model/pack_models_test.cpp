// SPDX-License-Identifier: MIT
// The error bounds of pack.h for frames of real models. If only normals are stored, tangents are made up.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/pack/frame_list.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"
#include "tspace/frame.h"

namespace tspace::test {
namespace {

/// Returns the frames of a primitive that can be compared: invalid frames are skipped, and the others are made
/// orthonormal.
FrameList framesOf(const ScenePrimitive& primitive) {
    FrameList frames;
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        const Vec3 n = primitive.normals[i];
        const bool has_tangents = !primitive.tangents.empty();
        const Vec4 t = has_tangents ? primitive.tangents[i] : Vec4{n.y, -n.z, n.x, i % 2 == 0 ? 1.0f : -1.0f};
        const double angle = angleDeg(n, xyz(t));
        if (!(angle > 1.01 && angle < 178.99) || (t.w != 1 && t.w != -1)) continue;
        const Frame sound = orthonormalize({xyz(t), {}, n});
        frames.add(sound.normal, {sound.tangent.x, sound.tangent.y, sound.tangent.z, t.w});
    }
    return frames;
}

TEST(PackBounds, HoldForTheFramesOfAllModels) {
    TSPACE_NEEDS_SHARED("models");
    std::size_t frame_count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared("models"))) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".glb" && extension != ".gltf") continue;
        Scene scene;
        try {
            scene = readScene(entry.path().string(), {}, false);
        } catch (const std::exception&) {
            continue;  // some files are intentionally invalid
        }
        for (const ScenePrimitive& primitive : scene.primitives) {
            const FrameList frames = framesOf(primitive);
            if (frames.size() == 0) continue;
            frame_count += frames.size();
            for (const FrameFormat format : kAllFormats) {
                expectWithinBounds(format, errorsOf(format, frames));
                ASSERT_FALSE(HasFailure()) << entry.path() << primitive.place;
            }
        }
    }
    EXPECT_GT(frame_count, 100'000);
    std::printf("%zu frames\n", frame_count);
}

}  // namespace
}  // namespace tspace::test
