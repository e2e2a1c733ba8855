/* Meshes: how many fraction bits each array gets, and the arrays. */
#include "quantise_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The largest number of fraction bits that keeps every coordinate of the mesh within 2^30. */
static int position_bits(const scene_mesh *mesh)
{
    double largest = 0;
    int e;
    for (size_t i = 0; i < 3 * mesh->n_vertices; i++) largest = fmax(largest, fabs(mesh->pos[i]));
    frexp(largest, &e);
    return largest > 0 ? 30 - e : 30;
}

mesh_plan *quantise_plan_meshes(const scene *s, const gn_knobs *knobs)
{
    mesh_plan *plan = calloc(s->n_meshes + 1, sizeof *plan);
    const int lost = -1 - quantise_world_exp(s); /* bits of a rotation */
    for (size_t i = 0; plan && i < s->n_meshes; i++) {
        plan[i].short_positions = knobs->short_vertices % 2;
        plan[i].normal_one = knobs->short_vertices >= 2 ? 127 : 32767;
        plan[i].raised = lost > 0 ? lost / 8 * 8 : 0;
        plan[i].pos_bits = position_bits(&s->meshes[i]) - (plan[i].short_positions ? 15 : 0);
    }
    for (size_t i = 0; plan && i < s->n_objects; i++) {
        const scene_object *o = &s->objects[i];
        const size_t shown[] = {o->texture_idx, o->emissive_texture_idx};
        for (int k = 0; k < 2; k++) {
            if (shown[k] >= s->n_textures) continue;
            plan[o->mesh_idx].clamped[0] |= s->textures[shown[k]].clamp_u;
            plan[o->mesh_idx].clamped[1] |= s->textures[shown[k]].clamp_v;
        }
    }
    return plan;
}

/* As many fraction bits as 16-bit texture coordinates can have; less than 0: they do not fit at all. Textures that
 * repeat do not mind a whole number of periods: without it, coordinates far from 0 keep their fractions. */
static int plan_texture_coordinates(mesh_plan *plan, const scene_mesh *mesh)
{
    double largest = 0;
    int e;
    for (int k = 0; k < 2; k++) {
        double low = mesh->uv[k], high = mesh->uv[k];
        for (size_t i = 0; i < mesh->n_vertices; i++) {
            low = fmin(low, mesh->uv[2 * i + (size_t)k]);
            high = fmax(high, mesh->uv[2 * i + (size_t)k]);
        }
        plan->uv_periods[k] = plan->clamped[k] ? 0 : floor(low / 2 + high / 2);
        largest = fmax(largest, fmax(fabs(low - plan->uv_periods[k]), fabs(high - plan->uv_periods[k])));
    }
    frexp(largest, &e);
    return largest > 0 && e > 0 ? 15 - e : 15;
}

static int32_t *fixed_positions(const scene_mesh *mesh, int bits, bool short_positions)
{
    const double max = short_positions ? 32767 : 1073741824.0;
    size_t n = 3 * mesh->n_vertices;
    int32_t *pos = malloc(n * sizeof *pos);
    for (size_t i = 0; pos && i < n; i++) pos[i] = (int32_t)rounded(ldexp(mesh->pos[i], bits), 1, -max, max);
    return pos;
}

static int16_t *fixed_normals(const scene_mesh *mesh, double one)
{
    size_t n = 3 * mesh->n_vertices;
    int16_t *nrm = malloc(n * sizeof *nrm);
    for (size_t i = 0; nrm && i < n; i++) nrm[i] = (int16_t)rounded(mesh->nrm[i], one, -one, one);
    return nrm;
}

static int16_t *fixed_texture_coordinates(const scene_mesh *mesh, const mesh_plan *plan, int bits)
{
    size_t n = 2 * mesh->n_vertices;
    int16_t *uv = malloc(n * sizeof *uv);
    for (size_t i = 0; uv && i < n; i++)
        uv[i] = (int16_t)rounded(mesh->uv[i] - plan->uv_periods[i & 1], ldexp(1, bits), -32768, 32767);
    return uv;
}

uint16_t *quantise_words(const double *v, size_t n, double one)
{
    uint16_t *out = malloc(n * sizeof *out);
    for (size_t i = 0; out && i < n; i++) out[i] = (uint16_t)rounded(v[i], one, 0, 65535);
    return out;
}

static uint16_t *fixed_indices(const scene_mesh *mesh)
{
    size_t n = 3 * mesh->n_triangles;
    uint16_t *idx = malloc(n * sizeof *idx);
    for (size_t i = 0; idx && i < n; i++) idx[i] = (uint16_t)mesh->idx[i];
    return idx;
}

int quantise_mesh(gn_mesh *out, const scene_mesh *mesh, mesh_plan *plan, char *error, size_t error_bytes)
{
    size_t n = mesh->n_vertices;
    if (n > 65535 || mesh->n_triangles > 65535) {
        snprintf(error, error_bytes, "mesh '%s': more than 65535 vertices or triangles", mesh->name);
        return -1;
    }
    int bits = plan->pos_bits, said = bits + plan->raised,
        uv_bits = mesh->uv && n ? plan_texture_coordinates(plan, mesh) : 0;
    if (uv_bits < 0) {
        snprintf(error, error_bytes,
                 "mesh '%s': its texture coordinates are farther from 0, or from each other, than 32767", mesh->name);
        return -1;
    }
    out->n_vertices = (uint16_t)n;
    out->n_triangles = (uint16_t)mesh->n_triangles;
    out->pos_frac_bits = (uint8_t)(said < 0 ? 0 : said > 30 ? 30 : said);
    out->uv_frac_bits = (uint8_t)uv_bits;
    out->pos = fixed_positions(mesh, bits, plan->short_positions);
    out->idx = fixed_indices(mesh);
    if (mesh->nrm) out->nrm_q15 = fixed_normals(mesh, plan->normal_one);
    if (mesh->rgb) out->rgb_uq16 = quantise_words(mesh->rgb, 3 * n, 65535);
    if (mesh->uv) out->uv = fixed_texture_coordinates(mesh, plan, uv_bits);
    if (mesh->mask_uv) out->mask_uv_uq16 = quantise_words(mesh->mask_uv, 2 * n, 65535);
    if (!out->pos || !out->idx || (mesh->nrm && !out->nrm_q15) || (mesh->rgb && !out->rgb_uq16) ||
        (mesh->uv && !out->uv) || (mesh->mask_uv && !out->mask_uv_uq16))
        return quantise_no_memory(error, error_bytes);
    return 0;
}
