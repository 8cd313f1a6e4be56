// SPDX-License-Identifier: MIT
// Processor name; compiler and flags at build time.
#include "machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "tspace/version.h"

namespace tspace::bench {

namespace {

std::string cpuName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

#ifdef __clang__
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "gcc " __VERSION__;
#endif

}  // namespace

nlohmann::ordered_json machineJson() {
    return {{"tspace", TSPACE_VERSION_STRING},
            {"cpu", cpuName()},
            {"cores", std::thread::hardware_concurrency()},
            {"compiler", kCompiler},
            {"flags", TSPACE_BENCH_FLAGS}};
}

std::string machineText() {
    return fmt::format("{}, {} cores, {}, {}; tspace {}", cpuName(), std::thread::hardware_concurrency(), kCompiler,
                       TSPACE_BENCH_FLAGS, TSPACE_VERSION_STRING);
}

}  // namespace tspace::bench
