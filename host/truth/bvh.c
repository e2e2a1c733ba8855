/* A hierarchy of boxes over the casting triangles.
 *
 * Built over a stack of its own, by the surface-area heuristic over bins of the boxes' centres; in equal halves below a
 * depth of 32, and where the centres coincide, so that 2^32 triangles end before depth 64. The order of the scene alone
 * decides the tree.
 */
#include "truth.h"

#include <float.h>
#include <stdlib.h>

enum { LEAF = 4, BINS = 16, SAH_DEPTH = 32 };

typedef struct {
    double low[3], high[3];
} box;

static const box no_box = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

static void grow(box *b, vec3 p)
{
    double at[3];
    vec3_store(at, p);
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], at[k]);
        b->high[k] = fmax(b->high[k], at[k]);
    }
}

static void unite(box *b, const box *other)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], other->low[k]);
        b->high[k] = fmax(b->high[k], other->high[k]);
    }
}

static box box_of(const truth_caster *c)
{
    box b = no_box;
    for (int k = 0; k < 3; k++) grow(&b, c->p[k]);
    return b;
}

static double half_area(const box *b)
{
    const double x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    return x * y + y * z + z * x;
}

static double centre(const truth_caster *c, int axis)
{
    const box b = box_of(c);
    return 0.5 * b.low[axis] + 0.5 * b.high[axis];
}

/* Where a range of casters is cut. */
typedef struct {
    int axis; /* -1: nowhere */
    int bin;  /* the first of the right side */
    double low, per_bin;
    double cost;
} cut;

static int bin_of(const cut *at, const truth_caster *c)
{
    return (int)clamp((centre(c, at->axis) - at->low) / at->per_bin, 0.0, BINS - 1);
}

static void try_axis(cut *best, const truth_caster *casters, uint32_t n, int axis)
{
    cut at = {.axis = axis, .low = HUGE_VAL};
    double high = -HUGE_VAL;
    for (uint32_t i = 0; i < n; i++) {
        at.low = fmin(at.low, centre(&casters[i], axis));
        high = fmax(high, centre(&casters[i], axis));
    }
    at.per_bin = (high - at.low) / BINS;
    if (!(at.per_bin > 0.0)) return;

    box bins[BINS], right[BINS];
    uint32_t count[BINS] = {0};
    for (int i = 0; i < BINS; i++) bins[i] = no_box;
    for (uint32_t i = 0; i < n; i++) {
        const box b = box_of(&casters[i]);
        unite(&bins[bin_of(&at, &casters[i])], &b);
        count[bin_of(&at, &casters[i])]++;
    }
    right[BINS - 1] = bins[BINS - 1];
    for (int i = BINS - 2; i >= 0; i--) {
        right[i] = bins[i];
        unite(&right[i], &right[i + 1]);
    }
    box left = no_box;
    uint32_t n_left = 0;
    for (at.bin = 1; at.bin < BINS; at.bin++) {
        unite(&left, &bins[at.bin - 1]);
        n_left += count[at.bin - 1];
        if (n_left == 0 || n_left == n) continue;
        at.cost = n_left * half_area(&left) + (n - n_left) * half_area(&right[at.bin]);
        if (best->axis < 0 || at.cost < best->cost) *best = at;
    }
}

/* Puts the left side first, and returns how many it has. */
static uint32_t split(truth_caster *casters, uint32_t n, int depth)
{
    cut best = {.axis = -1};
    for (int axis = 0; axis < 3 && depth < SAH_DEPTH; axis++) try_axis(&best, casters, n, axis);
    if (best.axis < 0) return n / 2;
    uint32_t n_left = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (bin_of(&best, &casters[i]) >= best.bin) continue;
        const truth_caster c = casters[i];
        casters[i] = casters[n_left];
        casters[n_left++] = c;
    }
    return n_left;
}

static void fit_node(truth_node *node, const truth_caster *casters, uint32_t first, uint32_t n)
{
    box b = no_box;
    for (uint32_t i = first; i < first + n; i++)
        for (int k = 0; k < 3; k++) grow(&b, casters[i].p[k]);
    *node = (truth_node){.low = vec3_load(b.low), .high = vec3_load(b.high), .first = first, .n_casters = n};
}

static void build(truth_tracer *t)
{
    struct {
        uint32_t node;
        int depth;
    } stack[TRUTH_MAX_DEPTH + 1];
    int n_stacked = 0;
    fit_node(&t->nodes[0], t->casters, 0, (uint32_t)t->n_casters);
    t->n_nodes = 1;
    stack[n_stacked].node = 0;
    stack[n_stacked++].depth = 0;
    while (n_stacked > 0) {
        const int depth = stack[--n_stacked].depth;
        truth_node *node = &t->nodes[stack[n_stacked].node];
        const uint32_t first = node->first, n = node->n_casters;
        if (n <= LEAF) continue;
        const uint32_t n_left = split(t->casters + first, n, depth), left = (uint32_t)t->n_nodes;
        fit_node(&t->nodes[left], t->casters, first, n_left);
        fit_node(&t->nodes[left + 1], t->casters, first + n_left, n - n_left);
        t->n_nodes += 2;
        node->first = left;
        node->n_casters = 0;
        for (uint32_t side = 0; side < 2; side++) {
            stack[n_stacked].node = left + side;
            stack[n_stacked++].depth = depth + 1;
        }
    }
}

static size_t count_casters(const ref_frame *frame)
{
    size_t n = 0;
    for (size_t o = 0; o < frame->s->n_objects; o++)
        if (ref_casts(frame, o)) n += frame->s->meshes[frame->s->objects[o].mesh_idx].n_triangles;
    return n;
}

static void take_object(truth_tracer *t, const ref_frame *frame, size_t object_idx)
{
    const scene_object *object = &frame->s->objects[object_idx];
    const size_t n = frame->s->meshes[object->mesh_idx].n_triangles;
    for (size_t i = 0; i < n; i++) {
        truth_caster *c = &t->casters[t->n_casters++];
        c->source = ref_triangle_of(frame, object_idx, i);
        c->two_sided = object->two_sided || object->casts_two_sided;
        c->uncertainty = truth_vertex_error(&c->source);
        for (int k = 0; k < 3; k++) {
            c->p[k] = c->source.instance->world[c->source.idx[k]];
            t->extent = fmax(t->extent, fmax(fabs(c->p[k].x), fmax(fabs(c->p[k].y), fabs(c->p[k].z))));
        }
    }
}

const char *truth_begin(truth_tracer *tracer, const ref_frame *frame)
{
    const size_t n = count_casters(frame);
    *tracer = (truth_tracer){.s = frame->s};
    if (n > UINT32_MAX / 2) return "too many triangles";
    tracer->casters = calloc(n + 1, sizeof *tracer->casters);
    tracer->nodes = calloc(2 * n + 1, sizeof *tracer->nodes);
    if (!tracer->casters || !tracer->nodes) return "out of memory for the casters";
    for (size_t o = 0; o < frame->s->n_objects; o++)
        if (ref_casts(frame, o)) take_object(tracer, frame, o);
    if (n > 0) build(tracer);
    return NULL;
}

void truth_end(truth_tracer *tracer)
{
    free(tracer->casters);
    free(tracer->nodes);
    *tracer = (truth_tracer){0};
}

/* ---- the way of a ray ---- */

/* A ray against boxes: in or out is decided in doubles, so the boxes are made larger by what rounding can do. The
 * subtraction of the origin is off by the origin's error and a unit of the difference; the division by the way, and the
 * way's own error, move the point where a side is met along the other axes by less than four units of the distance
 * gone, which is at most the sum of the scene's extent and the origin's coordinate. Twice that is added to every side.
 */
typedef struct {
    double from[3], inverse[3], margin;
    bool flat[3]; /* no way along this axis, or too short to divide by */
    double end;   /* t of the target */
} slab_ray;

static slab_ray make_slab_ray(const truth_ray *ray, double extent)
{
    slab_ray out;
    double to[3];
    vec3_store(to, ray->to);
    vec3_store(out.from, ray->from);
    const double farthest = extent + fmax(fabs(ray->from.x), fmax(fabs(ray->from.y), fabs(ray->from.z)));
    out.margin = 2.0 * (ray->from_error + ray->to_error + 8.0 * DBL_EPSILON * farthest);
    out.end = ray->target.infinite ? HUGE_VAL : 1.0 + 4.0 * DBL_EPSILON;
    for (int k = 0; k < 3; k++) {
        out.inverse[k] = 1.0 / to[k];
        out.flat[k] = !(fabs(to[k]) > 1e-290);
    }
    return out;
}

static bool meets_box(const slab_ray *ray, const truth_node *node)
{
    double low[3], high[3], begin = 0.0, end = ray->end;
    vec3_store(low, node->low);
    vec3_store(high, node->high);
    for (int k = 0; k < 3; k++) {
        const double a = low[k] - ray->from[k] - ray->margin, b = high[k] - ray->from[k] + ray->margin;
        if (ray->flat[k]) {
            if (a > 0.0 || b < 0.0) return false;
            continue;
        }
        const double ta = a * ray->inverse[k], tb = b * ray->inverse[k];
        begin = fmax(begin, fmin(ta, tb));
        end = fmin(end, fmax(ta, tb));
    }
    return begin <= end;
}

void truth_visit(const truth_tracer *tracer, const truth_ray *ray, truth_visitor *meet, void *user)
{
    uint32_t stack[TRUTH_MAX_DEPTH + 1];
    int n_stacked = 0;
    const slab_ray slabs = make_slab_ray(ray, tracer->extent);
    if (tracer->n_nodes > 0) stack[n_stacked++] = 0;
    while (n_stacked > 0) {
        const truth_node *node = &tracer->nodes[stack[--n_stacked]];
        if (!meets_box(&slabs, node)) continue;
        if (node->n_casters == 0) {
            stack[n_stacked++] = node->first + 1;
            stack[n_stacked++] = node->first;
        }
        for (uint32_t i = 0; i < node->n_casters; i++)
            if (!meet(user, &tracer->casters[node->first + i])) return;
    }
}
