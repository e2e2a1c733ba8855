/* Textures of patches: the level that a small triangle shows, and coordinates at its corners. */
#include "gn_internal.h"

#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_texture.h"
#include "shade/gn_patch.h"
#include "shade/gn_record.h"

#if GN_INTERPOLATES && GN_TEXTURES

/* Coordinates of a vertex, as they are stored. */
GN_HOT static inline const int16_t *uv_of(const gn_patch *p, int k)
{
    return p->shared->of.object->mesh->uv + 2 * (size_t)p->record.vertex[k];
}

#if GN_MIPMAPS
/* The texture's level whose texels are nearest to a pixel's size over the triangle: MODEL 8 with the areas of both. */
GN_HOT static int32_t find_patch_level(gn_shading *s, const gn_texture *texture)
{
    const gn_patch *p = &s->lattice.from.patch;
    const int16_t *a = uv_of(p, 0), *b = uv_of(p, 1), *c = uv_of(p, 2);
    /* halves, so that twice the area fits: 2^30 */
    const int32_t u1 = (b[0] - a[0]) >> 1, v1 = (b[1] - a[1]) >> 1, u2 = (c[0] - a[0]) >> 1, v2 = (c[1] - a[1]) >> 1;
    const uint32_t area = gn_abs32(u1 * v2 - u2 * v1);
    if (!area) return 0;
    const uint64_t texels = (uint64_t)area * (gn_texture_size(texture, 0) * gn_texture_size(texture, 1)); /* 2^54 */
    gn_patch_face(s);
    const int32_t level2 =
        gn_record_level2(&p->record, s->frame, p->view_q14, texels, 2 - 2 * p->shared->of.object->mesh->uv_frac_bits);
    int32_t level = level2 < 0 ? 0 : (level2 + 1) >> 1, n = 0;
    while (n < level && ((gn_texture_size(texture, 0) | gn_texture_size(texture, 1)) >> n) > 1) n++;
    return n;
}
#endif

/* Texels along an axis at the corners, Q17; a bilinear texture's are half a texel less. Returns 0 beyond 2^12 texels.
 */
GN_HOT static int find_patch_axis(gn_patch *p, const int16_t *a, const int16_t *b, const int16_t *c, int axis)
{
    const int32_t frac = p->shared->of.object->mesh->uv_frac_bits, size = (int32_t)gn_texture_size(p->texture, axis),
                  less = p->texture->flags & GN_TEXTURE_BILINEAR ? 65536 - 256 : 0, limit = 12 + frac, up = 17 - frac;
    /* whole turns change nothing where a texture repeats */
    const int32_t turns = gn_texture_clamps(p->texture, axis) ? 0 : a[axis] & -(1 << frac);
    const int32_t t0 = (a[axis] - turns) * size, t1 = (b[axis] - turns) * size,
                  t2 = (c[axis] - turns) * size; /* 2^29 */
    if ((gn_abs32(t0) | gn_abs32(t1) | gn_abs32(t2)) >> limit) return 0;
    gn_patch_set(&p->texel_q17[axis], t0 * (1 << up) - less, t1 * (1 << up) - less, t2 * (1 << up) - less);
    return 1;
}

GN_HOT int gn_patch_find_texture(gn_shading *s)
{
    gn_patch *p = &s->lattice.from.patch;
    p->texture = p->shared->of.object->texture;
#if GN_MIPMAPS
    if (gn_texture_has_levels(p->texture)) {
        gn_texture_use_level(&p->level, p->texture, (uint32_t)find_patch_level(s, p->texture));
        p->texture = &p->level;
    }
#endif
    const int16_t *a = uv_of(p, 0), *b = uv_of(p, 1), *c = uv_of(p, 2);
    return find_patch_axis(p, a, b, c, 0) && find_patch_axis(p, a, b, c, 1);
}

#endif
