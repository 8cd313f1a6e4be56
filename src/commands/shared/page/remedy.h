// SPDX-License-Identifier: MIT
// What a remedy gives: the command that it names, run in memory.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "model/io/file_io.h"
#include "tspace/asset.h"

namespace tspace {

/// The first command that a remedy names.
struct RemedyCommand {
    std::string text = {};                        ///< "tspace generate --repair"
    std::optional<GenerateOptions> options = {};  ///< what it asks for; nothing where it leaves something open
};
/// Nothing where it names none.
std::optional<RemedyCommand> commandIn(const std::string& remedy);

/// The bytes that a command makes of a model, as a file that is read from memory.
class MendedFile {
  public:
    /// `file`: how `input` is opened. Throws FileError.
    MendedFile(const std::string& input, const FileOptions& file, GenerateOptions options);
    MendedFile(const MendedFile&) = delete;
    MendedFile& operator=(const MendedFile&) = delete;

    /// How it is opened, under the name "mended.glb"; files that it names are those beside the input. Valid as long as this is.
    [[nodiscard]] FileOptions open();

  private:
    std::string input_;
    FileOptions file_;
    Bytes bytes_ = {};
    std::map<std::string, Bytes> named_ = {};
};

}  // namespace tspace
