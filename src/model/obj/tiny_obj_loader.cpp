// SPDX-License-Identifier: MIT
// Compiles the parser from its header, so that sanitizers instrument it. The WebAssembly build replaces this file by
// one without std::iostream (bindings/js/wasm).
#define TINYOBJLOADER_IMPLEMENTATION
#include "model/obj/tiny_obj_loader.h"

#include <istream>
#include <map>
#include <streambuf>

namespace tspace::obj {
namespace {

/// Stream over bytes that are already in memory.
class MemoryStream : private std::streambuf, public std::istream {
  public:
    explicit MemoryStream(std::string& text) : std::istream(static_cast<std::streambuf*>(this)) {
        setg(text.data(), text.data(), text.data() + text.size());
    }
};

}  // namespace

bool parseObj(std::string& text, const tinyobj::callback_t& callbacks, void* user) {
    MemoryStream stream(text);
    std::string warning;
    std::string error;
    // Without a material reader (null), the parser opens no files.
    return tinyobj::LoadObjWithCallback(stream, callbacks, user, nullptr, &warning, &error);
}

std::vector<tinyobj::material_t> parseMtl(std::string& text) {
    MemoryStream stream(text);
    std::map<std::string, int> unused_index;
    std::vector<tinyobj::material_t> materials;
    std::string warning;
    std::string error;
    tinyobj::LoadMtl(&unused_index, &materials, &stream, &warning, &error);
    return materials;
}

}  // namespace tspace::obj
