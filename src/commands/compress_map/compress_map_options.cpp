// SPDX-License-Identifier: MIT
// How a normal map becomes a texture.
#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {

OptionList compressMapOptions(CompressMapFileOptions& options) {
    OptionList list;
    add(list, "Texture",
        flag("--signed", options.is_signed,
             "Write BC5 with a sign (SNORM). Flat parts of maps of more than 8 bits are then exact; engines must be "
             "told."));
    add(list, "Texture",
        setting("--no-levels", options.levels, false, "Write the first level alone. By default all smaller ones too."));
    add(list, kInputAndOutput, flag("--dry-run", options.dry_run, "Do everything but write."));
    addThreads(list, options.execution,
               "Threads; 0: as many as there are cores. The output is the same for any number.");
    addLimits(list, options.file);
    addSync(list, options.file.sync);
    return list;
}

}  // namespace tspace::options
