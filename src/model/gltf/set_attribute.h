// SPDX-License-Identifier: MIT
// Sets one attribute of the primitives that share it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "model/gltf/editor.h"
#include "model/gltf/pool_elements.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

struct SharedAttribute {
    std::span<const Primitive> primitives = {};  ///< all of the document, as it was when `numbers` were chosen
    std::span<const std::size_t> numbers = {};   ///< the primitives that share the attribute, or lack it
    std::ptrdiff_t target = kBase;
    std::string name = {};
    /// Whether existing elements may stay, or be overwritten in place.
    bool may_stay = true;
    /// An accessor that only these primitives used, for an attribute that was removed: its entry is re-used.
    std::optional<std::size_t> spare = {};
};

/// Sets the attribute in all of `numbers`. Returns false when the document has exactly these bits already.
bool setAttribute(Editor& editor, const Document& document, const SharedAttribute& attribute, ElementData&& data);

}  // namespace tspace::gltf
