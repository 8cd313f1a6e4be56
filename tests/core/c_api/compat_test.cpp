// SPDX-License-Identifier: MIT
// The MikkTSpace drop-in: which callbacks it calls, when and in which order, and how it handles unusual results of
// callbacks.
#include "tspace/compat/mikktspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tspace/tspace.h"

namespace {

/// A strip of unit squares along x; face f has its corners at x = f and f + 1.
struct Strip {
    std::vector<int> sizes;
    int face_count = 0;
    std::vector<std::string> calls;
    std::thread::id caller = std::this_thread::get_id();
    bool only_caller = true;

    explicit Strip(std::vector<int> face_sizes)
        : sizes(std::move(face_sizes)), face_count(static_cast<int>(sizes.size())) {}

    static Strip& of(const SMikkTSpaceContext* context) {
        auto& self = *static_cast<Strip*>(context->m_pUserData);
        self.only_caller = self.only_caller && std::this_thread::get_id() == self.caller;
        return self;
    }
    void note(const char* what, int face, int vertex) {
        calls.push_back(what + std::to_string(face) + "." + std::to_string(vertex));
    }

    static int numFaces(const SMikkTSpaceContext* c) { return of(c).face_count; }
    static int numVertices(const SMikkTSpaceContext* c, const int face) {
        const Strip& self = of(c);
        return face < static_cast<int>(self.sizes.size()) ? self.sizes[static_cast<std::size_t>(face)] : 0;
    }
    static void position(const SMikkTSpaceContext* c, float out[], const int face, const int vertex) {
        of(c).note("p", face, vertex);
        out[0] = static_cast<float>(face + (vertex == 1 || vertex == 2 ? 1 : 0));
        out[1] = vertex >= 2 ? 1.0f : 0.0f;
        out[2] = 0.0f;
    }
    static void normal(const SMikkTSpaceContext* c, float out[], const int face, const int vertex) {
        of(c).note("n", face, vertex);
        out[0] = out[1] = 0.0f;
        out[2] = 1.0f;
    }
    static void texCoord(const SMikkTSpaceContext* c, float out[], const int face, const int vertex) {
        of(c).note("t", face, vertex);
        out[0] = static_cast<float>(face + (vertex == 1 || vertex == 2 ? 1 : 0));
        out[1] = vertex >= 2 ? 1.0f : 0.0f;
    }
    static void basic(const SMikkTSpaceContext* c, const float tangent[], const float sign, const int face,
                      const int vertex) {
        of(c).note("b", face, vertex);
        EXPECT_EQ(tangent[0], 1.0f);
        EXPECT_EQ(sign, 1.0f);
    }
    static void full(const SMikkTSpaceContext* c, const float tangent[], const float bitangent[], const float mag_s,
                     const float mag_t, const tbool preserving, const int face, const int vertex) {
        of(c).note("f", face, vertex);
        EXPECT_EQ(tangent[0], 1.0f);
        EXPECT_EQ(bitangent[1], 1.0f);
        EXPECT_EQ(mag_s, 1.0f);
        EXPECT_EQ(mag_t, 1.0f);
        EXPECT_EQ(preserving, 1);
    }

    SMikkTSpaceInterface callbacks = {numFaces, numVertices, position, normal, texCoord, basic, full};
    SMikkTSpaceContext context() { return {&callbacks, this}; }

    tbool run() {
        const SMikkTSpaceContext c = context();
        return genTangSpaceDefault(&c);
    }
    [[nodiscard]] std::size_t count(char kind) const {
        std::size_t n = 0;
        for (const std::string& call : calls) n += call[0] == kind ? 1 : 0;
        return n;
    }
};

TEST(Compat, ReadsEverythingThenWritesFaceByFaceFullBeforeBasic) {
    Strip strip({4, 5, 3});
    ASSERT_TRUE(strip.run());
    const std::vector<std::string> written = {"f0.0", "b0.0", "f0.1", "b0.1", "f0.2", "b0.2", "f0.3",
                                              "b0.3", "f2.0", "b2.0", "f2.1", "b2.1", "f2.2", "b2.2"};
    ASSERT_GE(strip.calls.size(), written.size());
    EXPECT_EQ(written,
              std::vector<std::string>(strip.calls.end() - static_cast<long>(written.size()), strip.calls.end()));
    EXPECT_EQ(strip.count('p'), 7u);
    EXPECT_EQ(strip.count('n'), 7u);
    EXPECT_EQ(strip.count('t'), 7u);
}

TEST(Compat, CallsBackFromTheCallingThreadOnly) {
    Strip strip(std::vector<int>(20000, 4));
    ASSERT_TRUE(strip.run());
    EXPECT_TRUE(strip.only_caller);
    EXPECT_EQ(strip.count('b'), 80000u);
}

TEST(Compat, NeedsNeitherSetter) {
    Strip strip({4});
    strip.callbacks.m_setTSpace = nullptr;
    EXPECT_TRUE(strip.run());
    EXPECT_EQ(strip.count('b'), 4u);
    strip.callbacks.m_setTSpaceBasic = nullptr;
    EXPECT_TRUE(strip.run());
    EXPECT_EQ(strip.count('b'), 4u);
    strip.callbacks.m_setTSpace = Strip::full;
    EXPECT_TRUE(strip.run());
    EXPECT_EQ(strip.count('f'), 4u);
}

TEST(Compat, IsFalseWithoutAnyGetter) {
    for (int missing = 0; missing < 5; ++missing) {
        Strip strip({4});
        if (missing == 0) strip.callbacks.m_getNumFaces = nullptr;
        if (missing == 1) strip.callbacks.m_getNumVerticesOfFace = nullptr;
        if (missing == 2) strip.callbacks.m_getPosition = nullptr;
        if (missing == 3) strip.callbacks.m_getNormal = nullptr;
        if (missing == 4) strip.callbacks.m_getTexCoord = nullptr;
        EXPECT_FALSE(strip.run()) << missing;
        EXPECT_TRUE(strip.calls.empty());
    }
    EXPECT_FALSE(genTangSpaceDefault(nullptr));
    const SMikkTSpaceContext empty = {nullptr, nullptr};
    EXPECT_FALSE(genTangSpaceDefault(&empty));
}

TEST(Compat, IsFalseWithoutAFaceOfThreeOrFourVertices) {
    for (const std::vector<int>& sizes : {std::vector<int>{}, {0}, {2, 5}, {-1, -3, INT_MIN}, {1, INT_MAX, 100}}) {
        Strip strip(sizes);
        EXPECT_FALSE(strip.run());
        EXPECT_EQ(strip.count('b') + strip.count('f'), 0u);
    }
}

TEST(Compat, TreatsNegativeCountsAsZero) {
    Strip strip({4});
    for (const int face_count : {-1, INT_MIN}) {
        strip.face_count = face_count;
        EXPECT_FALSE(strip.run());
    }
    Strip mixed({-7, 4, INT_MAX, INT_MIN, 4});
    EXPECT_TRUE(mixed.run());
    EXPECT_EQ(mixed.count('b'), 8u);
    EXPECT_EQ(mixed.count('p'), 8u);
}

TEST(Compat, ReadsTheFirstCornerOfAnUnsupportedFirstFaceOnly) {
    Strip strip({0, 7, 9, 4});
    EXPECT_TRUE(strip.run());
    EXPECT_EQ(strip.calls.front(), "p1.0");
    EXPECT_EQ(strip.count('p'), 5u);
    EXPECT_EQ(strip.count('n'), 4u);
}

TEST(Compat, RejectsMoreCornersThanFitBeforeReadingOne) {
    Strip strip({});
    strip.callbacks.m_getNumFaces = [](const SMikkTSpaceContext*) { return INT_MAX; };
    strip.callbacks.m_getNumVerticesOfFace = [](const SMikkTSpaceContext*, const int) { return 4; };
    EXPECT_FALSE(strip.run());
    EXPECT_TRUE(strip.calls.empty());
}

TEST(Compat, TakesAnyThreshold) {
    for (const float threshold : {0.0f, 0.5f, 360.0f, -90.0f, 1e30f, INFINITY, NAN}) {
        Strip strip({4, 3});
        const SMikkTSpaceContext context = strip.context();
        EXPECT_TRUE(genTangSpace(&context, threshold)) << threshold;
        EXPECT_EQ(strip.count('b'), 7u);
    }
}

struct CountedMemory {
    std::size_t used = 0, most = 0;
    bool is_empty = false;

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<CountedMemory*>(user);
        if (self.is_empty) return nullptr;
        self.most = std::max(self.most, self.used += bytes);
        return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    }
    static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
        static_cast<CountedMemory*>(user)->used -= bytes;
        std::free(memory);
    }
    tspace_Allocator allocator{allocate, release, this};
};

TEST(Compat, TakesThreadsAndAnAllocatorForAllOfItsMemory) {
    Strip plain(std::vector<int>(40000, 4)), threaded(plain.sizes);
    const SMikkTSpaceContext context = plain.context(), other = threaded.context();
    CountedMemory memory;
    tspace_Execution execution;
    TSPACE_INIT(execution);
    execution.thread_count = 3;
    execution.allocator = &memory.allocator;
    EXPECT_EQ(tspace_genTangSpace(&context, 180.0f, nullptr), 1);
    EXPECT_EQ(tspace_genTangSpace(&other, 180.0f, &execution), 1);
    EXPECT_EQ(plain.calls, threaded.calls);
    EXPECT_TRUE(threaded.only_caller);
    EXPECT_EQ(memory.used, 0u);
    EXPECT_GT(memory.most, 4 * plain.sizes.size() * sizeof(float) * (8 + 4 + 3 + 2));
    memory.is_empty = true;
    threaded.calls.clear();
    EXPECT_EQ(tspace_genTangSpace(&other, 180.0f, &execution), 0);
    EXPECT_TRUE(threaded.calls.empty());
    execution.struct_size = 3;
    EXPECT_EQ(tspace_genTangSpace(&other, 180.0f, &execution), 0);
}

}  // namespace
