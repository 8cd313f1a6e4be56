// SPDX-License-Identifier: MIT
// The codec of KHR_draco_mesh_compression, by the library Draco. Knows no JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/codecs/component_type.h"
#include "model/io/file_io.h"

namespace tspace::gltf {

/// The lattice that the values of an attribute lie on.
struct DracoRounding {
    int bits = 0;  ///< per component; 0: values are stored exactly
    bool is_octahedral = false;
    std::vector<float> origin =
        {};  ///< smallest value of each component, then the extent of all; empty: to be measured
    float range = 0;
};

/// What Draco takes an attribute for; decides how its values are predicted.
enum class DracoKind { position, normal, color, uv, other };

struct DracoAttribute {
    std::uint32_t id = 0;
    DracoKind kind = DracoKind::other;
    ComponentType component = ComponentType::f32;
    bool normalized = false;
    std::size_t component_count = 3;
    Bytes values = {};  ///< one element per point, tightly packed
    DracoRounding rounding = {};
};

struct DracoMesh {
    std::vector<std::uint32_t> corners = {};  ///< three points per triangle
    std::size_t point_count = 0;
    std::vector<DracoAttribute> attributes = {};
};

/// Upper bounds of a mesh, checked before memory is allocated. 64 bits wide, because a file may claim more than a
/// size_t of 32 bits holds.
struct DracoLimits {
    std::uint64_t corner_count = 0, point_count = 0, bytes = 0;
};

/// Why this build cannot decode or encode; empty when it can. One sentence.
std::string dracoMissing();

/// Decodes the triangles, and the attributes of `mesh`, of which id, component and component_count say what is wanted;
/// fills the rest. Returns what is wrong with the data, or nothing.
std::string decodeDraco(std::span<const std::uint8_t> data, const DracoLimits& limits, DracoMesh& mesh);

/// Encodes points and triangles in their order, and fills the ids. `exact`: an attribute whose rounding would change a
/// value is stored without. False when the library cannot do it.
bool encodeDraco(DracoMesh& mesh, bool exact, Bytes& data);

}  // namespace tspace::gltf
