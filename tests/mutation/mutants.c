/* Single-point mutants of C source as clang-format lays it out. usage: mutants SEED N FILE...: N of all, chosen by the
 * seed, a line each: FILE LINE COLUMN LENGTH REPLACEMENT (columns from 1). mutants all FILE...: every one. */
#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MUTANTS_MAX = 200000, TEXT_MAX = 160 };

typedef struct {
    const char *file;
    int line, column, length;
    char text[TEXT_MAX];
} mutant;

static mutant all[MUTANTS_MAX];
static size_t n_all;

static const char *current_file;
static int current_line;

static void add(int column, int length, const char *text)
{
    if (n_all == MUTANTS_MAX) exit(2);
    mutant *m = &all[n_all++];
    m->file = current_file, m->line = current_line, m->column = column + 1, m->length = length;
    snprintf(m->text, sizeof m->text, "%s", text);
}

/* Binary operators stand between blanks; unary ones do not. */
static const struct {
    const char *old, *now[2];
} operators[] = {{" < ", {" <= ", " >= "}},      {" <= ", {" < ", " > "}},   {" > ", {" >= ", " <= "}},
                 {" >= ", {" > ", " < "}},       {" == ", {" != ", NULL}},   {" != ", {" == ", NULL}},
                 {" + ", {" - ", NULL}},         {" - ", {" + ", NULL}},     {" * ", {" + ", NULL}},
                 {" / ", {" * ", NULL}},         {" % ", {" / ", NULL}},     {" << ", {" >> ", " << 1 + "}},
                 {" >> ", {" << ", " >> 1 + "}}, {" & ", {" | ", NULL}},     {" | ", {" & ", " ^ "}},
                 {" ^ ", {" | ", NULL}},         {" && ", {" || ", NULL}},   {" || ", {" && ", NULL}},
                 {" += ", {" -= ", " = "}},      {" -= ", {" += ", " = "}},  {" |= ", {" &= ", NULL}},
                 {" &= ", {" |= ", NULL}},       {" <<= ", {" >>= ", NULL}}, {" >>= ", {" <<= ", NULL}}};

static void operators_at(const char *line, int i)
{
    for (size_t k = 0; k < sizeof operators / sizeof *operators; k++) {
        const size_t n = strlen(operators[k].old);
        if (strncmp(line + i, operators[k].old, n) != 0) continue;
        for (int j = 0; j < 2; j++)
            if (operators[k].now[j]) add(i, (int)n, operators[k].now[j]);
    }
}

/* A number becomes one more and one less. */
static int constant_at(const char *line, int i)
{
    char *end, text[40];
    const unsigned long long v = strtoull(line + i, &end, 0);
    int n = (int)(end - (line + i));
    const int hex = n > 2 && (line[i + 1] == 'x' || line[i + 1] == 'X');
    const char *format = hex ? "0x%llX" : "%llu";
    snprintf(text, sizeof text, format, v + 1);
    add(i, n, text);
    if (v) {
        snprintf(text, sizeof text, format, v - 1);
        add(i, n, text);
    }
    while (isalnum((unsigned char)line[i + n])) n++; /* its suffix */
    return n;
}

/* The bracket that closes the one at `open`; -1: not on this line. */
static int closing(const char *line, int open)
{
    int depth = 0;
    for (int i = open; line[i]; i++) {
        if (line[i] == '(') depth++;
        if (line[i] == ')' && --depth == 0) return i;
    }
    return -1;
}

/* "if (x)" becomes "if (!(x))". */
static void condition_at(const char *line, int i)
{
    const int end = strncmp(line + i, "if (", 4) == 0 ? closing(line, i + 3) : -1;
    char text[TEXT_MAX];
    if (end < 0 || end - i + 4 >= TEXT_MAX) return;
    snprintf(text, sizeof text, "if (!%.*s)", end - i - 2, line + i + 3);
    add(i, end - i + 1, text);
}

/* Its other bound instead of a bound; what is clamped, or saturated, without bounds. */
static void bound_at(const char *line, int i)
{
    static const char *const min_max[] = {"gn_min32(", "gn_max32(", "gn_max32(", "gn_min32("};
    static const char *const limited[] = {"gn_clamp64(", "gn_sat32("};
    for (int k = 0; k < 4; k += 2)
        if (strncmp(line + i, min_max[k], 9) == 0) add(i, 9, min_max[k + 1]);
    for (int k = 0; k < 2; k++) {
        const int n = (int)strlen(limited[k]), end = closing(line, i + n - 1);
        char text[TEXT_MAX];
        if (strncmp(line + i, limited[k], (size_t)n) != 0 || end < 0) continue;
        int depth = 0, last = i + n; /* the first argument */
        while (last < end && (depth || line[last] != ',')) depth += (line[last] == '(') - (line[last] == ')'), last++;
        if (last - i + 2 >= TEXT_MAX) continue;
        snprintf(text, sizeof text, "(%.*s)", last - i - n, line + i + n);
        add(i, end - i + 1, text);
    }
}

/* An assignment or a call by itself goes. */
static void statement(const char *line)
{
    int i = 0, n = (int)strlen(line), k;
    while (line[i] == ' ') i++;
    if (n - i < 3 || line[n - 1] != ';') return;
    for (k = i; isalnum((unsigned char)line[k]) || strchr("_->.[]", line[k]); k++)
        if (!line[k]) return;
    const int call = line[k] == '(' && closing(line, k) == n - 2;
    const int assignment = line[k] == ' ' && (strchr("=+-|&", line[k + 1]) != NULL || line[k + 1] == '<') &&
                           strchr(line + k, '=') != NULL && strncmp(line + i, "return", 6) != 0;
    if (k > i && (call || assignment)) add(i, n - i, ";");
}

/* Comments and strings become blanks. */
static void blank(char *line, int *comment)
{
    int string = 0;
    for (char *c = line; *c; c++) {
        if (*comment) {
            if (c[0] == '*' && c[1] == '/') *comment = 0, c[1] = ' ';
            *c = ' ';
        } else if (string) {
            if (*c == '\\') c[1] = 'x';
            if (*c == '"') string = 0;
            *c = ' ';
        } else if (c[0] == '/' && c[1] == '*') {
            *comment = 1, c[0] = c[1] = ' ';
        } else if (*c == '"') {
            string = 1, *c = ' ';
        }
    }
    for (size_t n = strlen(line); n && line[n - 1] == ' '; n--) line[n - 1] = 0;
}

static void mutate_line(const char *line)
{
    statement(line);
    for (int i = 0; line[i]; i++) {
        const int word = i && (isalnum((unsigned char)line[i - 1]) || line[i - 1] == '_');
        operators_at(line, i);
        if (!word) condition_at(line, i), bound_at(line, i);
        if (!word && isdigit((unsigned char)line[i])) i += constant_at(line, i) - 1;
        else if (strncmp(line + i, "++", 2) == 0) add(i, 2, "--");
    }
}

static void mutate_file(const char *path)
{
    char line[400];
    int comment = 0, directive = 0;
    FILE *f = fopen(path, "r");
    if (!f) exit(2);
    current_file = path;
    for (current_line = 1; fgets(line, sizeof line, f); current_line++) {
        line[strcspn(line, "\n")] = 0;
        const size_t n = strlen(line);
        const int begins = line[strspn(line, " ")] == '#', goes_on = n && line[n - 1] == '\\';
        const int skip = directive || begins || strstr(line, "STATIC_ASSERT");
        directive = (directive || begins) && goes_on;
        blank(line, &comment);
        if (!skip) mutate_line(line);
    }
    fclose(f);
}

static uint64_t state;

static uint32_t next(void)
{
    state = state * 6364136223846793005U + 1442695040888963407U;
    return (uint32_t)(state >> 32);
}

int main(int argc, char **argv)
{
    const int every = argc > 2 && strcmp(argv[1], "all") == 0;
    if (argc < (every ? 3 : 4)) return 2;
    for (int i = every ? 2 : 3; i < argc; i++) mutate_file(argv[i]);
    size_t n = every ? n_all : strtoul(argv[2], NULL, 0);
    state = strtoull(argv[1], NULL, 0) * 0x9E3779B97F4A7C15U + 1;
    for (size_t i = 0; i < n && i < n_all; i++) {
        if (!every) { /* without repetition: the first n of a shuffle */
            const size_t k = i + (size_t)((uint64_t)next() * (n_all - i) >> 32);
            const mutant m = all[i];
            all[i] = all[k], all[k] = m;
        }
        printf("%s %d %d %d %s\n", all[i].file, all[i].line, all[i].column, all[i].length, all[i].text);
    }
    return 0;
}
