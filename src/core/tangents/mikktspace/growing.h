// SPDX-License-Identifier: MIT
// A list that grows, on the caller's allocator. For the calling thread only, as every Buffer.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/memory.h"

namespace tspace::mikk {

template <class T>
class Growing {
  public:
    explicit Growing(const Allocator* allocator) : allocator_(allocator) {}

    /// `capacity` must not be below size().
    [[gnu::noinline]] void reserve(std::size_t capacity) {
        Buffer<T> larger(allocator_, capacity);
        std::copy_n(buffer_.data(), count_, larger.data());
        buffer_ = std::move(larger);
    }
    void push(const T& value) {
        if (count_ == buffer_.size()) reserve(std::max<std::size_t>(16, 2 * count_));
        buffer_[count_++] = value;
    }
    /// Makes room for `more` elements and returns the first; they are not initialised.
    T* extend(std::size_t more) {
        if (count_ + more > buffer_.size()) reserve(std::max(count_ + more, 2 * count_));
        count_ += more;
        return buffer_.data() + count_ - more;
    }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    T& operator[](std::size_t i) { return buffer_[i]; }
    const T& operator[](std::size_t i) const { return buffer_[i]; }
    T* begin() { return buffer_.data(); }
    T* end() { return buffer_.data() + count_; }
    const T* begin() const { return buffer_.data(); }
    const T* end() const { return buffer_.data() + count_; }

    /// Takes the last `count` elements off.
    void drop(std::size_t count) { count_ -= count; }

    /// The elements in a Buffer of exactly their size.
    [[nodiscard, gnu::noinline]] Buffer<T> exact() const {
        Buffer<T> result(allocator_, count_);
        std::copy_n(buffer_.data(), count_, result.data());
        return result;
    }

  private:
    const Allocator* allocator_;
    Buffer<T> buffer_;
    std::size_t count_ = 0;
};

}  // namespace tspace::mikk
