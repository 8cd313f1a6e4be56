// SPDX-License-Identifier: MIT
// Explicit instantiation of the functions of Bytes.
#include "model/io/bytes.h"

template class std::vector<std::uint8_t, tspace::UnsetAllocator<std::uint8_t>>;
