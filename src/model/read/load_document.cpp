// SPDX-License-Identifier: MIT
// Chooses between the bytes of the caller, the importer and the file.
#include "model/read/load_document.h"

#include "model/imported/import_document.h"

namespace tspace::gltf {

Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution,
                      const Progress& progress) {
    if (options.content.data() != nullptr)
        return parseDocument(Bytes(options.content.begin(), options.content.end()), path, options);
    if (isImportedFormat(path)) return importDocument(path, options, progress);
    return parseDocument(readFile(path, {}, execution), path, options);
}

}  // namespace tspace::gltf
