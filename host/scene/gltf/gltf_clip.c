/* The clips of a file, which glTF calls animations: their list, and the one that plays. */
#include <stdlib.h>
#include <string.h>

#include "gltf.h"

/* By the largest times that the file itself names for its keys: what does not play is not read. */
static double duration_of(const gltf *g, const json_value *animation)
{
    const json_value *samplers = json_get(animation, "samplers");
    double duration = 0;
    for (size_t i = 0; samplers && i < samplers->n_children; i++) {
        const json_value *input = json_get(samplers->children[i], "input");
        const bool known = input && input->type == JSON_NUMBER && input->number >= 0 && input->number <= INT32_MAX;
        const json_value *times = known ? json_at(g->accessors, (size_t)input->number) : NULL;
        const json_value *most = json_at(json_get(times, "max"), 0);
        if (most && most->type == JSON_NUMBER && most->number > duration) duration = most->number;
    }
    return duration;
}

static bool list_clips(gltf *g)
{
    scene *s = g->l->s;
    const size_t n = g->animations ? g->animations->n_children : 0;
    s->clips = loader_own(g->l, n + 1, sizeof *s->clips);
    for (size_t i = 0; s->clips && i < n; i++) {
        const json_value *json = g->animations->children[i];
        const char *name = gltf_name(g, json, "animation");
        char *copy = name ? loader_own(g->l, strlen(name) + 1, 1) : NULL;
        if (!copy) return false;
        strcpy(copy, name);
        s->clips[s->n_clips++] = (scene_clip){copy, duration_of(g, json)};
    }
    return s->clips != NULL;
}

/* A name goes before a number. n_clips: there is none. */
static size_t find_clip(const scene *s, const char *wanted)
{
    for (size_t i = 0; i < s->n_clips; i++)
        if (strcmp(s->clips[i].name, wanted) == 0) return i;
    const bool number = *wanted && strlen(wanted) < 10 && !wanted[strspn(wanted, "0123456789")];
    const unsigned long idx = number ? strtoul(wanted, NULL, 10) : s->n_clips;
    return idx < s->n_clips ? idx : s->n_clips;
}

static bool fail_to_find(loader *l)
{
    const scene *s = l->s;
    const char *names = "";
    for (size_t i = 0; i < s->n_clips && strlen(names) < 200; i++) {
        names = loader_format(l, "%s%s%zu '%.60s'", names, i ? ", " : "", i, s->clips[i].name);
        if (!names) return false;
    }
    return loader_fail(l, "%s: there is no clip '%.60s': it has %s", l->path, l->options->clip,
                       s->n_clips ? names : "none");
}

bool gltf_choose_clip(gltf *g)
{
    scene *s = g->l->s;
    const char *wanted = g->l->options->clip;
    if (!list_clips(g)) return false;
    s->clip_idx = wanted ? find_clip(s, wanted) : 0;
    if (wanted && s->clip_idx == s->n_clips) return fail_to_find(g->l);
    if (wanted || s->n_clips < 2 || g->l->options->rig) return true;
    return loader_remark(g->l, "of %zu clips the first plays, '%.100s': --clip takes another, by name or number",
                         s->n_clips, s->clips[0].name);
}
