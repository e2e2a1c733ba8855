/* The library with compact arithmetic as one function beside the host's, of which it shares no symbol:
 * tests/oracle/test_compact.sh. */
#ifndef GNOMON_TESTS_COMPACT_ENGINE_H
#define GNOMON_TESTS_COMPACT_ENGINE_H

#include "gnomon.h"

/* Renders into width * height pixels each: colours, object << 32 | triangle (-1: none), and what is left of the light
 * (0 .. 65536; 0 where the surface faces away). The last two may be NULL. */
gn_status compact_render(const gn_scene *scene, int width, int height, uint16_t *rgb565, int64_t *triangle,
                         uint32_t *shadow_uq16);

#endif
