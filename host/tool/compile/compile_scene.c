/* scene.c and scene.h: const data for flash, and the frames of the animation. */
#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>

#include "compile.h"

enum { PER_LINE = 12 };

void compile_write_text(FILE *file, const char *text)
{
    for (; *text; text++) fputc(*text == '*' || *text < 32 || *text > 126 || *text == '\\' ? '.' : *text, file);
}

/* ---- Arrays ------------------------------------------------------------------------------------------------------ */

typedef enum { I32, I16, U16, U8, POSITION, NORMAL } number_type;
static const char *const type_names[] = {"int32_t", "int16_t", "uint16_t", "uint8_t", "gn_position", "gn_normal"};

static long number_at(number_type type, const void *array, size_t i)
{
    switch (type) {
    case I32:
    case POSITION:
        return ((const int32_t *)array)[i];
    case I16:
    case NORMAL:
        return ((const int16_t *)array)[i];
    case U16:
        return ((const uint16_t *)array)[i];
    default:
        return ((const uint8_t *)array)[i];
    }
}

static void write_numbers(FILE *f, number_type type, const void *array, size_t n, size_t per_line)
{
    for (size_t i = 0; i < n; i++) {
        const char *gap = i % per_line == 0 ? "\n    " : " ";
        fprintf(f, "%s%ld,", gap, number_at(type, array, i));
    }
}

/* static const TYPE KIND_IDX_NAME[N] = {...}; nothing if there is no array */
static void write_array(FILE *f, number_type type, const char *kind, size_t idx, const char *name, const void *array,
                        size_t n, size_t per_line)
{
    if (!array || !n) return;
    fprintf(f, "static const %s %s_%zu_%s[%zu] = {", type_names[type], kind, idx, name, n);
    write_numbers(f, type, array, n, per_line);
    fprintf(f, "\n};\n");
}

/* .FIELD = KIND_IDX_NAME, */
static void write_pointer(FILE *f, const char *field, const char *kind, size_t idx, const char *name, const void *array)
{
    if (array) fprintf(f, ", .%s = %s_%zu_%s", field, kind, idx, name);
}

/* ---- Meshes and textures ----------------------------------------------------------------------------------------- */

static void write_mesh_arrays(FILE *f, const gn_mesh *m, size_t i, const char *name)
{
    size_t n = m->n_vertices;
    fprintf(f, "\n/* mesh %zu '", i);
    compile_write_text(f, name);
    fprintf(f, "': %zu vertices, %u triangles */\n", n, m->n_triangles);
    write_array(f, POSITION, "mesh", i, "pos", m->pos, 3 * n, PER_LINE);
    write_array(f, NORMAL, "mesh", i, "nrm", m->nrm_q15, 3 * n, PER_LINE);
    write_array(f, U16, "mesh", i, "rgb", m->rgb_uq16, 3 * n, PER_LINE);
    write_array(f, I16, "mesh", i, "uv", m->uv, 2 * n, PER_LINE);
    write_array(f, U16, "mesh", i, "mask_uv", m->mask_uv_uq16, 2 * n, PER_LINE);
    write_array(f, U16, "mesh", i, "idx", m->idx, 3 * (size_t)m->n_triangles, 2 * PER_LINE);
}

static void write_meshes(FILE *f, const compiled *c)
{
    const fixed_scene *fixed = &c->fixed;
    for (size_t i = 0; i < fixed->n_meshes; i++) write_mesh_arrays(f, &fixed->meshes[i], i, c->mesh_name[i]);
    if (!fixed->n_meshes) return; /* no array is of zero elements */
    fprintf(f, "\nstatic const gn_mesh meshes[%zu] = {\n", fixed->n_meshes);
    for (size_t i = 0; i < fixed->n_meshes; i++) {
        const gn_mesh *m = &fixed->meshes[i];
        fprintf(f, "    {.n_vertices = %u, .n_triangles = %u, .pos_frac_bits = %u, .uv_frac_bits = %u", m->n_vertices,
                m->n_triangles, m->pos_frac_bits, m->uv_frac_bits);
        write_pointer(f, "pos", "mesh", i, "pos", m->pos);
        write_pointer(f, "nrm_q15", "mesh", i, "nrm", m->nrm_q15);
        write_pointer(f, "rgb_uq16", "mesh", i, "rgb", m->rgb_uq16);
        write_pointer(f, "uv", "mesh", i, "uv", m->uv);
        write_pointer(f, "mask_uv_uq16", "mesh", i, "mask_uv", m->mask_uv_uq16);
        write_pointer(f, "idx", "mesh", i, "idx", m->idx);
        fprintf(f, "},\n");
    }
    fprintf(f, "};\n");
}

static void write_textures(FILE *f, const compiled *c)
{
    size_t n = c->n_textures;
    for (size_t i = 0; i < n; i++) {
        const gn_texture *t = &c->fixed.textures[i];
        fprintf(f, "\n/* texture %zu '", i);
        compile_write_text(f, c->texture_name[i]);
        fprintf(f, "': %dx%d */\n", 1 << t->width_log2, 1 << t->height_log2);
        write_array(f, U8, "texture", i, "rgba", t->rgba, quantise_texel_bytes(t) << (t->width_log2 + t->height_log2),
                    2 * PER_LINE);
    }
    if (!n) return;
    fprintf(f, "\nstatic const gn_texture textures[%zu] = {\n", n);
    for (size_t i = 0; i < n; i++) {
        const gn_texture *t = &c->fixed.textures[i];
        fprintf(f, "    {.width_log2 = %u, .height_log2 = %u, .flags = %u, .rgba = texture_%zu_rgba},\n", t->width_log2,
                t->height_log2, t->flags, i);
    }
    fprintf(f, "};\n");
}

/* ---- Objects, lights, scene -------------------------------------------------------------------------------------- */

/* ", .NAME = {a, b, c}" */
static void write_signed(FILE *f, const char *name, const int32_t *v, size_t n)
{
    fprintf(f, ", .%s = {", name);
    for (size_t i = 0; i < n; i++) fprintf(f, "%s%" PRId32, i ? ", " : "", v[i]);
    fprintf(f, "}");
}

static void write_unsigned(FILE *f, const char *name, const uint32_t *v, size_t n)
{
    fprintf(f, ", .%s = {", name);
    for (size_t i = 0; i < n; i++) fprintf(f, "%s%" PRIu32, i ? ", " : "", v[i]);
    fprintf(f, "}");
}

static void write_affine(FILE *f, const gn_affine *a)
{
    fprintf(f, ".to_world = {.exp = %" PRId32 ", .m_q30 = {", a->exp);
    for (int r = 0; r < 3; r++)
        fprintf(f, "%s{%" PRId32 ", %" PRId32 ", %" PRId32 "}", r ? ", " : "", a->m_q30[r][0], a->m_q30[r][1],
                a->m_q30[r][2]);
    fprintf(f, "}");
    write_signed(f, "t_q16", a->t_q16, 3);
    fprintf(f, "}");
}

static void write_name(FILE *f, const char *name)
{
    fprintf(f, "    /* ");
    compile_write_text(f, name);
    fprintf(f, " */\n    {");
}

static void write_object(FILE *f, const compiled *c, size_t i)
{
    const gn_object *o = &c->fixed.objects[i];
    write_name(f, c->object_name[i]);
    fprintf(f, ".mesh = &meshes[%td], .flags = %" PRIu32 ",\n     ", o->mesh - c->fixed.meshes, o->flags);
    write_affine(f, &o->to_world);
    write_unsigned(f, "albedo_uq16", o->albedo_uq16, 3);
    fprintf(f,
            ",\n     .visible_alpha = (gn_alpha)%d, .caster_alpha = (gn_alpha)%d, .alpha_uq16 = %" PRIu32
            ", .alpha_cutoff_uq16 = %" PRIu32,
            (int)o->visible_alpha, (int)o->caster_alpha, o->alpha_uq16, o->alpha_cutoff_uq16);
    write_unsigned(f, "specular_uq16", o->specular_uq16, 3);
    fprintf(f, ", .shininess_log2 = %u", o->shininess_log2);
    if (o->texture) fprintf(f, ", .texture = &textures[%td]", o->texture - c->fixed.textures);
    if (o->mask_image) fprintf(f, ", .mask_image = &textures[%td]", o->mask_image - c->fixed.textures);
    write_pointer(f, "mask_u8", "object", i, "mask", o->mask_u8);
    write_pointer(f, "baked_uq12", "object", i, "baked", o->baked_uq12);
    fprintf(f, "},\n");
}

static void write_objects(FILE *f, const compiled *c)
{
    size_t n = c->fixed.scene.n_objects;
    for (size_t i = 0; i < n; i++) {
        const gn_object *o = &c->fixed.objects[i];
        write_array(f, U8, "object", i, "mask", o->mask_u8, 4 * (size_t)o->mesh->n_vertices, 2 * PER_LINE);
        write_array(f, U16, "object", i, "baked", o->baked_uq12, 3 * (size_t)o->mesh->n_vertices, PER_LINE);
    }
    fprintf(f, "\nstatic const gn_object objects[%zu] = {\n", n ? n : 1);
    for (size_t i = 0; i < n; i++) write_object(f, c, i);
    fprintf(f, "%s};\n", n ? "" : "    {.mesh = 0},\n");
}

static void write_light(FILE *f, const gn_light *l, const char *name)
{
    write_name(f, name);
    fprintf(
        f,
        ".kind = (gn_light_kind)%d, .mode = (gn_light_mode)%d, .softness = (gn_softness)%d, .mask_channel = %" PRId32,
        (int)l->kind, (int)l->mode, (int)l->softness, l->mask_channel);
    write_signed(f, "direction", l->direction, 3);
    write_signed(f, "position_q16", l->position_q16, 3);
    write_unsigned(f, "colour_uq16", l->colour_uq16, 3);
    fprintf(f,
            ",\n     .colour_exp = %" PRId32 ", .range_q16 = %" PRIu32 "U, .near_q16 = %" PRId32
            ", .inner_turn = %u, .outer_turn = %u",
            l->colour_exp, l->range_q16, l->near_q16, l->inner_turn, l->outer_turn);
    fprintf(f,
            ", .shadow_strength_uq16 = %" PRIu32 ",\n     .bias_constant_q16 = %" PRId32 ", .bias_slope_q16 = %" PRId32
            ", .bias_normal_q16 = %" PRId32,
            l->shadow_strength_uq16, l->bias_constant_q16, l->bias_slope_q16, l->bias_normal_q16);
    write_signed(f, "bias_receiver_q16", l->bias_receiver_q16, 4);
    fprintf(f,
            ", .bias_caster_q16 = %" PRId32 ", .receiver_plane = %" PRIu32
            ", .auto_bias = (gn_auto_bias)%d, .near_offset_q16 = %" PRId32 "},\n",
            l->bias_caster_q16, l->receiver_plane, (int)l->auto_bias, l->near_offset_q16);
}

static void write_lights(FILE *f, const compiled *c)
{
    size_t n = c->fixed.scene.n_lights;
    fprintf(f, "\nstatic const gn_light lights[%zu] = {\n", n ? n : 1);
    for (size_t i = 0; i < n; i++) write_light(f, &c->fixed.lights[i], c->light_name[i]);
    fprintf(f, "%s};\n", n ? "" : "    {.shadow_strength_uq16 = 0},\n");
}

static void write_shadow(FILE *f, const gn_shadow_settings *s)
{
    fprintf(f,
            "    .shadow = {.max_distance_q16 = %" PRId32 ", .distance_fade_uq16 = %" PRIu32
            ", .cascade_fade_uq16 = %" PRIu32 ",\n",
            s->max_distance_q16, s->distance_fade_uq16, s->cascade_fade_uq16);
    fprintf(f,
            "               .filter = (gn_filter)%d, .other_filter = (gn_filter)%d, .kernel = (gn_kernel)%d, "
            ".penumbra_uq16 = %" PRIu32 ", .disk_samples = %" PRIu32 ",\n",
            (int)s->filter, (int)s->other_filter, (int)s->kernel, s->penumbra_uq16, s->disk_samples);
    fprintf(f,
            "               .mixing = (gn_mixing)%d, .tile_sizes = (gn_tile_sizes)%d, .fit = (gn_fit)%d, .main_light = "
            "%" PRIu32 ", .caster_culling = %" PRIu32 ", .object_lights = %" PRIu32,
            (int)s->mixing, (int)s->tile_sizes, (int)s->fit, s->main_light, s->caster_culling, s->object_lights);
    write_unsigned(f, "refresh", s->refresh, 4);
    fprintf(f, ",\n               .n_cascades = %" PRIu32, s->n_cascades);
    if (s->cascades_unused) fprintf(f, ", .cascades_unused = 0x%" PRIx32, s->cascades_unused);
    write_unsigned(f, "cascade_ratio_uq16", s->cascade_ratio_uq16, 3);
    fprintf(f, ", .blend = (gn_blend)%d, .distance_mode = (gn_distance_mode)%d},\n", (int)s->blend,
            (int)s->distance_mode);
}

static void write_scene_struct(FILE *f, const compiled *c)
{
    const gn_scene *s = &c->fixed.scene;
    fprintf(f,
            "\nstatic const gn_scene still = {\n    .objects = objects, .n_objects = %" PRIu32
            ", .lights = lights, .n_lights = %" PRIu32 ",\n    .camera = {",
            s->n_objects, s->n_lights);
    write_affine(f, &s->camera.to_world);
    fprintf(f,
            ",\n               .focal_q24 = %" PRIu32 "U, .near_q16 = %" PRId32 ", .far_q16 = %" PRId32
            "},\n    .unit_log2 = %" PRId32,
            s->camera.focal_q24, s->camera.near_q16, s->camera.far_q16, s->unit_log2);
    write_unsigned(f, "ambient_uq16", s->ambient_uq16, 3);
    write_unsigned(f, "background_uq16", s->background_uq16, 3);
    fprintf(f, ",\n");
    write_shadow(f, &s->shadow);
    fprintf(f, "};\n");
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

static void write_tracks(FILE *f, const compiled *c)
{
    for (size_t i = 0; i < c->n_tracks; i++) {
        const compile_track *t = &c->tracks[i];
        const char *name = t->field->of == COMPILE_OF_OBJECT  ? c->object_name[t->idx]
                           : t->field->of == COMPILE_OF_LIGHT ? c->light_name[t->idx]
                                                              : "the scene";
        fprintf(f, "\n/* %s of ", t->field->name);
        compile_write_text(f, name);
        fprintf(f, ", frame by frame */\nstatic const int32_t track_%zu[SCENE_FRAMES][%zu] = {", i, t->field->n_words);
        for (int frame = 0; frame < c->n_frames; frame++) {
            const int32_t *words = t->words + (size_t)frame * t->field->n_words;
            fprintf(f, "\n    {");
            for (size_t k = 0; k < t->field->n_words; k++) fprintf(f, "%s%" PRId32, k ? ", " : "", words[k]);
            fprintf(f, "},");
        }
        fprintf(f, "\n};\n");
    }
}

static void write_track_use(FILE *f, const compile_track *t, size_t i)
{
    fprintf(f, "    memcpy(&now->");
    if (t->field->of == COMPILE_OF_OBJECT) fprintf(f, "objects[%zu]", t->idx);
    else if (t->field->of == COMPILE_OF_LIGHT) fprintf(f, "lights[%zu]", t->idx);
    else fprintf(f, "scene");
    fprintf(f, ".%s, track_%zu[frame], sizeof track_%zu[frame]);\n", t->field->name, i, i);
}

static void write_frame_function(FILE *f, const compiled *c)
{
    fprintf(f, "\nconst gn_scene *scene_frame(scene_state *now, uint32_t frame)\n{\n");
    if (!c->n_tracks) {
        fprintf(f, "    (void)now, (void)frame; /* nothing moves */\n    return &still;\n}\n");
        return;
    }
    fprintf(
        f,
        "    if (frame >= SCENE_FRAMES) frame = SCENE_FRAMES - 1;\n    memcpy(&now->scene, &still, sizeof still);\n");
    if (compile_moves(c, COMPILE_OF_OBJECT))
        fprintf(f, "    memcpy(now->objects, objects, sizeof objects);\n    now->scene.objects = now->objects;\n");
    if (compile_moves(c, COMPILE_OF_LIGHT))
        fprintf(f, "    memcpy(now->lights, lights, sizeof lights);\n    now->scene.lights = now->lights;\n");
    for (size_t i = 0; i < c->n_tracks; i++) write_track_use(f, &c->tracks[i], i);
    fprintf(f, "    return &now->scene;\n}\n");
}

void compile_write_origin(FILE *f, const compiled *c)
{
    fprintf(f, "Made by gnomon compile from ");
    const char *slash = c->options->scene_path, *name = slash;
    for (; *slash; slash++)
        if (*slash == '/') name = slash + 1;
    compile_write_text(f, name);
    for (int i = 0; i < c->options->n_sets; i++) {
        fprintf(f, " --set ");
        compile_write_text(f, c->options->sets[i]);
    }
}

void compile_write_scene(FILE *f, const compiled *c)
{
    fprintf(f, "/* ");
    compile_write_origin(f, c);
    fprintf(f, " */\n#include \"scene.h\"\n%s", c->n_tracks ? "\n#include <string.h>\n" : "");
    write_meshes(f, c);
    write_textures(f, c);
    write_objects(f, c);
    write_lights(f, c);
    write_scene_struct(f, c);
    write_tracks(f, c);
    write_frame_function(f, c);
}

void compile_write_header(FILE *f, const compiled *c)
{
    static const char *const format_names[] = {"RGB565", "RGB888", "RGB565_SWAPPED", "GREY8", "GREY4", "MONO1"};
    fprintf(f, "/* ");
    compile_write_origin(f, c);
    fprintf(
        f,
        ".\n *\n * Compile the library, scene.c and your program with -DGN_USER_CONFIG='\"gn_scene_config.h\"'.\n */\n"
        "#ifndef SCENE_H\n#define SCENE_H\n\n#include \"gnomon.h\"\n\n"
        "#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n");
    fprintf(f, "#define SCENE_WIDTH  %d\n#define SCENE_HEIGHT %d\n#define SCENE_FORMAT GN_FORMAT_%s\n",
            c->options->width, c->options->height, format_names[c->set.output]);
    fprintf(f, "#define SCENE_FRAMES %d\n#define SCENE_FRAME_US %ld /* microseconds from frame to frame */\n\n",
            c->n_frames, c->scene.fps > 0 ? (long)(1e6 / c->scene.fps + 0.5) : 0L);
    fprintf(f, "/* What moves: RAM. */\ntypedef struct {\n");
    if (c->n_tracks) fprintf(f, "    gn_scene scene;\n");
    else fprintf(f, "    uint8_t nothing;\n");
    if (compile_moves(c, COMPILE_OF_OBJECT))
        fprintf(f, "    gn_object objects[%" PRIu32 "];\n", c->fixed.scene.n_objects);
    if (compile_moves(c, COMPILE_OF_LIGHT)) fprintf(f, "    gn_light lights[%" PRIu32 "];\n", c->fixed.scene.n_lights);
    fprintf(f, "} scene_state;\n\n"
               "/* The scene at a frame, 0 .. SCENE_FRAMES - 1, in any order; valid until the next call. */\n"
               "const gn_scene *scene_frame(scene_state *now, uint32_t frame);\n\n"
               "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}
