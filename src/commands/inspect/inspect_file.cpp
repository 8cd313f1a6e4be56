// SPDX-License-Identifier: MIT
// Chooses the reader by the name of the file.
#include "commands/inspect/inspect.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"

namespace tspace {

Result<Inspection> inspectFile(const std::string& input, const FileOptions& options) {
    return atFileBorder([&]() -> Result<Inspection> {
        const bool is_obj = lowerExtension(input) == ".obj";
        return is_obj ? inspectObj(input, options) : inspectGltf(input, options);
    });
}

}  // namespace tspace
