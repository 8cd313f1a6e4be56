// SPDX-License-Identifier: MIT
#pragma once

#include "tspace/execution.h"

namespace tspace {

/// The options of a call, and what it runs on: below the border both go the same ways.
template <class Options>
struct Call : Options {
    Execution execution = {};
};

}  // namespace tspace
