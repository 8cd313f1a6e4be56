// SPDX-License-Identifier: MIT
// Standard input and output as files: the name "-" in options.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace::tool {

/// Reads all of stdin.
///
/// what                  noun for messages: "a model"
/// memory_limit_bytes    see FileOptions::memory_limit_bytes
/// is_valid              checks the first bytes
/// why_not               message if the first bytes are wrong
///
/// Fails with cannotRead, unsupportedFile, invalidFile (no data) and tooLarge.
Result<std::vector<std::uint8_t>> readStandardInput(const char* what, std::uint64_t memory_limit_bytes,
                                                    bool (*is_valid)(std::string_view), const char* why_not);

/// Bytes of a model or image from standard input.
class StandardInput {
  public:
    /// If `input` is "-", reads all of stdin and sets up `options` to use it. Fails with cannotRead, unsupportedFile
    /// (neither GLB nor glTF: other formats are recognized by their names) and tooLarge. `takes_images`: images are
    /// also allowed.
    Result<Done> open(const std::string& input, FileOptions& options, bool takes_images = false);

  private:
    std::vector<std::uint8_t> bytes_ = {};
};

/// Standard output as the destination of a model or image ("-").
class StandardOutput {
  public:
    /// Writes bytes. Returns false if they cannot be written. close() returns the reason, since errno may have changed
    /// by the time of the message.
    bool write(std::span<const std::uint8_t> bytes);
    /// Flushes the output; must be called at the end, also after errors. Fails with the reason if not everything was
    /// written.
    Result<Done> close();

  private:
    int failure_ = 0;
};

}  // namespace tspace::tool
