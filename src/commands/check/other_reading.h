// SPDX-License-Identifier: MIT
// Tangents that are wrong along the UVs they should follow may be right along others.
#pragma once

#include <optional>

#include "commands/check/primitive_checks.h"

namespace tspace {

struct OtherReading {
    UvReading reading = {};
    Surface surface = {};
    FrameHealth health = {};
    /// Which of the primitive's uses reads its texture like this, if any: then tangents along these UVs are a choice.
    std::optional<std::size_t> use = {};
};

/// The first reading that the tangents fit: the same set without its transform, then the other sets, then those of the
/// primitive's further textures. Strict, since a coincidence is likelier than it seems: those UVs have area nearly
/// everywhere the own ones have, the tangents follow them nearly everywhere, and clearly not the own ones. `health`:
/// along facts.reading. Fails as examineTangents does.
Result<std::optional<OtherReading>> findOtherReading(const PrimitiveFacts& facts, const FrameHealth& health);

/// Whether another reading has to explain directions, and not only signs.
bool areDirectionsWrong(const FrameHealth& health, const Surface& surface);

}  // namespace tspace
