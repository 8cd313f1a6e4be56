// SPDX-License-Identifier: MIT
// The options of diff, identify, inspect and flip-green.
#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {

OptionList diffOptions(DiffRequest& request) {
    OptionList list;
    const char* group = "Comparing";
    addAllowExternal(list, request.options.file);
    add(list, group,
        degrees(
            "--tolerance", request.tolerance_deg, 180,
            "Exit with 1 when an angle is above this, a sign differs, or a triangle has no partner. In degrees, 0 to "
            "180."));
    add(list, group, number("--worst", request.options.worst_count, 10000, "How many of the worst places are listed."));
    addLimits(list, request.options.file);
    return list;
}

OptionList identifyOptions(IdentifyOptions& options) {
    OptionList list;
    addAllowExternal(list, options.file);
    add(list, "Comparing",
        degrees("--tolerance", options.tolerance_deg, 180,
                "Tangents nearer than this count as the same. In degrees, 0 to 180."));
    addThreads(list, options.execution,
               "Number of threads; 0: as many as there are cores. Changes no bit of the result.");
    addLimits(list, options.file);
    return list;
}

OptionList inspectOptions(FileOptions& options) {
    OptionList list;
    addAllowExternal(list, options);
    addLimits(list, options);
    return list;
}

OptionList flipGreenOptions(FlipGreenOptions& options) {
    OptionList list;
    add(list, kInputAndOutput, flag("--dry-run", options.dry_run, "Do everything but write."));
    addMemoryLimit(list, options.memory_limit_bytes);
    addSync(list, options.sync);
    return list;
}

}  // namespace tspace::options
