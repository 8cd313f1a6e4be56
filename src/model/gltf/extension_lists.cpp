// SPDX-License-Identifier: MIT
// extensionsUsed and extensionsRequired.
#include "model/gltf/extension_lists.h"

#include <algorithm>

namespace tspace::gltf {

namespace {

constexpr const char* kLists[] = {"extensionsUsed", "extensionsRequired"};

}  // namespace

void requireExtension(Document& document, const char* name) {
    for (const char* key : kLists) {
        const Json& list = readArray(document.json, key, "", false);
        if (std::find(list.begin(), list.end(), name) == list.end()) document.json[key].push_back(name);
    }
}

void dropExtension(Document& document, const char* name) {
    for (const char* key : kLists) {
        const Json& list = readArray(document.json, key, "", false);
        const auto found = std::find(list.begin(), list.end(), name);
        if (found == list.end()) continue;
        Json& edited = document.json[key];
        edited.erase(static_cast<std::size_t>(found - list.begin()));
        if (edited.empty()) document.json.erase(key);
    }
}

}  // namespace tspace::gltf
