/* Types that every stage uses. Private, as all gn_*_types.h are: gn_state.h combines them into a renderer's state.
 */
#ifndef GN_BASE_TYPES_H
#define GN_BASE_TYPES_H

#include <stdint.h>

#include "gn_knobs.h"

/* A block float: a positive number mant * 2^exp, mant in [2^31, 2^32). See gn_math.h. */
typedef struct {
    uint32_t mant;
    int32_t exp;
} gn_bfloat;

/* Pixels whose centres lie in the triangle's bounding box, cut to the picture: x0 <= x < x1, y0 <= y < y1. */
typedef struct {
    int32_t x0, y0, x1, y1;
} gn_rect;

/* A colour in linear light, 65535: 1; red is the lower half of its word. */
typedef struct {
    uint32_t red_green, blue;
} gn_texel_rgb;

/* ---- Hints to the compiler that change no result ----------------------------------------------------------------- */

/* On a compiler that lacks one, that hint is empty. */

#ifdef GN_PORT
#include GN_PORT
#endif

/* Marks a function that runs per pixel, row or texel, or is called by one that does: a port may place it in fast memory
 * (port/gn_port.h). In a file that has hot functions all are marked. */
#ifdef GN_PORT_HOT
#define GN_HOT GN_PORT_HOT
#else
#define GN_HOT
#endif

#if defined(__GNUC__)
/* Tells the compiler that v changes here, so that v is not precomputed from earlier values. An unrolled loop then steps
 * one register instead of four, and a branch is not turned into predicated instructions. */
#define GN_KEEP(v) __asm__ volatile("" : "+r"(v))
/* For a function that is seldom called from a hot one: inlined, it would take registers. */
#define GN_NOINLINE __attribute__((noinline))
/* Bytes to words: a load or two each, where memcpy would be called (-ffreestanding). */
#define GN_COPY_WORDS(to, from, n) __builtin_memcpy(to, from, n)
/* For a function that runs a few times in a frame, and what it alone calls: few bytes before few instructions. */
#define GN_COLD __attribute__((cold))
/* Intended fall-through from one case into the next. */
#define GN_GOES_ON __attribute__((fallthrough))
/* A condition that is seldom true: its code is moved out of the fast path. */
#define GN_SELDOM(c) __builtin_expect(!!(c), 0)
#else
#define GN_KEEP(v) ((void)0)
#define GN_NOINLINE
#define GN_COPY_WORDS(to, from, n) memcpy(to, from, n)
#define GN_COLD
#define GN_GOES_ON   ((void)0)
#define GN_SELDOM(c) (c)
#endif

/* Before a loop of two to four turns, their number known: written out, whatever that takes of flash. Not with
 * GN_SIZE_FIRST. */
#if !GN_SIZE_FIRST && defined(__GNUC__) && (__GNUC__ >= 8 || defined(__clang__))
#define GN_UNROLL _Pragma("GCC unroll 4")
#else
#define GN_UNROLL
#endif

/* What the library asks of the core: whether it divides, and whether it multiplies two words to a double one. */
#ifndef GN_CORE_DIVIDES
#if defined(__ARM_FEATURE_IDIV) || defined(__riscv_div)
#define GN_CORE_DIVIDES 1
#else
#define GN_CORE_DIVIDES 0
#endif
#endif
#ifndef GN_CORE_LONG_PRODUCTS
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__)
#define GN_CORE_LONG_PRODUCTS 0
#else
#define GN_CORE_LONG_PRODUCTS 1
#endif
#endif

#endif
