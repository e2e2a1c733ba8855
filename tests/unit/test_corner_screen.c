/* Places in perspective views by linear forms: any forms and scales, against the quotients in double. */
#include <math.h>

#include "check.h"
#include "exact.h"
#include "rng.h"
#include "shade/gn_corner.h"

#if GN_INTERPOLATES && GN_SHADOWS && GN_PUNCTUAL_LIGHTS
#define RECIP 0x1p-17 /* relative error of gn_recip_norm(m, 1) */

static rng random_state = {31};
static gn_frame frame;
static gn_lattice lattice;
static gn_surface surface;

static int32_t any(int32_t bits)
{
    return (int32_t)(rng_u32(&random_state) >> (33 - bits)) * (rng_below(&random_state, 2) ? 1 : -1);
}

/* Refused: depths below 2^22, or as large as a rounding makes them, and what lies beyond 63 degrees. Not seen: nearer
 * than the near plane, which `near` / 2^up of the depth is. */
static void compare(int32_t u, int32_t v, int32_t z, int32_t near, int32_t up, tally *refused, tally *seen, tally *at)
{
    gn_view_forms *forms = &lattice.forms[0];
    gn_light_view *view = &frame.view[0];
    gn_corner_light place = {0};
    forms->view = view;
    forms->u = (gn_slope){u, 0, 0}, forms->v = (gn_slope){v, 0, 0}, forms->z = (gn_slope){z, 0, 0};
    forms->near = (gn_slope){near, 0, 0};
    forms->near_up = up;
    forms->z_least = rng_below(&random_state, 2) ? 1 << 22 : 1 << 27;
    forms->less_q30 = GN_AUTO_BIAS && rng_below(&random_state, 2) ? any(31) & INT32_MAX : 0;
    forms->in_tile = GN_AUTO_BIAS && rng_below(&random_state, 4) == 0;
    view->tile_log2 = (uint8_t)rng_range(&random_state, 4, 10);
    view->tile_texels = (uint16_t)rng_range(&random_state, 8, 1 << view->tile_log2);
    const int found = gn_corner_place_flat(&lattice, &frame, &surface, 0, view, 7, 9, &place);
    const double share = near < 0 ? 0 : ldexp((double)near / z, -up), wide = fmax(fabs((double)u), fabs((double)v)) / z;
    const int inside = z >= forms->z_least && z < 1 << 30;
    if (fabs(share - 1) < 0x1p-16) return;
    if (!inside || share > 1) {
        HOLDS(inside ? seen : refused, inside ? found && !place.seen : !found, "z %d, share %g", (int)z, share);
        return;
    }
    /* a share's last bit is lost before it is scaled */
    const double texels = ldexp(1, 16 + view->tile_log2), end = view->tile_texels * 65536.0;
    const double lo = fmin(u, v) * texels / z, hi = fmax(u, v) * texels / z;
    const double off_lo = 2 + fabs(lo) * RECIP, off_hi = 2 + fabs(hi) * RECIP;
    if (fabs(wide - 2) < 1e-6 || (forms->in_tile && (fabs(lo) < off_lo || fabs(hi - end) < off_hi))) return;
    HOLDS(refused, found == (wide < 2), "u %d, v %d, z %d", (int)u, (int)v, (int)z);
    if (!found) return;
    const int outside = forms->in_tile && (lo < 0 || hi > end);
    HOLDS(seen, place.seen == (outside ? GN_SEEN_OUTSIDE : 1), "share %g, u %d, v %d", share, (int)u, (int)v);
    HOLDS(at,
          fabs(place.u_q16 - (double)u / z * texels) < 2 + fabs((double)u / z * texels) * RECIP &&
              fabs(place.v_q16 - (double)v / z * texels) < 2 + fabs((double)v / z * texels) * RECIP &&
              fabs(place.depth_q30 - fmax(0, ldexp(1 - share, 30) - forms->less_q30)) <
                  8 + ldexp(1, 30 - ilogb(z) - up) + share * ldexp(RECIP, 30),
          "u %d, v %d, z %d, near %d, up %d: %d %d %d", (int)u, (int)v, (int)z, (int)near, (int)up, (int)place.u_q16,
          (int)place.v_q16, (int)place.depth_q30);
}

static void test_places(void)
{
    tally refused = {0}, seen = {0}, at = {0};
    for (int i = 0; i < 400000; i++) {
        const int32_t z = any(31), bits = rng_range(&random_state, 8, 31);
        compare(any(bits), any(bits), i % 8 ? z : z >> rng_range(&random_state, 0, 12), any(31),
                rng_range(&random_state, i % 3 ? -2 : -20, i % 3 ? 8 : 40), &refused, &seen, &at);
    }
    compare(0, 0, INT32_MAX, 1, 0, &refused, &seen, &at);
    compare(0, 0, 1 << 30, 1, 0, &refused, &seen, &at);
    CHECK_TALLY(refused, "what forms do not tell");
    CHECK_TALLY(seen, "what is seen");
    CHECK_TALLY(at, "where it is seen");
}
#endif

int main(void)
{
#if GN_INTERPOLATES && GN_SHADOWS && GN_PUNCTUAL_LIGHTS
    test_places();
#endif
    return check_report();
}
