/* Trying candidates on frames, and reporting what was saved. */
#include <stdlib.h>
#include <string.h>

#include "compile_trial.h"

/* ---- Trying ------------------------------------------------------------------------------------------------------ */

/* A frame that the library refuses is another picture. */
static bool same_frame(trial *b, int i)
{
    compile_hash hash = {0, 0};
    if (compile_draw(b->st, b->c, i, &b->wanted.hash[i], &hash)) {
        b->st->begun = false;
        return false;
    }
    return compile_same(&hash, &b->wanted.hash[i]);
}

bool trial_same_samples(trial *b)
{
    for (int i = b->n_samples; i-- > 0;) /* those that differed before come last */
        if (!same_frame(b, b->sample[i])) return false;
    return true;
}

void trial_add_sample(trial *b, int frame)
{
    for (int i = 0; i < b->n_samples; i++)
        if (b->sample[i] == frame) return;
    if (b->n_samples < SAMPLES_MAX) b->sample[b->n_samples++] = frame;
}

/* One candidate whose return makes the frame right again; if there is none, from the last on as many as it takes. */
static void satisfy(trial *b, int frame)
{
    for (size_t i = b->n; i-- > 0;) {
        if (!b->list[i].taken) continue;
        candidate_give_back(b, &b->list[i]);
        if (same_frame(b, frame)) return;
        candidate_take(b, &b->list[i]);
    }
    for (size_t i = b->n; i-- > 0;) {
        if (!b->list[i].taken) continue;
        candidate_give_back(b, &b->list[i]);
        if (same_frame(b, frame)) return;
    }
}

/* Of those taken, the ones that stay change no frame. Returns how many. */
size_t trial_try_taken(trial *b)
{
    size_t n_taken = 0;
    for (size_t i = 0; i < b->n; i++) n_taken += b->list[i].taken;
    while (n_taken) {
        compile_run run = {.hash = b->now.hash};
        int refused = compile_run_all(&run, b->st, b->c, &b->wanted);
        if (!refused && run.differs < 0) {
            b->now = run;
            break;
        }
        if (refused) {
            b->st->begun = false;
            for (size_t i = b->n; i-- > 0;)
                if (b->list[i].taken) candidate_give_back(b, &b->list[i]);
        } else {
            trial_add_sample(b, run.differs);
            satisfy(b, run.differs);
        }
        n_taken = 0;
        for (size_t i = 0; i < b->n; i++) n_taken += b->list[i].taken;
    }
    return n_taken;
}

size_t trial_try_all(trial *b)
{
    b->st->progress.n_all = b->n;
    for (size_t i = 0; i < b->n; i++) {
        b->st->progress.n_done = i;
        candidate_take(b, &b->list[i]);
        if (!trial_same_samples(b)) candidate_give_back(b, &b->list[i]);
    }
    b->st->progress.n_all = 0;
    return trial_try_taken(b);
}

void trial_add(trial *b, candidate_kind what, size_t idx)
{
    if (b->n == b->capacity) {
        candidate *grown = realloc(b->list, (2 * b->capacity + 16) * sizeof *grown);
        if (!grown) {
            b->no_memory = true;
            return;
        }
        b->list = grown;
        b->capacity = 2 * b->capacity + 16;
    }
    b->list[b->n++] = (candidate){.kind = what, .idx = idx};
}

/* A new kind of candidates. */
void trial_clear(trial *b, const char *what)
{
    b->n = 0;
    b->st->progress.doing = what;
}

/* ---- Reporting --------------------------------------------------------------------------------------------------- */

enum { NAMES_MAX = 8 };

static long ram_of(const compiled *c, const compile_run *run)
{
    compiled copy = *c;
    copy.run = *run;
    compile_choose(&copy);
    return settings_ram(&copy.set).total + compile_state_bytes(&copy, false);
}

measure trial_measure(const trial *b)
{
    return (measure){compile_flash_bytes(b->c, true), ram_of(b->c, &b->now), b->now.instructions};
}

/* A setting; NULL: something of an object, a light or a mesh. */
static const char *setting_of(candidate_kind k)
{
    static const char *const names[] = {
        [FILTER] = "filter",         [OTHER_FILTER] = "other_filter", [MIXING] = "mixing",
        [MAIN_LIGHT] = "main_light", [BLEND] = "cascade_blend",       [CASCADES] = "cascades"};
    return (size_t)k < sizeof names / sizeof *names ? names[k] : NULL;
}

static const char *name_of(const trial *b, const candidate *d)
{
    if (setting_of(d->kind)) return setting_of(d->kind);
    return candidate_is_of_light(d->kind)                          ? b->c->light_name[d->idx]
           : d->kind == TRIANGLES || candidate_is_of_mesh(d->kind) ? b->c->mesh_name[d->idx]
                                                                   : b->c->object_name[d->idx];
}

static bool named_before(const trial *b, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (b->list[k].taken && b->list[k].kind != UNUSED_CASCADE &&
            strcmp(name_of(b, &b->list[k]), name_of(b, &b->list[i])) == 0)
            return true;
    return false;
}

/* ": 'a', 'b', ..." of what was taken */
void trial_list_names(const trial *b, char *out, size_t bytes)
{
    size_t used = strlen(out), n = 0;
    for (size_t i = 0; i < b->n && used + 1 < bytes; i++) {
        const candidate *d = &b->list[i];
        if (!d->taken || d->kind == UNUSED_CASCADE || named_before(b, i)) continue;
        if (n == NAMES_MAX || used + strlen(name_of(b, d)) + 12 > bytes) {
            snprintf(out + used, bytes - used, ", ...");
            return;
        }
        used += (size_t)snprintf(out + used, bytes - used, "%s'%s'", n++ ? ", " : ": ", name_of(b, d));
    }
}

void trial_report(trial *b, const char *what, size_t n, const measure *before)
{
    compiled *c = b->c;
    if (!n || c->n_savings == COMPILE_SAVINGS_MAX) return;
    compile_saving *s = &c->savings[c->n_savings++];
    measure now = trial_measure(b);
    snprintf(s->what, sizeof s->what, "%s", what);
    trial_list_names(b, s->what, sizeof s->what);
    s->n = n;
    s->flash_bytes = before->flash - now.flash;
    s->ram_bytes = before->ram - now.ram;
    s->instructions =
        b->wanted.instructions > 0 ? (before->instructions - now.instructions) / b->wanted.instructions : 0;
}
