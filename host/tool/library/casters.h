/* What shadow tiles have to do with casters: which features of theirs pictures could have been without. */
#ifndef GNOMON_CASTERS_H
#define GNOMON_CASTERS_H

#include "../settings/settings.h"

/* Of frames that were drawn, all together. */
typedef struct {
    size_t clipped;               /* visible triangles that were */
    size_t unseen;                /* by boxes: casters that a shadow tile does not see */
    int64_t extent_q16, seen_q16; /* how far casters lie from the corner of a directional light's tile: all, and those
                                     it sees */
} casters;

/* Adds the shadow tiles of the frame that the general library drew last. */
void casters_add(casters *c, const gn_renderer *r);

/* How far they lie, all or those that boxes let through. */
enum { CASTERS_TEXELS_MAX = 8192 };
int casters_texels(const casters *c, bool boxes);

/* 0, or -1 with one line in error: the library refuses these frames without clipping. */
int casters_check(const casters *c, const settings *set, char *error, size_t error_bytes);

#endif
