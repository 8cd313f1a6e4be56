// SPDX-License-Identifier: MIT
// Table of frame encodings: tspace's formats and others. Errors over random frames, single-threaded times, and shader
// cost of decoding.
#include <fmt/core.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "codes.h"
#include "pictures.h"
#include "race.h"
#include "shaders/operation_counts.h"
#include "shaders/read_spirv.h"

namespace tspace::bench {

namespace {

using test::FrameList;

struct Errors {
    double worst_normal = 0, worst_tangent = 0, normal_sum = 0, tangent_sum = 0;
    std::size_t wrong_signs = 0, frames = 0;
};

Errors errorsOf(const Code& code, std::size_t frames) {
    test::RandomBits random(1);
    Errors errors;
    FrameList out;
    out.resize(kBatch);
    while (errors.frames < frames) {
        const FrameList in = test::randomFrames(random, kBatch);
        code.encode(in);
        code.decode(out);
        for (std::size_t i = 0; i < kBatch; ++i) {
            const Vec4 &before = in.tangents[i], &after = out.tangents[i];
            const double n = test::angleDeg(in.normals[i], out.normals[i]);
            const double t = test::angleDeg({before.x, before.y, before.z}, {after.x, after.y, after.z});
            errors.worst_normal = std::max(errors.worst_normal, n);
            errors.worst_tangent = std::max(errors.worst_tangent, t);
            errors.normal_sum += n;
            errors.tangent_sum += t;
            if (before.w != after.w) ++errors.wrong_signs;
        }
        errors.frames += kBatch;
    }
    return errors;
}

struct Times {
    double encode_ns = 0, decode_ns = 0;
};
Times timesOf(const Code& code, int rounds) {
    test::RandomBits random(1);
    const FrameList in = test::randomFrames(random, kBatch);
    FrameList out = in;
    Race race;
    const std::size_t encode = race.add([&] { code.encode(in); }), decode = race.add([&] { code.decode(out); });
    race.run(rounds);
    return {1e9 * race.best(encode) / kBatch, 1e9 * race.best(decode) / kBatch};
}

void printRow(const Code& code, const Errors& e, const Times& t, const std::string& cost) {
    const auto frames = static_cast<double>(e.frames);
    fmt::print("| {} | {} | {:.3g}; {:.3g} | {:.2g}; {:.2g} | {} | {:.1f}; {:.1f} | {} |\n", code.name, code.bytes,
               e.worst_normal, e.worst_tangent, e.normal_sum / frames, e.tangent_sum / frames, e.wrong_signs,
               t.encode_ns, t.decode_ns, cost);
}

bool writePicture(const std::string& path) {
    std::vector<Code> shown;
    for (const char* name :
         {"frame32", "oct32", "qtangent64", "snorm8_pair", "oct 10+10, angle 11", "smallest three 10+10+9"}) {
        for (Code& code : allCodes()) {
            if (code.name == name) shown.push_back(std::move(code));
        }
    }
    const Picture picture = differencePicture(shown, 128);
    return stbi_write_png(path.c_str(), picture.width, picture.height, 1, picture.gray.data(), picture.width) != 0;
}

}  // namespace

}  // namespace tspace::bench

int main(int argc, char** argv) {
    using namespace tspace::bench;
    CLI::App app("Codes of frames: errors, times, and what decoding costs a shader.");
    std::size_t frames = 10'000'000;
    int rounds = 31;
    app.add_option("--frames", frames, "Random frames for the errors.");
    app.add_option("--rounds", rounds, "How often each is timed; the best counts.")->check(CLI::Range(1, 1000));
    std::string picture_path;
    app.add_option("--picture", picture_path, "Only write a PNG: shaded with floats, then differences times 100.");
    CLI11_PARSE(app, argc, argv);
    if (!picture_path.empty()) return writePicture(picture_path) ? 0 : 4;

    const auto counts = tspace::shaders::countOperations(tspace::shaders::readSpirv("counted"));
    fmt::print(
        "Errors of N and T in degrees, over {} random frames. Times in ns per frame: one thread, the best of {}\n"
        "rounds. The formats of tspace use SIMD, replace invalid vectors and search for the best code; the others\n"
        "are plain C++ that rounds. Costs of the decoders in GLSL are instructions counted in SPIR-V.\n\n",
        frames, rounds);
    fmt::print(
        "| code | bytes | worst N; T | mean N; T | wrong signs | encode; decode ns | in a shader |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const Code& code : allCodes()) {
        const auto count = counts.find(code.function);
        printRow(code, errorsOf(code, frames), timesOf(code, rounds),
                 count == counts.end() ? "not counted: glslangValidator is missing" : count->second.text());
        std::fflush(stdout);
    }
    return 0;
}
