// SPDX-License-Identifier: MIT
// Copies of an accessor's elements, to be stored anew.
#pragma once

#include <cstdint>
#include <span>

#include "model/gltf/editor.h"
#include "model/gltf/gathered_bytes.h"

namespace tspace::gltf {

/// Element i is a copy of old element sources[i]. Bounds stay, because copies change none; the elements are to be
/// stored in the form that the accessor's have.
ElementData gatherElements(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources);

/// The same for split vertices. Elements that lie in the model file's own bytes are copied when they are written.
ElementData gatherSplit(const Document& document, const Accessor& accessor, const SplitSources& sources);

/// Brings min and max of float vectors up to date, where there are any; both go when an element is not finite, because
/// JSON has no such number.
void renewBounds(ElementData& data);

}  // namespace tspace::gltf
