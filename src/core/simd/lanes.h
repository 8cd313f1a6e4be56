// SPDX-License-Identifier: MIT
// Included by all lanes_*.h.
//
// Rules for code that is compiled for one instruction set: it includes only these files and its own kernel, because an
// inline function of a shared header might be emitted with instructions that other CPUs do not support, and the linker
// keeps a single copy of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
