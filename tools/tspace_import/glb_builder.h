// SPDX-License-Identifier: MIT
// Builds a GLB accessor by accessor, and counts repaired values.
#pragma once

#include <cstdint>
#include <vector>

#include "mend.h"
#include "model/gltf/document_builder.h"

namespace tspace::import {

class GlbBuilder : public gltf::DocumentBuilder {
  public:
    GlbBuilder() : DocumentBuilder(Json::object({{"version", "2.0"}})) {}

    Mended& mended() { return mended_; }
    std::vector<std::uint8_t> finish();

  private:
    Mended mended_ = {};
};

}  // namespace tspace::import
