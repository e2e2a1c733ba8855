/* Lines, words and numbers of OBJ and MTL files. */
#include "obj.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool obj_fail(obj_text *t, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (!t->forgiving) return loader_fail(t->l, "%s:%zu: %s", t->path, t->line, what);
    snprintf(t->wrong, sizeof t->wrong, "%s", what);
    return false;
}

bool obj_remark(obj_text *t, const char *format, ...)
{
    char what[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return loader_remark(t->l, "line %zu: %s", t->line, what);
}

bool obj_spend(obj_text *t, budget_kind kind, size_t n)
{
    const char *over = budget_spend(t->l, kind, n);
    return !over || loader_fail(t->l, "%s:%zu: %s", t->path, t->line, over);
}

bool obj_open(obj_text *t, loader *l, const char *path, uint8_t *bytes, size_t n_bytes, bool forgiving)
{
    const size_t mark = n_bytes >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; /* of UTF-8 */
    *t = (obj_text){
        .l = l, .path = path, .next = (char *)bytes + mark, .end = (char *)bytes + n_bytes, .forgiving = forgiving};
    if (loader_is_utf16(bytes, n_bytes)) return t->line++, obj_fail(t, "the text is UTF-16: save it as UTF-8");
    if (!memchr(bytes, '\n', n_bytes)) /* of an old Macintosh */
        for (size_t i = 0; i < n_bytes; i++) bytes[i] = bytes[i] == '\r' ? '\n' : bytes[i];
    const char *zero = memchr(bytes, 0, n_bytes);
    if (!zero) return true;
    for (const char *c = t->next; c < zero; c++) t->line += *c == '\n';
    t->line++;
    return obj_fail(t, "not a text file: it holds a zero byte");
}

/* Terminates the physical line at t->next and steps behind it; true if a backslash (blanked out) joins the next one. */
static bool take_physical_line(obj_text *t)
{
    char *start = t->next, *stop = memchr(start, '\n', (size_t)(t->end - start));
    t->next = stop ? stop + 1 : t->end;
    if (!stop) stop = t->end;
    t->n_lines++;
    *stop = ' ';
    while (stop > start && strchr(" \t\r", stop[-1])) *--stop = ' ';
    bool joins = stop > start && stop[-1] == '\\';
    if (joins) stop[-1] = ' ';
    return joins && t->next < t->end;
}

bool obj_next_line(obj_text *t)
{
    while (t->next < t->end) {
        t->at = t->next;
        t->line = t->n_lines + 1;
        while (take_physical_line(t)) {}
        /* The terminator takes the place of the line feed, or of the zero behind the file. */
        if (t->next == t->end && t->end[0] == ' ') *t->end = '\0';
        else t->next[-1] = '\0';
        char *comment = strchr(t->at, '#');
        while (comment && comment > t->at && !strchr(" \t", comment[-1])) comment = strchr(comment + 1, '#');
        if (comment) *comment = '\0';
        t->at += strspn(t->at, " \t\v\f\r");
        if (*t->at) return true;
    }
    return false;
}

char *obj_next_word(obj_text *t)
{
    t->at += strspn(t->at, " \t\v\f\r");
    if (!*t->at) return NULL;
    char *word = t->at;
    t->at += strcspn(t->at, " \t\v\f\r");
    if (*t->at) *t->at++ = '\0';
    return word;
}

char *obj_rest(obj_text *t)
{
    char *rest = t->at + strspn(t->at, " \t\v\f\r");
    size_t n = strlen(rest);
    while (n > 0 && strchr(" \t\v\f\r", rest[n - 1])) rest[--n] = '\0';
    t->at = rest + n;
    return rest;
}

/* As any C library prints them. */
static bool is_not_finite(const char *word)
{
    char start[4] = "";
    strncpy(start, word + (*word == '-' || *word == '+'), 3);
    return loader_same_word(start, "nan") || loader_same_word(start, "inf") || strcmp(start, "1.#") == 0;
}

/* strtod alone would also take nan, inf and hexadecimal. */
static bool to_number(obj_text *t, const char *word, double *out)
{
    char *end;
    *out = strtod(word, &end);
    if (t->any_number && is_not_finite(word)) return *out = (double)NAN, true;
    if (*end || strspn(word, "+-.0123456789eE") != strlen(word)) return obj_fail(t, "'%.40s' is not a number", word);
    if (t->any_number && !(fabs(*out) <= LOADER_MAX_COORDINATE)) *out = (double)NAN;
    return t->any_number || fabs(*out) <= LOADER_MAX_COORDINATE || obj_fail(t, "%.40s is out of range", word);
}

bool obj_numbers(obj_text *t, double *out, size_t n_max, size_t *n)
{
    *n = 0;
    for (char *word = obj_next_word(t); word; word = obj_next_word(t)) {
        if (*n >= n_max) return obj_fail(t, "more than %zu numbers", n_max);
        if (!to_number(t, word, &out[*n])) return false;
        ++*n;
    }
    return true;
}
