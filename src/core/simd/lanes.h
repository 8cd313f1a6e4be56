// SPDX-License-Identifier: MIT
// What all lanes_*.h include.
//
// Rules for code that is compiled for one CPU: it includes nothing but these files and its own kernel,
// because an inline function of a shared header might be emitted with instructions that other CPUs do not
// have, and the linker keeps one copy of it for everybody.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
