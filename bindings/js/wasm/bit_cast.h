// SPDX-License-Identifier: MIT
// std::bit_cast for the C++ library of emscripten 3.1, which lacks it. Included before everything else.
#pragma once

#include <bit>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}
}  // namespace std
#endif
