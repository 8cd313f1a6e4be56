// SPDX-License-Identifier: MIT
// JSON and BIN of a GLB that grows accessor by accessor.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mend.h"
#include "model/json/json.h"

namespace tspace::import {

class GlbBuilder {
  public:
    GlbBuilder();

    Json& json() { return json_; }
    Mended& mended() { return mended_; }

    /// Bytes as a buffer view; `target` 0: none.
    std::size_t addView(std::span<const std::uint8_t> bytes, unsigned target);
    /// `type` "VEC3" and so on. With `bounds` min and max are written.
    std::size_t addFloats(std::span<const float> values, std::size_t components, const std::string& type,
                          unsigned target, bool bounds = false);
    std::size_t addShorts(std::span<const std::uint16_t> values, std::size_t components, const std::string& type);
    /// Indices in 16 bits where they fit.
    std::size_t addIndices(std::span<const std::uint32_t> indices, std::size_t vertex_count);

    /// Appends to an array of the root and returns the index.
    std::size_t append(const char* array, Json entry);

    std::vector<std::uint8_t> finish();

  private:
    std::size_t addAccessor(std::size_t view, unsigned component, std::size_t count, const std::string& type);

    Json json_;
    std::vector<std::uint8_t> bin_ = {};
    Mended mended_ = {};
};

}  // namespace tspace::import
