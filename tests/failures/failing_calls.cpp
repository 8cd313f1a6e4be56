// SPDX-License-Identifier: MIT
// Loaded into a program before the C library (LD_PRELOAD): makes calls fail, or sends a signal during a call.
//
// TSPACE_FAIL_CALL=K       the Kth call of the functions below fails, as on a faulty disk
// TSPACE_FAIL_MALLOC=K     the Kth allocation of the C library fails; TSPACE_FAIL_MALLOC_AFTER=1: further ones fail too
// TSPACE_NO_RESERVE=1      the C++ library does not get its emergency memory for exceptions
// TSPACE_FAIL_MARK=FILE    a program that has reached this call writes its number of allocations to FILE when it ends
// TSPACE_SIGNAL_AT_SYNC=N  signal N is raised when the first file is synced to disk
// TSPACE_SIGNAL_AFTER_COMMIT=N  signal N is raised once, when a folder is synced after its files were renamed
// TSPACE_NO_THREADS=1      no thread can be started
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> call_count = 0;

long numberOf(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? 0 : std::atol(text);
}

/// Counts a call and returns whether it must fail, with `why` as errno.
bool fails(int why) {
    static const long failing = numberOf("TSPACE_FAIL_CALL");
    if (++call_count != failing) return false;
    errno = why;
    return true;
}

std::atomic<long> allocation_count = 0;
long failing_allocation = 0;
bool allocations_fail_after = false, is_started = false;

[[gnu::constructor]] void readFailingAllocation() {
    failing_allocation = numberOf("TSPACE_FAIL_MALLOC");
    allocations_fail_after = numberOf("TSPACE_FAIL_MALLOC_AFTER") != 0;
    allocation_count = 0;
    is_started = true;
}

/// Returns whether this is the C++ library's reserve for exceptions: 73 KB, allocated in one block before this library
/// is initialized.
bool isReserve(size_t bytes) {
    constexpr size_t kLarge = 32768;
    return !is_started && bytes > kLarge && std::getenv("TSPACE_NO_RESERVE") != nullptr;
}

bool allocationFails() {
    if (failing_allocation == 0) return false;
    const long count = ++allocation_count;
    if (count != failing_allocation && !(allocations_fail_after && count > failing_allocation)) return false;
    errno = ENOMEM;
    return true;
}

template <class Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int openReal(const char* name, const char* path, int flags, va_list more) {
    const bool makes = (flags & O_CREAT) != 0;
    const mode_t mode = makes ? va_arg(more, mode_t) : 0;
    return real<int(const char*, int, mode_t)>(name)(path, flags, mode);
}

}  // namespace

extern "C" {

#ifdef __GLIBC__
void* __libc_malloc(size_t bytes);
void* __libc_calloc(size_t count, size_t bytes);
void* __libc_realloc(void* old, size_t bytes);
void* __libc_memalign(size_t alignment, size_t bytes);

void* malloc(size_t bytes) { return isReserve(bytes) || allocationFails() ? nullptr : __libc_malloc(bytes); }
void* calloc(size_t count, size_t bytes) { return allocationFails() ? nullptr : __libc_calloc(count, bytes); }
void* realloc(void* old, size_t bytes) { return allocationFails() ? nullptr : __libc_realloc(old, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) {
    return allocationFails() ? nullptr : __libc_memalign(alignment, bytes);
}
int posix_memalign(void** memory, size_t alignment, size_t bytes) {
    *memory = allocationFails() ? nullptr : __libc_memalign(alignment, bytes);
    return *memory == nullptr ? ENOMEM : 0;
}
#endif

// open and openat have a variable number of arguments.
int open(const char* path, int flags, ...) {
    if (fails(EIO)) return -1;
    va_list more;
    va_start(more, flags);
    const int number = openReal("open", path, flags, more);
    va_end(more);
    return number;
}
int open64(const char* path, int flags, ...) {
    if (fails(EIO)) return -1;
    va_list more;
    va_start(more, flags);
    const int number = openReal("open64", path, flags, more);
    va_end(more);
    return number;
}

#define TSPACE_FAILING(result, failure, why, name, parameters, arguments) \
    result name parameters {                                              \
        if (fails(why)) return failure;                                   \
        return real<result parameters>(#name) arguments;                  \
    }

TSPACE_FAILING(FILE*, nullptr, EIO, fopen, (const char* path, const char* mode), (path, mode))
TSPACE_FAILING(FILE*, nullptr, EIO, fopen64, (const char* path, const char* mode), (path, mode))
TSPACE_FAILING(FILE*, nullptr, ENOMEM, fdopen, (int number, const char* mode), (number, mode))
TSPACE_FAILING(size_t, 0, EIO, fread, (void* to, size_t bytes, size_t count, FILE* file), (to, bytes, count, file))
TSPACE_FAILING(size_t, 0, ENOSPC, fwrite, (const void* from, size_t bytes, size_t count, FILE* file),
               (from, bytes, count, file))
TSPACE_FAILING(int, EOF, ENOSPC, fflush, (FILE * file), (file))
TSPACE_FAILING(ssize_t, -1, EIO, pread, (int number, void* to, size_t bytes, off_t at), (number, to, bytes, at))
TSPACE_FAILING(ssize_t, -1, EIO, pread64, (int number, void* to, size_t bytes, off64_t at), (number, to, bytes, at))
TSPACE_FAILING(int, -1, EIO, rename, (const char* from, const char* to), (from, to))
TSPACE_FAILING(int, -1, EIO, link, (const char* from, const char* to), (from, to))
TSPACE_FAILING(int, -1, EIO, mkdir, (const char* path, mode_t mode), (path, mode))
TSPACE_FAILING(int, -1, EPERM, fchmod, (int number, mode_t mode), (number, mode))
TSPACE_FAILING(int, -1, EPERM, fchown, (int number, uid_t user, gid_t group), (number, user, group))
TSPACE_FAILING(int, -1, EIO, stat, (const char* path, struct stat* status), (path, status))
TSPACE_FAILING(int, -1, EIO, lstat, (const char* path, struct stat* status), (path, status))
TSPACE_FAILING(int, -1, EIO, fstat, (int number, struct stat* status), (number, status))

int fclose(FILE* file) {
    // If it must fail, close the file nevertheless, as the system does.
    const bool is_failing = fails(EIO);
    const int done = real<int(FILE*)>("fclose")(file);
    if (!is_failing) return done;
    errno = EIO;
    return EOF;
}

int fsync(int number) {
    static const int signal = static_cast<int>(numberOf("TSPACE_SIGNAL_AT_SYNC"));
    if (signal != 0) kill(getpid(), signal);
    static const int after_commit = static_cast<int>(numberOf("TSPACE_SIGNAL_AFTER_COMMIT"));
    static std::atomic<bool> was_sent = false;
    struct stat status = {};
    if (after_commit != 0 && real<int(int, struct stat*)>("fstat")(number, &status) == 0 && S_ISDIR(status.st_mode) &&
        !was_sent.exchange(true))
        kill(getpid(), after_commit);
    if (fails(EIO)) return -1;
    return real<int(int)>("fsync")(number);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument) {
    static const bool none = numberOf("TSPACE_NO_THREADS") != 0;
    if (none) return EAGAIN;
    return real<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create")(thread, attributes,
                                                                                                   body, argument);
}

[[gnu::destructor]] void tellWhetherReached() {
    const char* path = std::getenv("TSPACE_FAIL_MARK");
    const bool was_reached =
        failing_allocation != 0 ? allocation_count >= failing_allocation : call_count >= numberOf("TSPACE_FAIL_CALL");
    const long count = allocation_count;
    failing_allocation = 0;
    if (path == nullptr || !was_reached) return;
    const int file = real<int(const char*, int, mode_t)>("open")(path, O_WRONLY | O_CREAT, 0600);
    if (file < 0) return;
    dprintf(file, "%ld", count);
    close(file);
}

}  // extern "C"
