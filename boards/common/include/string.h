/* For toolchains that come without a C library: what lib/ uses of string.h. boards/common/memory.c has it. */
#ifndef GNOMON_BOARDS_STRING_H
#define GNOMON_BOARDS_STRING_H

#include <stddef.h>

void *memset(void *to, int value, size_t n);
void *memcpy(void *restrict to, const void *restrict from, size_t n);
void *memmove(void *to, const void *from, size_t n);
int memcmp(const void *a, const void *b, size_t n);

#endif
