/* Reading a board's linker script and settings, as far as memory goes. */
#include "board.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_BYTES = 16384 };
enum { OWN_FLASH_BYTES = 3000 };         /* start, console, the app play, libgcc */
enum { RISCV_OS = 121, RISCV_O2 = 168 }; /* per cent of a Cortex-M4 with -Os */

/* The file's text with a terminating zero; NULL: it does not open. */
static char *read_text(const char *folder, const char *file)
{
    char path[512];
    int n = snprintf(path, sizeof path, "%s/%s", folder, file);
    FILE *f = n > 0 && (size_t)n < sizeof path ? fopen(path, "rb") : NULL;
    char *text = f ? calloc(1, TEXT_BYTES) : NULL;
    if (text) text[fread(text, 1, TEXT_BYTES - 1, f)] = 0;
    if (f) fclose(f);
    return text;
}

/* "16K", "2M - 256"; what comes before a colon is another case. -1: no number. */
static long size_of(const char *at)
{
    char line[128];
    snprintf(line, sizeof line, "%.*s", (int)strcspn(at, ";}\n"), at);
    const char *colon = strchr(line, ':'), *p = colon ? colon + 1 : line;
    char *end;
    long bytes = strtol(p, &end, 0);
    if (end == p || bytes < 0 || bytes > 1 << 30) return -1;
    if (*end == 'K') bytes *= 1024, end++;
    else if (*end == 'M') bytes *= 1024 * 1024, end++;
    while (isspace((unsigned char)*end)) end++;
    if (*end != '-') return bytes;
    long less = strtol(end + 1, &end, 0);
    return bytes - (*end == 'K' ? 1024 * less : less);
}

static bool region_of(const char *script, const char *alias, char region[64])
{
    char pattern[64];
    snprintf(pattern, sizeof pattern, "REGION_ALIAS(\"%s\"", alias);
    const char *at = strstr(script, pattern);
    return at && sscanf(at + strlen(pattern), ", %60[a-z0-9_A-Z]", region) == 1;
}

/* The region that an alias stands for. */
static long length_of(const char *script, const char *alias)
{
    char region[64];
    if (!region_of(script, alias, region)) return -1;
    strcat(region, " (");
    const char *at = strstr(script, region);
    at = at ? strstr(at, "LENGTH =") : NULL;
    return at ? size_of(at + 8) : -1;
}

static bool same_region(const char *script, const char *a, const char *b)
{
    char region[64], other[64];
    return region_of(script, a, region) && region_of(script, b, other) && strcmp(region, other) == 0;
}

/* -O2 unrolls and inlines: measured with the presets on scenes of host/scenes. */
void board_set_optimisation(board *b, const char *flag)
{
    static const int percent_o2[FLASH_CORES] = {144, 132};
    const bool small = strcmp(flag, "-Os") == 0;
    if (b->riscv) b->code_percent = small ? RISCV_OS : RISCV_O2;
    else b->code_percent = small ? 100 : percent_o2[b->core];
}

int board_code_percent(const board *b, bool compact)
{
    static const int compact_o2[FLASH_CORES] = {127, 128}; /* it has fewer loops to unroll */
    if (!b->code_percent) return 100;
    return compact && !b->riscv && b->code_percent > 100 ? compact_o2[b->core] : b->code_percent;
}

static void read_core(board *out, const char *settings_text)
{
    const char *cpu = settings_text ? strstr(settings_text, "BOARD_CPU") : NULL;
    bool arm = !cpu || strstr(cpu, "-mcpu=cortex") != NULL;
    out->short_enums = arm;
    out->core = cpu && strstr(cpu, "cortex-m0") ? FLASH_CORTEX_M0 : FLASH_CORTEX_M4;
    out->riscv = !arm;
    out->own_flash = OWN_FLASH_BYTES;
    board_set_optimisation(out, settings_text && strstr(settings_text, "BOARD_OPT := -Os") ? "-Os" : "-O2");
}

int board_read(board *out, const char *name, char *error, size_t error_bytes)
{
    char folder[256];
    snprintf(folder, sizeof folder, "%s%s", strchr(name, '/') ? "" : "boards/", name);
    char *script = read_text(folder, "link.ld"), *settings_text = read_text(folder, "board.mk");
    *out = (board){.stack = 0};
    snprintf(out->name, sizeof out->name, "%s", name);
    if (script) {
        const char *stack = strstr(script, "STACK_BYTES =");
        out->ram = length_of(script, "RAM");
        out->flash = length_of(script, "FLASH");
        out->stack = stack ? size_of(stack + 13) : 0;
        const char *own = strstr(script, "BOARD_BYTES =");
        out->own_ram = own ? size_of(own + 13) : 0;
        out->fast_in_ram = same_region(script, "FAST", "RAM");
        out->hot_in_ram = same_region(script, "HOT", "RAM");
        read_core(out, settings_text);
    }
    bool ok = script && out->ram > 0 && out->flash > 0 && out->stack >= 0;
    if (!script)
        snprintf(error, error_bytes, "--board %s: there is no %s/link.ld; --ram and --flash say the same of any board",
                 name, folder);
    else if (!ok)
        snprintf(
            error, error_bytes,
            "--board %s: %s/link.ld: wanted are REGION_ALIAS(\"RAM\", name) and (\"FLASH\", name), each of a region "
            "\"name (rwx) : ORIGIN = 0x20000000, LENGTH = 64K\", as boards/mps2-an386/link.ld has them",
            name, folder);
    free(script);
    free(settings_text);
    return ok ? 0 : -1;
}
