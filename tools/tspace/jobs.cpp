// SPDX-License-Identifier: MIT
// Determines the files to process and their outputs. Reads the file system, but writes nothing.
#include "jobs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "glob.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "system.h"

namespace tspace::tool {
namespace {

namespace fs = std::filesystem;

/// Returns a canonical name of a file, also for files that do not exist yet.
std::string canonicalName(const fs::path& path) try {
    return canonicalPath(path).string();
} catch (const fs::filesystem_error&) {
    return Path(fs::absolute(path).lexically_normal()).string();
}

struct Found {
    Job job;
    fs::path relative;  // path relative to its folder; for files named on the command line: the file name
};

/// Lists files that `is_wanted` accepts in `folder` and below, except those in `skipped_folder` (the output folder). If
/// a folder cannot be read, only its files are missing.
void listFiles(const fs::path& folder, bool (*is_wanted)(const std::string&), const std::string& skipped_folder,
               std::vector<fs::path>& files, std::vector<Found>& failures) {
    std::vector<fs::path> folders;
    std::vector<FolderEntry> entries;
    const int failed = listFolder(folder, entries);
    for (const FolderEntry& entry : entries) {
        const fs::path path = folder / fs::path(Path(entry.name));
        if (entry.kind == PathKind::folder) {
            // Links to folders are skipped, because they may form a cycle.
            if (!entry.is_link) folders.push_back(path);
        } else if (entry.kind == PathKind::file && is_wanted(Path(path).string())) {
            files.push_back(path);
        }
    }
    if (failed != 0) {
        failures.push_back(
            {{.input = Path(folder).string(),
              .error = {ErrorCode::cannotRead, std::string("cannot read the folder: ") + std::strerror(failed)}},
             {}});
    }
    for (const fs::path& below : folders) {
        if (skipped_folder.empty() || canonicalName(below) != skipped_folder)
            listFiles(below, is_wanted, skipped_folder, files, failures);
    }
}

bool isImageFile(const std::string& path) { return isImageName(path); }

Found foundBelow(const fs::path& root, const fs::path& file, bool is_image) {
    const fs::path relative = file.lexically_relative(root);
    return {{.input = Path(file).string(), .name = Path(relative).string(), .is_found_image = is_image}, relative};
}

void findFiles(const fs::path& folder, const std::string& skipped_folder, SearchedFiles searched,
               std::vector<Found>& found) {
    std::vector<fs::path> files;
    std::vector<Found> failures;
    listFiles(folder, isModelFile, skipped_folder, files, failures);
    const bool are_images = searched == SearchedFiles::modelsOrImages && files.empty() && failures.empty();
    if (are_images) listFiles(folder, isImageFile, skipped_folder, files, failures);
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) found.push_back(foundBelow(folder, file, are_images));
    if (files.empty() && failures.empty()) {
        const char* message =
            are_images ? "this folder contains no model files and no images" : "this folder contains no model files";
        found.push_back({{.input = Path(folder).string(), .error = {ErrorCode::invalidFile, message}}, {}});
    }
    std::move(failures.begin(), failures.end(), std::back_inserter(found));
}

/// Finds matching model files, or images if there are none. The output folder is not skipped, because the pattern is
/// explicit.
void findMatches(const std::string& pattern, SearchedFiles searched, std::vector<Found>& found) {
    const fs::path root = patternRoot(pattern);
    std::vector<Found> models, images;
    for (const fs::path& match : matchPattern(pattern)) {
        if (isModelFile(Path(match).string())) {
            models.push_back(foundBelow(root, match, false));
        } else if (isImageFile(Path(match).string())) {
            images.push_back(foundBelow(root, match, true));
        }
    }
    const bool with_images = searched == SearchedFiles::modelsOrImages;
    std::vector<Found>& matches = models.empty() && with_images ? images : models;
    if (matches.empty()) {
        const char* message =
            with_images ? "no model file or image matches this pattern" : "no model file matches this pattern";
        found.push_back({{.input = pattern, .error = {ErrorCode::cannotRead, message}}, {}});
    }
    std::move(matches.begin(), matches.end(), std::back_inserter(found));
}

bool isPatternInput(const std::string& input) { return isPattern(input) && !isThere(input); }

std::vector<Found> findInputs(const std::vector<std::string>& inputs, const std::string& skipped_folder,
                              SearchedFiles searched = SearchedFiles::models) {
    std::vector<Found> found;
    for (const std::string& input : inputs) {
        if (isFolder(input)) {
            findFiles(Path(input), skipped_folder, searched, found);
        } else if (isPatternInput(input)) {
            findMatches(input, searched, found);
        } else {
            found.push_back({{.input = input, .name = input}, fs::path(Path(input)).filename()});
        }
    }
    return found;
}

const char* extensionFor(Container container, const Path& input) {
    const std::string extension = lowerExtension(input);
    if (container == Container::gltf) return ".gltf";
    if (extension == ".vrm") return ".vrm";
    return container == Container::sameAsInput && extension == ".gltf" ? ".gltf" : ".glb";
}

Error usage(std::string message) { return {ErrorCode::invalidOption, std::move(message)}; }

Result<std::vector<Job>> jobsInPlace(const JobRequest& request) {
    std::vector<Job> jobs = inputJobs(request.inputs);
    // A model that is named twice is processed once.
    std::set<std::string> named;
    std::erase_if(jobs, [&](const Job& job) {
        return job.error.code == ErrorCode::ok && job.input != "-" && !named.insert(identityOf(job.input)).second;
    });
    for (Job& job : jobs) {
        job.output = job.input;
        if (job.input == "-") return usage("--in-place cannot be used with standard input");
        if (!isGltfName(job.input) && job.error.code == ErrorCode::ok && !lowerExtension(job.input).empty())
            job.error = usage("only .glb, .vrm and .gltf files can be overwritten in place; use -o to write a .glb");
    }
    return jobs;
}

Result<std::vector<Job>> jobWithNamedOutput(const JobRequest& request) {
    Job job{.input = request.inputs.front(), .output = request.output, .name = request.inputs.front()};
    const std::string extension = lowerExtension(job.output);
    const bool is_glb = isGlbOutput(job.output);
    if (is_glb && !isGlbName(job.output)) {
        // A stream keeps its name, without an added extension.
        if (request.container == Container::gltf) return usage("only a GLB can be written to a stream: " + job.output);
        return std::vector<Job>{std::move(job)};
    }
    if (extension.empty()) {
        job.output += extensionFor(request.container, job.input);
        job.remark = "the output has no extension, so it is written to the file " + job.output +
                     "; to write into a "
                     "folder, use " +
                     request.output + "/";
    } else if (!isGltfName(job.output)) {
        return usage("the output '" + job.output + "' must end in .glb, .vrm or .gltf");
    } else if (request.container != Container::sameAsInput && is_glb != (request.container == Container::glb)) {
        return usage("--container contradicts the extension of the output: " + job.output);
    }
    if (identityOf(job.output) == identityOf(job.input))
        return usage("the output " + job.output + " is the input; use --in-place to overwrite it");
    return std::vector<Job>{std::move(job)};
}

/// Returns the job for a single model that is written to stdout.
Result<std::vector<Job>> jobToStandardOutput(const JobRequest& request, bool has_several) {
    if (has_several) return usage("only one model can be written to stdout");
    if (request.container == Container::gltf)
        return usage("only a GLB can be written to stdout, so --container gltf cannot be used with -o -");
    if (request.has_manifest) return usage("--manifest cannot be used if the output is stdout");
    if (!request.is_dry_run && isTerminal(stdout))
        return usage("a model cannot be printed on a terminal; redirect stdout to a file or a pipe");
    const std::string& input = request.inputs.front();
    return std::vector<Job>{{.input = input, .output = "-", .name = input}};
}

Result<std::vector<Job>> jobsIntoFolder(const JobRequest& request) {
    const fs::path folder = Path(request.output);
    std::map<std::string, std::string> writers;  // input path of each canonical output path
    std::set<std::string> inputs;                // identities of the input files
    std::vector<Found> found = findInputs(request.inputs, canonicalName(folder));
    for (const Found& item : found) inputs.insert(identityOf(item.job.input));
    std::vector<Job> jobs;
    for (Found& item : found) {
        Job& job = item.job;
        if (job.input == "-") return usage("the output of a model from standard input must be named with -o");
        if (job.error.code == ErrorCode::ok) {
            const char* extension = extensionFor(request.container, job.input);
            fs::path relative = item.relative;
            job.output = Path(folder / relative.replace_extension(extension)).string();
            // If a.glb and a.obj are in the same folder, the second one becomes a.obj.glb.
            const auto taken = writers.find(canonicalName(job.output));
            if (taken != writers.end() && lowerExtension(taken->second) != lowerExtension(job.input))
                job.output = Path(folder / item.relative).string() + extension;
            const std::string name = canonicalName(job.output);
            const auto [writer, is_new] = writers.emplace(name, job.input);
            if (inputs.count(identityOf(job.output)) != 0) {
                job.error =
                    usage("the output " + job.output + " is one of the inputs; use another folder or --in-place");
            } else if (!is_new) {
                job.error = usage("the output " + job.output + " is already the output of " + writer->second);
            }
        }
        jobs.push_back(std::move(job));
    }
    return jobs;
}

}  // namespace

std::string importerPath() {
    const Path own = ownProgram();
    if (own.empty()) return {};
    const Path importer = folderOf(own) / "tspace-import";
    return isThere(importer) ? importer.string() : std::string();
}

bool isModelFile(const std::string& path) {
    const std::string extension = lowerExtension(path);
    if (isGltfName(path) || extension == ".obj") return true;
    static const bool has_importer = !importerPath().empty();
    constexpr std::array kImported = {".fbx", ".ply", ".stl", ".dae", ".3ds"};
    return has_importer && std::find(kImported.begin(), kImported.end(), extension) != kImported.end();
}

std::vector<std::string> outputFolders(const std::vector<Job>& jobs) {
    std::set<std::string> sorted;
    for (const Job& job : jobs) {
        if (!job.output.empty()) sorted.insert(Path(fs::path(folderOf(canonicalName(job.output))) / "").string());
    }
    // Subfolders directly follow their parent folder.
    std::vector<std::string> folders;
    for (const std::string& folder : sorted) {
        if (folders.empty() || !folder.starts_with(folders.back())) folders.push_back(folder);
    }
    return folders;
}

std::vector<Job> inputJobs(const std::vector<std::string>& inputs, SearchedFiles searched) {
    std::vector<Job> jobs;
    for (Found& item : findInputs(inputs, "", searched)) jobs.push_back(std::move(item.job));
    return jobs;
}

Result<std::vector<Job>> generateJobs(const JobRequest& request) {
    const std::string& output = request.output;
    if (request.in_place && !output.empty()) return usage("--in-place and -o cannot be used together");
    if (request.in_place) return jobsInPlace(request);
    if (output.empty())
        return usage(
            "--output is missing: use -o OUT, or --in-place to overwrite the inputs (see tspace generate --help)");

    const bool several = request.has_list || request.inputs.size() > 1 || isFolder(request.inputs.front()) ||
                         isPatternInput(request.inputs.front());
    if (output == "-") return jobToStandardOutput(request, several);
    const bool is_file = isThere(output) && !isFolder(output);
    if (several && (is_file || (isGltfName(output) && !isFolder(output)))) {
        const bool is_search = !request.has_list && request.inputs.size() == 1;
        return usage(std::string("with ") + (is_search ? "a folder or a pattern as input" : "several inputs") +
                     " the output must be a folder, not " + output);
    }
    if (several || isFolder(output) || fs::path(Path(output)).filename().empty()) return jobsIntoFolder(request);
    return jobWithNamedOutput(request);
}

}  // namespace tspace::tool
