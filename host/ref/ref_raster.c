/* The visible surface at each pixel (MODEL 1, 2), by homogeneous edge functions in view space.
 *
 * The ray through a pixel centre is (s, t, F) with s = sx - W/2, t = H/2 - sy. Relative to the ray, a vertex (X, Y, Z)
 * lies at q = (F X - s Z, F Y - t Z), and q_a x q_b is, up to a positive factor, the determinant of ray, a, b: the edge
 * function, and the weight of the vertex opposite. Nothing is divided by a vertex's depth, so vertices behind the
 * camera need no clipping: where the three weights have one sign, the ray's line meets the triangle, and the depth
 * there says whether in front of near.
 */
#include "ref_internal.h"

typedef struct {
    vec3 p[3]; /* view space; parallel rays: with 1 for Z, which makes (X, Y, Z) the same homogeneous coordinates */
    double depth[3];
    vec2 growth[3]; /* of the edge function opposite to p[k], to the right and downwards, over F */
    int64_t id;
    ref_triangle source;
} view_triangle;

/* Indices of the samples at half-integers inside [low, high]; one too many on each side at most. Clamped before the
 * conversion: the corners of huge triangles fit no int. */
ref_box ref_clip_box(vec2 low, vec2 high, int width, int height)
{
    return (ref_box){.x0 = (int)clamp(floor(low.x - 0.5), 0.0, width),
                     .y0 = (int)clamp(floor(low.y - 0.5), 0.0, height),
                     .x1 = (int)clamp(ceil(high.x - 0.5), -1.0, width - 1.0),
                     .y1 = (int)clamp(ceil(high.y - 0.5), -1.0, height - 1.0)};
}

static void grow_box(vec2 *low, vec2 *high, const ref_camera *camera, vec3 p)
{
    const double scale = camera->parallel ? camera->focal_px : camera->focal_px / p.z;
    const double x = camera->half_width_px + scale * p.x;
    const double y = camera->half_height_px - scale * p.y;
    *low = (vec2){fmin(low->x, x), fmin(low->y, y)};
    *high = (vec2){fmax(high->x, x), fmax(high->y, y)};
}

/* Bounds of the part of the triangle with Z >= near: its corners there, and where its edges cross the plane. [R3] */
static ref_box triangle_box(const vec3 p[3], const ref_camera *camera, int width, int height)
{
    vec2 low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
    const double near = camera->near;
    for (int k = 0; k < 3; k++) {
        const vec3 a = p[k], b = p[(k + 1) % 3];
        if (a.z >= near) grow_box(&low, &high, camera, a);
        if ((a.z >= near) == (b.z >= near)) continue;
        vec3 crossing = vec3_add(a, vec3_scale(vec3_sub(b, a), (near - a.z) / (b.z - a.z)));
        crossing.z = near;
        grow_box(&low, &high, camera, crossing);
    }
    return ref_clip_box(low, high, width, height);
}

/* +1: covered, front face; -1: covered, back face; 0: not covered. Where the line meets the triangle behind the camera
 * the sign is the other one, and the caller's depth test refuses it. */
static int pixel_coverage(const view_triangle *triangle, double s, double t, double focal_px, double weight[3])
{
    const vec3 *p = triangle->p;
    vec2 q[3];
    for (int k = 0; k < 3; k++) q[k] = (vec2){focal_px * p[k].x - s * p[k].z, focal_px * p[k].y - t * p[k].z};
    int sides = 0;
    for (int k = 0; k < 3; k++) {
        weight[k] = cross2(q[(k + 1) % 3], q[(k + 2) % 3]);
        sides += edge_side(weight[k], triangle->growth[k].x, triangle->growth[k].y);
    }
    return sides == 3 ? 1 : sides == -3 ? -1 : 0;
}

/* Puts a transparent surface between those that are kept, behind others of its depth, which were drawn before. [M8] */
static void add_layer(ref_frame *frame, const view_triangle *triangle, const ref_hit *hit, double depth, size_t pixel)
{
    ref_picture *p = frame->picture;
    ref_layer *layer = p->layer + pixel * (size_t)p->n_layers;
    ref_layer next = {.depth = depth,
                      .triangle = triangle->id,
                      .bary = {hit->bary[0], hit->bary[1], hit->bary[2]},
                      .behind = hit->behind,
                      .alpha = ref_alpha(frame->s, &triangle->source, hit->bary)};
    if (!(next.alpha > 0.0)) return;
    for (int k = 0; k < p->n_layers; k++) {
        const ref_layer was = layer[k];
        if (was.alpha > 0.0 && was.depth <= next.depth) continue;
        layer[k] = next;
        next = was;
    }
}

/* The nearest depth wins, the first drawn at equal depths. Where alpha cuts [M8] there is no surface, and what is
 * behind is seen. [R2] */
static void draw_on_pixel(ref_frame *frame, const view_triangle *triangle, int i, int j)
{
    const ref_camera *camera = &frame->camera;
    const double s = i + 0.5 - camera->half_width_px, t = camera->half_height_px - (j + 0.5);
    double weight[3];
    const int facing = pixel_coverage(triangle, s, t, camera->focal_px, weight) * triangle->source.instance->sign;
    const scene_object *object = triangle->source.object;
    if (facing == 0 || (facing < 0 && !object->two_sided)) return;
    const double sum = weight[0] + weight[1] + weight[2];
    if (!(fabs(sum) > 0.0)) return;
    ref_hit hit = {.behind = facing < 0};
    for (int k = 0; k < 3; k++) hit.bary[k] = weight[k] / sum;
    const double depth =
        hit.bary[0] * triangle->depth[0] + hit.bary[1] * triangle->depth[1] + hit.bary[2] * triangle->depth[2];
    const size_t pixel = (size_t)j * (size_t)frame->picture->width + (size_t)i;
    if (!(depth >= camera->near) || !(depth < frame->picture->depth[pixel])) return;
    if (object->visible_alpha == SCENE_ALPHA_BLEND && frame->picture->n_layers) {
        add_layer(frame, triangle, &hit, depth, pixel);
        return;
    }
    if (object->visible_alpha != SCENE_ALPHA_OPAQUE &&
        ref_alpha_cuts(object->visible_alpha, ref_alpha(frame->s, &triangle->source, hit.bary), object->alpha_cutoff, i,
                       j))
        return;
    frame->picture->depth[pixel] = depth;
    frame->picture->triangle[pixel] = triangle->id;
    frame->hits[pixel] = hit;
}

/* The derivatives to s and t are x and y of a x b; by cross2 they change sign with the edge's direction and nothing
 * else. */
static void draw_triangle(ref_frame *frame, view_triangle *triangle)
{
    const ref_box box = triangle_box(triangle->p, &frame->camera, frame->picture->width, frame->picture->height);
    for (int k = 0; k < 3; k++) {
        triangle->depth[k] = triangle->p[k].z;
        if (frame->camera.parallel) triangle->p[k].z = 1.0;
    }
    for (int k = 0; k < 3; k++) {
        const vec3 a = triangle->p[(k + 1) % 3], b = triangle->p[(k + 2) % 3];
        triangle->growth[k].x = cross2((vec2){a.y, a.z}, (vec2){b.y, b.z});
        triangle->growth[k].y = -cross2((vec2){a.z, a.x}, (vec2){b.z, b.x});
    }
    for (int j = box.y0; j <= box.y1; j++)
        for (int i = box.x0; i <= box.x1; i++) draw_on_pixel(frame, triangle, i, j);
}

/* Of the layers those that nothing opaque hides: of the same depth, only what was drawn before it. */
static void drop_hidden(ref_picture *p, size_t pixel)
{
    ref_layer *layer = p->layer + pixel * (size_t)p->n_layers;
    for (int k = 0; k < p->n_layers; k++)
        if (layer[k].depth > p->depth[pixel] ||
            (layer[k].depth == p->depth[pixel] && layer[k].triangle > p->triangle[pixel]))
            layer[k].alpha = 0.0;
}

void ref_find_surfaces(ref_frame *frame)
{
    const size_t n_pixels = (size_t)frame->picture->width * (size_t)frame->picture->height;
    for (size_t i = 0; i < n_pixels * (size_t)frame->picture->n_layers; i++)
        frame->picture->layer[i] = (ref_layer){.depth = HUGE_VAL};
    for (size_t i = 0; i < n_pixels; i++) {
        frame->picture->depth[i] = HUGE_VAL;
        frame->picture->triangle[i] = -1;
        for (size_t l = 0; l < frame->picture->n_lights; l++)
            frame->picture->shadow[l][i] = frame->picture->ndotl[l][i] = 0.0;
    }
    for (size_t o = 0; o < frame->s->n_objects; o++) {
        const scene_object *object = &frame->s->objects[o];
        const size_t n_triangles =
            object->hidden || !frame->instances[o].sign ? 0 : frame->s->meshes[object->mesh_idx].n_triangles;
        const vec3 *view = frame->instances[o].view;
        for (size_t i = 0; i < n_triangles; i++) {
            view_triangle triangle = {.id = (int64_t)(((uint64_t)o << 32) | i), .source = ref_triangle_of(frame, o, i)};
            for (int k = 0; k < 3; k++) triangle.p[k] = view[triangle.source.idx[k]];
            draw_triangle(frame, &triangle);
        }
    }
    for (size_t i = 0; frame->picture->n_layers && i < n_pixels; i++) drop_hidden(frame->picture, i);
}
