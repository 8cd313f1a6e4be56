// SPDX-License-Identifier: MIT
#include "tspace/convention.h"

#include <gtest/gtest.h>

#include <string>

namespace tspace {
namespace {

TEST(Convention, PresetsStoreTheSignOfTheirFormat) {
    EXPECT_EQ(signFactor(conventions::opengl), 1);
    EXPECT_EQ(signFactor(conventions::blender), 1);
    EXPECT_EQ(signFactor(conventions::unity), 1);
    EXPECT_EQ(signFactor(conventions::gltf), -1);
    EXPECT_EQ(signFactor(conventions::godot), -1);
    EXPECT_EQ(signFactor(conventions::directx), 1);
    EXPECT_EQ(signFactor(conventions::unreal), 1);
}

TEST(Convention, EachOfTheThreeSignChoicesFlipsOnce) {
    for (int bits = 0; bits < 8; ++bits) {
        const Convention c{.v_axis = (bits & 1) != 0 ? VAxis::down : VAxis::up,
                           .green = (bits & 2) != 0 ? Green::down : Green::up,
                           .stored_sign = (bits & 4) != 0 ? StoredSign::negated : StoredSign::asIs};
        const int flips = (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1);
        EXPECT_EQ(signFactor(c), flips % 2 == 0 ? 1 : -1) << bits;
        EXPECT_EQ(normalFactor(c), 1) << "the sign of a tangent says nothing about the outside of a face";
    }
}

TEST(Convention, HandednessAndWindingCancelEachOther) {
    EXPECT_EQ(normalFactor({.handedness = Handedness::left}), -1);
    EXPECT_EQ(normalFactor({.winding = Winding::clockwise}), -1);
    EXPECT_EQ(normalFactor({.handedness = Handedness::left, .winding = Winding::clockwise}), 1);
    EXPECT_EQ(signFactor({.handedness = Handedness::left}), 1);
    EXPECT_EQ(signFactor({.winding = Winding::clockwise}), 1);
}

TEST(Convention, PresetsAreFoundByName) {
    ASSERT_NE(findConvention("gltf"), nullptr);
    EXPECT_EQ(*findConvention("gltf"), conventions::gltf);
    EXPECT_EQ(*findConvention("opengl"), conventions::opengl);
    EXPECT_EQ(*findConvention("directx"), conventions::directx);
    EXPECT_EQ(*findConvention("unreal"), conventions::unreal);
    EXPECT_EQ(*findConvention("unity"), conventions::unity);
    EXPECT_EQ(*findConvention("blender"), conventions::blender);
    EXPECT_EQ(*findConvention("godot"), conventions::godot);
    EXPECT_EQ(findConvention("GLTF"), nullptr);
    EXPECT_EQ(findConvention(""), nullptr);
    EXPECT_EQ(findConvention(nullptr), nullptr);
}

}  // namespace
}  // namespace tspace
