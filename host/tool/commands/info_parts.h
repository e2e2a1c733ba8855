/* What a scene takes on parts that people own, for gnomon info. */
#ifndef GNOMON_INFO_PARTS_H
#define GNOMON_INFO_PARTS_H

#include "../compile/compile.h"
#include "../cost/part.h"

typedef struct {
    int n_cores; /* at work: all, unless their memory does not fit */
    double fps[COMPILE_WORKS];
    bool by_panel[COMPILE_WORKS]; /* the panel takes longer than the part */
    long ram, flash;              /* bytes */
    bool fits;
} info_part;

typedef struct {
    info_part part[PARTS];
    compile_work work[COMPILE_WORKS];
    bool counted;      /* compact arithmetic counts nothing: there are no frames per second */
    bool moves;        /* else there is no animated frame */
    char refused[160]; /* why the scene cannot be compiled; empty: it can */
} info_parts;

/* n_frames: of the whole animation. */
void info_parts_find(info_parts *out, const tool_options *o, int n_frames);
void info_parts_text(const info_parts *p);
void info_parts_json(const info_parts *p); /* ", "name": ...", or "no_parts": why */

#endif
