// SPDX-License-Identifier: MIT
// Headers of the C++ library that most files include. They are precompiled, because parsing them takes longer than
// compiling most files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bit_cast.h"
