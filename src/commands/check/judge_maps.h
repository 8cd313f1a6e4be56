// SPDX-License-Identifier: MIT
// Which normal maps get their green channel inverted, and their files afterwards.
#pragma once

#include <span>
#include <vector>

#include "commands/check/map_content.h"
#include "model/io/file_io.h"
#include "model/scene/scene.h"

namespace tspace {

/// One image that is a normal map.
struct JudgedMap {
    std::size_t image = 0;
    Bytes flipped = {};          ///< the image file with green inverted; empty: it stays as it is
    MapLook look = {};           ///< what it holds
    bool is_y_inverted = false;  ///< y is, which is not in green
    NormalMapReport report = {};
};

/// The image file with its green channel inverted; nothing, with the reason in `why` (half a sentence), where that is not
/// possible.
Bytes flipImage(std::span<const std::uint8_t> bytes, const MemoryBudget& budget, std::string& why);

/// Looks at the normal maps of the scene, which has its images, and inverts those that FlipGreen says (all stay with
/// FlipGreen::none).
///
/// keeps_tangents    per primitive of the scene: its tangents stay, or a repair leaves what a normal map cancels. Where
///                   their signs are inverted too, the two cancel out, and FlipGreen::down leaves the map alone
///
/// Throws FileError.
std::vector<JudgedMap> judgeMaps(const Scene& scene, const std::vector<bool>& keeps_tangents,
                                 const GenerateOptions& options);

}  // namespace tspace
