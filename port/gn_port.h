/* The port contract: what a port to a core may provide. Everything has a portable default, so that a port starts empty
 * and grows where it pays. docs/FIRMWARE.md tells how to write and test one; port/template compiles.
 *
 * A port is a folder port/NAME with gn_port_NAME.h, which includes this header, and .c files. The library is compiled
 * with -DGN_PORT='"gn_port_NAME.h"' -Iport -Iport/NAME, and the folder's .c files are linked.
 */
#ifndef GN_PORT_H
#define GN_PORT_H

#include <stddef.h>
#include <stdint.h>

/* ---- Placement -----------------------------------------------------------------------------------------------------
 *
 * Hot code: functions that run per pixel, row or texel, and their callees, are marked in the library (GN_HOT) and in
 * ports. With GN_PORT_HOT_SECTION, a string that a port's header or -D defines, each such function has a section of its
 * own, GN_PORT_HOT_SECTION and a number, which a linker script places and may drop if nothing calls it. On a Raspberry
 * Pi Pico, whose SDK has the linker script, it is ".time_critical.gnomon". Without it functions stay in their default
 * section.
 *
 * Buffers: a program marks what should live in fast memory (the screen tile's gn_scratch above all, then the
 * gn_renderer), and what a DMA engine reads. The linker script places .fast. DMA buffers are aligned to the largest
 * cache line of all supported cores.
 */
#if defined(GN_PORT_HOT_SECTION) && defined(__GNUC__)
#define GN_PORT_TEXT__(n) #n
#define GN_PORT_TEXT_(n)  GN_PORT_TEXT__(n)
#define GN_PORT_HOT       __attribute__((section(GN_PORT_HOT_SECTION "." GN_PORT_TEXT_(__COUNTER__))))
#else
#define GN_PORT_HOT
#endif
#if defined(__GNUC__)
#define GN_PORT_FAST __attribute__((section(".fast")))
#define GN_PORT_DMA  __attribute__((aligned(32)))
#else
#define GN_PORT_FAST
#define GN_PORT_DMA
#endif

/* ---- Cache maintenance ---------------------------------------------------------------------------------------------
 *
 * Called with memory that the library or a display driver has written, before a DMA engine reads it. Owes: when it
 * returns, n_bytes from `bytes` on are in memory, not only in a data cache or a write buffer. n_bytes may be 0; `bytes`
 * may have any alignment.
 */
void gn_port_before_dma(const void *bytes, size_t n_bytes);

/* ---- Kernels -------------------------------------------------------------------------------------------------------
 *
 * Each owes the same bits as its portable definition for every argument within the preconditions, accesses no other
 * memory, needs no alignment beyond that of the types, and may be called from several cores at once.
 *
 * Replaced by name, in the port's header:
 *   #define gn_kernel_dark_texels16 gn_port_dark_texels16
 *                     16-bit shadow texels under a tent; lib/base/gn_q.h defines it
 *
 * Replaced by linking:
 *   memset            clears screen tiles and shadow tiles: many whole words. The C library defines its behaviour
 *   __aeabi_lmul      a 64-bit product modulo 2^64: on cores without a wide multiplication, most products of two
 *                     32-bit values
 */
uint32_t gn_port_dark_texels16(const uint16_t *texel, size_t pitch, uint32_t least, int32_t n, uint8_t *dark);

#endif
