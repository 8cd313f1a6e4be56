/* SPDX-License-Identifier: MIT */
/* Checks for test programs in C: a check that fails prints its location and ends the program with status 1. */
#ifndef TSPACE_TESTS_C_CHECK_H
#define TSPACE_TESTS_C_CHECK_H

#include <stdio.h>
#include <stdlib.h>

#define CHECK(condition)                                                              \
    do {                                                                              \
        if (!(condition)) {                                                           \
            fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #condition); \
            exit(1);                                                                  \
        }                                                                             \
    } while (0)

#endif
