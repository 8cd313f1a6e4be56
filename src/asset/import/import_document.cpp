// SPDX-License-Identifier: MIT
// A child process, its limits, and its result.
#include "asset/import/import_document.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "asset/file_error.h"
#include "asset/file_io.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

/// What Assimp 5 reads, but for OBJ and glTF, which tspace reads itself, and for formats without meshes or with parsers
/// that nobody maintains.
constexpr std::array kExtensions = {".3d",  ".3ds",     ".3mf", ".ac",   ".ase", ".b3d", ".blend", ".cob",
                                    ".dae", ".dxf",     ".fbx", ".hmp",  ".iqm", ".lwo", ".lws",   ".md2",
                                    ".md3", ".md5mesh", ".mdl", ".ms3d", ".ndo", ".nff", ".off",   ".ply",
                                    ".q3o", ".q3s",     ".smd", ".stl",  ".ter", ".x",   ".xgl",   ".zgl"};

/// A folder of its own for the result, removed with all in it.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "tspace-import-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) failFile(ErrorCode::cannotWrite, "cannot make a temporary folder");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] fs::path path(const char* name) const { return path_ / name; }

  private:
    fs::path path_;
};

/// Starts the importer with its messages in a file. Fails with unsupportedFile.
pid_t start(const std::vector<std::string>& command, const fs::path& messages) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::array<char*, 1> no_environment = {nullptr};
    pid_t child = 0;
    const int failed = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), no_environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        failFile(ErrorCode::unsupportedFile, "the importer " + pathInQuotes(command[0]) + " cannot be started");
    return child;
}

/// The child's status. After `seconds` it is killed, and `timed_out` is set.
int waitFor(pid_t child, unsigned seconds, bool& timed_out) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::seconds(seconds);
    auto pause = std::chrono::milliseconds(1);
    int status = 0;
    for (;;) {
        const pid_t done = waitpid(child, &status, WNOHANG);
        if (done == child || (done < 0 && errno != EINTR)) return status;
        if (Clock::now() > end) {
            timed_out = true;
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return status;
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(pause * 2, std::chrono::milliseconds(20));
    }
}

/// Fit to stand in a message.
std::string firstLine(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) return {};
    const Bytes bytes = readFile(path);
    const auto end = std::find(bytes.begin(), bytes.end(), '\n');
    constexpr std::size_t kMostBytes = 300;
    const std::string quoted = inQuotes(std::string(bytes.begin(), end), kMostBytes);
    return quoted.substr(1, quoted.size() - 2);
}

/// What the importer says of a file that it could read: its lines that begin with "warning: ".
void addWarnings(const fs::path& path, std::vector<std::string>& warnings) {
    constexpr std::string_view kMark = "warning: ";
    const Bytes bytes = readFile(path);
    for (auto begin = bytes.begin(); begin != bytes.end();) {
        const auto end = std::find(begin, bytes.end(), '\n');
        const std::string line(begin, end);
        if (line.starts_with(kMark)) warnings.push_back(line.substr(kMark.size()));
        begin = end == bytes.end() ? end : end + 1;
    }
}

}  // namespace

bool isImportedFormat(const fs::path& path) {
    const std::string extension = lowerExtension(path);
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

gltf::Document importDocument(const fs::path& path, const FileOptions& options) {
    if (options.importer.empty()) {
        failFile(ErrorCode::unsupportedFile, "reading " + lowerExtension(path) +
                                                 " files needs tspace-import, which is not there (see docs/import.md)");
    }
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || !fs::is_regular_file(path, error)) readFile(path);  // fails, and says why
    if (size > options.import_max_file_bytes) {
        failFile(ErrorCode::unsupportedFile, "the file is larger than the importer's limit of " +
                                                 std::to_string(options.import_max_file_bytes >> 20) + " MiB");
    }
    // A small file has no use for much memory; one that claims much is stopped early.
    constexpr std::uint64_t kAnyFile = std::uint64_t{192} << 20, kPerByte = 256;
    const std::uint64_t memory = options.memory_limit_bytes != 0
                                     ? options.memory_limit_bytes
                                     : std::min(options.import_max_memory_bytes, kAnyFile + kPerByte * size);
    const ScratchFolder scratch;
    const fs::path result = scratch.path("scene.glb"), messages = scratch.path("messages");
    bool timed_out = false;
    const pid_t child = start({options.importer, fs::absolute(path).string(), result.string(), std::to_string(memory),
                               std::to_string(options.import_max_seconds)},
                              messages);
    const int status = waitFor(child, options.import_max_seconds, timed_out);
    if (timed_out || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
        failFile(ErrorCode::invalidFile,
                 "the importer was stopped after " + std::to_string(options.import_max_seconds) + " s");
    }
    if (WIFSIGNALED(status)) failFile(ErrorCode::invalidFile, "the importer crashed on this file");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        const std::string why = firstLine(messages);
        failFile(ErrorCode::invalidFile, why.empty() ? "the importer cannot read it" : why);
    }
    gltf::Document document = gltf::parseDocument(readFile(result), path, options);
    document.input_bytes = static_cast<std::uint64_t>(size);
    document.imported = true;
    addWarnings(messages, document.warnings);
    return document;
}

}  // namespace tspace
