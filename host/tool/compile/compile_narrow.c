/* Vertices in half the bytes: taken where no byte of any frame changes by it, else measured.
 *
 * Coordinates whose lower 15 bits are 0 are the same number in 16 bits at a scale 2^15 coarser, and the library's sums
 * with them are the same bits whatever the camera. Where they are not 0 they are rounded, and that is taken only if
 * every frame stays as it is. */
#include <stdlib.h>
#include <string.h>

#include "compile.h"

enum { DROPPED_BITS = 15, MEASURED_FRAMES = 5 };

/* What is narrowed, of all meshes, as it was. */
typedef struct {
    compile_narrowed what;
    int32_t **pos;
    int16_t **nrm;
    uint8_t *frac_bits;
    bool exact; /* nothing had to be rounded */
} vertices;

static void *own(const void *array)
{
    return (void *)(uintptr_t)array;
}

static void *copy_of(const void *array, size_t bytes)
{
    void *copy = malloc(bytes + 1);
    if (copy) memcpy(copy, array, bytes);
    return copy;
}

static void release(vertices *v, size_t n_meshes)
{
    for (size_t i = 0; v->pos && i < n_meshes; i++) free(v->pos[i]);
    for (size_t i = 0; v->nrm && i < n_meshes; i++) free(v->nrm[i]);
    free(v->pos);
    free(v->nrm);
    free(v->frac_bits);
}

static int keep(vertices *v, const fixed_scene *f)
{
    v->pos = calloc(f->n_meshes + 1, sizeof *v->pos);
    v->nrm = calloc(f->n_meshes + 1, sizeof *v->nrm);
    v->frac_bits = calloc(f->n_meshes + 1, sizeof *v->frac_bits);
    if (!v->pos || !v->nrm || !v->frac_bits) return -1;
    for (size_t i = 0; i < f->n_meshes; i++) {
        const gn_mesh *m = &f->meshes[i];
        v->frac_bits[i] = m->pos_frac_bits;
        if (!(v->pos[i] = copy_of(m->pos, 12u * m->n_vertices))) return -1;
        if (m->nrm_q15 && !(v->nrm[i] = copy_of(m->nrm_q15, 6u * m->n_vertices))) return -1;
    }
    return 0;
}

/* round(v / 2^15), within what 16 bits hold */
static int32_t narrow_position(int32_t v)
{
    int64_t n = ((int64_t)v + (1 << (DROPPED_BITS - 1))) >> DROPPED_BITS;
    return n > 32767 ? 32767 : n < -32767 ? -32767 : (int32_t)n;
}

static int16_t narrow_normal(int16_t v)
{
    return (int16_t)((v * 127 + (v < 0 ? -16383 : 16383)) / 32767);
}

/* Returns false where the coarser scale does not exist. */
static bool narrow_mesh(vertices *v, gn_mesh *m)
{
    int32_t *pos = own(m->pos);
    int16_t *nrm = own(m->nrm_q15);
    const size_t n = 3 * (size_t)m->n_vertices;
    if (v->what == COMPILE_NORMALS) {
        for (size_t i = 0; nrm && i < n; i++) nrm[i] = narrow_normal(nrm[i]);
        v->exact = false; /* another length, and mostly another direction */
        return true;
    }
    if (m->pos_frac_bits < DROPPED_BITS) return false;
    for (size_t i = 0; i < n; i++) {
        int32_t narrowed = narrow_position(pos[i]);
        v->exact = v->exact && (int64_t)narrowed * (1 << DROPPED_BITS) == pos[i];
        pos[i] = narrowed;
    }
    m->pos_frac_bits = (uint8_t)(m->pos_frac_bits - DROPPED_BITS);
    return true;
}

static void set_bits(compiled *c, compile_narrowed what, bool narrow)
{
    int *parts = &c->set.quality.short_vertices;
    *parts = narrow ? *parts | 1 << what : *parts & ~(1 << what);
}

static void give_back(vertices *v, compiled *c)
{
    for (size_t i = 0; i < c->fixed.n_meshes; i++) {
        gn_mesh *m = &c->fixed.meshes[i];
        m->pos_frac_bits = v->frac_bits[i];
        memcpy(own(m->pos), v->pos[i], 12u * m->n_vertices);
        if (m->nrm_q15) memcpy(own(m->nrm_q15), v->nrm[i], 6u * m->n_vertices);
    }
    set_bits(c, v->what, false);
}

static bool take(vertices *v, compiled *c)
{
    bool fits = true;
    v->exact = true;
    for (size_t i = 0; i < c->fixed.n_meshes; i++) fits = narrow_mesh(v, &c->fixed.meshes[i]) && fits;
    set_bits(c, v->what, true);
    return fits;
}

/* ---- What it would change ---------------------------------------------------------------------------------------- */

static void add_difference(compile_change *change, const uint8_t *a, const uint8_t *b, size_t bytes)
{
    change->n_pixels += bytes / 3;
    for (size_t i = 0; i < bytes; i += 3) {
        int max = 0;
        for (size_t k = i; k < i + 3; k++) max = abs(a[k] - b[k]) > max ? abs(a[k] - b[k]) : max;
        change->n_changed += max > 0;
        if (max > change->max_error) change->max_error = max;
    }
}

/* Some frames with and without. */
static int measure(vertices *v, compiled *c, compile_stage *st, compile_change *change)
{
    const size_t bytes = 3 * (size_t)c->options->width * (size_t)c->options->height;
    const int n = c->n_frames < MEASURED_FRAMES ? c->n_frames : MEASURED_FRAMES;
    uint8_t *both = malloc(2 * bytes);
    int failed = !both;
    *change = (compile_change){0};
    for (int i = 0; !failed && i < n; i++) {
        const int frame = n > 1 ? (c->n_frames - 1) * i / (n - 1) : 0;
        failed = compile_show(st, c, frame, both);
        bool fits = take(v, c);
        failed |= !fits || compile_show(st, c, frame, both + bytes);
        give_back(v, c);
        if (!failed) add_difference(change, both, both + bytes, bytes);
    }
    free(both);
    return failed ? -1 : 0;
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static bool was_requested(const compiled *c, const char *knob)
{
    const size_t n = strlen(knob);
    for (int i = 0; i < c->options->n_sets; i++)
        if (strncmp(c->options->sets[i], knob, n) == 0 && c->options->sets[i][n] == '=') return true;
    return false;
}

static bool wanted_narrow(const compiled *c, compile_narrowed what)
{
    bool any = what == COMPILE_POSITIONS;
    for (size_t i = 0; i < c->fixed.n_meshes; i++) any = any || c->fixed.meshes[i].nrm_q15;
    return any && !(c->set.quality.short_vertices >> what & 1) && !was_requested(c, "short_vertices");
}

int compile_narrow(compiled *c, compile_stage *st, compile_narrowed what, bool rounded, const compile_run *wanted,
                   compile_run *now)
{
    vertices v = {.what = what};
    int status = COMPILE_NARROW_NOT;
    if (!wanted_narrow(c, what) || c->options->asset) return status; /* of an asset, the types are the caller's */
    if (!keep(&v, &c->fixed)) {
        compile_run run = {.hash = now->hash};
        bool same = take(&v, c) && (rounded || v.exact) && !compile_run_all(&run, st, c, wanted) && run.differs < 0;
        if (same) {
            *now = run;
            status = v.exact ? COMPILE_NARROW_EXACT : COMPILE_NARROW_ROUNDED;
        } else {
            st->begun = false;
            give_back(&v, c);
            if (measure(&v, c, st, &c->narrow_change[what])) c->narrow_change[what] = (compile_change){0};
            st->begun = false;
        }
    }
    release(&v, c->fixed.n_meshes);
    return status;
}
