/* Values of settings: numbers and words, read and said. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "settings_parse.h"

int settings_fail(char *error, size_t error_bytes, const char *key, const char *value, const char *expected)
{
    snprintf(error, error_bytes, "setting '%s': '%s' is not %s", key, value, expected);
    return -1;
}

/* strtod alone would also take leading blanks, hexadecimal, inf and nan. */
int settings_number(const char *text, double *out, const char **end)
{
    char *stop;
    *out = strtod(text, &stop);
    if (end) *end = stop;
    if (stop == text || (!end && *stop) || !isfinite(*out)) return -1;
    return strspn(text, "+-.0123456789eE") >= (size_t)(stop - text) ? 0 : -1;
}

int settings_numbers(const char *text, double *out, int max, double lo, double hi)
{
    const char *end = text;
    int n = 0;
    for (;;) {
        if (n == max || settings_number(end, &out[n], &end) || out[n] < lo || out[n] > hi) return 0;
        n++;
        if (*end != ',') return *end ? 0 : n;
        end++;
    }
}

int settings_whole(const char *text, int lo, int hi, int *out)
{
    double v;
    if (settings_number(text, &v, NULL) || floor(v) != v || v < lo || v > hi) return -1;
    *out = (int)v;
    return 0;
}

int settings_word(const char *word, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(word, words[i]) == 0) return i;
    return -1;
}

void settings_join(char *out, size_t bytes, const char *const *words, const char *joint)
{
    size_t used = 0;
    for (int i = 0; words[i] && used < bytes; i++) {
        const char *before = i == 0 ? "" : words[i + 1] ? ", " : joint;
        used += (size_t)snprintf(out + used, bytes - used, "%s%s", before, words[i]);
    }
}
