// SPDX-License-Identifier: MIT
// Caller-owned array with a fixed distance in bytes between elements (interleaved vertex buffers).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace tspace {

// Float tuples used at the API boundary. They have no padding, so an array of Vec3 is an array of 3 floats per element
// and may be viewed as such.

struct Vec2 {
    float x = 0, y = 0;
    friend bool operator==(const Vec2&, const Vec2&) = default;
};

struct Vec3 {
    float x = 0, y = 0, z = 0;
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Tangent with its sign: x, y, z is the tangent, w is the sign (+1 or -1).
struct Vec4 {
    float x = 0, y = 0, z = 0, w = 0;
    friend bool operator==(const Vec4&, const Vec4&) = default;
};

static_assert(sizeof(Vec2) == 8 && sizeof(Vec3) == 12 && sizeof(Vec4) == 16);

/// Returns the first three components: the tangent without its sign.
inline Vec3 xyz(const Vec4& v) { return {v.x, v.y, v.z}; }

/// View of `count` elements of T. The first is at `data`; each next one follows at a distance of `stride_bytes`. `data`
/// may be null only if `count` is 0. Functions that take a span check that the stride is at least sizeof(T) (if there
/// are two or more elements) and a multiple of alignof(T).
template <class T>
struct StridedSpan {
    T* data = nullptr;
    std::size_t count = 0;
    std::size_t stride_bytes = sizeof(T);

    constexpr StridedSpan() = default;
    constexpr StridedSpan(T* first, std::size_t n, std::size_t stride = sizeof(T))
        : data(first), count(n), stride_bytes(stride) {}
    constexpr StridedSpan(std::span<T> s) : data(s.data()), count(s.size()) {}
    /// Views any contiguous container of T (std::vector, std::array); implicit, as for std::span.
    template <class Container>
    requires std::is_constructible_v<std::span<T>, Container&> constexpr StridedSpan(Container& c)
        : StridedSpan(std::span<T>(c)) {}
    /// Converts a mutable span to a const one.
    template <class U>
    requires(std::is_same_v<const U, T> && !std::is_const_v<U>) constexpr StridedSpan(const StridedSpan<U>& s)
        : data(s.data), count(s.count), stride_bytes(s.stride_bytes) {}

    [[nodiscard]] constexpr bool empty() const { return count == 0; }

    /// Returns element `i`, 0 <= i < count. Not checked.
    T& operator[](std::size_t i) const {
        using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
        return *reinterpret_cast<T*>(reinterpret_cast<Byte*>(data) + i * stride_bytes);
    }
};

/// Views an array of floats as vectors: `count` vectors, `stride_bytes` apart (default: tightly packed).
inline StridedSpan<const Vec2> vec2Span(const float* data, std::size_t count, std::size_t stride_bytes = sizeof(Vec2)) {
    return {reinterpret_cast<const Vec2*>(data), count, stride_bytes};
}
inline StridedSpan<const Vec3> vec3Span(const float* data, std::size_t count, std::size_t stride_bytes = sizeof(Vec3)) {
    return {reinterpret_cast<const Vec3*>(data), count, stride_bytes};
}
inline StridedSpan<Vec3> vec3Span(float* data, std::size_t count, std::size_t stride_bytes = sizeof(Vec3)) {
    return {reinterpret_cast<Vec3*>(data), count, stride_bytes};
}
inline StridedSpan<const Vec4> vec4Span(const float* data, std::size_t count, std::size_t stride_bytes = sizeof(Vec4)) {
    return {reinterpret_cast<const Vec4*>(data), count, stride_bytes};
}
inline StridedSpan<Vec4> vec4Span(float* data, std::size_t count, std::size_t stride_bytes = sizeof(Vec4)) {
    return {reinterpret_cast<Vec4*>(data), count, stride_bytes};
}

}  // namespace tspace
