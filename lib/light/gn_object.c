/* Boxes of objects: axis-aligned bounds in the world, by which lights, views and tiles leave objects out. */
#include "gn_internal.h"

#include "base/gn_count.h"
#include "base/gn_math.h"
#include "base/gn_q.h"
#include "geometry/gn_skin.h"
#include "geometry/gn_xform.h"
#include "light/gn_lights.h"
#include "scene/gn_scene.h"

/* Least and largest of n coordinates, three apart. */
static void stored_extent(const gn_position *at, uint32_t n, int32_t *lo, int32_t *hi)
{
    int32_t least = *at, most = least;
    for (; n; n--, at += 3) {
        least = gn_min32(least, *at);
        most = gn_max32(most, *at);
    }
    *lo = least;
    *hi = most;
}

/* The same of all coordinates of a mesh that its skin poses. Vertices whose place is a word of records are kept: the
 * last one's ends with the records, or all places are below 0, as a mesh of 2^28 vertices would take gigabytes. */
static void posed_extent(const gn_object *object, gn_records *records, int32_t place, int32_t lo[3], int32_t hi[3])
{
    int32_t p[3];
    for (uint32_t i = 0; i < object->mesh->n_vertices; i++, place += 3) {
        gn_position_of(p, object, i);
        GN_UNROLL
        for (int k = 0; k < 3; k++) {
            lo[k] = i ? gn_min32(lo[k], p[k]) : p[k];
            hi[k] = i ? gn_max32(hi[k], p[k]) : p[k];
        }
        for (int k = 0; place >= 0 && k < 3; k++) records->word[place + k] = p[k];
    }
}

/* Centre and half extents of the mesh's vertices, posed by the skin if it has one and then kept, in the mesh's own
 * format. Returns 0 if a position is out of range. */
static int mesh_box(const gn_object *object, gn_records *records, int32_t place, int32_t centre[3], int32_t half[3])
{
    const gn_mesh *mesh = object->mesh;
    int32_t lo[3], hi[3];
    GN_COUNT(boxed, mesh->n_vertices);
    if (GN_SIZE_FIRST || GN_SKIN(object)) posed_extent(object, records, place, lo, hi);
    else
        for (int k = 0; k < 3; k++) stored_extent(mesh->pos + k, mesh->n_vertices, &lo[k], &hi[k]);
    if (!gn_position_ok(lo) || !gn_position_ok(hi)) return 0;
    for (int k = 0; k < 3; k++) {
        centre[k] = (int32_t)(((int64_t)lo[k] + hi[k]) >> 1);
        half[k] = (int32_t)(((int64_t)hi[k] - lo[k] + 1) >> 1);
    }
    return 1;
}

/* The word of records where the vertices of skins begin: they end with the last word, as records are written from the
 * first on. Below 0: the first vertices have no room. */
static int64_t posed_begin(const gn_frame *frame)
{
    int64_t first = sizeof(gn_records) / sizeof(int32_t);
    for (uint32_t i = 0; i < frame->scene->n_objects; i++)
        if (GN_SKIN(&frame->scene->objects[i])) first -= (int64_t)3 * frame->scene->objects[i].mesh->n_vertices;
    return first;
}

gn_status gn_object_boxes(gn_frame *frame)
{
    static const int32_t world[3][3] = {{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, origin[3] = {0, 0, 0};
    int64_t next = posed_begin(frame);
    for (uint32_t i = 0; i < frame->scene->n_objects; i++) {
        const gn_object *object = &frame->scene->objects[i];
        gn_object_state *state = &frame->object[i];
        int32_t centre[3], half[3],
            place = GN_SKIN(object) && next > GN_POSED_NOWHERE ? (int32_t)next : GN_POSED_NOWHERE;
        gn_xform xform;
        if (GN_SKIN(object)) next += (int64_t)3 * object->mesh->n_vertices;
#if GN_VERTEX_JOINTS
        state->posed = place;
#endif
        if (!mesh_box(object, &frame->records, place, centre, half))
            return GN_FAIL_AT(frame, GN_ERR_VERTEX_RANGE, i, GN_FIELD_MESH_POS);
        uint64_t farthest = 0; /* OR of the largest coordinates: bit 31 and above tell that one is too large */
        gn_xform_compose(&xform, world, origin, object);
        for (int r = 0; r < 3; r++) {
            int64_t c = gn_shr64(gn_dot64(xform.m[r], centre), xform.shift) + xform.t_q16[r];
            uint64_t h = 0; /* three products of at most 2^60 */
            for (int k = 0; k < 3; k++) h += (uint64_t)gn_abs32(xform.m[r][k]) * (uint32_t)half[k];
            h = (h >> xform.shift) + 2; /* outwards by what the centre, this and the vertices are rounded by */
            farthest |= gn_abs64(c) + h;
            state->centre_q16[r] = (int32_t)c;
            state->half_q16[r] = (int32_t)h;
        }
        /* beyond 32 bits: the box becomes everything a view can see, as the object may still cast a shadow into it */
        for (int r = 0; farthest >> 31 && r < 3; r++) state->centre_q16[r] = 0, state->half_q16[r] = INT32_MAX;
    }
    return GN_OK;
}

uint64_t gn_object_distance2_q32(const gn_object_state *object, const int32_t p_q16[3])
{
    uint64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        int64_t d = (int64_t)gn_abs64((int64_t)p_q16[k] - object->centre_q16[k]) - object->half_q16[k];
        if (d > (int64_t)1 << 31) d = (int64_t)1 << 31; /* three squares below 2^64 */
        if (d > 0) sum += (uint64_t)(d * d);
    }
    return sum;
}
