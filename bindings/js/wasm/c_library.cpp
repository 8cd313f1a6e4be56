// SPDX-License-Identifier: MIT
// Minimal versions of C library functions: JavaScript does the work, or no module needs the result. The library's
// functions take 30 KB.
#include <cstdarg>
#include <cstddef>
#include <ctime>

extern "C" {

/// Parses a JSON number whose syntax was checked before.
__attribute__((import_module("env"), import_name("parseNumber"))) double tspace_js_parseNumber(const char* text);
/// Repeated from exports.h, whose includes declare some functions below differently.
__attribute__((import_module("env"), import_name("endCall"), noreturn)) void tspace_js_endCall(int code);
/// Milliseconds since an arbitrary start.
__attribute__((import_module("env"), import_name("now"))) double tspace_js_now();

/// Called only by the JSON library, which has checked every character.
double strtod(const char* text, char** end) {
    if (end != nullptr) {
        *end = const_cast<char*>(text);
        while (**end != '\0') ++*end;
    }
    return tspace_js_parseNumber(text);
}
// Never called. Defined because otherwise the linker would use the C library's file, which defines strtod again.
float strtof(const char* text, char** end) { return static_cast<float>(strtod(text, end)); }
long double strtold(const char* text, char** end) { return strtod(text, end); }
double strtod_l(const char* text, char** end, void*) { return strtod(text, end); }
float strtof_l(const char* text, char** end, void*) { return strtof(text, end); }
long double strtold_l(const char* text, char** end, void*) { return strtold(text, end); }

/// Supports only the formats of the JSON library: four hexadecimal digits, "%04x" or "%.4X".
int snprintf(char* to, std::size_t size, const char* format, ...) {
    std::va_list numbers;
    va_start(numbers, format);
    std::size_t count = 0;
    const auto put = [&](char c) {
        if (count + 1 < size) to[count] = c;
        ++count;
    };
    for (; *format != '\0'; ++format) {
        if (*format != '%') {
            put(*format);
            continue;
        }
        format += 3;
        if (*format != 'x' && *format != 'X') tspace_js_endCall(11);
        const auto number = va_arg(numbers, unsigned);
        for (int shift = 12; shift >= 0; shift -= 4) put("0123456789abcdef"[number >> shift & 15]);
    }
    va_end(numbers);
    if (size != 0) to[count < size ? count : size - 1] = '\0';
    return static_cast<int>(count);
}

/// There are no environment variables.
char* getenv(const char*) { return nullptr; }

int clock_gettime(clockid_t, std::timespec* time) {
    const double now = tspace_js_now();
    time->tv_sec = static_cast<std::time_t>(now / 1000);
    time->tv_nsec = static_cast<long>((now - 1000.0 * static_cast<double>(time->tv_sec)) * 1e6);
    return 0;
}

}  // extern "C"
