// SPDX-License-Identifier: MIT
// Runs a fuzz program without libFuzzer: fuzz_NAME SEEDS SECONDS. First runs every file below SEEDS unchanged, then
// files with random changes until the time limit. The order is deterministic. A crashing input is saved as
// "crash-input".
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

using Input = std::vector<std::uint8_t>;

Input current;

void keepInput() {
    std::ofstream("crash-input", std::ios::binary)
        .write(reinterpret_cast<const char*>(current.data()), static_cast<std::streamsize>(current.size()));
    std::fprintf(stderr, "fuzz: the input is in crash-input (%zu bytes)\n", current.size());
}

/// Saves the input when a signal arrives, for builds without sanitizers. The process ends afterwards, so the function
/// need not be signal-safe.
void keepInputOf(int signal) {
    keepInput();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void run(Input input) {
    current = std::move(input);
    LLVMFuzzerTestOneInput(current.data(), current.size());
}

class Mutator {
  public:
    explicit Mutator(const std::vector<Input>& seeds) : seeds_(seeds) {}

    Input next() {
        Input input = seeds_[below(seeds_.size())];
        for (std::size_t n = 1 + below(4); n > 0 && !input.empty(); --n) change(input);
        return input;
    }

  private:
    std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }

    void change(Input& input) {
        constexpr std::uint8_t kTelling[] = {0, 1, 2, 0x7f, 0x80, 0xff, '0', '9', '-', '"', '[', '{', ',', '\n'};
        const std::size_t at = below(input.size());
        const auto place = input.begin() + static_cast<std::ptrdiff_t>(at);
        switch (below(7)) {
            case 0: *place ^= static_cast<std::uint8_t>(1U << below(8)); break;
            case 1: *place = kTelling[below(std::size(kTelling))]; break;
            case 2: *place = static_cast<std::uint8_t>(random_()); break;
            case 3:
                input.erase(place, place + static_cast<std::ptrdiff_t>(
                                               1 + below(std::min<std::size_t>(input.size() - at, 16))));
                break;
            case 4: input.resize(at); break;
            case 5: {
                const Input piece(place, place + static_cast<std::ptrdiff_t>(
                                                     below(std::min<std::size_t>(input.size() - at, 32) + 1)));
                input.insert(input.begin() + static_cast<std::ptrdiff_t>(below(input.size() + 1)), piece.begin(),
                             piece.end());
                break;
            }
            default: {  // copies a part of another seed into the input
                const Input& other = seeds_[below(seeds_.size())];
                if (other.empty()) break;
                const std::size_t from = below(other.size()),
                                  count = below(std::min<std::size_t>(other.size() - from, 64) + 1);
                for (std::size_t i = 0; i < count && at + i < input.size(); ++i) input[at + i] = other[from + i];
            }
        }
    }

    const std::vector<Input>& seeds_;
    std::mt19937_64 random_{1};
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s SEEDS SECONDS\n", argv[0]);
        return 2;
    }
    if (__sanitizer_set_death_callback != nullptr) {
        __sanitizer_set_death_callback(keepInput);
    } else {
        for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS}) std::signal(signal, keepInputOf);
    }
    std::vector<Input> seeds;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[1])) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
        std::ifstream stream(file, std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    if (seeds.empty()) {
        std::fprintf(stderr, "fuzz: no seeds in %s\n", argv[1]);
        return 2;
    }
    for (const Input& seed : seeds) run(seed);
    Mutator mutator(seeds);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[2]));
    std::size_t count = 0;
    for (; std::chrono::steady_clock::now() < end; ++count) run(mutator.next());
    std::printf("%zu seeds and %zu changed inputs: no fault\n", seeds.size(), count);
    return 0;
}
