/* The workload of the speed measurement: two sets of random triangles for a 320x240 picture with a horizontal field of
 * view of 90 degrees, deterministic (tests/bench/bench_workload.c holds their checksum). */
#ifndef GNOMON_TESTS_BENCH_GEN_H
#define GNOMON_TESTS_BENCH_GEN_H

#include <stdint.h>

enum { BENCH_WIDTH = 320, BENCH_HEIGHT = 240, BENCH_FOCAL_PX = BENCH_WIDTH / 2 };
enum { BENCH_N_LARGE = 200, BENCH_N_SMALL = 1000 };
enum { BENCH_FRAC_BITS = 9 };

/* View space, x right, y up, z forward, BENCH_FRAC_BITS fraction bits; counter-clockwise seen from the eye. */
typedef struct {
    int32_t v[3][3];
} bench_triangle;

/* Set L: areas of 800 to 1500 px; set S: 15 to 25 px. One random sequence runs through both. */
void bench_generate(bench_triangle large[BENCH_N_LARGE], bench_triangle small[BENCH_N_SMALL]);

#endif
