// SPDX-License-Identifier: MIT
// Reads and writes the lines of a manifest.
#include "manifest.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>

#include "commands/shared/report.h"
#include "console.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "model/io/temporary_files.h"
#include "model/io/uri.h"
#include "system.h"

namespace tspace::tool {
namespace {

constexpr const char* kSchema = "tspace.manifest/1";

std::string timeNow() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    char text[sizeof "2026-01-01T00:00:00Z"] = {};
    const std::tm utc = utcTime(now);
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

std::string keyOf(const Job& job) { return job.input + '\n' + job.output; }

bool isUtf8(const std::string& text) try {
    static_cast<void>(Json(text).dump());
    return true;
} catch (const JsonError&) {
    return false;
}

/// Adds a text that may not be valid UTF-8, such as a file name on Linux. JSON cannot represent it, so it is added as
/// NAMEEncoded, percent-encoded like URIs.
void addText(Json& object, const std::string& name, const std::string& text) {
    object[name] = text;
    if (!isUtf8(text)) object[name + "Encoded"] = percentEncode(text);
}

std::string textOf(const Json& object, const std::string& name) {
    const Json* encoded = object.find(name + "Encoded");
    return encoded != nullptr ? percentDecode(encoded->get<std::string>()) : object.at(name).get<std::string>();
}

Json filesJson(const std::vector<HashedFile>& files) {
    Json list = Json::array();
    for (const HashedFile& file : files) {
        Json entry = Json::object();
        addText(entry, "path", file.path);
        entry["bytes"] = file.hash.bytes;
        entry["hash"] = file.hash.hash;
        list.push_back(std::move(entry));
    }
    return list;
}

std::vector<HashedFile> filesFromJson(const Json& list) {
    std::vector<HashedFile> files;
    for (const Json& file : list) {
        files.push_back(
            {textOf(file, "path"), {file.at("bytes").get<std::uint64_t>(), file.at("hash").get<std::string>()}});
    }
    return files;
}

/// Parses a line of the manifest. Throws JsonError if a member is missing or has a wrong type.
ManifestEntry entryFromJson(const Json& line) {
    ManifestEntry entry;
    entry.version = line.at("version").get<std::string>();
    entry.options = textOf(line, "options");
    entry.job.input = textOf(line, "input");
    entry.job.output = textOf(line, "output");
    entry.job.error.code = line.at("ok").get<bool>() ? ErrorCode::ok : ErrorCode::internal;
    entry.inputs = filesFromJson(line.at("inputs"));
    entry.outputs = filesFromJson(line.at("outputs"));
    return entry;
}

bool areUnchanged(const std::vector<HashedFile>& files) {
    for (const HashedFile& file : files) {
        if (hashFile(file.path) != file.hash) return false;
    }
    return true;
}

Error fileError(ErrorCode code, const std::string& path) {
    return {code, std::string(code == ErrorCode::cannotRead ? "cannot read" : "cannot write") + " the manifest " +
                      path + ": " + std::strerror(errno)};
}

/// Returns whether lines may be appended: the file is missing or empty, or is a manifest, even one of a run that was
/// killed within its first line.
bool isManifest(const std::string& path) {
    constexpr std::string_view kBegin = R"({"schema":"tspace.manifest/)";
    constexpr std::size_t kSearchedBytes = std::size_t{1} << 16;
    std::ifstream file(std::filesystem::path(Path(path)), std::ios::binary);
    std::string found(kSearchedBytes, '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    found.resize(static_cast<std::size_t>(file.gcount()));
    return kBegin.starts_with(found) || found.find(kBegin) != std::string::npos;
}

/// Returns whether the last line is incomplete, because a run was killed while it wrote.
bool endsInsideALine(const std::string& path) {
    std::ifstream file(std::filesystem::path(Path(path)), std::ios::binary | std::ios::ate);
    if (!file || file.tellg() <= 0) return false;
    file.seekg(-1, std::ios::end);
    return file.get() != '\n';
}

}  // namespace

Result<ManifestRecord> ManifestRecord::read(const std::string& path) {
    ManifestRecord record;
    errno = 0;
    std::ifstream file(std::filesystem::path(Path(path)), std::ios::binary);
    if (!file) {
        if (errno == ENOENT) return record;
        return fileError(ErrorCode::cannotRead, path);
    }
    for (std::string text; std::getline(file, text);) {
        try {
            const Json line = Json::parse(text);
            if (line.at("schema") != kSchema) continue;
            ManifestEntry entry = entryFromJson(line);
            record.entries_[keyOf(entry.job)] = std::move(entry);
        } catch (const JsonError&) {
            continue;
        }
    }
    if (file.bad()) return fileError(ErrorCode::cannotRead, path);
    return record;
}

bool ManifestRecord::isDone(const Job& job, const std::string& options) const {
    const auto found = entries_.find(keyOf(job));
    if (found == entries_.end()) return false;
    const ManifestEntry& entry = found->second;
    return entry.job.error.code == ErrorCode::ok && entry.version == TSPACE_VERSION && entry.options == options &&
           !entry.outputs.empty() && areUnchanged(entry.inputs) && areUnchanged(entry.outputs);
}

Result<ManifestWriter> ManifestWriter::open(const std::string& path) {
    ManifestWriter writer;
    const auto refuse = [&](const char* why) {
        return Error{ErrorCode::cannotWrite, "cannot write the manifest " + path + ": " + why};
    };
    if (isForeignLink(path))
        return refuse("it is a symbolic link that another user created in a world-writable folder");
    const PathKind kind = kindOf(path);
    if (kind == PathKind::other) return refuse("it is neither a file nor a stream");
    if (kind == PathKind::file && !isManifest(path)) return refuse("the existing file is not a manifest");
    const bool needs_line_end = kind == PathKind::file && endsInsideALine(path);
    writer.path_ = path;
    std::error_code failed;
    std::filesystem::create_directories(std::filesystem::path(folderOf(path)), failed);
    writer.file_ = openFile(path, "ab");
    if (!writer.file_) return fileError(ErrorCode::cannotWrite, path);
    std::setvbuf(writer.file_.get(), nullptr, _IOFBF, std::size_t{1} << 20);
    if (needs_line_end) std::fputc('\n', writer.file_.get());
    return writer;
}

Result<Done> ManifestWriter::append(const ManifestEntry& entry) {
    const bool ok = entry.job.error.code == ErrorCode::ok;
    Json line = {{"schema", kSchema}, {"version", entry.version}, {"time", timeNow()}};
    addText(line, "options", entry.options);
    addText(line, "input", entry.job.input);
    addText(line, "output", entry.job.output);
    line["ok"] = ok;
    line["error"] = report::errorJson(ok ? nullptr : &entry.job.error);
    line["changed"] = entry.changed;
    line["seconds"] = entry.seconds;
    line["inputs"] = filesJson(entry.inputs);
    line["outputs"] = filesJson(entry.outputs);
    const std::string text = line.dump(-1, ' ', BadUtf8::replace) + "\n";
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0)
        return fileError(ErrorCode::cannotWrite, path_);
    return Done{};
}

Result<Done> BatchRecord::open(const BatchArguments& batch, const std::vector<Job>& jobs, bool is_dry_run) {
    if (!is_dry_run) {
        std::set<std::string> folders;
        for (const Job& job : jobs) {
            if (!job.output.empty() && job.output != "-") folders.insert(folderOf(job.output).string());
        }
        for (const std::string& folder : folders) removeAbandonedOnce(folder);
    }
    path_ = batch.manifest;
    if (path_.empty()) return Done{};
    if (batch.resume) {
        Result<ManifestRecord> record = ManifestRecord::read(path_);
        if (!record) return record.error();
        record_ = std::move(*record);
        for (const std::string& folder : outputFolders(jobs)) removeAbandonedFiles(folder);
    }
    Result<ManifestWriter> writer = ManifestWriter::open(path_);
    if (!writer) return writer.error();
    writer_.emplace(std::move(*writer));
    kept_.emplace(std::vector<std::string>{path_});
    return Done{};
}

report::ExitCode BatchRecord::append(const ManifestEntry& entry) {
    const std::lock_guard lock(mutex_);
    if (!writer_) return report::ExitCode::done;
    const Result<Done> written = writer_->append(entry);
    if (written) return report::ExitCode::done;
    writer_.reset();
    return printError(path_, written.error());
}

std::vector<HashedFile> hashFiles(const std::vector<std::string>& paths) {
    std::vector<HashedFile> files;
    for (const std::string& path : paths) {
        // Streams are skipped, because reading them would block.
        if (kindOf(path) == PathKind::stream) continue;
        if (const std::optional<FileHash> hash = hashFile(path)) files.push_back({path, *hash});
    }
    return files;
}

}  // namespace tspace::tool
