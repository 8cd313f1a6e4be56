// SPDX-License-Identifier: MIT
// What the disk says about paths.
#pragma once

#include <cstdint>
#include <string>

#include "model/io/path.h"

namespace tspace {

/// 0 where there is no such file.
std::uint64_t fileSize(const Path& path);

/// The path of `file` relative to `folder`, with slashes; empty where it lies elsewhere.
std::string pathBelow(const Path& folder, const Path& file);

/// Whether a model that is written there is a GLB: isGlbName(), or a stream (kindOf()) that is not called .gltf.
bool isGlbOutput(const Path& path);

}  // namespace tspace
