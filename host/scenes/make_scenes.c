/* make_scenes FOLDER: writes the project's own scenes there. */
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
    if (argc != 2) {
        fprintf(stderr, "usage: make_scenes FOLDER\n");
        return 2;
    }
    int failed = make(argv[1], "sundial.gltf", sundial_write);
    failed |= make(argv[1], "avenue.gltf", avenue_write);
    failed |= make(argv[1], "desk.gltf", desk_write);
    failed |= make(argv[1], "room.gltf", room_write);
    failed |= make(argv[1], "fence.gltf", fence_write);
    failed |= make(argv[1], "mixed.gltf", mixed_write);
    return failed ? 1 : 0;
}
