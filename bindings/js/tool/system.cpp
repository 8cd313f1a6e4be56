// SPDX-License-Identifier: MIT
// Functions of the C library that emscripten only emulates: system.js (bindings/js/bin) implements them with node. Also
// starts the program: main() runs in a separate thread, so that the first thread can handle signals.
#include <dirent.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <ctime>

// Offsets, sizes and flags that system.js uses as numbers.
static_assert(offsetof(struct stat, st_dev) == 0 && offsetof(struct stat, st_mode) == 12 &&
              offsetof(struct stat, st_nlink) == 16);
static_assert(offsetof(struct stat, st_uid) == 20 && offsetof(struct stat, st_gid) == 24 &&
              offsetof(struct stat, st_size) == 40);
static_assert(offsetof(struct stat, st_mtim) == 64 && offsetof(struct stat, st_ino) == 80 && sizeof(struct stat) == 88);
static_assert(sizeof(struct timespec) == 8 && sizeof(struct dirent) == 280);
static_assert(offsetof(struct dirent, d_reclen) == 16 && offsetof(struct dirent, d_type) == 18 &&
              offsetof(struct dirent, d_name) == 19);
static_assert(O_CREAT == 64 && O_EXCL == 128 && O_TRUNC == 512 && O_APPEND == 1024 && O_DIRECTORY == 65536 &&
              O_NOFOLLOW == 131072);

#define TSPACE_HOST(name) __attribute__((import_module("env"), import_name(#name)))
#define TSPACE_EXPORT(name) __attribute__((export_name(#name)))

extern "C" {

/// main(), which C++ code must not call by this name.
int tspace_main(int argc, char** argv) __asm__("main");

/// Returns 0, or a negative error number.
TSPACE_HOST(makeLink) int tspace_makeLink(const char* from, const char* to);
TSPACE_HOST(sendSignal) int tspace_sendSignal(int process, int signal);
TSPACE_HOST(processNumber) int tspace_processNumber();
TSPACE_HOST(userNumber) unsigned tspace_userNumber();
/// Fills a text of at most `size` bytes, including its terminator.
TSPACE_HOST(hostName) void tspace_hostName(char* name, std::size_t size);
/// Fills memory with unpredictable bytes.
TSPACE_HOST(fillRandom) void tspace_fillRandom(void* to, std::size_t size);
/// Runs start(argument) in a thread identified by `thread`; returns 0, or an error number.
TSPACE_HOST(startThread)
int tspace_startThread(pthread_t thread, void* stack_end, void* (*start)(void*), void* argument);
TSPACE_HOST(endProgram) __attribute__((noreturn)) void tspace_endProgram(int code);

static int resultOf(int result) {
    if (result >= 0) return result;
    errno = -result;
    return -1;
}

int link(const char* from, const char* to) { return resultOf(tspace_makeLink(from, to)); }
int kill(pid_t process, int signal) { return resultOf(tspace_sendSignal(process, signal)); }
uid_t geteuid() { return tspace_userNumber(); }
int gethostname(char* name, std::size_t size) {
    tspace_hostName(name, size);
    return 0;
}
int getentropy(void* to, std::size_t size) {
    tspace_fillRandom(to, size);
    return 0;
}
long __syscall_getpid() { return tspace_processNumber(); }
void __call_sighandler(void (*handler)(int), int signal) { handler(signal); }
void _exit(int code) { tspace_endProgram(code); }

/// Always fails, because address space cannot be reserved: the C library would allocate memory instead. Arenas then
/// take their blocks from the heap.
void* mmap(void*, std::size_t, int, int, int, off_t) {
    errno = ENOMEM;
    return MAP_FAILED;
}
int munmap(void*, std::size_t) { return 0; }

/// Always fails, because no timer can raise a signal; the tool then ends at the first signal.
int setitimer(int, const struct itimerval*, struct itimerval*) {
    errno = ENOSYS;
    return -1;
}

/// Computes the UTC date from the days since 1970, with years that start in March (Howard Hinnant, "chrono-compatible
/// low-level date algorithms", 2021).
struct tm* gmtime_r(const time_t* time, struct tm* utc) {
    constexpr long kDay = 86400, kDaysOf400Years = 146097;
    long days = *time / kDay, rest = *time % kDay;
    if (rest < 0) {
        rest += kDay;
        --days;
    }
    const long shifted = days + 719468;  // since 0000-03-01
    const long era = (shifted >= 0 ? shifted : shifted - kDaysOf400Years + 1) / kDaysOf400Years;
    const long of_era = shifted - era * kDaysOf400Years;
    const long year_of_era = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
    const long of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    const long month = (5 * of_year + 2) / 153;
    *utc = {};
    utc->tm_mday = static_cast<int>(of_year - (153 * month + 2) / 5 + 1);
    utc->tm_mon = static_cast<int>(month < 10 ? month + 2 : month - 10);
    utc->tm_year = static_cast<int>(year_of_era + era * 400 + (utc->tm_mon < 2 ? 1 : 0) - 1900);
    utc->tm_hour = static_cast<int>(rest / 3600);
    utc->tm_min = static_cast<int>(rest / 60 % 60);
    utc->tm_sec = static_cast<int>(rest % 60);
    return utc;
}

/// Supports only the formats that the tool prints: years, months, days, hours, minutes and seconds as digits.
std::size_t strftime(char* to, std::size_t size, const char* format, const struct tm* time) {
    std::size_t count = 0;
    const auto put = [&](char c) {
        if (count < size) to[count] = c;
        ++count;
    };
    for (; *format != '\0'; ++format) {
        if (*format != '%') {
            put(*format);
            continue;
        }
        int number = 0, digits = 2;
        switch (*++format) {
            case 'Y':
                number = time->tm_year + 1900;
                digits = 4;
                break;
            case 'm': number = time->tm_mon + 1; break;
            case 'd': number = time->tm_mday; break;
            case 'H': number = time->tm_hour; break;
            case 'M': number = time->tm_min; break;
            default: number = time->tm_sec; break;
        }
        int unit = 1;
        for (int i = 1; i < digits; ++i) unit *= 10;
        for (; unit != 0; unit /= 10) put(static_cast<char>('0' + number / unit % 10));
    }
    put('\0');
    return count <= size ? count - 1 : 0;
}
/// Used by the C++ library's locales, which format no times here.
std::size_t strftime_l(char* to, std::size_t size, const char* format, const struct tm* time, locale_t) {
    return strftime(to, size, format, time);
}

struct Arguments {
    int count;
    char** words;
};

static void* runMain(void* words) {
    const Arguments arguments = *static_cast<Arguments*>(words);
    const int code = tspace_main(arguments.count, arguments.words);
    std::fflush(nullptr);
    tspace_endProgram(code);
}

/// Starts main(). Returns false if no thread can be created.
TSPACE_EXPORT(startMain) bool tspace_startMain(int count, char** words) {
    static Arguments arguments;
    arguments = {count, words};
    pthread_t thread;
    return pthread_create(&thread, nullptr, runMain, &arguments) == 0;
}

/// Called by pthread_create(), which has allocated the thread's stack.
int __pthread_create_js(pthread_t thread, const pthread_attr_t*, void* (*start)(void*), void* argument) {
    pthread_attr_t made;
    void* stack = nullptr;
    std::size_t size = 0;
    pthread_getattr_np(thread, &made);
    pthread_attr_getstack(&made, &stack, &size);
    return tspace_startThread(thread, static_cast<char*>(stack) + size, start, argument);
}
int _emscripten_default_pthread_stack_size() { return 4 << 20; }

}  // extern "C"
