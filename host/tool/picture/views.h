/* Pictures for people: one view of an engine's picture as 8-bit RGB. */
#ifndef GNOMON_VIEWS_H
#define GNOMON_VIEWS_H

#include "../engine/engine.h"

typedef enum { VIEW_COLOUR, VIEW_SHADOW, VIEW_DEPTH, VIEW_NORMAL, VIEW_ATLAS, VIEW_CASCADE } view_kind;

/* -1 if there is no such view. */
int view_from_name(const char *name);

/* A new RGB picture of *w x *h, or NULL with one line in error. */
uint8_t *view_draw(const engine_picture *p, view_kind view, size_t light, int *w, int *h, char *error,
                   size_t error_bytes);

/* |a - b| per channel of two RGB pictures, eight times as strong. */
uint8_t *view_error(const uint8_t *a, const uint8_t *b, int w, int h);

/* n RGB pictures of one size in one: side by side with grey gaps, or one below the other if they are more than twice as
 * wide as high. NULL: out of memory. */
enum { VIEW_GAP = 4 };
uint8_t *view_beside(const uint8_t *const *pictures, int n, int w, int h, int *out_w, int *out_h);

#endif
