/* Textures that repeat mirrored, as the library has them: repeated or clamped.
 *
 * Where every triangle stays between two whole coordinates, coordinates are folded into 0..1, where a mirrored texture
 * is the clamped one. Elsewhere the image and its mirror image side by side are a texture that repeats, at half of the
 * coordinates. */
#include "loader.h"

#include <math.h>

static const double touch = 1e-5; /* so far beyond a whole coordinate is on it: a part of a texel */

static bool is_mirrored(const scene *s, size_t texture, int axis)
{
    return texture != SCENE_NONE && s->textures[texture].mirrored[axis];
}

static bool mirrors(const scene *s, const scene_object *o, int axis)
{
    if (!s->meshes[o->mesh_idx].uv) return false;
    return is_mirrored(s, o->texture_idx, axis) || is_mirrored(s, o->emissive_texture_idx, axis);
}

/* Whether a triangle goes from one side of a whole coordinate to the other. */
static bool crosses(const scene_mesh *mesh, int axis)
{
    for (size_t i = 0; i < mesh->n_triangles; i++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t k = 0; k < 3; k++) {
            const double at = mesh->uv[2 * (size_t)mesh->idx[3 * i + k] + (size_t)axis];
            low = fmin(low, at);
            high = fmax(high, at);
        }
        if (floor(low + touch) + 1 < high - touch) return true;
    }
    return false;
}

static double folded(double at)
{
    const double in_two = at - 2 * floor(at / 2);
    return in_two <= 1 ? in_two : 2 - in_two;
}

/* wide: per texture, it needs its mirror image. Both textures of a surface have the same coordinates. */
static void find_wide(const scene *s, int axis, bool *wide)
{
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < s->n_objects; i++) {
            const scene_object *o = &s->objects[i];
            if (!mirrors(s, o, axis)) continue;
            const size_t both[2] = {o->texture_idx == SCENE_NONE ? o->emissive_texture_idx : o->texture_idx,
                                    o->emissive_texture_idx == SCENE_NONE ? o->texture_idx : o->emissive_texture_idx};
            if (wide[both[0]] && wide[both[1]]) continue;
            if (!wide[both[0]] && !wide[both[1]] && !crosses(&s->meshes[o->mesh_idx], axis)) continue;
            wide[both[0]] = wide[both[1]] = more = true;
        }
    }
}

static void move_coordinates(scene_mesh *mesh, int axis, bool wide)
{
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        double *at = &mesh->uv[2 * i + (size_t)axis];
        *at = wide ? *at / 2 : folded(*at);
    }
}

static bool set_axis(loader *l, int axis)
{
    scene *s = l->s;
    bool *wide = loader_alloc(l, s->n_textures + 1, sizeof *wide),
         *moved = loader_alloc(l, s->n_meshes + 1, sizeof *moved);
    if (!wide || !moved) return false;
    find_wide(s, axis, wide);
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        if (!mirrors(s, o, axis) || moved[o->mesh_idx]) continue;
        moved[o->mesh_idx] = true;
        move_coordinates(&s->meshes[o->mesh_idx], axis,
                         wide[is_mirrored(s, o->texture_idx, axis) ? o->texture_idx : o->emissive_texture_idx]);
    }
    for (size_t i = 0; i < s->n_textures; i++) {
        scene_texture *t = &s->textures[i];
        if (!t->mirrored[axis]) continue;
        if (wide[i] && !texture_add_mirror(l, t, axis)) return false;
        *(axis ? &t->clamp_v : &t->clamp_u) = !wide[i];
        t->mirrored[axis] = false;
    }
    return true;
}

bool mirror_textures(loader *l)
{
    return set_axis(l, 0) && set_axis(l, 1);
}
