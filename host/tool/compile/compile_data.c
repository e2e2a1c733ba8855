/* Meshes, textures, objects, lights and the scene, as const data. */
#include <inttypes.h>
#include <string.h>

#include "../../scene/core/texture_format.h"
#include "compile_emit.h"

/* "KIND_IDX_NAME", or 0 */
static void write_array_name(FILE *f, const char *kind, size_t idx, const char *name, const void *array)
{
    if (array) fprintf(f, "%s_%zu_%s", kind, idx, name);
    else fprintf(f, "0");
}

/* With names, arrays may be used from outside: NAME_meshes. */
static void write_table(FILE *f, const compiled *c, const char *type, const char *name, size_t n)
{
    if (c->symbol) fprintf(f, "\nconst %s %s_%s[%zu] = {\n", type, c->symbol, name, n);
    else fprintf(f, "\nstatic const %s %s[%zu] = {\n", type, name, n);
}

static void write_element(FILE *f, const compiled *c, const char *table, ptrdiff_t i)
{
    if (c->symbol) fprintf(f, "&%s_%s[%td]", c->symbol, table, i);
    else fprintf(f, "&%s[%td]", table, i);
}

/* ---- Meshes and textures ----------------------------------------------------------------------------------------- */

static const emit_field mesh_fields[] = {
    EMIT_FIELD(gn_mesh, FIELD_POINTER, pos),          EMIT_FIELD(gn_mesh, FIELD_POINTER, nrm_q15),
    EMIT_FIELD(gn_mesh, FIELD_POINTER, rgb_uq16),     EMIT_FIELD(gn_mesh, FIELD_POINTER, uv),
    EMIT_FIELD(gn_mesh, FIELD_POINTER, mask_uv_uq16), EMIT_FIELD(gn_mesh, FIELD_POINTER, idx),
    EMIT_FIELD(gn_mesh, FIELD_U16, n_vertices),       EMIT_FIELD(gn_mesh, FIELD_U16, n_triangles),
    EMIT_FIELD(gn_mesh, FIELD_U8, pos_frac_bits),     EMIT_FIELD(gn_mesh, FIELD_U8, uv_frac_bits)};

static void write_mesh_arrays(FILE *f, const gn_mesh *m, size_t i, const char *name)
{
    const size_t n = m->n_vertices;
    fprintf(f, "\n/* mesh %zu '", i);
    compile_write_text(f, name);
    fprintf(f, "': %zu vertices, %u triangles */\n", n, m->n_triangles);
    emit_array(f, EMIT_POSITION, "mesh", i, "pos", m->pos, 3 * n, EMIT_PER_LINE);
    emit_array(f, EMIT_NORMAL, "mesh", i, "nrm_q15", m->nrm_q15, 3 * n, EMIT_PER_LINE);
    emit_array(f, EMIT_U16, "mesh", i, "rgb_uq16", m->rgb_uq16, 3 * n, EMIT_PER_LINE);
    emit_array(f, EMIT_I16, "mesh", i, "uv", m->uv, 2 * n, EMIT_PER_LINE);
    emit_array(f, EMIT_U16, "mesh", i, "mask_uv_uq16", m->mask_uv_uq16, 2 * n, EMIT_PER_LINE);
    emit_array(f, EMIT_U16, "mesh", i, "idx", m->idx, 3 * (size_t)m->n_triangles, 2 * EMIT_PER_LINE);
}

static void write_mesh_pointer(FILE *f, const compiled *c, const emit_field *field, const void *at, size_t idx)
{
    (void)c;
    write_array_name(f, "mesh", idx, field->name, at);
}

static void write_meshes(FILE *f, const compiled *c)
{
    const fixed_scene *fixed = &c->fixed;
    for (size_t i = 0; i < fixed->n_meshes; i++) write_mesh_arrays(f, &fixed->meshes[i], i, c->mesh_name[i]);
    if (!fixed->n_meshes) return; /* no array is of zero elements */
    write_table(f, c, "gn_mesh", "meshes", fixed->n_meshes);
    for (size_t i = 0; i < fixed->n_meshes; i++) {
        emit_struct(f, c, mesh_fields, EMIT_COUNT(mesh_fields), &fixed->meshes[i], i, write_mesh_pointer);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

static const emit_field texture_fields[] = {
    EMIT_FIELD(gn_texture, FIELD_POINTER, rgba),   EMIT_FIELD(gn_texture, FIELD_U8, width_log2),
    EMIT_FIELD(gn_texture, FIELD_U8, height_log2), EMIT_FIELD(gn_texture, FIELD_U8, flags),
    EMIT_FIELD(gn_texture, FIELD_U8, format),      EMIT_FIELD(gn_texture, FIELD_U16, width),
    EMIT_FIELD(gn_texture, FIELD_U16, height),     EMIT_FIELD(gn_texture, FIELD_POINTER, palette)};

static void write_texture_pointer(FILE *f, const compiled *c, const emit_field *field, const void *at, size_t idx)
{
    (void)c;
    write_array_name(f, "texture", idx, field->name, at);
}

static void write_textures(FILE *f, const compiled *c)
{
    size_t n = c->n_textures;
    for (size_t i = 0; i < n; i++) {
        const gn_texture *t = &c->fixed.textures[i];
        fprintf(f, "\n/* texture %zu '", i);
        compile_write_text(f, c->texture_name[i]);
        fprintf(f, "': %zux%zu, %s */\n", quantise_texture_side(t, 0), quantise_texture_side(t, 1),
                texture_format_names[t->format]);
        emit_array(f, EMIT_U8, "texture", i, "rgba", t->rgba, quantise_texture_bytes(t), 2 * EMIT_PER_LINE);
        if (t->palette)
            emit_array(f, EMIT_U8, "texture", i, "palette", t->palette, quantise_palette_bytes(t), 2 * EMIT_PER_LINE);
    }
    if (!n) return;
    write_table(f, c, "gn_texture", "textures", n);
    for (size_t i = 0; i < n; i++) {
        emit_struct(f, c, texture_fields, EMIT_COUNT(texture_fields), &c->fixed.textures[i], i, write_texture_pointer);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

/* ---- Objects and lights ------------------------------------------------------------------------------------------ */

static const emit_field object_fields[] = {EMIT_FIELD(gn_object, FIELD_POINTER, mesh),
                                           EMIT_FIELD(gn_object, FIELD_AFFINE, to_world),
                                           EMIT_VECTOR(gn_object, FIELD_U32, albedo_uq16, 3),
                                           EMIT_FIELD(gn_object, FIELD_U32, flags),
                                           EMIT_ENUM(gn_object, visible_alpha, gn_alpha),
                                           EMIT_ENUM(gn_object, caster_alpha, gn_alpha),
                                           EMIT_FIELD(gn_object, FIELD_U32, alpha_uq16),
                                           EMIT_FIELD(gn_object, FIELD_U32, alpha_cutoff_uq16),
                                           EMIT_VECTOR(gn_object, FIELD_U32, specular_uq16, 3),
                                           EMIT_FIELD(gn_object, FIELD_U8, shininess_log2),
                                           EMIT_VECTOR(gn_object, FIELD_U32, emissive_uq16, 3),
                                           EMIT_FIELD(gn_object, FIELD_POINTER, texture),
                                           EMIT_FIELD(gn_object, FIELD_POINTER, emissive_texture),
                                           EMIT_FIELD(gn_object, FIELD_POINTER, mask_image),
                                           EMIT_FIELD(gn_object, FIELD_POINTER, mask_u8),
                                           EMIT_FIELD(gn_object, FIELD_POINTER, baked_uq12),
                                           EMIT_FIELD(gn_object, FIELD_POINTER, skin)};

static const emit_field skin_fields[] = {
    EMIT_FIELD(gn_skin, FIELD_POINTER, joint), EMIT_FIELD(gn_skin, FIELD_POINTER, joint_idx),
    EMIT_FIELD(gn_skin, FIELD_POINTER, weight_u8), EMIT_FIELD(gn_skin, FIELD_U16, n_joints),
    EMIT_FIELD(gn_skin, FIELD_U8, per_vertex)};

static void write_object_pointer(FILE *f, const compiled *c, const emit_field *field, const void *at, size_t idx)
{
    if (at && strcmp(field->name, "mesh") == 0) write_element(f, c, "meshes", (const gn_mesh *)at - c->fixed.meshes);
    else if (at && (strcmp(field->name, "texture") == 0 || strcmp(field->name, "emissive_texture") == 0 ||
                    strcmp(field->name, "mask_image") == 0))
        write_element(f, c, "textures", (const gn_texture *)at - c->fixed.textures);
    else if (at && strcmp(field->name, "skin") == 0) fprintf(f, "&skins[%zu]", compile_count_skins(c, idx));
    else write_array_name(f, "object", idx, field->name, at);
}

/* Joints that move: a pose per frame. */
static const compile_track *track_of(const compiled *c, size_t object_idx)
{
    for (size_t i = 0; i < c->n_tracks; i++)
        if (c->tracks[i].field->of == COMPILE_OF_SKIN && c->tracks[i].idx == object_idx) return &c->tracks[i];
    return NULL;
}

static void write_skin_pointer(FILE *f, const compiled *c, const emit_field *field, const void *at, size_t idx)
{
    const compile_track *t = strcmp(field->name, "joint") == 0 ? track_of(c, idx) : NULL;
    if (t) fprintf(f, "track_%td[0]", t - c->tracks);
    else write_array_name(f, "object", idx, field->name, at);
}

static void write_pose(FILE *f, const gn_affine *joint, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        fprintf(f, "    ");
        emit_affine(f, &joint[i]);
        fprintf(f, "%s\n", i + 1 < n ? "," : "");
    }
}

static void write_joints(FILE *f, const compiled *c, size_t object_idx)
{
    const gn_skin *skin = c->fixed.objects[object_idx].skin;
    const compile_track *t = track_of(c, object_idx);
    if (!t) {
        fprintf(f, "static const gn_affine object_%zu_joint[%u] = {\n", object_idx, skin->n_joints);
        write_pose(f, skin->joint, skin->n_joints);
        fprintf(f, "};\n");
        return;
    }
    fprintf(f, "static const gn_affine track_%td[SCENE_FRAMES][%u] = {\n", t - c->tracks, skin->n_joints);
    for (int frame = 0; frame < c->n_frames; frame++) {
        fprintf(f, "    {\n");
        write_pose(f, (const gn_affine *)(const void *)(t->words + (size_t)frame * t->n_words), skin->n_joints);
        fprintf(f, "    }%s\n", frame + 1 < c->n_frames ? "," : "");
    }
    fprintf(f, "};\n");
}

static void write_skins(FILE *f, const compiled *c)
{
    const size_t n = compile_count_skins(c, c->fixed.scene.n_objects);
    for (size_t i = 0; i < c->fixed.scene.n_objects; i++) {
        const gn_skin *skin = c->fixed.objects[i].skin;
        if (!skin) continue;
        const size_t n_bytes = (size_t)skin->per_vertex * c->fixed.objects[i].mesh->n_vertices;
        emit_array(f, EMIT_U8, "object", i, "joint_idx", skin->joint_idx, n_bytes, 2 * EMIT_PER_LINE);
        emit_array(f, EMIT_U8, "object", i, "weight_u8", skin->weight_u8, n_bytes, 2 * EMIT_PER_LINE);
        write_joints(f, c, i);
    }
    if (!n) return;
    fprintf(f, "\nstatic const gn_skin skins[%zu] = {\n", n);
    for (size_t i = 0; i < c->fixed.scene.n_objects; i++) {
        if (!c->fixed.objects[i].skin) continue;
        emit_struct(f, c, skin_fields, EMIT_COUNT(skin_fields), c->fixed.objects[i].skin, i, write_skin_pointer);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

static void write_name(FILE *f, const char *name)
{
    fprintf(f, "    /* ");
    compile_write_text(f, name);
    fprintf(f, " */\n");
}

static void write_objects(FILE *f, const compiled *c)
{
    const size_t n = c->fixed.scene.n_objects;
    for (size_t i = 0; i < n; i++) {
        const gn_object *o = &c->fixed.objects[i];
        const size_t n_vertices = o->mesh->n_vertices;
        emit_array(f, EMIT_U8, "object", i, "mask_u8", o->mask_u8, 4 * n_vertices, 2 * EMIT_PER_LINE);
        emit_array(f, EMIT_U16, "object", i, "baked_uq12", o->baked_uq12, 3 * n_vertices, EMIT_PER_LINE);
    }
    write_skins(f, c);
    if (!n) return;
    fprintf(f, "\nstatic const gn_object objects[%zu] = {\n", n);
    for (size_t i = 0; i < n; i++) {
        write_name(f, c->object_name[i]);
        emit_struct(f, c, object_fields, EMIT_COUNT(object_fields), &c->fixed.objects[i], i, write_object_pointer);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

static const emit_field light_fields[] = {EMIT_ENUM(gn_light, kind, gn_light_kind),
                                          EMIT_ENUM(gn_light, mode, gn_light_mode),
                                          EMIT_VECTOR(gn_light, FIELD_I32, direction, 3),
                                          EMIT_VECTOR(gn_light, FIELD_I32, position_q16, 3),
                                          EMIT_VECTOR(gn_light, FIELD_U32, colour_uq16, 3),
                                          EMIT_FIELD(gn_light, FIELD_I32, colour_exp),
                                          EMIT_FIELD(gn_light, FIELD_U32, range_q16),
                                          EMIT_FIELD(gn_light, FIELD_I32, near_q16),
                                          EMIT_FIELD(gn_light, FIELD_U16, inner_turn),
                                          EMIT_FIELD(gn_light, FIELD_U16, outer_turn),
                                          EMIT_FIELD(gn_light, FIELD_U32, shadow_strength_uq16),
                                          EMIT_ENUM(gn_light, softness, gn_softness),
                                          EMIT_FIELD(gn_light, FIELD_I32, mask_channel),
                                          EMIT_FIELD(gn_light, FIELD_I32, bias_constant_q16),
                                          EMIT_FIELD(gn_light, FIELD_I32, bias_slope_q16),
                                          EMIT_FIELD(gn_light, FIELD_I32, bias_normal_q16),
                                          EMIT_VECTOR(gn_light, FIELD_I32, bias_receiver_q16, 4),
                                          EMIT_FIELD(gn_light, FIELD_I32, bias_caster_q16),
                                          EMIT_FIELD(gn_light, FIELD_U32, receiver_plane),
                                          EMIT_ENUM(gn_light, auto_bias, gn_auto_bias),
                                          EMIT_FIELD(gn_light, FIELD_I32, near_offset_q16)};

static void write_lights(FILE *f, const compiled *c)
{
    const size_t n = c->fixed.scene.n_lights;
    if (!n) return;
    fprintf(f, "\nstatic const gn_light lights[%zu] = {\n", n);
    for (size_t i = 0; i < n; i++) {
        write_name(f, c->light_name[i]);
        emit_struct(f, c, light_fields, EMIT_COUNT(light_fields), &c->fixed.lights[i], i, NULL);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

/* ---- Scene ------------------------------------------------------------------------------------------------------- */

static const emit_field camera_fields[] = {
    EMIT_FIELD(gn_camera, FIELD_AFFINE, to_world), EMIT_FIELD(gn_camera, FIELD_U32, focal_q24),
    EMIT_FIELD(gn_camera, FIELD_I32, half_height_q16), EMIT_FIELD(gn_camera, FIELD_I32, near_q16),
    EMIT_FIELD(gn_camera, FIELD_I32, far_q16)};

static const emit_field shadow_fields[] = {EMIT_FIELD(gn_shadow_settings, FIELD_I32, max_distance_q16),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, distance_fade_uq16),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, cascade_fade_uq16),
                                           EMIT_ENUM(gn_shadow_settings, filter, gn_filter),
                                           EMIT_ENUM(gn_shadow_settings, other_filter, gn_filter),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, penumbra_uq16),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, disk_samples),
                                           EMIT_ENUM(gn_shadow_settings, mixing, gn_mixing),
                                           EMIT_ENUM(gn_shadow_settings, tile_sizes, gn_tile_sizes),
                                           EMIT_ENUM(gn_shadow_settings, fit, gn_fit),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, main_light),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, caster_culling),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, object_lights),
                                           EMIT_VECTOR(gn_shadow_settings, FIELD_U32, refresh, 4),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, n_cascades),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, cascades_unused),
                                           EMIT_VECTOR(gn_shadow_settings, FIELD_U32, cascade_ratio_uq16, 3),
                                           EMIT_ENUM(gn_shadow_settings, blend, gn_blend),
                                           EMIT_ENUM(gn_shadow_settings, distance_mode, gn_distance_mode),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_POINTER, fixed_fits),
                                           EMIT_FIELD(gn_shadow_settings, FIELD_U32, n_fixed_fits)};

static const emit_field fit_fields[] = {
    EMIT_FIELD(gn_fixed_fit, FIELD_U16, light_idx), EMIT_FIELD(gn_fixed_fit, FIELD_U8, cascade_idx),
    EMIT_VECTOR(gn_fixed_fit, FIELD_I32, lo_q16, 3), EMIT_VECTOR(gn_fixed_fit, FIELD_I32, hi_q16, 3),
    EMIT_FIELD(gn_fixed_fit, FIELD_U32, worth_px)};

static void write_fits(FILE *f, const compiled *c)
{
    const gn_shadow_settings *s = &c->fixed.scene.shadow;
    if (!s->n_fixed_fits) return;
    fprintf(f, "\nstatic const gn_fixed_fit fixed_fits[%" PRIu32 "] = {\n", s->n_fixed_fits);
    for (uint32_t i = 0; i < s->n_fixed_fits; i++) {
        write_name(f, c->light_name[s->fixed_fits[i].light_idx]);
        emit_struct(f, c, fit_fields, EMIT_COUNT(fit_fields), &s->fixed_fits[i], i, NULL);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

static void write_fits_pointer(FILE *f, const compiled *c, const emit_field *field, const void *at, size_t idx)
{
    (void)c, (void)field, (void)idx;
    fprintf(f, "%s", at ? "fixed_fits" : "0");
}

static void write_vector(FILE *f, const char *name, const uint32_t v[3])
{
    fprintf(f, "    F(%s) {%" PRIu32 "U, %" PRIu32 "U, %" PRIu32 "U},\n", name, v[0], v[1], v[2]);
}

static void write_scene(FILE *f, const compiled *c)
{
    const gn_scene *s = &c->fixed.scene;
    fprintf(f,
            "\nstatic const gn_scene still = {\n    F(objects) %s, F(lights) %s, F(n_objects) %" PRIu32
            ", F(n_lights) %" PRIu32 ",\n    F(camera)\n",
            s->n_objects ? "objects" : "0", s->n_lights ? "lights" : "0", s->n_objects, s->n_lights);
    emit_struct(f, c, camera_fields, EMIT_COUNT(camera_fields), &s->camera, 0, NULL);
    fprintf(f, ",\n    F(unit_log2) %" PRId32 ",\n", s->unit_log2);
    write_vector(f, "ambient_uq16", s->ambient_uq16);
    write_vector(f, "background_uq20", s->background_uq20);
    write_vector(f, "background_bottom_uq20", s->background_bottom_uq20);
    fprintf(f, "    F(background_gradient) %" PRIu32 ", F(draw_behind) 0, F(draw_over) 0, F(draw_user) 0,\n",
            s->background_gradient);
    fprintf(f, "    F(shadow)\n");
    emit_struct(f, c, shadow_fields, EMIT_COUNT(shadow_fields), &s->shadow, 0, write_fits_pointer);
    fprintf(f, "};\n");
}

static void write_cameras(FILE *f, const compiled *c)
{
    fprintf(f, "\nstatic const gn_camera cameras[%zu] = {\n", c->n_cameras);
    for (size_t i = 0; i < c->n_cameras; i++) {
        write_name(f, c->camera_name[i]);
        emit_struct(f, c, camera_fields, EMIT_COUNT(camera_fields), &c->cameras[i], i, NULL);
        fprintf(f, ",\n");
    }
    fprintf(f, "};\n");
}

void emit_data(FILE *f, const compiled *c)
{
    emit_macro(f);
    write_meshes(f, c);
    write_textures(f, c);
    write_objects(f, c);
    write_lights(f, c);
    write_fits(f, c);
    write_scene(f, c);
    if (c->symbol) write_cameras(f, c);
}
