// SPDX-License-Identifier: MIT
// New elements for one attribute of primitives that share it.
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
    std::span<const std::size_t> numbers = {};   ///< those that share the attribute, or have none
    std::ptrdiff_t target = kBase;
    std::string name = {};
    /// Whether elements that are there may stay, or be overwritten where they are.
    bool may_stay = true;
    /// An accessor that these primitives alone have used for something that they no longer have: its entry is taken for
    /// what is new.
    std::optional<std::size_t> spare = {};
};

/// Sets the attribute in all of them. Returns false when the document has these very bits already.
bool setAttribute(Editor& editor, const Document& document, const SharedAttribute& attribute, ElementData&& data);

}  // namespace tspace::gltf
