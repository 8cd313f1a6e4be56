// SPDX-License-Identifier: MIT
// Functions of the C library that JavaScript has, or that nobody needs: those of the library are 30 KB.
#include <cstddef>
#include <ctime>

extern "C" {

/// The number that a text of JSON spells, which is there and is right.
__attribute__((import_module("env"), import_name("parseNumber"))) double tspace_js_parseNumber(const char* text);
/// Milliseconds from some start.
__attribute__((import_module("env"), import_name("now"))) double tspace_js_now();

/// The JSON library is the only one that asks, and has looked at every character.
double strtod(const char* text, char** end) {
    if (end != nullptr) {
        *end = const_cast<char*>(text);
        while (**end != '\0') ++*end;
    }
    return tspace_js_parseNumber(text);
}
// The others of the same file of the C library, which would come along with it. They are not called.
float strtof(const char* text, char** end) { return static_cast<float>(strtod(text, end)); }
long double strtold(const char* text, char** end) { return strtod(text, end); }
double strtod_l(const char* text, char** end, void*) { return strtod(text, end); }
float strtof_l(const char* text, char** end, void*) { return strtof(text, end); }
long double strtold_l(const char* text, char** end, void*) { return strtold(text, end); }

/// Parts of messages of the JSON library, which tspace does not show.
int snprintf(char* to, std::size_t size, const char*, ...) {
    if (size != 0) *to = '\0';
    return 0;
}

/// There is no environment.
char* getenv(const char*) { return nullptr; }

int clock_gettime(clockid_t, std::timespec* time) {
    const double now = tspace_js_now();
    time->tv_sec = static_cast<std::time_t>(now / 1000);
    time->tv_nsec = static_cast<long>((now - 1000.0 * static_cast<double>(time->tv_sec)) * 1e6);
    return 0;
}

}  // extern "C"
