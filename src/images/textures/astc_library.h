// SPDX-License-Identifier: MIT
// Arm's astcenc, which is loaded for the first ASTC texture. Included only with its header (TSPACE_HAS_ASTC).
#pragma once

#define ASTCENC_DYNAMIC_LIBRARY
#include <astcenc.h>

#include <memory>

#include "images/loaded_library.h"

namespace tspace {

/// Functions of the library installed at run time.
struct Astc {
    LoadedLibrary library = LoadedLibrary(TSPACE_ASTC_LIBRARY, std::size_t{8} << 20);
    decltype(&astcenc_config_init) initConfig = library.find("astcenc_config_init");
    decltype(&astcenc_context_alloc) allocateContext = library.find("astcenc_context_alloc");
    decltype(&astcenc_context_free) freeContext = library.find("astcenc_context_free");
    decltype(&astcenc_decompress_image) decompress = library.find("astcenc_decompress_image");
    decltype(&astcenc_compress_image) compress = library.find("astcenc_compress_image");
    bool is_loaded = library.hasAll();
};

inline const Astc& astc() {
    static const Astc loaded;
    return loaded;
}

struct FreeAstcContext {
    void operator()(astcenc_context* context) const { astc().freeContext(context); }
};
using AstcContext = std::unique_ptr<astcenc_context, FreeAstcContext>;

}  // namespace tspace
