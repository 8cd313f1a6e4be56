// SPDX-License-Identifier: MIT
// Accessors: the input is JSON with `bufferViews` and `accessors`, a zero byte, and the bytes of buffer 0. Every
// accessor is decoded in every way; each call must return values or an error.
#include <algorithm>
#include <string>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"
#include "model/gltf/load_document.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace {

using namespace tspace;
using namespace tspace::gltf;

template <class Body>
void attempt(Body&& body) {
    try {
        body();
    } catch (const FileError&) {
        // expected for invalid files
    }
}

void decode(const Document& document, std::size_t index) {
    attempt([&] {
        const Accessor accessor = readAccessor(document, index);
        attempt([&] { (void)copyElements(document, accessor); });
        attempt([&] { (void)decodeVec2(document, accessor, "/here"); });
        attempt([&] { (void)decodeVec3(document, accessor, "/here"); });
        attempt([&] { (void)decodeVec4(document, accessor, "/here"); });
        attempt([&] { (void)decodeIndices(document, accessor, 100, "/here"); });
        (void)formatName(accessor);
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::uint8_t* end_of_text = std::find(data, data + size, std::uint8_t{0});
    const std::uint8_t* first_byte = std::min(end_of_text + 1, data + size);
    attempt([&] {
        Json root = parseJson({data, end_of_text}).root;
        if (!root.is_object()) return;
        root["asset"] = {{"version", "2.0"}};
        const Bytes bytes(first_byte, data + size);
        root["buffers"] = Json::array({Json{{"byteLength", bytes.size()}}});
        if (!bytes.empty()) root["buffers"][0]["uri"] = encodeDataUri("application/octet-stream", bytes);
        const std::string text = root.dump(-1, ' ', BadUtf8::replace);
        const Document document = parseDocument(Bytes(text.begin(), text.end()), "model.gltf", {});
        for (std::size_t i = 0; i < rootArray(document, "accessors").size(); ++i) decode(document, i);
    });
    return 0;
}
