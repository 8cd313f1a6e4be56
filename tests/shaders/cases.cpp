// SPDX-License-Identifier: MIT
// Expected results come from the C++ decoder, or from geometry in double precision, but not from the formulas of the
// shaders.
#include "cases.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <sstream>

#include "core/base/vec_math.h"
#include "core/pack/format_names.h"
#include "core/pack/random_frames.h"
#include "tspace/pack.h"

namespace tspace::shaders {

namespace {

using test::RandomBits;

/// One item of a case: its words, appended number by number, and its expected result.
struct Item {
    std::vector<std::uint32_t> words;
    std::array<double, kResultFloats> expected{};

    void add(double x) { words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(x))); }
    void add(const DVec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void expect(const DVec3& v) { expected = {v.x, v.y, v.z}; }
    void expect(const DVec3& n, const DVec3& t, double sign) { expected = {n.x, n.y, n.z, 0, t.x, t.y, t.z, sign}; }
};

struct DFrame {
    DVec3 normal, tangent;
    double sign = 1;
};
void addFrame(Item& item, const DFrame& f) {
    item.add(f.normal);
    item.add(f.tangent);
    item.add(f.sign);
}

/// Rounds to float, so that the shader and the expected result start from the same numbers.
double rounded(double x) { return static_cast<float>(x); }
DVec3 rounded(const DVec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }
DVec3 unitOf(const DVec3& v) { return (1 / length(v)) * v; }
double number(RandomBits& random, double low, double high) {
    return rounded(low + (high - low) * (random.number() + 1) / 2);
}
DVec3 vectorIn(RandomBits& random, double size) {
    const double x = number(random, -size, size), y = number(random, -size, size);
    return {x, y, number(random, -size, size)};
}
DFrame frameOf(RandomBits& random) {
    const test::FrameList one = test::randomFrames(random, 1);
    const Vec4& t = one.tangents[0];
    return {toDouble(one.normals[0]), toDouble({t.x, t.y, t.z}), t.w};
}

// ---- the formats

/// Returns packed frames, and then other words: random ones, and words with few bits set or clear.
std::vector<std::byte> someWords(FrameFormat format, std::size_t count) {
    RandomBits random(17);
    const std::size_t bytes = frameBytes(format), others = count / 10;
    const test::FrameList frames = test::randomFrames(random, count);
    std::vector<std::byte> words(bytes * (count + others));
    if (!packFrames(frames.normals, frames.tangents, format, std::span(words).first(bytes * count))) return {};
    for (std::size_t i = 0; i < others; ++i) {
        const bool is_sparse = i % 2 == 0, is_inverted = i % 4 == 0;
        for (std::size_t b = 0; b < bytes; ++b) {
            const std::uint64_t draw = random.next();
            const bool is_kept = !is_sparse || (draw >> 8) % bytes == 0;
            std::byte value = is_kept ? static_cast<std::byte>(draw & 0xff) : std::byte{0};
            if (is_inverted) value ^= std::byte{0xff};
            words[bytes * (count + i) + b] = value;
        }
    }
    return words;
}

void setHeader(Case& c) {
    const auto count = static_cast<std::uint32_t>(c.count()), words = static_cast<std::uint32_t>(c.item_words);
    const std::uint32_t header[kHeaderWords] = {c.number, count, words, 0};
    c.buffer.insert(c.buffer.begin(), std::begin(header), std::end(header));
}

/// Creates a case that decodes `format`. Each word contains `unit_bytes` bytes of the format, as integer attributes are
/// fetched.
Case formatCase(std::string name, std::uint32_t number, FrameFormat format, std::size_t count, std::size_t unit_bytes) {
    const std::vector<std::byte> bytes = someWords(format, count);
    const std::size_t each = frameBytes(format), items = bytes.size() / each;
    Case c{.name = std::move(name), .number = number, .item_words = (each + unit_bytes - 1) / unit_bytes};
    test::FrameList frames;
    frames.resize(items);
    if (!unpackFrames(bytes, format, frames.normals, frames.tangents)) return c;
    c.buffer.assign(items * c.item_words, 0);
    for (std::size_t i = 0; i < items; ++i) {
        for (std::size_t b = 0; b < each; ++b) {
            c.buffer[i * c.item_words + b / unit_bytes] |= std::to_integer<std::uint32_t>(bytes[i * each + b])
                                                           << (8 * (b % unit_bytes));
        }
        const Vec3& n = frames.normals[i];
        const Vec4& t = frames.tangents[i];
        c.expected.insert(c.expected.end(), {n.x, n.y, n.z, 0, t.x, t.y, t.z, t.w});
    }
    c.bound = 2 * 0x1p-23;  // two units in the last place of 1.0
    setHeader(c);
    return c;
}

// ---- the other functions, item by item

/// Appends a frame from a quaternion, whose components are floats as vertex fetch provides them.
void quaternionItem(RandomBits& random, Item& item) {
    double q[4];
    for (double& component : q) component = number(random, -1, 1);
    // Sometimes w is the smallest number that has a sign: a half turn.
    if (random.next() % 64 == 0) q[3] = rounded((random.next() & 1) != 0 ? 1.0 / 32767 : -1.0 / 32767);
    double square = 0;
    for (const double component : q) {
        item.add(component);
        square += component * component;
    }
    const double k = 1 / std::sqrt(square), x = k * q[0], y = k * q[1], z = k * q[2], w = k * q[3];
    // Rotates a vector by the quaternion q = (u, w): v + 2 u x (u x v + w v).
    const auto turned = [&](const DVec3& v) {
        const DVec3 u{x, y, z};
        return v + 2 * cross(u, cross(u, v) + w * v);
    };
    item.expect(turned({0, 0, 1}), turned({1, 0, 0}), q[3] < 0 ? -1 : 1);
}

void vectorsItem(RandomBits& random, Item& item) {
    const DVec3 n = random.next() % 64 == 0 ? DVec3{} : vectorIn(random, 1), t = vectorIn(random, 1);
    const double w = number(random, -1, 1);
    item.add(n);
    item.add(t);
    item.add(w);
    item.expect(length(n) == 0 ? DVec3{0, 0, 1} : unitOf(n), unitOf(t), w < 0 ? -1 : 1);
}

struct Matrix {
    DVec3 column[3];
    DVec3 operator*(const DVec3& v) const { return v.x * column[0] + v.y * column[1] + v.z * column[2]; }
};
double determinant(const Matrix& m) { return dot(m.column[0], cross(m.column[1], m.column[2])); }

/// Returns a random matrix (rotation, scale of either sign and shear) that is not nearly singular.
Matrix someMatrix(RandomBits& random) {
    for (;;) {
        const DVec3 a = vectorIn(random, 1.5), b = vectorIn(random, 1.5);
        const Matrix m{{a, b, vectorIn(random, 1.5)}};
        if (std::fabs(determinant(m)) > 0.3) return m;
    }
}
void addMatrix(Item& item, const Matrix& m) {
    for (const DVec3& column : m.column) item.add(column);
}

/// Sets the expected frame after a transformation by m. N is perpendicular to the transformed surface, on its outer
/// side. T is transformed by m. The sign makes cross(N, T) point toward the transformed bitangent.
void expectMoved(Item& item, const DFrame& f, const Matrix& m) {
    const DVec3 b = f.sign * cross(f.normal, f.tangent);
    const DVec3 across = cross(m * f.tangent, m * cross(f.normal, f.tangent));
    const DVec3 n = unitOf((dot(across, m * f.normal) < 0 ? -1 : 1) * across), t = unitOf(m * f.tangent);
    item.expect(n, t, dot(m * b, cross(n, t)) < 0 ? -1 : 1);
}

/// Returns a matrix that is singular up to float rounding, so that only rounding determines the sign of its
/// determinant.
Matrix someFlatMatrix(RandomBits& random) {
    const DVec3 a = vectorIn(random, 1.5), b = vectorIn(random, 1.5);
    const double x = random.number(), y = random.number();
    return {{a, b, rounded(x * a + y * b)}};
}

void transformItem(RandomBits& random, Item& item) {
    for (;;) {
        const DFrame f = frameOf(random);
        const bool is_flat = random.next() % 8 == 0;
        const Matrix m = is_flat ? someFlatMatrix(random) : someMatrix(random);
        const DVec3 across = cross(m * f.tangent, m * cross(f.normal, f.tangent));
        if (is_flat && (length(across) < 0.3 || length(m * f.tangent) < 0.3)) continue;
        addFrame(item, f);
        addMatrix(item, m);
        if (!is_flat) return expectMoved(item, f, m);
        // N points to the side of the plane that the surface faces, as if the plane had a small thickness.
        return item.expect(unitOf(across), unitOf(m * f.tangent), f.sign);
    }
}

void skinItem(RandomBits& random, Item& item) {
    for (;;) {
        const DFrame f = frameOf(random);
        Matrix bones[4], blended{};
        double weights[4];
        for (std::size_t i = 0; i < 4; ++i) {
            bones[i] = someMatrix(random);
            weights[i] = number(random, 0, 0.5);
            for (std::size_t c = 0; c < 3; ++c) {
                blended.column[c] = blended.column[c] + weights[i] * bones[i].column[c];
            }
        }
        if (std::fabs(determinant(blended)) < 0.1) continue;
        addFrame(item, f);
        for (const Matrix& bone : bones) addMatrix(item, bone);
        for (const double weight : weights) item.add(weight);
        return expectMoved(item, f, blended);
    }
}

void morphItem(RandomBits& random, Item& item) {
    const DFrame f = frameOf(random);
    DVec3 normal_delta = vectorIn(random, 0.5), tangent_delta = vectorIn(random, 0.5);
    if (random.next() % 64 == 0) normal_delta = rounded(-1.0 * f.normal);  // the sum vanishes, so N must not change
    if (random.next() % 64 == 0) tangent_delta = DVec3{};
    addFrame(item, f);
    item.add(normal_delta);
    item.add(tangent_delta);
    const DVec3 sum = f.normal + normal_delta, n = length(sum) == 0 ? f.normal : unitOf(sum);
    const DVec3 t = f.tangent + tangent_delta;
    item.expect(n, unitOf(t - dot(n, t) * n), f.sign);
}

/// Appends a frame from screen-space derivatives: random derivatives of position and UV, and the expected tangent.
void stepsItem(RandomBits& random, Item& item) {
    for (;;) {
        const DVec3 p_dx = vectorIn(random, 0.01), p_dy = vectorIn(random, 0.01);
        const double a = number(random, -0.01, 0.01), b = number(random, -0.01, 0.01);
        const double c = number(random, -0.01, 0.01), d = number(random, -0.01, 0.01), area = a * d - b * c;
        const DVec3 face = cross(p_dx, p_dy), n = rounded(vectorIn(random, 1));
        const DVec3 along_u = (1 / area) * (d * p_dx - b * p_dy), along_v = (1 / area) * (a * p_dy - c * p_dx);
        const DVec3 across = cross(unitOf(n), unitOf(along_u));
        if (std::fabs(area) < 1e-5 || std::fabs(dot(n, face)) < 2e-6 || length(across) < 0.2) continue;
        item.add(n);
        item.add(p_dx);
        item.add(p_dy);
        for (const double x : {a, b, c, d}) item.add(x);
        // If along_v is rotated about the line of intersection until it is perpendicular to N, it stays on the same
        // side of T. This determines the sign of the UVs as seen along N.
        const double side = dot(cross(along_u, along_v), n);
        const DVec3 unit = unitOf(n);
        return item.expect(unit, unitOf(cross(across, unit)), side < 0 ? -1 : 1);
    }
}

/// An interpolated frame: N and T are shorter than 1 and not exactly orthogonal, and w deviates in its last bits.
struct Interpolated {
    DVec3 normal, tangent, bitangent;
    double w, sign;
};
Interpolated someInterpolated(RandomBits& random) {
    const DFrame f = frameOf(random);
    const DVec3 n = rounded(number(random, 0.5, 1) * f.normal + vectorIn(random, 0.2));
    const DVec3 t = rounded(number(random, 0.5, 1) * f.tangent + vectorIn(random, 0.2));
    return {n, t, rounded(f.sign * cross(n, t)), f.sign * number(random, 0.999999, 1.000001), f.sign};
}
DVec3 someTexel(RandomBits& random) {
    const double x = number(random, -0.7, 0.7), y = number(random, -0.7, 0.7);
    return {x, y, number(random, 0.3, 1)};
}
/// Returns the vector of a texel of a two-channel map.
DVec3 unpackedTexel(double r, double g) {
    const double x = 2 * r - 1, y = 2 * g - 1;
    return {x, y, std::sqrt(std::fmax(0, 1 - x * x - y * y))};
}
DVec3 combined(const DVec3& texel, const DVec3& t, const DVec3& b, const DVec3& n) {
    return texel.x * t + texel.y * b + texel.z * n;
}

void bitangentItem(RandomBits& random, Item& item) {
    const Interpolated in = someInterpolated(random);
    item.add(in.normal);
    item.add(in.tangent);
    item.add(in.w);
    item.expect(in.sign * cross(in.normal, in.tangent));
}
void texelItem(RandomBits& random, Item& item) {
    const DVec3 rgb{number(random, 0, 1), number(random, 0, 1), number(random, 0, 1)};
    item.add(rgb);
    item.expect(2 * rgb - DVec3{1, 1, 1});
}
void texelOfTwoItem(RandomBits& random, Item& item) {
    const double r = number(random, 0.15, 0.85), g = random.next() % 8 == 0 ? 1.0 : number(random, 0.2, 0.8);
    item.add(r);
    item.add(g);
    item.expect(unpackedTexel(r, g));
}

/// Appends shading as MikkTSpace defines it, with bitangents computed per pixel or per vertex.
void mikktspaceItem(RandomBits& random, Item& item) {
    const Interpolated in = someInterpolated(random);
    const DVec3 texel = someTexel(random);
    item.add(texel);
    item.add(in.normal);
    item.add(in.tangent);
    item.add(in.w);
    item.expect(unitOf(combined(texel, in.tangent, in.sign * cross(in.normal, in.tangent), in.normal)));
}
void mikktspacePerVertexItem(RandomBits& random, Item& item) {
    const Interpolated in = someInterpolated(random);
    const DVec3 texel = someTexel(random);
    for (const DVec3& v : {texel, in.normal, in.tangent, in.bitangent}) item.add(v);
    item.expect(unitOf(combined(texel, in.tangent, in.bitangent, in.normal)));
}
void threeItem(RandomBits& random, Item& item) {
    const Interpolated in = someInterpolated(random);
    const DVec3 texel = someTexel(random);
    const double face = (random.next() & 1) != 0 ? 1 : -1;
    for (const DVec3& v : {texel, in.normal, in.tangent, in.bitangent}) item.add(v);
    item.add(face);
    item.expect(face * unitOf(combined(texel, unitOf(in.tangent), unitOf(in.bitangent), unitOf(in.normal))));
}
/// Appends the interpolated frame, and sets the normal that is expected for the two-channel texel (r, g).
void addTwoChannelRest(RandomBits& random, Item& item, double r, double g) {
    const Interpolated in = someInterpolated(random);
    item.add(in.normal);
    item.add(in.tangent);
    item.add(in.w);
    const DVec3 bitangent = in.sign * cross(in.normal, in.tangent);
    item.expect(unitOf(combined(unpackedTexel(r, g), in.tangent, bitangent, in.normal)));
}
void unrealItem(RandomBits& random, Item& item) {
    const double r = number(random, 0.25, 0.75), g = number(random, 0.25, 0.75);
    item.add(r);
    item.add(g);
    addTwoChannelRest(random, item, r, g);
}
void unityItem(RandomBits& random, Item& item) {
    const double x = number(random, 0.25, 0.75), g = number(random, 0.25, 0.75);
    const bool is_in_alpha = (random.next() & 1) != 0;
    for (const double channel : {is_in_alpha ? 1.0 : x, g, 0.3, is_in_alpha ? x : 1.0}) item.add(channel);
    addTwoChannelRest(random, item, x, g);
}
void godotItem(RandomBits& random, Item& item) {
    const Interpolated in = someInterpolated(random);
    const double r = number(random, 0.25, 0.75), g = number(random, 0.25, 0.75), depth = number(random, 0, 1);
    item.add(r);
    item.add(g);
    for (const DVec3& v : {in.normal, in.tangent, in.bitangent}) item.add(v);
    item.add(depth);
    const DVec3 n = unitOf(in.normal);
    const DVec3 mapped = combined(unpackedTexel(r, g), unitOf(in.tangent), unitOf(in.bitangent), n);
    item.expect(unitOf(n + depth * (mapped - n)));
}

struct ItemCase {
    const char* name;
    void (*make)(RandomBits&, Item&);
    double bound;
};
/// The cases from number 9 on, except the two of kAttributeCases. Bounds are multiples of the errors of lavapipe; these
/// functions divide by lengths down to 0.1.
constexpr ItemCase kItemCases[] = {
    {"frameOfQuaternion", quaternionItem, 1e-6},
    {"frameOfVectors", vectorsItem, 5e-7},
    {"transformFrame", transformItem, 3e-6},
    {"skinFrame", skinItem, 3e-5},
    {"morphFrame", morphItem, 3e-6},
    {"frameOfSteps", stepsItem, 3e-6},
    {nullptr, nullptr, 0},
    {nullptr, nullptr, 0},
    {"bitangent", bitangentItem, 1e-6},
    {"texel", texelItem, 3e-7},
    {"texelOfTwo", texelOfTwoItem, 3e-6},
    {"applyMikktspace", mikktspaceItem, 3e-6},
    {"applyMikktspacePerVertex", mikktspacePerVertexItem, 3e-6},
    {"applyThree", threeItem, 3e-6},
    {"applyUnreal", unrealItem, 3e-6},
    {"applyUnity", unityItem, 3e-6},
    {"applyGodot", godotItem, 3e-6},
};
constexpr std::uint32_t kFirstItemCase = 9, kBytesCase = 15, kShortsCase = 16;

Case itemCase(std::uint32_t number, const ItemCase& from, std::size_t count) {
    Case c{.name = from.name, .number = number, .bound = from.bound};
    RandomBits random(number);
    for (std::size_t i = 0; i < count; ++i) {
        Item item;
        from.make(random, item);
        c.item_words = item.words.size();
        c.buffer.insert(c.buffer.end(), item.words.begin(), item.words.end());
        c.expected.insert(c.expected.end(), item.expected.begin(), item.expected.end());
    }
    setHeader(c);
    return c;
}

}  // namespace

std::size_t caseCount() { return kFirstItemCase + std::size(kItemCases); }

Case makeCase(std::uint32_t number, std::size_t count) {
    if (number < kFirstItemCase) return formatCase(test::kFormatNames[number], number, FrameFormat{number}, count, 4);
    // The cases of the helpers for attributes, with one word per byte or per 16-bit integer.
    if (number == kBytesCase) return formatCase("word", number, FrameFormat::frame32, count / 10, 1);
    if (number == kShortsCase) return formatCase("words", number, FrameFormat::frame64, count / 10, 2);
    return itemCase(number, kItemCases[number - kFirstItemCase], count / 10);
}

double worstDifference(const Case& c, std::span<const float> results) {
    double worst = 0;
    for (std::size_t i = 0; i < c.expected.size() && i < results.size(); ++i) {
        const double difference = std::fabs(results[i] - c.expected[i]);
        if (!(difference <= worst)) worst = difference;
    }
    return worst;
}

std::string whatIsWrong(const Case& c, std::span<const float> results) {
    if (c.count() == 0) return c.name + ": there are no items";
    if (results.size() != c.expected.size()) return c.name + ": not as many results as were asked for";
    for (std::size_t i = 0; i < results.size(); ++i) {
        const bool is_sign = i % kResultFloats == kResultFloats - 1;
        if (std::fabs(results[i] - c.expected[i]) <= (is_sign ? 0 : c.bound)) continue;
        std::ostringstream text;
        text.precision(9);
        const std::size_t item = i / kResultFloats;
        text << c.name << ", item " << item << ", component " << i % kResultFloats << ": " << results[i] << " and not "
             << c.expected[i] << "; words";
        for (std::size_t w = 0; w < c.item_words; ++w) {
            text << ' ' << std::hex << c.buffer[kHeaderWords + item * c.item_words + w];
        }
        return text.str();
    }
    return {};
}

}  // namespace tspace::shaders
