// SPDX-License-Identifier: MIT
// JSON values, and formatting that is identical to that of the library nlohmann/json.
#include "model/json/json.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace tspace {
namespace {

using Oracle = nlohmann::ordered_json;

/// Returns a text with every kind of byte. It is valid UTF-8 unless `any_bytes` is set.
std::string randomText(bool any_bytes) {
    std::string text;
    for (const int kind : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, any_bytes ? 7 : 6))) {
        static constexpr const char* kPieces[] = {"a", "\"\\/", "\n\t", "\x01\x7f", "\u00e9", "\U0001F600", "\xff\xc3"};
        text += kPieces[kind];
    }
    return text;
}

/// A random value, as a value of both libraries.
struct Twin {
    Json json;
    Oracle oracle;
};

Twin randomTwin(int depth, bool any_bytes) {
    const auto same = [](const auto& value) { return Twin{value, value}; };
    // While nesting is allowed, half of the values are arrays or objects.
    const int kind = depth > 0 && *rc::gen::arbitrary<bool>() ? 7 + *rc::gen::arbitrary<bool>()
                                                              : *rc::gen::element(0, 1, 2, 3, 4, 5, 6);
    switch (kind) {
        case 0: return {nullptr, nullptr};
        case 1: return same(*rc::gen::arbitrary<bool>());
        case 2: return same(*rc::gen::arbitrary<std::int64_t>());
        case 3: return same(*rc::gen::arbitrary<std::uint64_t>());
        case 4: return same(*rc::gen::arbitrary<double>());
        case 5: return same(*rc::gen::arbitrary<float>());
        case 6: return same(randomText(any_bytes));
        case 7: {
            Twin twin{Json::array(), Oracle::array()};
            for (int i = *rc::gen::element(0, 1, 2, 3); i > 0; --i) {
                const Twin child = randomTwin(depth - 1, any_bytes);
                twin.json.push_back(child.json);
                twin.oracle.push_back(child.oracle);
            }
            return twin;
        }
        default: {
            Twin twin{Json::object(), Oracle::object()};
            for (int i = *rc::gen::element(0, 1, 2, 3); i > 0; --i) {
                const Twin child = randomTwin(depth - 1, any_bytes);
                const std::string name = randomText(any_bytes);
                twin.json[name] = child.json;
                twin.oracle[name] = child.oracle;
            }
            return twin;
        }
    }
}

RC_GTEST_PROP(JsonText, IsSpelledAsByTheLibrary, ()) {
    const Twin twin = randomTwin(3, false);
    const int indent = *rc::gen::inRange(-1, 4);
    const char indent_char = *rc::gen::element(' ', '\t');
    RC_ASSERT(twin.json.dump(indent, indent_char) == twin.oracle.dump(indent, indent_char));
}

RC_GTEST_PROP(JsonText, ReplacesBytesThatAreNotUtf8AsTheLibraryDoes, ()) {
    const Twin twin = randomTwin(2, true);
    RC_ASSERT(twin.json.dump(-1, ' ', BadUtf8::replace) ==
              twin.oracle.dump(-1, ' ', false, Oracle::error_handler_t::replace));
}

RC_GTEST_PROP(JsonText, RoundTripsEqually, ()) {
    const Twin twin = randomTwin(3, false);
    const std::string text = twin.json.dump(2);
    const Json read = Json::parse(text);
    RC_ASSERT(read.dump(2) == text);
    RC_ASSERT(Oracle::parse(text).dump() == read.dump());
}

RC_GTEST_PROP(JsonText, IsRejectedExactlyWhereTheLibraryRefusesIt, ()) {
    std::string text = randomTwin(2, false).json.dump();
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    text[at] = *rc::gen::element('"', '{', ']', ',', ':', '0', 'e', ' ', '\\', '\n');
    bool accepts = true;
    try {
        static_cast<void>(Json::parse(text));
    } catch (const JsonError& error) {
        if (error.repeated) return;  // the other library accepts repeated members
        accepts = false;
    }
    RC_ASSERT(accepts == Oracle::accept(text));
}

TEST(Json, IsParsedWithoutThrowingOnRequest) {
    JsonError error;
    EXPECT_EQ(Json::read("[1]", error), Json::array({1}));
    EXPECT_FALSE(Json::read("[1", error));
    EXPECT_EQ(error.message, "the JSON has a syntax error");
    EXPECT_TRUE(error.byte);
    EXPECT_FALSE(Json::read("1e400", error));
    EXPECT_EQ(error.message, "the JSON contains a number that is too large");
    EXPECT_FALSE(Json::read(R"({"a":1,"a":2})", error));
    EXPECT_EQ(error.repeated, "a");
    EXPECT_FALSE(Json::read(std::string(kMaxJsonDepth + 1, '['), error));
}

TEST(Json, RejectsInvalidUtf8UnlessItIsToBeReplaced) {
    EXPECT_THROW(static_cast<void>(Json("\xff").dump()), JsonError);
    EXPECT_EQ(Json("\xff").dump(-1, ' ', BadUtf8::replace), "\"\xEF\xBF\xBD\"");
}

TEST(Json, BracesAreAnObjectWhereAllEntriesAreNamed) {
    const std::vector<std::string> words = {"a", "b"};
    const double pair[2] = {1, 0.5};
    const Json json = {{"n", 1},         {"list", {1, 2u, 0.5f}}, {"in", {{"x", nullptr}}},
                       {"words", words}, {"pair", pair},          {"bools", std::array{true, false}}};
    EXPECT_EQ(json.dump(),
              R"({"n":1,"list":[1,2,0.5],"in":{"x":null},"words":["a","b"],"pair":[1.0,0.5],"bools":[true,false]})");
    EXPECT_EQ(Json::array({Json{{"a", 1}}}).dump(), R"([{"a":1}])");
    EXPECT_EQ(Json::array({"a", 1}).dump(), R"(["a",1])");
    EXPECT_EQ(Json::object({{"a", words}, {"b", 2}}).dump(), R"({"a":["a","b"],"b":2})");
}

TEST(Json, CreatesRequestedMembersAndElements) {
    Json json;
    json["a"][2]["b"] = 1;
    EXPECT_EQ(json.dump(), R"({"a":[null,null,{"b":1}]})");
    json["a"].erase(std::size_t{0});
    json["a"].push_back("end");
    json["z"] = json["a"].front();
    json.erase("absent");
    EXPECT_EQ(json.dump(), R"({"a":[null,{"b":1},"end"],"z":null})");
    json.erase("a");
    EXPECT_EQ(json.dump(), R"({"z":null})");
    EXPECT_EQ(json.find("a"), nullptr);
}

TEST(Json, CopiesAreIndependentAndMovesLeaveNull) {
    Json first = {{"a", {1, 2}}};
    Json second = first;
    second["a"][0] = "changed";
    EXPECT_EQ(first.dump(), R"({"a":[1,2]})");
    const Json third = std::move(second);
    EXPECT_EQ(third.dump(), R"({"a":["changed",2]})");
    first = Json(first["a"][1]);
    EXPECT_EQ(first, 2);
}

TEST(Json, ComparesNumbersByValue) {
    constexpr std::uint64_t kLarge = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(Json(3), Json(3u));
    EXPECT_EQ(Json(3), Json(3.0));
    EXPECT_FALSE(Json(-1) == Json(kLarge));
    EXPECT_LT(Json(-1), Json(kLarge));
    EXPECT_LT(Json(-2), Json(-1));
    EXPECT_GT(Json(1.5), Json(1));
    EXPECT_FALSE(Json("1") == Json(1));
    EXPECT_FALSE(Json("1") < Json(1));
    EXPECT_FALSE((Json{{"a", 1}, {"b", 2}} == Json{{"b", 2}, {"a", 1}}));
}

TEST(Json, ConvertsToTheNearestRepresentableNumber) {
    const std::uint64_t more = (std::uint64_t{1} << 32) + 16;
    EXPECT_EQ(Json(more).get<std::uint32_t>(), 0xffffffffU);  // saturates; not 16, the low bits
    EXPECT_EQ(Json(more).get<std::uint64_t>(), more);
    EXPECT_EQ(Json(more).get<std::int32_t>(), 0x7fffffff);
    EXPECT_EQ(Json(~std::uint64_t{0}).get<std::int64_t>(), std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(Json(-1).get<std::size_t>(), 0U);
    EXPECT_EQ(Json(std::int64_t{-1} << 40).get<std::int32_t>(), std::numeric_limits<std::int32_t>::min());
    EXPECT_EQ(Json(-1).get<double>(), -1.0);
}

TEST(Json, ThrowsWhereAValueIsOfAnotherKind) {
    const Json json = {{"text", "x"}, {"number", 1}};
    EXPECT_THROW(static_cast<void>(json["text"].get<int>()), JsonError);
    EXPECT_THROW(static_cast<void>(json["number"].text()), JsonError);
    EXPECT_THROW(static_cast<void>(json["absent"]), JsonError);
    EXPECT_THROW(static_cast<void>(json[0]), JsonError);
    EXPECT_THROW(static_cast<void>(json["text"].items()), JsonError);
    EXPECT_THROW(Json(1).push_back(2), JsonError);
    EXPECT_EQ(json["number"].size(), 0u);
    EXPECT_FALSE(json["number"].contains("a"));
}

TEST(JsonText, ChargesItsMemory) {
    struct Counter final : JsonMemory {
        void take(std::size_t bytes) override {
            taken += bytes;
            if (taken > limit) throw std::bad_alloc();
        }
        std::size_t taken = 0, limit = std::numeric_limits<std::size_t>::max();
    };
    std::string text = "[";
    for (int i = 0; i < 10000; ++i) text += "{\"a\":\"b\"},";
    text += "0]";
    Counter counter;
    static_cast<void>(Json::parse(text, &counter));
    EXPECT_GT(counter.taken, 10000u * (2 * sizeof(std::string) + sizeof(Json)));
    Counter small;
    small.limit = 1000;
    EXPECT_THROW(static_cast<void>(Json::parse(text, &small)), std::bad_alloc);
    EXPECT_LT(small.taken, 2000u);
}

}  // namespace
}  // namespace tspace
