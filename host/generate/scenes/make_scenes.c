/* make_scenes FOLDER GALLERY_FOLDER BENCH_FOLDER: writes the project's own scenes, the small ones of the gallery, and
 * those of the bench. */
#include <stdio.h>

#include "scenes.h"

static int make(const char *folder, const char *name, int (*write)(FILE *))
{
    char path[1000];
    int n = snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = n > 0 && (size_t)n < sizeof path ? fopen(path, "wb") : NULL;
    int failed = !file || write(file);
    if (file && fclose(file)) failed = 1;
    if (failed) fprintf(stderr, "make_scenes: %s/%s could not be written\n", folder, name);
    return failed;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: make_scenes FOLDER GALLERY_FOLDER BENCH_FOLDER\n");
        return 2;
    }
    int failed = make(argv[1], "sundial.gltf", sundial_write);
    failed |= make(argv[1], "cube.gltf", cube_write);
    failed |= make(argv[1], "avenue.gltf", avenue_write);
    failed |= make(argv[1], "desk.gltf", desk_write);
    failed |= make(argv[1], "room.gltf", room_write);
    failed |= make(argv[1], "fence.gltf", fence_write);
    failed |= make(argv[1], "mixed.gltf", mixed_write);
    failed |= make(argv[2], "edge.gltf", gallery_edge_write);
    failed |= make(argv[2], "slopes.gltf", gallery_slopes_write);
    failed |= make(argv[2], "cones.gltf", gallery_cones_write);
    failed |= make(argv[2], "lamps.gltf", gallery_lamps_write);
    failed |= make(argv[2], "materials.gltf", gallery_materials_write);
    failed |= make(argv[2], "near.gltf", gallery_near_write);
    failed |= make(argv[2], "baked.gltf", gallery_baked_write);
    failed |= make(argv[2], "suns.gltf", gallery_suns_write);
    failed |= make(argv[2], "sheets.gltf", gallery_sheets_write);
    failed |= make(argv[2], "glass.gltf", gallery_glass_write);
    failed |= make(argv[2], "glow.gltf", gallery_glow_write);
    failed |= make(argv[2], "isometric.gltf", gallery_isometric_write);
    failed |= make(argv[2], "snake.gltf", gallery_snake_write);
    failed |= make(argv[3], "hound.gltf", hound_write);
    failed |= make(argv[3], "walker.gltf", walker_write);
    failed |= make(argv[3], "crowd.gltf", crowd_write);
    failed |= make(argv[3], "gauge.gltf", gauge_write);
    failed |= make(argv[3], "game.gltf", game_write);
    return failed ? 1 : 0;
}
