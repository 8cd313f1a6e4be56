// SPDX-License-Identifier: MIT
// The importer is not available on Windows: it confines itself with Landlock and seccomp of Linux.
#include "model/imported/import_document.h"
#include "model/io/file_error.h"

namespace tspace {

ImportResult runImporter(const std::string& program, const std::string&, bool, const ImportLimits&,
                         const std::function<void()>&) {
    failFile(ErrorCode::unsupportedFile, "the importer " + pathInQuotes(program) +
                                             " is not supported on Windows, where only glTF and OBJ can be read");
}

}  // namespace tspace
