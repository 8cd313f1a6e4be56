// SPDX-License-Identifier: MIT
// Instantiates the functions of Bytes explicitly (see io/bytes.h).
#include "model/io/bytes.h"

template class std::vector<std::uint8_t, tspace::UnsetAllocator<std::uint8_t>>;
