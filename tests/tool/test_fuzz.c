/* Scene and picture files that are damaged: loaded or refused in one line, and nothing read or written beyond its end,
 * which the sanitizers see. The files of tests/data/corpus are where the damage begins.
 *
 * SCENES=n: damaged files of each kind; KINDS="png glb": of these alone; SEED=n: others; FIRST=n leaves out those
 * before. A file is its kind, seed and number. Run from the project's folder. With LIBFUZZER, by coverage: see
 * tests/soak.sh. */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../host/scene/image/jpeg.h"
#include "../host/scene/image/png.h"
#include "../host/scene/image/zlib_stream.h"
#include "campaign.h"
#include "check.h"
#include "damage.h"
#include "data/jpeg_fixture.h"
#include "data/scene_fixture.h"

#define FOLDER "build/tmp/fuzz"
enum { MAX_FILE = 4096, MAX_FILES = 24, MAX_DAMAGES = 4, MAX_SIDE = 512 };

typedef struct {
    const char *name; /* of the folder; the ending of its files but for JPEG */
    const char *ending;
    int is_text;
    size_t n_files, n_bytes[MAX_FILES];
    uint8_t bytes[MAX_FILES][MAX_FILE];
    long n_read;
} kind;

enum { GLTF, GLB, OBJ, MTL, PNG, JPEG, N_KINDS };
static kind kinds[N_KINDS] = {{.name = "gltf", .ending = ".gltf", .is_text = 1},
                              {.name = "glb", .ending = ".glb"},
                              {.name = "obj", .ending = ".obj", .is_text = 1},
                              {.name = "mtl", .ending = ".mtl", .is_text = 1},
                              {.name = "png", .ending = ".png"},
                              {.name = "jpeg", .ending = ".jpg"}};

/* ---- The corpus -------------------------------------------------------------------------------------------------- */

static void keep(kind *k, const uint8_t *bytes, size_t n)
{
    if (!CHECK(k->n_files < MAX_FILES && n <= MAX_FILE)) exit(check_report());
    memcpy(k->bytes[k->n_files], bytes, n);
    k->n_bytes[k->n_files++] = n;
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

static void read_folder(kind *k)
{
    static uint8_t bytes[MAX_FILE + 1];
    char path[400];
    struct dirent **found;
    snprintf(path, sizeof path, "tests/data/corpus/%s", k->name);
    int n = scandir(path, &found, NULL, by_name);
    if (!CHECK(n > 0)) exit(check_report());
    for (int i = 0; i < n; i++) {
        const char *ending = strrchr(found[i]->d_name, '.');
        snprintf(path, sizeof path, "tests/data/corpus/%s/%s", k->name, found[i]->d_name);
        FILE *file = ending && !strcmp(ending, k->ending) ? fopen(path, "rb") : NULL;
        if (file) {
            keep(k, bytes, fread(bytes, 1, sizeof bytes, file));
            fclose(file);
        }
        free(found[i]);
    }
    free(found);
    CHECK(k->n_files > 1);
}

static void make_jpegs(kind *k)
{
    static const flat_picture flat[] = {
        {.n = 3, .w = 50, .height = 30, .h = {4, 3, 1}, .v = {2, 1, 3}, .restart = 1, .adobe = 0},
        {.n = 3, .w = 50, .height = 30, .h = {1, 3, 2}, .v = {4, 1, 3}, .alone = true, .adobe = -1},
        {.n = 4, .w = 33, .height = 9, .h = {1, 1, 2, 4}, .v = {1, 2, 2, 1}, .adobe = 2},
        {.n = 1, .w = 100, .height = 3, .h = {3}, .v = {2}, .restart = 5, .adobe = -1},
    };
    for (size_t i = 0; i < sizeof flat / sizeof *flat; i++) {
        make_flat(&flat[i]);
        keep(k, jpeg, n_jpeg);
    }
}

/* ---- Damage of a format, and what mends its frame so that the damage gets through to what lies behind ---------------
 */

static uint32_t word_be(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static void mend_png(uint8_t *bytes, size_t n_bytes)
{
    for (size_t at = 8; at + 12 <= n_bytes;) {
        size_t n = word_be(bytes + at);
        if (n > n_bytes - at - 12) return;
        uint32_t crc = zlib_crc32(0, bytes + at + 4, n + 4);
        for (int i = 0; i < 4; i++) bytes[at + 8 + n + (size_t)i] = (uint8_t)(crc >> (24 - 8 * i));
        at += n + 12;
    }
}

static void put_word_le(uint8_t *at, size_t v)
{
    for (int i = 0; i < 4; i++) at[i] = (uint8_t)(v >> (8 * i));
}

/* Of a .glb the text of its first chunk, behind which blanks keep the alignment. */
static size_t damage_glb_text(rng *r, uint8_t *bytes, size_t n, const uint8_t *other, size_t n_other)
{
    static uint8_t text[MAX_FILE + MAX_DAMAGES * DAMAGE_ADDS + 4];
    size_t length = n < 20 ? 0 : (size_t)bytes[13] << 8 | bytes[12], behind = 20 + length;
    if (length == 0 || behind > n || n_other < 40) return damage_bytes(r, bytes, n, other, n_other);
    memcpy(text, bytes + 20, length);
    size_t changed = damage_text(r, text, length, other + 20, n_other - 20);
    while (changed % 4) text[changed++] = ' ';
    memmove(bytes + 20 + changed, bytes + behind, n - behind);
    memcpy(bytes + 20, text, changed);
    put_word_le(bytes + 12, changed);
    put_word_le(bytes + 8, n - length + changed);
    return n - length + changed;
}

/* A segment becomes another one. */
static void damage_marker(rng *r, uint8_t *bytes, size_t n)
{
    static const uint8_t markers[] = {0xC0, 0xC1, 0xC2, 0xC4, 0xDA, 0xDB, 0xDD, 0xE0, 0xEE, 0xD0, 0xD9, 0xDC};
    for (size_t i = rng_below(r, (uint32_t)n); i + 1 < n; i++) {
        if (bytes[i] != 0xFF || bytes[i + 1] < 0xC0) continue;
        bytes[i + 1] = markers[rng_below(r, sizeof markers)];
        return;
    }
}

static size_t damage(const kind *k, rng *r, uint8_t *bytes, size_t n)
{
    size_t i = rng_below(r, (uint32_t)k->n_files), n_other = k->n_bytes[i];
    const uint8_t *other = k->bytes[i];
    if (n < 2) return n;
    if (k->is_text) return damage_text(r, bytes, n, other, n_other);
    if (k == &kinds[GLB] && rng_below(r, 4)) return damage_glb_text(r, bytes, n, other, n_other);
    if (k == &kinds[JPEG] && rng_below(r, 8) == 0) damage_marker(r, bytes, n);
    return damage_bytes(r, bytes, n, other, n_other);
}

/* ---- Reading ------------------------------------------------------------------------------------------------------
 */

/* From memory of just that size, so that the sanitizer sees what is read behind it. */
static void decode(kind *k, const uint8_t *bytes, size_t n)
{
    rgba8_picture p;
    const bool is_png = k == &kinds[PNG];
    uint8_t *exact = malloc(n ? n : 1);
    if (!CHECK(exact != NULL)) exit(check_report());
    memcpy(exact, bytes, n);
    size_t n_work = 0;
    int w = 0, h = 0;
    error[0] = '\0';
    bool measured = is_png ? png_measure(exact, n, &w, &h, &n_work) : jpeg_measure(exact, n, &w, &h, &n_work);
    bool ok = (is_png ? png_decode_rgba8 : jpeg_decode_rgba8)(exact, n, MAX_SIDE, &p, error, sizeof error);
    if (ok) {
        for (int i = 0; i < p.w * p.h; i++) last_texels += p.rgba[4 * i];
        k->n_read++;
        CHECK(p.w >= 1 && p.h >= 1 && p.w <= MAX_SIDE && p.h <= MAX_SIDE && measured && w == p.w && h == p.h);
        CHECK(is_png || p.rgba[3] == 255);
    } else CHECK(!p.rgba && error[0] && !strchr(error, '\n'));
    free(p.rgba);
    free(exact);
}

/* Beside the scene lie a material file and a picture that are whole, for those that name them. */
static void load_scene(kind *k, const uint8_t *bytes, size_t n, long number)
{
    char path[100];
    snprintf(path, sizeof path, FOLDER "/scene%s", k->ending);
    write_file(path, bytes, n);
    const scene_options options = {.frame = (int)(number % 9),
                                   .width = 64,
                                   .height = 48,
                                   .ground = (scene_ground)(number % 3),
                                   .smooth = number % 2 == 0,
                                   .rig = number % 5 == 0};
    if (load(k == &kinds[MTL] ? FOLDER "/scene.obj" : path, &options) == 0) {
        check_invariants();
        k->n_read++;
        scene_free(&s);
    } else CHECK(is_empty() && error[0] && !strchr(error, '\n'));
}

static void read_damaged(kind *k, const uint8_t *bytes, size_t n, long number)
{
    if (k == &kinds[PNG] || k == &kinds[JPEG]) decode(k, bytes, n);
    else load_scene(k, bytes, n, number);
}

static void put_beside(const kind *k)
{
    const kind *obj = &kinds[OBJ], *mtl = &kinds[MTL], *png = &kinds[PNG];
    write_file(FOLDER "/picture.png", png->bytes[0], png->n_bytes[0]);
    write_file(FOLDER "/scene.mtl", mtl->bytes[mtl->n_files - 1], mtl->n_bytes[mtl->n_files - 1]);
    if (k == mtl) write_file(FOLDER "/scene.obj", obj->bytes[obj->n_files - 1], obj->n_bytes[obj->n_files - 1]);
}

static void read_corpus(void)
{
    mkdir("build", 0777);
    mkdir("build/tmp", 0777);
    mkdir(FOLDER, 0777);
    for (kind *k = kinds; k < kinds + N_KINDS; k++) read_folder(k);
    make_jpegs(&kinds[JPEG]);
}

#ifndef LIBFUZZER

/* ---- The campaign -------------------------------------------------------------------------------------------------
 */

static void try_damaged(kind *k, long seed, long number)
{
    static uint8_t bytes[MAX_FILE + MAX_DAMAGES * (DAMAGE_ADDS + 4)];
    rng r = {((uint64_t)seed << 40) + ((uint64_t)(k - kinds) << 56) + (uint64_t)number};
    size_t i = rng_below(&r, (uint32_t)k->n_files), n = k->n_bytes[i];
    memcpy(bytes, k->bytes[i], n);
    for (uint32_t left = rng_below(&r, 2) ? 1 : 1 + rng_below(&r, MAX_DAMAGES); left > 0; left--)
        n = damage(k, &r, bytes, n);
    if (k == &kinds[PNG] && rng_below(&r, 8)) mend_png(bytes, n);
    read_damaged(k, bytes, n, number);
}

/* What is whole is read, but for the JPEG file of arithmetic coding; and so is every beginning of it, or refused. */
static void try_whole(kind *k)
{
    for (size_t i = 0; i < k->n_files; i++) read_damaged(k, k->bytes[i], k->n_bytes[i], 0);
    CHECK_EQ_INT(k->n_read, k->n_files - (k == &kinds[JPEG]));
    for (size_t i = 0; i < k->n_files; i++)
        for (size_t n = 0; n < k->n_bytes[i]; n += 1 + k->n_bytes[i] / 400) read_damaged(k, k->bytes[i], n, 0);
}

static void try_kind(kind *k, long seed, long n)
{
    put_beside(k);
    try_whole(k);
    for (long i = option("FIRST", 0); i < n; i++) {
        try_damaged(k, seed, i);
        show_progress(k->name, seed, i + 1, n);
    }
    printf("seed %ld: %ld damaged %s files, %ld of them read\n", seed, n, k->name, k->n_read);
    CHECK(k->n_read > n / 100); /* damage that gets through */
}

int main(void)
{
    const char *asked = getenv("KINDS");
    const long seed = option("SEED", 1), n = option("SCENES", 0);
    read_corpus();
    for (kind *k = kinds; k < kinds + N_KINDS; k++)
        if (!asked || strstr(asked, k->name)) try_kind(k, seed, n ? n : k < &kinds[PNG] ? 6000 : 40000);
    return check_report();
}

#else

/* ---- By coverage -------------------------------------------------------------------------------------------------
 * A file is a byte for its kind, one for the options of loading, and its bytes. */

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t n, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *bytes, size_t n, size_t most);

/* The whole files are where it begins: in a folder that is among the program's arguments. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    read_corpus();
    mkdir(FOLDER "/seeds", 0777);
    for (int k = 0; k < N_KINDS; k++)
        for (size_t i = 0; i < kinds[k].n_files; i++) {
            char path[100];
            uint8_t bytes[MAX_FILE + 2] = {(uint8_t)k, 0};
            memcpy(bytes + 2, kinds[k].bytes[i], kinds[k].n_bytes[i]);
            snprintf(path, sizeof path, FOLDER "/seeds/%s-%zu", kinds[k].name, i);
            write_file(path, bytes, kinds[k].n_bytes[i] + 2);
        }
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    if (n < 2) return 0;
    kind *k = &kinds[bytes[0] % N_KINDS];
    static const kind *beside;
    if (beside != k) put_beside(k); /* files: only when they are others */
    beside = k;
    read_damaged(k, bytes + 2, n - 2, bytes[1]);
    if (check_n_failed) abort();
    return 0;
}

/* Damage that knows the format, as above, or any. */
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t n, size_t most, unsigned seed)
{
    static uint8_t file[MAX_FILE + DAMAGE_ADDS + 4];
    rng r = {seed};
    const kind *k = n ? &kinds[bytes[0] % N_KINDS] : NULL;
    if (n < 4 || n > MAX_FILE || rng_below(&r, 3) == 0) return LLVMFuzzerMutate(bytes, n, most);
    memcpy(file, bytes + 2, n - 2);
    size_t changed = damage(k, &r, file, n - 2);
    if (k == &kinds[PNG] && rng_below(&r, 8)) mend_png(file, changed);
    if (changed > most - 2) changed = most - 2;
    memcpy(bytes + 2, file, changed);
    return changed + 2;
}

#endif
