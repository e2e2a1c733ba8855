/* Of known names the one that a misspelt one may mean. */
#ifndef GNOMON_NEAREST_H
#define GNOMON_NEAREST_H

typedef struct {
    const char *wanted;
    const char *name; /* the nearest so far; NULL: none is near */
    int distance;     /* letters to insert, remove or replace */
} nearest;

nearest nearest_to(const char *wanted);

/* Looks at one more name. */
void nearest_try(nearest *n, const char *name);

/* ": is NAME meant?" for a message, or nothing. */
const char *nearest_question(const nearest *n, char *out, int out_bytes);

#endif
