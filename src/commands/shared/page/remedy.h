// SPDX-License-Identifier: MIT
// What a remedy gives: the command that it names, run in memory.
#pragma once

#include <optional>
#include <string>

#include "model/scene/scene.h"
#include "tspace/asset.h"

namespace tspace {

/// The first command that a remedy names.
struct RemedyCommand {
    std::string text = {};                        ///< "tspace generate --repair"
    std::optional<GenerateOptions> options = {};  ///< what it asks for; nothing where it leaves something open
};
/// Nothing where it names none.
std::optional<RemedyCommand> commandIn(const std::string& remedy);

/// What a command makes of a model, with its images, as a picture shows it. `file`: how `input` is opened. Throws FileError.
DrawnScene mendedScene(const std::string& input, const FileOptions& file, GenerateOptions options);

}  // namespace tspace
