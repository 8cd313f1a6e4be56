// SPDX-License-Identifier: MIT
// Packing and unpacking of frames, compared with copying them.
#include <cstring>

#include "core/pack/format_names.h"
#include "core/pack/random_frames.h"
#include "race.h"
#include "rows.h"
#include "tspace/pack.h"

namespace tspace::bench {

namespace {

constexpr std::size_t kFrames = 16384;  ///< small enough for the L2 cache
constexpr double kPackAsked = 60, kUnpackAsked = 3;

const test::FrameList& someFrames() {
    static const test::FrameList frames = [] {
        test::RandomBits random(1);
        return test::randomFrames(random, kFrames);
    }();
    return frames;
}

RowResult runPacking(const std::string& title, FrameFormat format, bool unpack, Lab& lab) {
    RowResult row{.title = title, .unit = " ns"};
    const test::FrameList& frames = someFrames();
    test::FrameList out = frames;
    std::vector<std::byte> bytes(kFrames * frameBytes(format));
    row.wrong = !packFrames(frames.normals, frames.tangents, format, bytes);
    Race race;
    const std::size_t runner = race.add([&] {
        const bool done = unpack ? unpackFrames(bytes, format, out.normals, out.tangents).ok()
                                 : packFrames(frames.normals, frames.tangents, format, bytes).ok();
        row.wrong = row.wrong || !done;
    });
    const std::size_t copy = race.add([&] {
        std::memcpy(out.normals.data(), frames.normals.data(), kFrames * sizeof(Vec3));
        std::memcpy(out.tangents.data(), frames.tangents.data(), kFrames * sizeof(Vec4));
        asm volatile("" ::: "memory");  // prevents the copies from being optimized away
    });
    race.run(lab.rounds());
    const auto ns = [&](std::size_t which) { return 1e9 * race.best(which) / kFrames; };
    row.one_thread.value = ns(runner);
    row.one_thread.asked = unpack ? kUnpackAsked : kPackAsked;
    row.note = "for comparison, copying the 28 bytes of a frame takes " + std::to_string(ns(copy)).substr(0, 4) + " ns";
    return row;
}

}  // namespace

std::vector<Row> packRows() {
    std::vector<Row> rows;
    for (const bool unpack : {false, true}) {
        for (std::uint32_t f = 0; f < std::size(test::kFormatNames); ++f) {
            const std::string title = std::string(unpack ? "unpack `" : "pack `") + test::kFormatNames[f] + "`";
            rows.push_back({title, [=](Lab& lab) { return runPacking(title, FrameFormat{f}, unpack, lab); }});
        }
    }
    return rows;
}

}  // namespace tspace::bench
