#include "nearest.h"

#include <stdio.h>
#include <string.h>

enum { LETTERS_MAX = 40 };

/* Levenshtein's distance, row by row: row[j] is that of the first i letters of a to the first j of b. */
static int distance(const char *a, const char *b)
{
    int row[LETTERS_MAX + 1];
    const int n_a = (int)strlen(a), n_b = (int)strlen(b);
    for (int j = 0; j <= n_b; j++) row[j] = j;
    for (int i = 1; i <= n_a; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= n_b; j++) {
            int least = diagonal + (a[i - 1] != b[j - 1]);
            if (row[j] + 1 < least) least = row[j] + 1;
            if (row[j - 1] + 1 < least) least = row[j - 1] + 1;
            diagonal = row[j];
            row[j] = least;
        }
    }
    return row[n_b];
}

nearest nearest_to(const char *wanted)
{
    /* a third of the letters may be wrong, and one more is too many */
    return (nearest){.wanted = wanted, .distance = (int)strlen(wanted) / 3 + 1};
}

void nearest_try(nearest *n, const char *name)
{
    if (strlen(n->wanted) > LETTERS_MAX || strlen(name) > LETTERS_MAX) return;
    const int d = distance(n->wanted, name);
    if (d >= n->distance) return;
    n->distance = d;
    n->name = name;
}

const char *nearest_question(const nearest *n, char *out, int out_bytes)
{
    out[0] = 0;
    if (n->name) snprintf(out, (size_t)out_bytes, ": is '%s' meant?", n->name);
    return out;
}
