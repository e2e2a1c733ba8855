/* [M11] Far textures do not glitter. The camera slides over a chequered floor by a fraction of a texel per frame: what
 * pixels change from frame to frame, with the texture's smaller levels and without, in the library and the reference. A
 * floor seen from a height of 1.5 units, 8 texels per unit; far: from a view depth of 12 units on, where a pixel is
 * longer than a texel. "--table" prints it. */
#include "../host/scene/core/texture_format.h"
#include "../host/tool/engine/engine.h"
#include "row_scenes.h"

enum { WIDTH = 160, HEIGHT = 120, N_FRAMES = 12 };

#define FAR 12.0

typedef struct {
    double rms;    /* of the change of a channel from frame to frame, of 255 */
    double spread; /* rms distance of far pixels from their mean: what is left of the pattern */
} flicker;

static void build(fixture *f, scene_texture *checker, bool levels)
{
    const double ground[12] = {-60, 0, 10, 60, 0, 10, 60, 0, -80, -60, 0, -80};
    const double uv[8] = {-30, 22.5, 30, 22.5, 30, -22.5, -30, -22.5};
    start(f);
    add_quad(f, ground)->uv = copy(uv, 8);
    set_albedo(f, 0.9, 0.9, 0.9);
    add_sun(f, 0.3, -1, -0.2, 0.9);
    fill_textures();
    *checker = (scene_texture){.name = no_name, .width = 16, .height = 16, .bilinear = true};
    checker->rgba = malloc(sizeof checker_rgba);
    if (!checker->rgba) abort();
    memcpy(checker->rgba, checker_rgba, sizeof checker_rgba);
    CHECK(texture_set_levels(checker, levels));
    f->textures[f->s.n_textures] = *checker;
    f->objects[0].texture_idx = f->s.n_textures++;
}

static bool is_far(const engine_picture *p, size_t i)
{
    return p->triangle[i] >= 0 && p->depth[i] > FAR && p->depth[i] < 60;
}

static void compare(flicker *out, const engine_picture *before, const engine_picture *now, long *n)
{
    double mean[3] = {0, 0, 0};
    long far = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        if (!is_far(before, i) || !is_far(now, i)) continue;
        for (size_t c = 0; c < 3; c++) {
            out->rms += pow(now->rgb8[3 * i + c] - before->rgb8[3 * i + c], 2);
            mean[c] += now->rgb8[3 * i + c];
        }
        far++;
    }
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; i++)
        if (is_far(before, i / 3) && is_far(now, i / 3))
            out->spread += pow(now->rgb8[i] - mean[i % 3] / (double)far, 2);
    *n += 3 * far;
}

/* A twentieth of a unit sideways and forwards: less than half a texel. */
static flicker walk(bool levels, bool fixed, int preset)
{
    static fixture f;
    scene_texture checker;
    engine_picture picture[2];
    flicker out = {0, 0};
    long n = 0;
    settings set;
    char error[200] = "";
    settings_init(&set);
    settings_preset(&set, preset);
    build(&f, &checker, levels);
    for (int frame = 0; frame < N_FRAMES; frame++) {
        engine_picture *now = &picture[frame % 2];
        camera(&f, 0.05 * frame, 1.5, 6 - 0.03 * frame, 0.05 * frame, 0.6, -6 - 0.03 * frame);
        const int failed = fixed ? engine_fixed(now, &f.s, &set, WIDTH, HEIGHT, ENGINE_ALL, error, sizeof error)
                                 : engine_reference(now, &f.s, &set, WIDTH, HEIGHT, error, sizeof error);
        if (!CHECK_EQ_INT(failed, 0)) abort();
        if (frame > 0) {
            compare(&out, &picture[1 - frame % 2], now, &n);
            engine_free(&picture[1 - frame % 2]);
        }
    }
    engine_free(&picture[(N_FRAMES - 1) % 2]);
    free(checker.rgba);
    end(&f);
    CHECK(n > 3000 * (N_FRAMES - 1));
    out.rms = sqrt(out.rms / (double)n);
    out.spread = sqrt(out.spread / (double)n);
    return out;
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        bool fixed;
        int preset;
    } ways[] = {{"reference", false, SETTINGS_ACCURATE},
                {"library, accurate", true, SETTINGS_ACCURATE},
                {"library, balanced", true, SETTINGS_BALANCED},
                {"library, fast", true, SETTINGS_FAST}};
    const bool table = argc > 1 && strcmp(argv[1], "--table") == 0;
    if (table)
        printf("\n| far floor | change without levels | with | pattern without | with |\n|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        const flicker without = walk(false, ways[i].fixed, ways[i].preset),
                      with = walk(true, ways[i].fixed, ways[i].preset);
        CHECK(without.rms > 25);
        CHECK(10 * with.rms < without.rms);
        if (table)
            printf("| %s | %.2f | %.2f | %.2f | %.2f |\n", ways[i].name, without.rms, with.rms, without.spread,
                   with.spread);
        else printf("%s: %.2f of 255 without levels, %.2f with\n", ways[i].name, without.rms, with.rms);
    }
    return table ? 0 : check_report();
}
