/* What gnomon compile would make of a scene, for gnomon info. */
#ifndef GNOMON_INFO_MEMORY_H
#define GNOMON_INFO_MEMORY_H

#include "../compile/compile.h"

typedef struct {
    compile_memory memory[SETTINGS_PRESETS][FLASH_CORES]; /* on Arm's cores */
    char optimise[12];                                    /* how the library is built for these */
    char refused[SETTINGS_PRESETS][160];                  /* why a preset cannot be compiled; empty: it can */
    int frames;                                           /* of the whole animation */
    char verdict[1600]; /* whether the settings fit the board; empty: none was requested */
    bool fits;
} info_memory;

/* Plays the frames of --frames, else the one of --frame. 0, or -1 with one line in error. */
int info_memory_find(info_memory *out, const tool_options *o, char *error, size_t error_bytes);
void info_memory_text(const info_memory *m);
void info_memory_json(const info_memory *m); /* ", "name": ..." */

#endif
