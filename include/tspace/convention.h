// SPDX-License-Identifier: MIT
// Conventions of formats and engines: meaning of the tangent sign, and which side of a face is outside.
#pragma once

#include <cstdint>

namespace tspace {

/// Position of v = 0 in the texture. It decides every sign, so it has no default.
enum class VAxis : std::uint32_t {
    unset = 0,  ///< not set; functions that compute tangents fail with invalidOption
    up = 1,     ///< v = 0 is the bottom row of the image (OpenGL, Blender, Unity)
    down = 2    ///< v = 0 is the top row of the image (glTF, DirectX, Unreal, Godot)
};

/// Meaning of a large green value in a normal map.
enum class Green : std::uint32_t {
    up = 0,   ///< towards the top row of the image ("OpenGL", +Y)
    down = 1  ///< towards the bottom row ("DirectX", -Y)
};

/// Whether the stored sign is the sign in `B = sign * cross(N, T)` or its negative.
enum class StoredSign : std::uint32_t { asIs = 0, negated = 1 };

enum class Handedness : std::uint32_t { right = 0, left = 1 };

/// Order of a face's vertices as seen from outside.
enum class Winding : std::uint32_t { counterClockwise = 0, clockwise = 1 };

/// There is no default: choose a preset, such as `conventions::gltf`. `conventions::opengl` is the mathematical
/// convention: B points along increasing v, B = sign * cross(N, T), and faces are counter-clockwise in a right-handed
/// system; with it Method::mikktspace returns the sign of the reference.
///
/// T always points along increasing u. The green axis of the image determines the direction of B, and so the stored
/// sign:
///     sign = uv_orientation * (v_axis down ? -1 : 1) * (green down ? -1 : 1) * (stored_sign negated ? -1 : 1)
/// where uv_orientation is +1 when cross(dP/du, dP/dv) points along N. Handedness and winding define which side of a
/// face is outside (see `normalFactor`), and so the direction of N; B = sign * cross(N, T) holds numerically in both
/// cases. Normals depend on handedness and winding only.
struct Convention {
    VAxis v_axis = VAxis::unset;
    Green green = Green::up;
    StoredSign stored_sign = StoredSign::asIs;
    Handedness handedness = Handedness::right;
    Winding winding = Winding::counterClockwise;

    friend bool operator==(const Convention&, const Convention&) = default;
};

/// Returns the factor (+1 or -1) that converts the raw sign (of dP/dv for the UVs as given) to the stored sign.
inline constexpr float signFactor(const Convention& c) {
    const bool flip = (c.v_axis == VAxis::down) != (c.green == Green::down);
    return flip != (c.stored_sign == StoredSign::negated) ? -1.0f : 1.0f;
}

/// Returns the factor (+1 or -1) that makes cross(P1-P0, P2-P0) point outside.
inline constexpr float normalFactor(const Convention& c) {
    return (c.handedness == Handedness::left) != (c.winding == Winding::clockwise) ? -1.0f : 1.0f;
}

/// Named presets. `docs/concepts/conventions.md` lists their sources.
namespace conventions {
inline constexpr Convention opengl{.v_axis = VAxis::up};
/// glTF 2.0: v down, green up; w is therefore the negative of the raw UV orientation.
inline constexpr Convention gltf{.v_axis = VAxis::down};
inline constexpr Convention directx{
    .v_axis = VAxis::down, .green = Green::down, .handedness = Handedness::left, .winding = Winding::clockwise};
inline constexpr Convention unreal{.v_axis = VAxis::down, .green = Green::down, .handedness = Handedness::left};
inline constexpr Convention unity{.v_axis = VAxis::up, .handedness = Handedness::left, .winding = Winding::clockwise};
inline constexpr Convention blender{.v_axis = VAxis::up};
inline constexpr Convention godot{.v_axis = VAxis::down, .winding = Winding::clockwise};
}  // namespace conventions

/// Finds a preset by its name in lower case ("gltf", "opengl", "directx", "unreal", "unity", "blender", "godot").
/// Returns null for any other name.
const Convention* findConvention(const char* name);

}  // namespace tspace
