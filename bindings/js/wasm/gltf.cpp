// SPDX-License-Identifier: MIT
// The module of the entry "tspace/gltf": the C file API for models in memory, behind a single function.
#include <cstdlib>

#include "api/c_call.h"
#include "codecs.h"
#include "commands/shared/request.h"
#include "exports.h"
#include "images/image.h"
#include "model/read/read_scene.h"
#include "tspace/tspace_files.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {
/// Requests a file that a model references from JavaScript: sets the address and size of bytes that are valid until the
/// end of the call. Returns an error code. May throw, which ends the call and discards the instance.
TSPACE_JS_IMPORT(findFile)
tspace_ErrorCode tspace_js_findFile(std::size_t model, const char* path, const std::uint8_t** data, std::size_t* size);
/// Reports the progress of the call. May throw.
TSPACE_JS_IMPORT(tell) void tspace_js_tell(const char* what, double done, double total);
/// Passes a copy of an image file to JavaScript.
TSPACE_JS_IMPORT(takeImage)
void tspace_js_takeImage(const std::uint8_t* data, std::size_t bytes, const char* mime_type);
}

namespace {

void tell(const char* what, std::uint64_t done, std::uint64_t total) {
    tspace_js_tell(what, static_cast<double>(done), static_cast<double>(total));
}

enum class Verb : std::uint32_t { generate, check, inspect, identify, diff };

/// Layout shared with JavaScript.
struct ModelWords {
    const std::uint8_t* data;
    std::size_t size;
    const char* name;
    std::uint32_t has_files;
};

tspace_ErrorCode findFile(void* user, const char* path, const std::uint8_t** data, std::size_t* size) {
    return tspace_js_findFile(reinterpret_cast<std::uintptr_t>(user), path, data, size);
}

tspace_Model modelOf(const ModelWords& words, std::uintptr_t number) {
    return {.struct_size = sizeof(tspace_Model),
            .reserved = 0,
            .data = words.data,
            .size = words.size,
            .name = words.name,
            .find_file = words.has_files != 0 ? findFile : nullptr,
            .user = reinterpret_cast<void*>(number)};
}

}  // namespace

extern "C" {

/// true: the next call can be stopped.
TSPACE_JS_EXPORT(setCanStop) void setCanStop(bool can_stop) { tspace_js_can_stop = can_stop; }

/// `models`: one model, or two for diff. `results`: receives four words, address and size of output and report, to be
/// freed.
TSPACE_JS_EXPORT(callFiles)
std::uint32_t callFiles(std::uint32_t verb, const ModelWords* models, const char* options, tspace_Bytes* results) {
    const bool is_diff = static_cast<Verb>(verb) == Verb::diff;
    const tspace_Model a = modelOf(models[0], 0), b = is_diff ? modelOf(models[1], 1) : a;
    tspace_Error failure{};
    const Progress progress = tell;
    const auto call = [&] {
        switch (static_cast<Verb>(verb)) {
            case Verb::generate:
                return c_files::generateBytes(&a, options, progress, &results[0], &results[1], &failure);
            case Verb::check: return c_files::checkBytes(&a, options, progress, &results[1], &failure);
            case Verb::inspect: return tspace_inspectBytes(&a, options, &results[1], &failure);
            case Verb::identify: return tspace_identifyBytes(&a, options, &results[1], &failure);
            case Verb::diff: break;
        }
        return tspace_diffBytes(&a, &b, options, &results[1], &failure);
    };
    const tspace_ErrorCode code = call();
    if (code != TSPACE_OK) {
        error = Error{static_cast<ErrorCode>(code), failure.message};
        error.element = failure.element;
    }
    return code;
}

/// Calls takeImage for each normal map of a model. An error in the model ends the call.
TSPACE_JS_EXPORT(findImages) void findImages(const ModelWords* model, const char* text) {
    FileOptions options;
    const tspace_Model given = modelOf(*model, 0);
    c_files::openModel(&given, options);
    options::Given names;
    c_files::readOptions(options::inspectOptions(options), text, names);
    for (const SceneImage& image : readScene(c_files::nameOf(given), options, true).images) {
        const char* type = mimeType(imageFormat(image.bytes));
        if (!image.bytes.empty()) tspace_js_takeImage(image.bytes.data(), image.bytes.size(), type);
    }
}

}  // extern "C"
