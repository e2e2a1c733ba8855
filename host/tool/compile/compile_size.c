/* What the compiled scene takes on a 32-bit target, to the byte: as its compilers lay out the structures of gnomon.h.
 */
#include "rig.h"

enum { MESH_BYTES = 32, TEXTURE_BYTES = 16, CAMERA_BYTES = 68 };

static long padded(long bytes)
{
    return (bytes + 3) / 4 * 4;
}

/* Enumerations take 4 bytes each, or, as Arm's compilers have them by default, one. */
static long object_bytes(bool short_enums)
{
    return short_enums ? 128 : 132;
}

static long light_bytes(bool short_enums)
{
    return short_enums ? 112 : 116;
}

static long scene_bytes(bool short_enums)
{
    return short_enums ? 220 : 240;
}

static long mesh_bytes(const gn_mesh *m, const gn_knobs *knobs)
{
    long n = m->n_vertices, bytes = padded(3 * n * knobs->position_bits / 8) + padded((long)m->n_triangles * 6);
    if (m->nrm_q15) bytes += padded(3 * n * knobs->normal_bits / 8);
    if (m->rgb_uq16) bytes += padded(6 * n);
    if (m->uv) bytes += 4 * n;
    if (m->mask_uv_uq16) bytes += 4 * n;
    return bytes + MESH_BYTES;
}

long compile_flash_bytes(const compiled *c, bool short_enums)
{
    const gn_scene *s = &c->fixed.scene;
    long bytes = scene_bytes(short_enums) + (long)s->n_objects * object_bytes(short_enums) +
                 (long)s->n_lights * light_bytes(short_enums) + CAMERA_BYTES * (long)c->n_cameras;
    for (size_t i = 0; i < c->fixed.n_meshes; i++) bytes += mesh_bytes(&c->fixed.meshes[i], &c->set.quality);
    for (size_t i = 0; i < c->n_textures; i++)
        bytes += TEXTURE_BYTES + padded((long)quantise_texture_bytes(&c->fixed.textures[i])) +
                 (long)quantise_palette_bytes(&c->fixed.textures[i]);
    for (uint32_t i = 0; i < s->n_objects; i++) {
        const gn_object *o = &s->objects[i];
        if (o->mask_u8) bytes += 4L * o->mesh->n_vertices;
        if (o->baked_uq12) bytes += padded(6L * o->mesh->n_vertices);
    }
    if (c->rig) bytes += rig_flash_bytes(c->rig);
    for (size_t i = 0; i < c->n_tracks; i++) bytes += 4L * c->n_frames * (long)c->tracks[i].field->n_words;
    return bytes;
}

long compile_state_bytes(const compiled *c, bool short_enums)
{
    if (c->symbol)
        return scene_bytes(short_enums) + (long)c->fixed.scene.n_objects * object_bytes(short_enums) +
               (long)c->fixed.scene.n_lights * light_bytes(short_enums) + CAMERA_BYTES * (long)c->n_cameras + 4;
    if (!c->n_tracks) return 1;
    long bytes = scene_bytes(short_enums);
    if (compile_moves(c, COMPILE_OF_OBJECT)) bytes += (long)c->fixed.scene.n_objects * object_bytes(short_enums);
    if (compile_moves(c, COMPILE_OF_LIGHT)) bytes += (long)c->fixed.scene.n_lights * light_bytes(short_enums);
    return bytes;
}
