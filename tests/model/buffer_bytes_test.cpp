// SPDX-License-Identifier: MIT
#include "model/gltf/buffer_bytes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace tspace::gltf {
namespace {

Bytes anyBytes() {
    const auto values = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
    return Bytes(values.begin(), values.end());
}

Bytes flat(const std::vector<OutputPiece>& pieces) {
    Bytes all;
    for (const OutputPiece& piece : pieces) {
        Bytes made(piece.maker ? piece.size() : 0);
        if (piece.maker) piece.maker->make(0, made);
        const std::span<const std::uint8_t> bytes = piece.maker ? made : piece.bytes;
        all.insert(all.end(), bytes.begin(), bytes.end());
    }
    return all;
}

/// A source of bytes that returns copies of existing ones.
class Copying final : public ByteMaker {
  public:
    explicit Copying(Bytes bytes) : bytes_(std::move(bytes)) {}
    [[nodiscard]] std::size_t size() const override { return bytes_.size(); }
    void make(std::size_t begin, std::span<std::uint8_t> to) const override {
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(begin), to.size(), to.begin());
    }

  private:
    Bytes bytes_;
};

RC_GTEST_PROP(BufferBytes, EqualsAContiguousArray, ()) {
    Bytes outside = anyBytes();
    Bytes expected = outside;
    BufferBytes bytes(std::span<std::uint8_t>{outside});
    std::vector<std::size_t> begins, counts;
    const auto steps = *rc::gen::inRange(0, 6);
    for (int step = 0; step < steps; ++step) {
        const Bytes added = anyBytes();
        const auto alignment = *rc::gen::element<std::size_t>(1, 4, 8);
        expected.resize((expected.size() + alignment - 1) / alignment * alignment, 0);
        begins.push_back(expected.size());
        counts.push_back(added.size());
        expected.insert(expected.end(), added.begin(), added.end());
        const auto kind = *rc::gen::inRange(0, 3);
        if (kind == 0) {
            RC_ASSERT(bytes.append(added, alignment) == begins.back());
        } else if (kind == 1) {
            RC_ASSERT(bytes.append(std::make_shared<Copying>(added), alignment) == begins.back());
        } else {
            using Kept = KeptBytes<std::uint8_t>;
            const auto kept = std::make_shared<Kept>(std::vector<std::uint8_t>(added.begin(), added.end()));
            RC_ASSERT(bytes.append(kept, alignment) == begins.back());
        }
    }
    RC_ASSERT(flat(bytes.pieces()) == expected);
    if (*rc::gen::arbitrary<bool>()) bytes.makeAll();
    RC_ASSERT(bytes.size() == expected.size());
    RC_ASSERT(bytes.joined() == expected);
    RC_ASSERT(flat(bytes.pieces()) == expected);
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const auto range = bytes.range(begins[i], counts[i]);
        RC_ASSERT(std::equal(range.begin(), range.end(), expected.begin() + static_cast<std::ptrdiff_t>(begins[i])));
    }

    auto ends = *rc::gen::container<std::vector<std::size_t>>(2 * *rc::gen::inRange<std::size_t>(0, 5),
                                                              rc::gen::inRange<std::size_t>(0, expected.size() + 1));
    std::sort(ends.begin(), ends.end());
    std::vector<ByteCut> cuts;
    for (std::size_t i = 0; i < ends.size(); i += 2) cuts.push_back({ends[i], ends[i + 1]});
    for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut) {
        expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(cut->begin),
                       expected.begin() + static_cast<std::ptrdiff_t>(cut->end));
    }
    bytes.cut(cuts);
    RC_ASSERT(bytes.size() == expected.size());
    RC_ASSERT(bytes.joined() == expected);
}

TEST(BufferBytes, AreWrittenAtTheirOffsets) {
    Bytes outside{1, 2, 3, 4};
    BufferBytes bytes(std::span<std::uint8_t>{outside});
    bytes.append({5, 6}, 1);
    bytes.range(1, 2)[0] = 20;
    bytes.range(5, 1)[0] = 60;
    EXPECT_EQ(outside, (Bytes{1, 20, 3, 4}));
    EXPECT_EQ(bytes.joined(), (Bytes{1, 20, 3, 4, 5, 60}));
}

TEST(BufferBytes, KeptBytesAreWrittenFromTheInput) {
    std::vector<std::uint32_t> values{1, 2, 3};
    const void* place = values.data();
    BufferBytes bytes;
    bytes.append(std::make_shared<KeptBytes<std::uint32_t>>(std::move(values)), 4);
    const std::vector<OutputPiece> pieces = bytes.pieces();
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_TRUE(pieces[0].isThere());
    EXPECT_EQ(pieces[0].bytes.data(), place);
    EXPECT_EQ(pieces[0].bytes.size(), 12u);
}

TEST(BufferBytes, KeepTheirAddressesWhenMoved) {
    BufferBytes bytes(Bytes{1, 2, 3});
    const std::uint8_t* place = std::as_const(bytes).range(0, 3).data();
    const BufferBytes moved = std::move(bytes);
    EXPECT_EQ(moved.range(0, 3).data(), place);
}

}  // namespace
}  // namespace tspace::gltf
