// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fnmatch.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>

#include "system.h"

namespace tspace::tool {

void openStandardStreams() {
    // Replaces closed standard streams by /dev/null, opened in the opposite direction (stdin write-only, stdout and
    // stderr read-only), so that reading or writing fails. open() returns the lowest free descriptor, which is
    // `number`.
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
        if (fcntl(number, F_GETFD) != -1 || errno != EBADF) continue;
        if (open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) open("/", O_RDONLY);
    }
}

std::vector<char*> commandLine(int argc, char** argv) { return {argv, argv + argc}; }

bool isTerminal(std::FILE* file) { return isatty(fileno(file)) != 0; }

std::size_t terminalColumns(std::FILE* file) {
    winsize size = {};
    return ioctl(fileno(file), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool terminalHasColors() {
    const char* terminal = std::getenv("TERM");
    return terminal != nullptr && std::string_view(terminal) != "dumb";
}

bool matchesName(const std::string& pattern, const std::string& name) {
    return fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0;
}

std::tm utcTime(std::time_t time) {
    std::tm utc = {};
    gmtime_r(&time, &utc);
    return utc;
}

}  // namespace tspace::tool
