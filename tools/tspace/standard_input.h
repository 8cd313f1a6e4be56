// SPDX-License-Identifier: MIT
// "-" as an input: the model that comes through a pipe.
#pragma once

#include <string>
#include <vector>

#include "tspace/asset.h"

namespace tspace::tool {

/// The bytes of a model on stdin, for as long as it is worked on.
class StandardInput {
  public:
    /// Where `input` is "-", reads all of stdin and points `options` at it. Fails with cannotRead, unsupportedFile
    /// (neither GLB nor glTF: other formats are told by their names) and tooLarge.
    Result<Done> open(const std::string& input, FileOptions& options);

  private:
    std::vector<std::uint8_t> bytes_ = {};
};

}  // namespace tspace::tool
