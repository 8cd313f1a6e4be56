// SPDX-License-Identifier: MIT
// Chooses the reader by the name of the file.
#include "asset/file_error.h"
#include "asset/file_io.h"
#include "inspect/inspect.h"

namespace tspace {

Result<Inspection> inspectFile(const std::string& input, const FileOptions& options) {
    return atFileBorder([&]() -> Result<Inspection> {
        const bool is_obj = lowerExtension(input) == ".obj";
        return is_obj ? inspectObj(input, options) : inspectGltf(input, options);
    });
}

}  // namespace tspace
