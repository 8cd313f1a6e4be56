// SPDX-License-Identifier: MIT
// What a check looks at, and which findings count.
#include <algorithm>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<Severity> kSeverities[] = {
    {"note", Severity::note},
    {"warning", Severity::warning},
    {"error", Severity::error},
};
/// One code, or several with commas between them.
Option ignoreOption(std::vector<FindingCode>& ignored) {
    const auto take = [&ignored](const std::string& name) {
        for (std::uint32_t code = 0; code < kFindingCodeCount; ++code) {
            if (name == findingName(static_cast<FindingCode>(code))) ignored.push_back(static_cast<FindingCode>(code));
        }
        return std::string();
    };
    Option made =
        option("--ignore", "CODE", take,
               "Leave out findings of this code, such as tangentsUnused: they are not shown, and do not count "
               "for the exit code. Several with commas between them, or several times.");
    for (std::uint32_t code = 0; code < kFindingCodeCount; ++code)
        made.choices.emplace_back(findingName(static_cast<FindingCode>(code)));
    made.is_repeatable = made.is_list = true;
    return made;
}

void addChecking(OptionList& list, CheckRequest& request) {
    const char* group = "Checking";
    CheckOptions& options = request.options;
    add(list, group,
        choice("--fail-on", "LEVEL", kSeverities, request.fail_on,
               "Exit with code 1 when there is a finding of this severity or above: note, warning or "
               "error."));
    add(list, group,
        choice("--severity", "LEVEL", kSeverities, request.least_severity,
               "Leave out findings below this severity: note, warning or error. They are not shown, and "
               "do not count for the exit code."));
    add(list, group, ignoreOption(request.ignored));
    add(list, group,
        degrees("--angle", options.direction_deg, 180,
                "How far a tangent may lie outside the directions that the triangles around it give. In "
                "degrees, 0 to 180."));
    add(list, group,
        choice("--convention", "NAME", kConventions, options.convention,
               "Whose signs are right: gltf, opengl, directx, unreal, unity, blender or godot, as for "
               "generate."));
    add(list, group,
        choice("--faces", "FACES", kFaces, options.faces,
               "What tangents are compared with. auto: triangles, and quads where the tangents fit "
               "clearly better to those, as Blender's do; triangles, quads: only those."));
    add(list, group,
        numberOrAuto("--weld-distance", "DISTANCE", "a distance", options.weld_distance, NormalOptions::weld_auto,
                     1000000000,
                     "Positions that differ by no more than this in each coordinate are one, for winding, "
                     "borders of primitives and noise, in the unit of positions before "
                     "nodes move them. 0: only equal ones are. auto: twice the spacing of floats at the largest "
                     "coordinate of the mesh. Tangents are computed on positions as they are."));
    add(list, group, setting("--no-images", options.images, false, "Do not look at the pixels of normal maps."));
}

}  // namespace

OptionList checkOptions(CheckRequest& request) {
    OptionList list;
    CheckOptions& options = request.options;
    addAllowExternal(list, options.file);
    addChecking(list, request);
    addThreads(list, options.execution, "Number of threads for each file; 0: as many as there are cores.");
    addLimits(list, options.file);
    return list;
}

void leaveOut(const CheckRequest& request, CheckReport& report) {
    const auto is_unwanted = [&](const Finding& finding) {
        const auto& ignored = request.ignored;
        return finding.severity < request.least_severity ||
               std::find(ignored.begin(), ignored.end(), finding.code) != ignored.end();
    };
    std::erase_if(report.findings, is_unwanted);
    const auto count = [&](Severity severity) {
        return static_cast<std::uint64_t>(std::count_if(report.findings.begin(), report.findings.end(),
                                                        [&](const Finding& f) { return f.severity == severity; }));
    };
    report.error_count = count(Severity::error);
    report.warning_count = count(Severity::warning);
    report.note_count = count(Severity::note);
}

bool failsBy(const CheckRequest& request, const CheckReport& report) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [&](const Finding& finding) { return finding.severity >= request.fail_on; });
}

}  // namespace tspace::options
