// SPDX-License-Identifier: MIT
// A context of libspng that frees itself.
#pragma once

#include <spng.h>

#include <memory>

namespace tspace {

struct FreePngContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using PngContext = std::unique_ptr<spng_ctx, FreePngContext>;

}  // namespace tspace
