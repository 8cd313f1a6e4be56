// SPDX-License-Identifier: MIT
// Included by all lanes_*.h.
//
// Rules for code that is compiled for one CPU: it includes nothing but these files and its own kernel,
// because an inline function of a shared header might be emitted with instructions that other CPUs do not
// have, and the linker keeps one copy of it for all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
