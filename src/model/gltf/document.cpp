// SPDX-License-Identifier: MIT
// Lists and extensions of a document.
#include "model/gltf/document.h"

#include <algorithm>

namespace tspace::gltf {

const Json& rootArray(const Document& document, const char* name) { return readArray(document.json, name, "", false); }

Json& editableRootArray(Document& document, const char* name) {
    Json& array = document.json[name];
    if (array.is_null()) array = Json::array();
    return array;
}

std::string formatOf(const Document& document) {
    if (document.imported) return lowerExtension(document.path).substr(1);
    return document.container == Container::glb ? "glb" : "gltf";
}

std::string generatorOf(const Document& document) {
    if (document.imported) return document.source_generator;
    const Json* asset = readObject(document.json, "asset", "");
    return asset != nullptr ? readString(*asset, "generator", "/asset") : std::string();
}

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
