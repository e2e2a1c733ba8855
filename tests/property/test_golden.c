/* Golden frames: the library's pictures of the own scenes, as CRC-32 of their bytes, are the same with every compiler
 * and optimisation level. "--write" prints the file anew: a deliberate change of pixels changes tests/golden.txt in the
 * same commit. */
#include <stdlib.h>
#include <string.h>

#include "../host/tool/engine/engine.h"
#include "check.h"

#define GOLDEN "tests/golden.txt"

static const struct {
    const char *scene;
    int frame;
    const char *sets[4]; /* as --set */
} frames[] = {
    {"sundial", 24, {NULL}},  {"sundial", 72, {NULL}},
    {"sundial", 132, {NULL}}, {"avenue", 0, {NULL}},
    {"desk", 0, {NULL}},      {"desk", 12, {"other_filter=disk", "disk_samples=9", "penumbra=2"}},
    {"room", 0, {NULL}},      {"room", 0, {"other_depth_bits=32", "other_filter=7x7"}},
    {"fence", 0, {NULL}},     {"fence", 0, {"depth_bits=8", "cascade_blend=dither", "softness=hard"}},
    {"mixed", 0, {NULL}},     {"mixed", 24, {"mixing=always", "tiles=importance", "main_light=1", "receiver_plane=1"}},
};

static uint32_t crc32_of(const void *data, size_t n)
{
    const uint8_t *p = data;
    uint32_t crc = ~0U;
    for (size_t i = 0; i < n; i++) {
        crc ^= p[i];
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1U ? 0xEDB88320U : 0);
    }
    return ~crc;
}

/* Words become bytes, the low one first, on any host. */
static void low_byte_first(uint16_t *words, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const uint8_t bytes[2] = {(uint8_t)words[i], (uint8_t)(words[i] >> 8)};
        memcpy(&words[i], bytes, 2);
    }
}

/* The line of golden.txt for one frame and preset. */
static int line_of(char *line, size_t bytes, const char *scene_name, int frame, const char *const sets[4], int preset)
{
    char path[256], error[512] = "";
    scene s;
    settings set;
    engine_picture p;
    scene_options options = {.frame = frame, .width = 320, .height = 240};
    snprintf(path, sizeof path, "host/scenes/%s.gltf", scene_name);
    settings_init(&set);
    settings_preset(&set, preset);
    int n_sets = 0;
    while (n_sets < 4 && sets[n_sets]) n_sets++;
    int failed = scene_load(&s, path, &options, error, sizeof error);
    if (!failed) {
        settings_preset_scene(&s, preset);
        failed = settings_apply_all(&set, &s, sets, n_sets, error, sizeof error) ||
                 engine_fixed(&p, &s, &set, 320, 240, ENGINE_ALL, error, sizeof error);
        scene_free(&s);
    }
    if (failed) {
        printf("%s: %s\n", path, error);
        return -1;
    }
    low_byte_first(p.rgb565, 320 * 240);
    snprintf(line, bytes, "%s frame %d %s: RGB565 %08x RGB888 %08x", scene_name, frame, settings_preset_name[preset],
             crc32_of(p.rgb565, 2 * 320 * 240), crc32_of(p.rgb8, 3 * 320 * 240));
    for (int i = 0; i < n_sets; i++) snprintf(line + strlen(line), bytes - strlen(line), " %s", sets[i]);
    snprintf(line + strlen(line), bytes - strlen(line), "\n");
    engine_free(&p);
    return 0;
}

int main(int argc, char **argv)
{
    int writing = argc > 1 && strcmp(argv[1], "--write") == 0;
    FILE *golden = writing ? NULL : fopen(GOLDEN, "r");
    if (!writing && !CHECK(golden != NULL)) return check_report();
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        for (int preset = 0; preset < SETTINGS_PRESETS; preset++) {
            char line[240] = "", expected[240] = "";
            CHECK_EQ_INT(line_of(line, sizeof line, frames[i].scene, frames[i].frame, frames[i].sets, preset), 0);
            if (writing) {
                fputs(line, stdout);
                continue;
            }
            CHECK(fgets(expected, sizeof expected, golden) != NULL);
            if (!CHECK(strcmp(line, expected) == 0)) printf("  got %s  expected %s", line, expected);
        }
    }
    if (golden) fclose(golden);
    return writing ? 0 : check_report();
}
