/* What is open: names in C for objects, lights, cameras, meshes and textures; and the state that a program may change.
 */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../scene/core/bounds.h"
#include "rig.h"

/* ---- Names ------------------------------------------------------------------------------------------------------- */

enum { NAME_BYTES = 48 };
typedef char identifier[NAME_BYTES];

static bool is_letter(char a)
{
    return (a >= 'a' && a <= 'z') || (a >= 'A' && a <= 'Z') || (a >= '0' && a <= '9');
}

static char upper(char a)
{
    return (char)(a >= 'a' && a <= 'z' ? a - 'a' + 'A' : a);
}

/* Letters and digits, upper case; all between them is one line. */
static void make_identifier(identifier out, const char *text)
{
    size_t n = 0;
    for (; *text && n < NAME_BYTES - 12; text++) {
        if (is_letter(*text)) out[n++] = upper(*text);
        else if (n && out[n - 1] != '_') out[n++] = '_';
    }
    while (n && out[n - 1] == '_') n--;
    if (!n) out[n++] = 'X';
    out[n] = 0;
}

void open_write_upper(FILE *f, const char *text)
{
    for (; *text; text++) fputc(upper(*text), f);
}

static bool is_taken(identifier *all, size_t n, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(all[i], name) == 0) return true;
    return false;
}

/* Names that are there twice get a number. */
static void make_unique(identifier *all, size_t i)
{
    const size_t length = strlen(all[i]);
    for (unsigned k = 2; is_taken(all, i, all[i]); k++) snprintf(all[i] + length, NAME_BYTES - length, "_%u", k);
}

/* enum { DESK_OBJECT_LAMP, ... DESK_OBJECTS }; KIND: OBJECT */
static void write_names(FILE *f, const compiled *c, const char *kind, const char *const *names, size_t n)
{
    identifier *all = malloc((n + 1) * sizeof *all);
    fprintf(f, "enum {");
    for (size_t i = 0; all && i < n; i++) {
        make_identifier(all[i], names[i]);
        make_unique(all, i);
        fprintf(f, "\n    ");
        open_write_upper(f, c->symbol);
        fprintf(f, "_%s_%s, /* ", kind, all[i]);
        compile_write_text(f, names[i]);
        fprintf(f, " */");
    }
    fprintf(f, "\n    ");
    open_write_upper(f, c->symbol);
    fprintf(f, "_%s%s = %zu\n};\n", kind, strcmp(kind, "MESH") == 0 ? "ES" : "S", n);
    free(all);
}

/* The picture's camera is the first; the others are those that the file has beside it. */
static int name_cameras(compiled *c)
{
    const scene_rig *from = c->scene.rig;
    const size_t n = from && from->n_cameras ? from->n_cameras : 1;
    c->cameras = malloc(n * sizeof *c->cameras);
    c->camera_name = malloc(n * sizeof *c->camera_name);
    if (!c->cameras || !c->camera_name) return -1;
    for (size_t i = 0; i < n; i++) {
        const scene_view *view = from && from->n_cameras ? &from->cameras[i] : NULL;
        c->camera_name[i] = view ? view->name : "camera";
        if (i) quantise_camera(&c->cameras[i], &view->camera, c->fixed.world_exp);
        else c->cameras[i] = c->fixed.scene.camera;
    }
    c->n_cameras = n;
    return 0;
}

int open_begin(compiled *c, char *error, size_t bytes)
{
    c->symbol = "scene";
    if (name_cameras(c)) {
        snprintf(error, bytes, "out of memory");
        return -1;
    }
    if (!c->options->asset || rig_begin(&c->rig, &c->scene, &c->fixed, error, bytes)) return c->options->asset ? -1 : 0;
    const size_t n = c->rig ? c->rig->fixed.n_clips : 0;
    c->clip_name = malloc((n + 1) * sizeof *c->clip_name);
    if (!c->clip_name) return -1;
    for (size_t i = 0; i < n; i++) c->clip_name[i] = c->scene.rig->clips[i].name;
    return 0;
}

/* ---- Declarations ------------------------------------------------------------------------------------------------ */

static void write_all_names(FILE *f, const compiled *c)
{
    fprintf(f, "/* What is there, by its name in the file. */\n");
    write_names(f, c, "OBJECT", c->object_name, c->fixed.scene.n_objects);
    write_names(f, c, "LIGHT", c->light_name, c->fixed.scene.n_lights);
    write_names(f, c, "CAMERA", c->camera_name, c->n_cameras);
    write_names(f, c, "MESH", c->mesh_name, c->fixed.n_meshes);
    write_names(f, c, "TEXTURE", c->texture_name, c->n_textures);
    if (c->rig) write_names(f, c, "CLIP", c->clip_name, c->rig->fixed.n_clips);
    if (c->fixed.n_meshes) fprintf(f, "\nextern const gn_mesh %s_meshes[%zu];\n", c->symbol, c->fixed.n_meshes);
    if (c->n_textures) fprintf(f, "extern const gn_texture %s_textures[%zu];\n", c->symbol, c->n_textures);
    if (c->rig) fprintf(f, "extern const gn_rig %s_rig; /* .clips[...].duration_q16 */\n", c->symbol);
}

static size_t at_least_one(size_t n)
{
    return n ? n : 1;
}

static void write_state(FILE *f, const compiled *c)
{
    fprintf(f,
            "\n/* All that a program may change, in RAM: places, colours, flags, meshes. */\ntypedef struct {\n"
            "    /* Ambient light, background, shadow settings. %s_init sets all of it, %s_now its camera alone. */\n"
            "    gn_scene scene;\n"
            "    gn_object objects[%zu];\n    gn_light lights[%zu];\n    gn_camera cameras[%zu];\n"
            "    uint32_t camera; /* which of them is looked through */\n",
            c->symbol, c->symbol, at_least_one(c->fixed.scene.n_objects), at_least_one(c->fixed.scene.n_lights),
            c->n_cameras);
    const size_t n_skins = compile_count_skins(c, c->fixed.scene.n_objects);
    if (n_skins) fprintf(f, "    gn_skin skins[%zu]; /* their joints may be the program's own */\n", n_skins);
    if (c->rig) fprintf(f, "    gn_affine nodes[%u]; /* of %s_pose */\n", c->rig->fixed.n_nodes, c->symbol);
    fprintf(f, "} %s_state;\n\n", c->symbol);
}

static bool casts(const scene *s, const scene_object *object, const double *point)
{
    (void)s, (void)point;
    return object->caster != SCENE_CASTER_OFF;
}

/* What a model is turned about. */
static void write_centre(FILE *f, const compiled *c)
{
    bounds b = {.radius = 1};
    if (!bounds_of_scene(&b, &c->scene, casts)) bounds_of_scene(&b, &c->scene, NULL);
    fprintf(f, "/* The middle of what casts shadows, as the file has it: x, y and z in the library's unit, as "
               "to_world.t_q16:\n"
               " * not for ");
    open_write_upper(f, c->symbol);
    fprintf(f, "_LENGTH. */\n#define ");
    open_write_upper(f, c->symbol);
    fprintf(f, "_CENTRE");
    for (int k = 0; k < 3; k++) fprintf(f, "%s%.0f", k ? ", " : " {", ldexp(b.centre[k], c->fixed.world_exp + 16));
    fprintf(f, "}\n\n");
}

/* Light falls off with the square of distance: an intensity of the file is scaled by its unit's square. */
static void write_intensity(FILE *f, const compiled *c)
{
    char name[64] = ""; /* cmd_asset.c takes no longer ones */
    for (size_t i = 0; c->symbol[i] && i + 1 < sizeof name; i++) name[i] = (char)upper(c->symbol[i]);
    fprintf(
        f,
        "/* Spot and point lights of a program's own: colour_uq16[k] = %s_INTENSITY(4), 0 .. 255.99, and colour_exp =\n"
        " * %s_INTENSITY_EXP light a white surface at a distance of 1 unit of the file by 4; in a glTF file that is 4 "
        "pi\n"
        " * candela. A program that sets one of the two must set the other. An irradiance E at a distance of d units "
        "of\n"
        " * the file takes E * d * d; where that is above 255, add to the exponent: %s_INTENSITY(160) with\n"
        " * %s_INTENSITY_EXP + 9 is 160 * 2^9. gn_light_spot and gn_light_point alone (irradiance 1 at 4 of the "
        "library's\n"
        " * units) are too dark for a model of hundreds of units. */\n"
        "#define %s_INTENSITY(x)  GN_UQ16(x)\n#define %s_INTENSITY_EXP %d\n\n",
        name, name, name, name, name, name, 2 * c->fixed.world_exp);
}

void open_write_declarations(FILE *f, const compiled *c)
{
    fprintf(f, "/* Lengths of the file as the library's: ");
    open_write_upper(f, c->symbol);
    fprintf(f, "_LENGTH(1.5), a constant, is 1.5 units of the file. */\n#define ");
    open_write_upper(f, c->symbol);
    fprintf(f, "_LENGTH(x) GN_Q16((x) * %.17g)\n\n", ldexp(1, c->fixed.world_exp));
    write_intensity(f, c);
    write_centre(f, c);
    write_all_names(f, c);
    write_state(f, c);
    fprintf(
        f,
        "/* Everything as the file has it. The state must live, and stay where it is, as long as it is drawn: make it "
        "static. */\nvoid %s_init(%s_state *now);\n\n",
        c->symbol, c->symbol);
    fprintf(f, "/* The scene as it is now, for gn_render. */\nconst gn_scene *%s_now(%s_state *now);\n\n", c->symbol,
            c->symbol);
    if (!c->rig) return;
    fprintf(
        f,
        "/* A clip at a time in seconds, GN_UQ16(1.5): places all that any clip moves, and nothing else. Clips end; "
        "one\n * that goes round takes time_q16 %% %s_rig.clips[clip].duration_q16. */\n"
        "void %s_pose(%s_state *now, uint32_t clip, uint32_t time_q16);\n\n",
        c->symbol, c->symbol, c->symbol);
}

/* ---- Functions --------------------------------------------------------------------------------------------------- */

void open_write_functions(FILE *f, const compiled *c)
{
    const char *name = c->symbol;
    const gn_scene *s = &c->fixed.scene;
    fprintf(f, "\nvoid %s_init(%s_state *now)\n{\n    memset(now, 0, sizeof *now);\n    now->scene = still;\n", name,
            name);
    if (s->n_objects) fprintf(f, "    memcpy(now->objects, objects, sizeof objects);\n");
    if (compile_count_skins(c, s->n_objects)) fprintf(f, "    memcpy(now->skins, skins, sizeof skins);\n");
    if (s->n_lights) fprintf(f, "    memcpy(now->lights, lights, sizeof lights);\n");
    fprintf(f, "    memcpy(now->cameras, cameras, sizeof cameras);\n");
    compile_write_skin_use(f, c);
    fprintf(f, "    now->scene.objects = now->objects;\n    now->scene.lights = now->lights;\n}\n");
    fprintf(f, "\nconst gn_scene *%s_now(%s_state *now)\n{\n", name, name);
    fprintf(f,
            "    now->scene.camera = now->cameras[now->camera < %zu ? now->camera : 0];\n"
            "    return &now->scene;\n}\n",
            c->n_cameras);
    if (!c->rig) return;
    fprintf(f,
            "\nvoid %s_pose(%s_state *now, uint32_t clip, uint32_t time_q16)\n{\n"
            "    gn_pose(&%s_rig, clip, time_q16, now->nodes, now->objects, now->lights, now->cameras);\n",
            name, name, name);
    rig_write_skins(f, c);
    fprintf(f, "}\n");
}
