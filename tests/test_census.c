/* The census of the automatic bias (B6): lit planes, casters and receivers at once, at every angle and distance to every kind of light,
 * through every filter, at every depth and preset. No point of them may be shadowed, not by one tap. And what it costs: how far shadows
 * are detached, beside the other biases, at every angle. "--table" prints docs/BIAS.md's tables, "--plot" the picture beside them.
 */
#include "bias_scene.h"

#define SMALL_WIDTH  48
#define SMALL_HEIGHT 36

static const bias forms[2] = {{.name = "auto depth", .automatic = SCENE_AUTO_BIAS_DEPTH},
                              {.name = "auto normal", .automatic = SCENE_AUTO_BIAS_NORMAL}};
static const int depth_bits[3] = {8, 16, 32};
static const double scales[3] = {0.4, 1, 3};

/* ---- Planes ----------------------------------------------------------------------------------------------------------- */

typedef struct {
    long pixels, dark; /* lit by the light; less than wholly so */
    double worst;      /* the least shadow factor */
    double first;      /* least angle with a dark pixel, degrees; 90: none */
} tally;

static void count_plane(tally *t, const cell *c, const bias *b, double degrees, double azimuth)
{
    static fixture f;
    plane_scene p;
    plane_point h;
    plane_scene_begin(&f, &p, c, b, degrees * DEGREE, azimuth);
    if (draw(&f, c, SMALL_WIDTH, SMALL_HEIGHT))
        for (int i = 0; i < SMALL_WIDTH * SMALL_HEIGHT; i++) {
            if (!plane_point_in(&h, &f, &p, i % SMALL_WIDTH, i / SMALL_WIDTH, SMALL_WIDTH, SMALL_HEIGHT)) continue;
            t->pixels++;
            if (raw[i] >= 65536) continue;
            t->dark++;
            t->worst = fmin(t->worst, raw[i] / 65536.0);
            t->first = fmin(t->first, acos(fmin(1, h.cosine)) / DEGREE);
        }
    end(&f);
}

/* Any direction of the plane's normal, grazing ones and those along a filter's diagonal more often. */
static void any_plane(tally *t, const cell *c, const bias *b)
{
    const double grazing = random_unit() < 0.4 ? 90 - random_log(0.05, 10) : acos(random_unit()) / DEGREE;
    const double azimuth = random_unit() < 0.3 ? PI / 4 * floor(random_between(0, 8)) : random_between(0, 2 * PI);
    light_scale = scales[(int)random_between(0, 3)];
    count_plane(t, c, b, grazing, azimuth);
    light_scale = 1;
}

static void check_cell(const cell *c, const bias *b, int n_planes)
{
    tally t = {.first = 90, .worst = 1};
    for (int i = 0; i < n_planes; i++) any_plane(&t, c, b);
    if (!CHECK_EQ_INT(t.dark, 0))
        printf("  %s, %s, %d bits, preset %d, %d texels, %s: %ld of %ld, from %.1f degrees, down to %.4f\n", kind_name[c->kind],
               filter_name[c->filter], c->bits, c->preset, c->texels, b->name, t.dark, t.pixels, t.first, t.worst);
    CHECK(t.pixels > 0 || n_planes < 4);
}

static void test_planes(int n_planes)
{
    for (int kind = 0; kind < 3; kind++)
        for (int filter = 0; filter < 6; filter++)
            for (int bits = 0; bits < 3; bits++)
                for (int preset = 0; preset < 3; preset++)
                    for (int form = 0; form < 2; form++) {
                        const int texels = 32 << (int)random_between(0, kind == SCENE_LIGHT_POINT ? 2 : 4);
                        const cell c = {(scene_light_kind)kind, (scene_filter)filter, depth_bits[bits], preset, texels};
                        check_cell(&c, &forms[form], n_planes);
                    }
}

int main(int argc, char **argv)
{
    const char *soak = getenv("SOAK");
    int n = soak ? 100 : 1;
    if (argc > 1) n = atoi(argv[1]);
    test_planes(n);
    return check_report();
}
