/* What the compiled scene takes on a 32-bit target, to the byte: as its compilers lay out the structures of gnomon.h.
 */
#include "rig.h"

enum { MESH_BYTES = 32, TEXTURE_BYTES = 16, CAMERA_BYTES = 68, SKIN_BYTES = 16, JOINT_BYTES = 52, FIT_BYTES = 32 };

static long padded(long bytes)
{
    return (bytes + 3) / 4 * 4;
}

/* Enumerations take 4 bytes each, or, as Arm's compilers have them by default, one. */
static long object_bytes(bool short_enums)
{
    return short_enums ? 136 : 140;
}

static long light_bytes(bool short_enums)
{
    return short_enums ? 112 : 116;
}

static long scene_bytes(bool short_enums)
{
    return short_enums ? 228 : 244;
}

static long mesh_bytes(const gn_mesh *m, const gn_knobs *knobs)
{
    long n = m->n_vertices,
         bytes = padded(3 * n * (knobs->short_vertices % 2 ? 2 : 4)) + padded((long)m->n_triangles * 6);
    if (m->nrm_q15) bytes += padded(3 * n * (knobs->short_vertices >= 2 ? 1 : 2));
    if (m->rgb_uq16) bytes += padded(6 * n);
    if (m->uv) bytes += 4 * n;
    if (m->mask_uv_uq16) bytes += 4 * n;
    return bytes + MESH_BYTES;
}

/* Of an object; joints that a track has are in its frames. */
static long skin_bytes(const compiled *c, uint32_t object_idx)
{
    const gn_object *o = &c->fixed.objects[object_idx];
    long bytes = SKIN_BYTES + 2 * padded((long)o->skin->per_vertex * o->mesh->n_vertices);
    for (size_t i = 0; i < c->n_tracks; i++)
        if (c->tracks[i].field->of == COMPILE_OF_SKIN && c->tracks[i].idx == object_idx) return bytes;
    return bytes + JOINT_BYTES * (long)o->skin->n_joints;
}

long compile_flash_bytes(const compiled *c, bool short_enums)
{
    const gn_scene *s = &c->fixed.scene;
    long bytes = scene_bytes(short_enums) + (long)s->n_objects * object_bytes(short_enums) +
                 (long)s->n_lights * light_bytes(short_enums) + CAMERA_BYTES * (long)c->n_cameras +
                 FIT_BYTES * (long)s->shadow.n_fixed_fits;
    for (size_t i = 0; i < c->fixed.n_meshes; i++) bytes += mesh_bytes(&c->fixed.meshes[i], &c->set.quality);
    for (size_t i = 0; i < c->n_textures; i++)
        bytes += TEXTURE_BYTES + padded((long)quantise_texture_bytes(&c->fixed.textures[i])) +
                 (long)quantise_palette_bytes(&c->fixed.textures[i]);
    for (uint32_t i = 0; i < s->n_objects; i++) {
        const gn_object *o = &s->objects[i];
        if (o->mask_u8) bytes += 4L * o->mesh->n_vertices;
        if (o->baked_uq12) bytes += padded(6L * o->mesh->n_vertices);
        if (o->skin) bytes += skin_bytes(c, i);
    }
    if (c->rig) bytes += rig_flash_bytes(c->rig);
    for (size_t i = 0; i < c->n_tracks; i++) bytes += 4L * c->n_frames * (long)c->tracks[i].n_words;
    return bytes;
}

long compile_state_bytes(const compiled *c, bool short_enums)
{
    const long skins = SKIN_BYTES * (long)compile_count_skins(c, c->fixed.scene.n_objects);
    if (c->symbol)
        return skins + scene_bytes(short_enums) + (long)c->fixed.scene.n_objects * object_bytes(short_enums) +
               (long)c->fixed.scene.n_lights * light_bytes(short_enums) + CAMERA_BYTES * (long)c->n_cameras + 4;
    if (!c->n_tracks) return 1;
    long bytes = scene_bytes(short_enums);
    if (compile_moves(c, COMPILE_OF_SKIN)) bytes += skins;
    if (compile_moves(c, COMPILE_OF_OBJECT) || compile_moves(c, COMPILE_OF_SKIN))
        bytes += (long)c->fixed.scene.n_objects * object_bytes(short_enums);
    if (compile_moves(c, COMPILE_OF_LIGHT)) bytes += (long)c->fixed.scene.n_lights * light_bytes(short_enums);
    return bytes;
}
