/* Shadow masks by casting rays. Nothing but sums, products, quotients and roots of coordinates on the mesh grid, so
 * that every machine writes the same bytes; the sample points are uneven, so that no ray runs along an edge. */
#include "mask_bake.h"

#include <math.h>
#include <string.h>

enum { N_SAMPLES = 6 };

/* Weights of a triangle's two other corners; the vertex itself has the rest. */
static const double sample_weight[N_SAMPLES][2] = {{0.031, 0.057}, {0.143, 0.069}, {0.061, 0.167},
                                                   {0.211, 0.129}, {0.107, 0.241}, {0.293, 0.037}};
static const double lift = 1.0 / 512; /* off the surface */

static mesh_point corner(const mesh_builder *m, size_t i)
{
    const float *p = m->vertex[m->idx[i]].pos;
    return (mesh_point){(double)p[0], (double)p[1], (double)p[2]};
}

/* Does the ray from p, as long as its direction, meet the triangle? */
static bool meets(mesh_point p, mesh_point ray, mesh_point a, mesh_point b, mesh_point c)
{
    mesh_point ab = mesh_sub(b, a), ac = mesh_sub(c, a), ap = mesh_sub(p, a);
    mesh_point q = mesh_cross(ray, ac), r = mesh_cross(ap, ab);
    double det = mesh_dot(ab, q);
    if (fabs(det) < 1e-12) return false;
    double u = mesh_dot(ap, q) / det, v = mesh_dot(ray, r) / det, t = mesh_dot(ac, r) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1;
}

static bool is_blocked(mesh_point p, mesh_point ray, mesh_builder *const *casters, size_t n_casters)
{
    for (size_t k = 0; k < n_casters; k++) {
        for (size_t i = 0; i < casters[k]->n_corners; i += 3) {
            if (meets(p, ray, corner(casters[k], i), corner(casters[k], i + 1), corner(casters[k], i + 2))) return true;
        }
    }
    return false;
}

static bool is_lit(mesh_point p, const mask_light *light, mesh_builder *const *casters, size_t n_casters)
{
    const double beyond_all = 1000;
    if (light->directional) return !is_blocked(p, mesh_scale(light->at, beyond_all), casters, n_casters);
    mesh_point ray = mesh_sub(light->at, p);
    double distance = sqrt(mesh_dot(ray, ray));
    if (distance <= light->near_distance) return true;
    return !is_blocked(p, mesh_scale(ray, 1 - light->near_distance / distance), casters, n_casters);
}

/* Adds the samples of the triangle that are nearest to its corner k. */
static void sample_triangle(const mesh_builder *m, size_t first, size_t k, const mask_light *light,
                            mesh_builder *const *casters, size_t n_casters, size_t *n_lit)
{
    mesh_point a = corner(m, first + k), b = corner(m, first + (k + 1) % 3), c = corner(m, first + (k + 2) % 3);
    mesh_point ab = mesh_sub(b, a), ac = mesh_sub(c, a), off = mesh_scale(mesh_unit(mesh_cross(ab, ac)), lift);
    for (size_t s = 0; s < N_SAMPLES; s++) {
        mesh_point p = mesh_add(a, mesh_add(mesh_scale(ab, sample_weight[s][0]), mesh_scale(ac, sample_weight[s][1])));
        *n_lit += is_lit(mesh_add(p, off), light, casters, n_casters);
    }
}

/* Vertices of one smooth surface, though of two colours. */
static bool is_same(const mesh_vertex *a, const mesh_vertex *b)
{
    return memcmp(a->pos, b->pos, sizeof a->pos) == 0 && memcmp(a->nrm, b->nrm, sizeof a->nrm) == 0;
}

static uint8_t bake_vertex(const mesh_builder *m, size_t vertex, const mask_light *light, mesh_builder *const *casters,
                           size_t n_casters)
{
    size_t n = 0, n_lit = 0;
    for (size_t i = 0; i < m->n_corners; i++) {
        if (!is_same(&m->vertex[m->idx[i]], &m->vertex[vertex])) continue;
        sample_triangle(m, i - i % 3, i % 3, light, casters, n_casters, &n_lit);
        n += N_SAMPLES;
    }
    return (uint8_t)(n ? (255 * n_lit + n / 2) / n : 255);
}

void mask_bake(mesh_builder *const *receivers, size_t n_receivers, mesh_builder *const *casters, size_t n_casters,
               const mask_light *lights, size_t n_lights)
{
    for (size_t r = 0; r < n_receivers; r++) {
        mesh_builder *m = receivers[r];
        m->attributes |= MESH_MASKS;
        memset(m->mask, 255, sizeof m->mask);
        for (size_t i = 0; i < m->n_vertices; i++) {
            for (size_t k = 0; k < n_lights; k++) {
                m->mask[i][lights[k].channel] = bake_vertex(m, i, &lights[k], casters, n_casters);
            }
        }
    }
}
