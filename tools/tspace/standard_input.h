// SPDX-License-Identifier: MIT
// "-" as an input or output: bytes that come and go through pipes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace::tool {

/// All of stdin.
///
/// what                  for a message: "a model"
/// memory_limit_bytes    as FileOptions::memory_limit_bytes
/// looks_right           looks at the first bytes
/// why_not               the message where those are not right
///
/// Fails with cannotRead, unsupportedFile, invalidFile (nothing there) and tooLarge.
Result<std::vector<std::uint8_t>> readStandardInput(const char* what, std::uint64_t memory_limit_bytes,
                                                    bool (*looks_right)(std::string_view), const char* why_not);

/// The bytes of a model on stdin, for as long as it is worked on.
class StandardInput {
  public:
    /// Where `input` is "-", reads all of stdin and points `options` at it. Fails with cannotRead, unsupportedFile
    /// (neither GLB nor glTF: other formats are told by their names) and tooLarge.
    /// `takes_images`: an image may come too.
    Result<Done> open(const std::string& input, FileOptions& options, bool takes_images = false);

  private:
    std::vector<std::uint8_t> bytes_ = {};
};

/// "-" as an output.
class StandardOutput {
  public:
    /// False where it cannot be written. close() gives the reason, since errno may have changed by the time of the message.
    bool write(std::span<const std::uint8_t> bytes);
    /// Call it at the end, also after errors: fails with the reason why not all was written.
    Result<Done> close();

  private:
    int failure_ = 0;
};

}  // namespace tspace::tool
