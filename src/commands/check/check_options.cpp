// SPDX-License-Identifier: MIT
// Options of a check: what is examined, and which findings are reported.
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
/// Returns the option whose value is one code, or several codes separated by commas.
Option ignoreOption(std::vector<FindingCode>& ignored) {
    const auto take = [&ignored](const std::string& name) {
        for (std::uint32_t code = 0; code < kFindingCodeCount; ++code) {
            if (name == findingName(static_cast<FindingCode>(code))) ignored.push_back(static_cast<FindingCode>(code));
        }
        return std::string();
    };
    Option made = option("--ignore", "CODE", take,
                         "Ignore findings with this code, such as tangentsUnused: they are not printed and do not "
                         "affect the exit code. Comma-separated; may be given several times.");
    for (std::uint32_t code = 0; code < kFindingCodeCount; ++code)
        made.choices.emplace_back(findingName(static_cast<FindingCode>(code)));
    made.is_repeatable = made.is_list = true;
    return made;
}

void addChecking(OptionList& list, CheckRequest& request) {
    const auto add = adder(list, "Checking");
    CheckOptions& options = request.options;
    add(choice("--fail-on", "LEVEL", kSeverities, request.fail_on,
               "Exit with code 1 if there is a finding of this severity or higher: note, warning or error."));
    add(choice("--severity", "LEVEL", kSeverities, request.min_severity,
               "Minimum severity to report: note, warning or error. Findings below it are not printed and do not "
               "affect the exit code."));
    add(ignoreOption(request.ignored));
    add(degrees("--angle", options.direction_deg, 180,
                "Tolerance in degrees, 0 to 180: how far a tangent may lie outside the range of directions that its "
                "adjacent triangles span."));
    add(choice("--convention", "NAME", kConventions, options.convention,
               "Expected sign convention: gltf, opengl, directx, unreal, unity, blender or godot, as in generate."));
    add(choice("--faces", "FACES", kFaces, options.faces,
               "Faces used to compute the tangents that stored tangents are compared with: triangles; quads; or auto: "
               "quads where the stored tangents clearly fit quads better, as in files from Blender, otherwise "
               "triangles."));
    add(weldOption(options.weld_distance,
                   "Weld distance, in mesh units (before node transforms): positions that differ by at most this "
                   "distance in each coordinate are welded for the checks of winding, primitive borders and noise. "
                   "0: only equal positions; auto: twice the float spacing at the largest coordinate of the mesh. "
                   "Tangents are always computed on the unwelded positions."));
    add(setting("--no-images", options.images, false, "Do not examine the pixels of normal maps."));
}

}  // namespace

OptionList checkOptions(CheckRequest& request) {
    OptionList list;
    CheckOptions& options = request.options;
    addAllowExternal(list, options.file);
    addChecking(list, request);
    addThreads(list, options.execution, "Number of threads per file; 0: one per core.");
    addLimits(list, options.file);
    return list;
}

void removeOmitted(const CheckRequest& request, CheckReport& report) {
    const auto is_unwanted = [&](const Finding& finding) {
        const auto& ignored = request.ignored;
        return finding.severity < request.min_severity ||
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

bool makesCheckFail(const CheckRequest& request, const CheckReport& report) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [&](const Finding& finding) { return finding.severity >= request.fail_on; });
}

}  // namespace tspace::options
