/* What no error says and a picture does not show. */
#include "remarks.h"

#include <math.h>
#include <stdio.h>

#include "../../scene/core/vec.h"
#include "tool.h"

enum { NAMES_BYTES = 200, NOTE_BYTES = 300, MAX_COMPARED = 1024, MAX_PAIRS = 32 };

static const double degrees_per_turn = 360, turn_radians = 6.283185307179586;

/* Most of what a file says in vain is for info; this changes the picture. */
static void remark_on_cones(const scene *s)
{
    for (size_t i = 0; i < s->n_lights; i++)
        if (s->lights[i].cone_limited)
            tool_error("cone of light %zu '%s' is limited to %.0f degrees: 1 to 179 can be drawn", i, s->lights[i].name,
                       degrees_per_turn * s->lights[i].outer);
}

void remarks_on_settings(const scene *s)
{
    remark_on_cones(s);
    for (size_t i = 0; i < s->n_remarks; i++) tool_error("%s", s->remarks[i]);
    for (size_t i = s->n_file_notes; i < s->n_notes; i++) tool_error("%s", s->notes[i]);
}

/* Bits: the sides of the camera's frustum that a point lies beyond. */
static unsigned sides_beyond(const scene_camera *c, double aspect, const double p[3])
{
    double at[3];
    for (int k = 0; k < 3; k++) {
        at[k] = 0;
        for (int i = 0; i < 3; i++) at[k] += c->to_world.m[i][k] * (p[i] - c->to_world.m[i][3]);
    }
    const double half = c->half_height > 0 ? c->half_height : -at[2] / c->focal, x = at[0], y = at[1];
    return (unsigned)((x > half * aspect) | (x < -half * aspect) << 1 | (y > half) << 2 | (y < -half) << 3 |
                      (-at[2] < c->near) << 4);
}

static bool is_beyond(const scene *s, const scene_object *o, double aspect)
{
    const scene_mesh *mesh = &s->meshes[o->mesh_idx];
    unsigned all = ~0U;
    for (size_t v = 0; v < mesh->n_vertices && all; v++) {
        double p[3];
        scene_vertex(p, s, o, v);
        all &= sides_beyond(&s->camera, aspect, p);
    }
    return all != 0;
}

/* Whether some face shows its front to the camera; else *backs, if some shows its back, and *normals grows by those of
 * all, as long as areas. */
static bool shows_front(const scene *s, const scene_object *o, double normals[3], bool *backs)
{
    const scene_mesh *mesh = &s->meshes[o->mesh_idx];
    const scene_camera *c = &s->camera;
    const int sign = scene_object_sign(o);
    if (o->two_sided) return true;
    for (size_t t = 0; t < mesh->n_triangles; t++) {
        double p[3][3], u[3], v[3], n[3], to_eye[3];
        for (size_t i = 0; i < 3; i++) scene_vertex(p[i], s, o, mesh->idx[3 * t + i]);
        vec_sub(u, p[1], p[0]);
        vec_sub(v, p[2], p[0]);
        vec_cross(n, u, v);
        for (int k = 0; k < 3; k++)
            to_eye[k] = c->half_height > 0 ? c->to_world.m[k][2] : c->to_world.m[k][3] - p[0][k];
        const double towards = sign * vec_dot(n, to_eye);
        if (towards > 0) return true;
        *backs |= towards < 0;
        for (int k = 0; k < 3; k++) normals[k] += sign * n[k];
    }
    return false;
}

void remarks_on_view(const scene *s, int width, int height)
{
    double normals[3] = {0, 0, 0};
    bool any = false, backs = false;
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        if (o->hidden || (s->added.ground && i + 1 == s->n_objects)) continue;
        if (!s->added.camera && is_beyond(s, o, (double)width / height)) continue;
        if (shows_front(s, o, normals, &backs)) return;
        any = true;
    }
    const double yaw = degrees_per_turn / turn_radians * atan2(normals[0], normals[2]),
                 pitch = degrees_per_turn / turn_radians * atan2(normals[1], hypot(normals[0], normals[2]));
    if (backs)
        tool_error(
            "the camera sees backs of faces alone, which are not drawn: --orbit %.0f,%.0f,1 looks at their fronts", yaw,
            fmin(fmax(pitch, -80), 80));
    else if (!any) tool_error("the camera sees none of the objects: --orbit 30,25,1 looks at them all");
}

void remarks_on_frame(const scene *s, int frame)
{
    const double last = s->fps > 0 ? ceil(s->duration * s->fps - 1e-6) : 0;
    if (frame <= last) return;
    if (last > 0) tool_error("the animation ends with frame %.0f, which is drawn for frame %d", last, frame);
    else tool_error("nothing moves in the file: frame %d is as frame 0", frame);
}

/* "0 'a', 3 'b'", cut off behind a name where there is no room for more */
static void name_lights_without_room(const scene *s, const engine_picture *p, char *out, size_t bytes)
{
    size_t used = 0;
    out[0] = 0;
    for (size_t i = 0; i < s->n_lights && i < p->n_lights; i++) {
        if (p->shadow_state[i] != GN_SHADOW_NO_ROOM) continue;
        int n = snprintf(out + used, bytes - used, "%s%zu '%.64s'", used ? ", " : "", i, s->lights[i].name);
        if (n < 0 || (size_t)n + sizeof ", ..." > bytes - used) {
            snprintf(out + used, bytes - used, "%s...", used ? ", " : "");
            return;
        }
        used += (size_t)n;
    }
}

void remarks_on_picture(const scene *s, const engine_picture *p)
{
    char names[NAMES_BYTES];
    uint32_t left_out = p->stats.n_lights_left_out, no_room = p->stats.n_lights_without_room;
    if (left_out)
        tool_error("%u time%s a light was left out of an object's list of %d: --set object_lights=0 keeps all",
                   left_out, left_out == 1 ? "" : "s", s->shadow.object_lights);
    if (!no_room) return;
    name_lights_without_room(s, p, names, sizeof names);
    tool_error("%u light%s no shadow tile, so no shadow: %s", no_room, no_room == 1 ? " has" : "s have", names);
}

/* Whether some point is in the range of both. */
static bool ranges_overlap(const scene_light *a, const scene_light *b)
{
    if (a->kind == SCENE_LIGHT_DIRECTIONAL || b->kind == SCENE_LIGHT_DIRECTIONAL) return true;
    double d[3];
    for (int i = 0; i < 3; i++) d[i] = a->position[i] - b->position[i];
    return hypot(hypot(d[0], d[1]), d[2]) < a->range + b->range;
}

static bool is_masked(const scene_light *l)
{
    return l->mode == SCENE_MIXED && l->mask_channel >= 0;
}

/* Of a light and those after it, up to *left pairs: a file of ten thousand lights has no remark on each of their pairs.
 */
static int note_shared_channels(scene *s, size_t first, int *left, char *error, size_t bytes)
{
    char note[NOTE_BYTES];
    const scene_light *a = &s->lights[first];
    if (!is_masked(a)) return 0;
    const size_t end = s->n_lights - first < MAX_COMPARED ? s->n_lights : first + MAX_COMPARED;
    for (size_t i = first + 1; i<end && * left> 0; i++) {
        const scene_light *b = &s->lights[i];
        if (!is_masked(b) || a->mask_channel != b->mask_channel || !ranges_overlap(a, b)) continue;
        snprintf(note, sizeof note,
                 "mixed lights %zu '%.64s' and %zu '%.64s' share mask channel %d, and their ranges overlap", first,
                 a->name, i, b->name, a->mask_channel);
        if (scene_add_note(s, note, error, bytes)) return -1;
        --*left;
    }
    return 0;
}

static bool has_baked_light(const scene *s)
{
    for (size_t i = 0; i < s->n_objects; i++)
        if (s->objects[i].baked) return true;
    return false;
}

static int note_useless_baked(scene *s, size_t light, char *error, size_t bytes)
{
    char note[NOTE_BYTES];
    if (s->lights[light].mode != SCENE_BAKED || has_baked_light(s)) return 0;
    snprintf(note, sizeof note, "light %zu '%.64s' is baked, but no object has baked light: it contributes nothing",
             light, s->lights[light].name);
    return scene_add_note(s, note, error, bytes);
}

int remarks_on_lights(scene *s, char *error, size_t error_bytes)
{
    int left = MAX_PAIRS;
    for (size_t i = 0; i < s->n_lights; i++)
        if (note_shared_channels(s, i, &left, error, error_bytes) || note_useless_baked(s, i, error, error_bytes))
            return -1;
    return 0;
}

void remarks_list_added(const scene *s, char *out, size_t bytes)
{
    static const char *const names[] = {"ground", "camera", "light"};
    const bool added[] = {s->added.ground, s->added.camera, s->added.light};
    size_t n = 0;
    if (bytes) *out = 0;
    for (int i = 0; i < 3; i++) {
        if (!added[i] || n >= bytes) continue;
        n += (size_t)snprintf(out + n, bytes - n, "%s%s", n ? ", " : "; added: ", names[i]);
    }
}
