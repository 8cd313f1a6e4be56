// SPDX-License-Identifier: MIT
// Child process with two pipes. It confines itself before it reads the file (tools/tspace_import), and is killed if the
// waiting thread that started it ends.
#include "model/imported/import_document.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>
#include <utility>

#include "model/io/file_error.h"

namespace tspace {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() { close(); }

    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool isOpen() const { return number_ >= 0; }
    void close() {
        if (isOpen()) ::close(std::exchange(number_, -1));
    }

  private:
    int number_ = -1;
};

struct Pipe {
    Descriptor read_end, write_end;
};

/// Creates a pipe that programs started by other threads do not inherit (close-on-exec). Its descriptors are above 2
/// even if this program was started without stdin, stdout or stderr, because the child replaces those.
Pipe makePipe() {
    std::array<int, 2> ends = {-1, -1};
#ifdef __linux__
    const bool made = pipe2(ends.data(), O_CLOEXEC) == 0;
#else
    const bool made = pipe(ends.data()) == 0;
#endif
    Descriptor low_read(ends[0]), low_write(ends[1]);
    Pipe pipe;
    if (made) pipe = {Descriptor(fcntl(ends[0], F_DUPFD_CLOEXEC, 3)), Descriptor(fcntl(ends[1], F_DUPFD_CLOEXEC, 3))};
    if (!pipe.read_end.isOpen() || !pipe.write_end.isOpen())
        failFile(ErrorCode::cannotRead, "cannot create a pipe to the importer");
    return pipe;
}

/// Running process, killed by the destructor unless it was waited for.
class Child {
  public:
    explicit Child(pid_t number) : number_(number) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (has_ended_) return;
        kill(number_, SIGKILL);
        while (waitpid(number_, &status_, 0) < 0 && errno == EINTR) {
        }
    }

    [[nodiscard]] bool hasEnded() {
        if (has_ended_) return true;
        const pid_t done = waitpid(number_, &status_, WNOHANG);
        // Errors other than EINTR mean that SIGCHLD was set to be ignored by the parent of this program, so children
        // cannot be waited for.
        has_ended_ = done == number_ || (done < 0 && errno != EINTR);
        return has_ended_;
    }
    [[nodiscard]] int status() const { return status_; }

  private:
    pid_t number_;
    int status_ = 0;
    bool has_ended_ = false;
};

/// Starts a program with `result` as stdout, `messages` as stderr, default signals, and an empty environment.
pid_t start(const std::vector<std::string>& command, const Descriptor& result, const Descriptor& messages) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, result.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages.number(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, most;
    sigemptyset(&none);
    sigfillset(&most);
    sigdelset(&most, SIGKILL);
    sigdelset(&most, SIGSTOP);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &most);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    std::array<char*, 1> no_environment = {nullptr};
    pid_t child = 0;
    const int failed =
        posix_spawn(&child, arguments[0], &actions, &attributes, arguments.data(), no_environment.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        failFile(ErrorCode::unsupportedFile, "the importer " + pathInQuotes(command[0]) + " cannot be started");
    return child;
}

/// Reserves memory for the length that a GLB's header declares, but no more than `most`.
void reserveWhole(Bytes& glb, std::uint64_t most) {
    constexpr std::size_t kLengthEnd = 12;
    if (glb.size() < kLengthEnd) return;
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length |= std::uint64_t{glb[8 + i]} << (8 * i);
    glb.reserve(static_cast<std::size_t>(std::min(length, most)));
}

/// Reads until the child has closed both pipes. Stops early if the time or space limit is exceeded.
class Reader {
  public:
    Reader(Descriptor glb, Descriptor messages, std::uint64_t max_bytes)
        : glb_(std::move(glb)), messages_(std::move(messages)), max_bytes_(max_bytes) {}

    ImportEnd read(Clock::time_point end, const std::function<void()>& tick, ImportResult& result) {
        while (glb_.isOpen() || messages_.isOpen()) {
            if (Clock::now() >= end) return ImportEnd::outOfTime;
            // poll() skips closed pipes, whose descriptor is -1.
            std::array<pollfd, 2> polled = {pollfd{glb_.number(), POLLIN, 0}, pollfd{messages_.number(), POLLIN, 0}};
            if (poll(polled.data(), polled.size(), kTickMs) <= 0) {
                tick();
                continue;
            }
            if (polled[0].revents != 0) takeGlb(result.glb);
            if (polled[1].revents != 0) takeMessages(result.messages);
            if (result.glb.size() > max_bytes_) return ImportEnd::outOfSpace;
        }
        return ImportEnd::done;
    }

  private:
    /// Returns the available bytes; empty at the end of the pipe.
    std::span<const std::uint8_t> take(Descriptor& from) {
        const ssize_t count = ::read(from.number(), block_.data(), block_.size());
        if (count == 0 || (count < 0 && errno != EINTR)) from.close();
        return {block_.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
    }
    void takeGlb(Bytes& glb) {
        const bool is_first = glb.empty();
        const auto bytes = take(glb_);
        glb.insert(glb.end(), bytes.begin(), bytes.end());
        if (is_first) reserveWhole(glb, max_bytes_);
    }
    void takeMessages(std::string& messages) {
        const auto bytes = take(messages_);
        const std::size_t room = kMaxMessages - std::min(kMaxMessages, messages.size());
        messages.append(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(room, bytes.size())));
    }

    static constexpr int kTickMs = 50;
    static constexpr std::size_t kMaxMessages = std::size_t{64} << 10;
    Descriptor glb_, messages_;
    std::uint64_t max_bytes_;
    std::vector<std::uint8_t> block_ = std::vector<std::uint8_t>(std::size_t{64} << 10);  // the capacity of a pipe
};

/// Waits for the child to end. Returns false if the time limit is exceeded first.
bool waitForEnd(Child& child, Clock::time_point end, const std::function<void()>& tick) {
    for (auto pause = milliseconds(1); !child.hasEnded(); pause = std::min(pause * 2, milliseconds(20))) {
        if (Clock::now() >= end) return false;
        std::this_thread::sleep_for(pause);
        tick();
    }
    return true;
}

}  // namespace

ImportResult runImporter(const std::string& program, const std::string& path, bool keep_coordinates,
                         const ImportLimits& limits, const std::function<void()>& tick) {
    Pipe glb = makePipe(), messages = makePipe();
    const Clock::time_point end = Clock::now() + std::chrono::seconds(limits.seconds);
    Child child(start({program, path, std::to_string(limits.memory_bytes), std::to_string(limits.processor_seconds),
                       std::to_string(limits.seconds), std::to_string(getpid()),
                       limits.reads_anywhere ? "anywhere" : "folder", keep_coordinates ? "as-they-are" : "near-origin"},
                      glb.write_end, messages.write_end));
    glb.write_end.close();
    messages.write_end.close();
    ImportResult result;
    result.end =
        Reader(std::move(glb.read_end), std::move(messages.read_end), limits.memory_bytes).read(end, tick, result);
    if (result.end != ImportEnd::done) return result;
    if (!waitForEnd(child, end, tick)) {
        result.end = ImportEnd::outOfTime;
    } else if (WIFSIGNALED(child.status())) {
        const int signal = WTERMSIG(child.status());
        result.end = signal == SIGXCPU   ? ImportEnd::outOfProcessorTime
                     : signal == SIGALRM ? ImportEnd::outOfTime
                                         : ImportEnd::crashed;
    } else if (WEXITSTATUS(child.status()) != 0) {
        result.end = ImportEnd::refused;
    }
    return result;
}

}  // namespace tspace
