/* Hints to the compiler that change no result: each is nothing where it is not known. */
#ifndef GN_HINT_H
#define GN_HINT_H

#include "gn_config.h"

#ifdef GN_PORT
#include GN_PORT
#endif

/* Of a function that runs per pixel, row or texel, or is called by one that does: a port may place it where code is
 * fetched fastest (port/gn_port.h). In a file that has hot functions all are marked. */
#ifdef GN_PORT_HOT
#define GN_HOT GN_PORT_HOT
#else
#define GN_HOT
#endif

#if defined(__GNUC__)
/* v is taken for changed here, and neither computed before nor from what was. It keeps what an unrolled loop steps in
 * one register, and a branch a branch, where four registers and predicated instructions would cost more. */
#define GN_KEEP(v) __asm__ volatile("" : "+r"(v))
/* Of a function that is seldom called from a hot one: inlined, it would take registers. */
#define GN_NOINLINE __attribute__((noinline))
/* From one case into the next. */
#define GN_GOES_ON __attribute__((fallthrough))
/* A condition that is seldom true: what it guards goes out of the way. */
#define GN_SELDOM(c) __builtin_expect(!!(c), 0)
#else
#define GN_KEEP(v) ((void)0)
#define GN_NOINLINE
#define GN_GOES_ON   ((void)0)
#define GN_SELDOM(c) (c)
#endif

/* Where size comes first, a pointer to an element is computed once: v is not known to be what it was computed from. */
#if GN_SIZE_FIRST && defined(__GNUC__)
#define GN_ELEMENT(v) __asm__("" : "+r"(v))
#else
#define GN_ELEMENT(v) ((void)0)
#endif

/* Of a function that is called from few places: shared where size comes first, inlined otherwise. */
#if GN_SIZE_FIRST
#define GN_SHARED GN_NOINLINE
#else
#define GN_SHARED inline
#endif

/* Whether the core has an instruction that divides: the only question about the core that the library asks. */
#ifndef GN_CORE_DIVIDES
#if defined(__ARM_FEATURE_IDIV) || defined(__riscv_div)
#define GN_CORE_DIVIDES 1
#else
#define GN_CORE_DIVIDES 0
#endif
#endif

#endif
