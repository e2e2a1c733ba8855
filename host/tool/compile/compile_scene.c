/* scene.c and scene.h: const data for flash, and the frames of the animation. */
#include <inttypes.h>
#include <string.h>

#include "compile_emit.h"

void compile_write_text(FILE *file, const char *text)
{
    for (; *text; text++) fputc(*text == '*' || *text < 32 || *text > 126 || *text == '\\' ? '.' : *text, file);
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

static void write_tracks(FILE *f, const compiled *c)
{
    for (size_t i = 0; i < c->n_tracks; i++) {
        const compile_track *t = &c->tracks[i];
        if (t->field->of == COMPILE_OF_SKIN) continue;
        const char *name = t->field->of == COMPILE_OF_OBJECT  ? c->object_name[t->idx]
                           : t->field->of == COMPILE_OF_LIGHT ? c->light_name[t->idx]
                                                              : "the scene";
        fprintf(f, "\n/* %s of ", t->field->name);
        compile_write_text(f, name);
        fprintf(f, ", frame by frame */\nstatic const int32_t track_%zu[SCENE_FRAMES][%zu] = {", i, t->n_words);
        for (int frame = 0; frame < c->n_frames; frame++) {
            const int32_t *words = t->words + (size_t)frame * t->n_words;
            fprintf(f, "\n    {");
            for (size_t k = 0; k < t->n_words; k++) fprintf(f, "%s%" PRId32, k ? ", " : "", words[k]);
            fprintf(f, "},");
        }
        fprintf(f, "\n};\n");
    }
}

static void write_track_use(FILE *f, const compiled *c, const compile_track *t, size_t i)
{
    const char *name = t->field->name;
    const bool camera = c->symbol && strncmp(name, "camera.", 7) == 0;
    if (t->field->of == COMPILE_OF_SKIN) {
        fprintf(f, "    now->skins[%zu].joint = track_%zu[frame];\n", compile_count_skins(c, t->idx), i);
        return;
    }
    fprintf(f, "    memcpy(&now->");
    if (t->field->of == COMPILE_OF_OBJECT) fprintf(f, "objects[%zu]", t->idx);
    else if (t->field->of == COMPILE_OF_LIGHT) fprintf(f, "lights[%zu]", t->idx);
    else if (camera) fprintf(f, "cameras[0]");
    else fprintf(f, "scene");
    fprintf(f, ".%s, track_%zu[frame], sizeof track_%zu[frame]);\n", name + (camera ? 7 : 0), i, i);
}

/* Only what moves is set: the rest is the program's. */
static void write_open_frame_function(FILE *f, const compiled *c)
{
    fprintf(f, "\nconst gn_scene *scene_frame(scene_state *now, uint32_t frame)\n{\n");
    if (c->n_tracks) fprintf(f, "    if (frame >= SCENE_FRAMES) frame = SCENE_FRAMES - 1;\n");
    else fprintf(f, "    (void)frame; /* nothing moves by itself */\n");
    for (size_t i = 0; i < c->n_tracks; i++) write_track_use(f, c, &c->tracks[i], i);
    fprintf(f, "    return scene_now(now);\n}\n");
}

void compile_write_skin_use(FILE *f, const compiled *c)
{
    for (size_t i = 0; i < c->fixed.scene.n_objects; i++)
        if (c->fixed.objects[i].skin)
            fprintf(f, "    now->objects[%zu].skin = &now->skins[%zu];\n", i, compile_count_skins(c, i));
}

/* Skins are of objects: those name the ones that move. */
static bool moves_objects(const compiled *c)
{
    return compile_moves(c, COMPILE_OF_OBJECT) || compile_moves(c, COMPILE_OF_SKIN);
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
    if (moves_objects(c))
        fprintf(f, "    memcpy(now->objects, objects, sizeof objects);\n    now->scene.objects = now->objects;\n");
    if (compile_moves(c, COMPILE_OF_SKIN)) {
        fprintf(f, "    memcpy(now->skins, skins, sizeof skins);\n");
        compile_write_skin_use(f, c);
    }
    if (compile_moves(c, COMPILE_OF_LIGHT))
        fprintf(f, "    memcpy(now->lights, lights, sizeof lights);\n    now->scene.lights = now->lights;\n");
    for (size_t i = 0; i < c->n_tracks; i++) write_track_use(f, c, &c->tracks[i], i);
    fprintf(f, "    return &now->scene;\n}\n");
}

void compile_write_origin(FILE *f, const compiled *c)
{
    fprintf(f, "Made by gnomon %s from ", c->options->asset ? "asset" : "compile");
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
    fprintf(f, " */\n#include \"scene.h\"\n%s", c->n_tracks || c->symbol ? "\n#include <string.h>\n" : "");
    emit_data(f, c);
    write_tracks(f, c);
    if (c->symbol) {
        open_write_functions(f, c);
        write_open_frame_function(f, c);
    } else write_frame_function(f, c);
}

static void write_state(FILE *f, const compiled *c)
{
    fprintf(f, "/* What moves: RAM. */\ntypedef struct {\n");
    if (c->n_tracks) fprintf(f, "    gn_scene scene;\n");
    else fprintf(f, "    uint8_t nothing;\n");
    if (moves_objects(c)) fprintf(f, "    gn_object objects[%" PRIu32 "];\n", c->fixed.scene.n_objects);
    if (compile_moves(c, COMPILE_OF_SKIN))
        fprintf(f, "    gn_skin skins[%zu];\n", compile_count_skins(c, c->fixed.scene.n_objects));
    if (compile_moves(c, COMPILE_OF_LIGHT)) fprintf(f, "    gn_light lights[%" PRIu32 "];\n", c->fixed.scene.n_lights);
    fprintf(f, "} scene_state;\n\n");
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
    if (c->symbol) open_write_declarations(f, c);
    else write_state(f, c);
    fprintf(f, "/* The scene at a frame, 0 .. SCENE_FRAMES - 1, in any order; valid until the next call.%s */\n",
            c->symbol ? " What does not\n * move by itself stays as it is. scene_init comes first." : "");
    fprintf(f, "const gn_scene *scene_frame(scene_state *now, uint32_t frame);\n\n"
               "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}
