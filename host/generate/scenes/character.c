/* Figures of limbs: a limb is a tube around joints, whose vertices follow the joints that they are near. */
#include "character.h"

#include <math.h>
#include <string.h>

enum { KEYS = 9 };

#define CAP   0.12 /* of a limb's length, over which its ends close */
#define BLEND 0.7  /* of a bone's length, over which two joints share a vertex */

/* ---- A limb ------------------------------------------------------------------------------------------------------ */

/* Its axis, and where its points lie along that: the joints and the end. */
typedef struct {
    const character_limb *limb;
    mesh_point at[CHARACTER_LIMB_JOINTS + 1];
    double along[CHARACTER_LIMB_JOINTS + 1], length;
    mesh_frame frame; /* y along the axis */
} tube;

static tube tube_of(const character *c, const character_limb *limb)
{
    tube t = {.limb = limb};
    for (size_t i = 0; i < limb->n_joints; i++) t.at[i] = c->joint[limb->joint[i]].at;
    t.at[limb->n_joints] = limb->end;
    t.frame = mesh_frame_along(t.at[0], mesh_unit(mesh_sub(limb->end, t.at[0])));
    for (size_t i = 0; i <= limb->n_joints; i++) t.along[i] = mesh_dot(mesh_sub(t.at[i], t.at[0]), t.frame.y);
    t.length = t.along[limb->n_joints];
    return t;
}

/* The bone at a place, and how far along that lies. */
static size_t bone_at(const tube *t, double along, double *share)
{
    size_t i = 0;
    while (i + 1 < t->limb->n_joints && along > t->along[i + 1]) i++;
    *share = (along - t->along[i]) / (t->along[i + 1] - t->along[i]);
    return i;
}

/* Smooth from joint to joint, closed at both ends. */
static double radius_at(const tube *t, double along)
{
    double u, end = fmin(along, t->length - along) / (CAP * t->length);
    const size_t i = bone_at(t, along, &u);
    const double *r = t->limb->radius + i, ease = u * u * (3 - 2 * u);
    end = fmax(fmin(end, 1), 0);
    return (r[0] + (r[1] - r[0]) * ease) * sqrt(1 - (1 - end) * (1 - end));
}

static mesh_point centre_at(const tube *t, double along)
{
    double u;
    const size_t i = bone_at(t, along, &u);
    return mesh_add(t->at[i], mesh_scale(mesh_sub(t->at[i + 1], t->at[i]), u));
}

/* Rings lie closer towards the ends. */
static double ring_at(const tube *t, size_t ring)
{
    const double u = (double)ring / (double)t->limb->n_rings;
    return t->length * (0.6 * u + 0.2 * (1 - cos(MESH_PI * u)));
}

static mesh_point point_at(const tube *t, double along, size_t segment)
{
    const mesh_point p = mesh_ring_point(radius_at(t, along), 0, segment, t->limb->n_segments);
    return mesh_add(centre_at(t, along),
                    mesh_add(mesh_scale(t->frame.x, p.x), mesh_scale(t->frame.z, p.z * t->limb->flat)));
}

/* ---- Its faces --------------------------------------------------------------------------------------------------- */

/* Within the limb's part of the texture; of a faceted one every face has a patch of its own. */
static void texture_of(const character *c, const character_limb *limb, size_t ring, size_t segment, mesh_uv uv[4])
{
    const double *part = limb->texture;
    for (int k = 0; k < 4; k++) {
        const size_t right = k == 1 || k == 2, down = k >= 2, face = ring * limb->n_segments + segment;
        const double u = ((double)(segment + right)) / (double)limb->n_segments,
                     v = ((double)(ring + down)) / (double)limb->n_rings;
        uv[k] = (mesh_uv){part[0] + part[2] * u, part[1] + part[3] * v};
        if (c->faceted)
            uv[k] = (mesh_uv){part[0] + (double)(2 * (face % 4) + right) / 16,
                              part[1] + (double)(2 * (face / 4) + down) / 64};
    }
}

static void add_faces(const character *c, const tube *t, mesh_builder *m)
{
    const character_limb *limb = t->limb;
    for (size_t ring = 0; ring < limb->n_rings; ring++)
        for (size_t k = 0; k < limb->n_segments; k++) {
            const double near = ring_at(t, ring), far = ring_at(t, ring + 1);
            const mesh_point p[4] = {point_at(t, near, k), point_at(t, near, k + 1), point_at(t, far, k + 1),
                                     point_at(t, far, k)};
            mesh_uv uv[4];
            texture_of(c, limb, ring, k, uv);
            mesh_polygon_uv(m, (mesh_point[]){p[3], p[2], p[1], p[0]}, (mesh_uv[]){uv[3], uv[2], uv[1], uv[0]}, 4);
        }
}

/* ---- Its vertices ------------------------------------------------------------------------------------------------ */

static double along_of(const tube *t, const mesh_vertex *v)
{
    const mesh_point p = {(double)v->pos[0], (double)v->pos[1], (double)v->pos[2]};
    return fmax(0, fmin(mesh_dot(mesh_sub(p, t->at[0]), t->frame.y), t->length));
}

static void set_normal(const tube *t, mesh_vertex *v)
{
    const double along = along_of(t, v), step = t->length / 200;
    const double slope =
        (radius_at(t, fmin(along + step, t->length)) - radius_at(t, fmax(along - step, 0))) / (2 * step);
    const mesh_point p = {(double)v->pos[0], (double)v->pos[1], (double)v->pos[2]},
                     out = mesh_sub(p, centre_at(t, along));
    const double x = mesh_dot(out, t->frame.x), z = mesh_dot(out, t->frame.z) / t->limb->flat, r = hypot(x, z);
    mesh_point n = mesh_scale(t->frame.y, along < t->length / 2 ? -1 : 1);
    if (r > t->length / 1000)
        n = mesh_unit(mesh_add(mesh_scale(t->frame.y, -slope),
                               mesh_add(mesh_scale(t->frame.x, x / r), mesh_scale(t->frame.z, z / r / t->limb->flat))));
    v->nrm[0] = (float)mesh_on_grid(n.x);
    v->nrm[1] = (float)mesh_on_grid(n.y);
    v->nrm[2] = (float)mesh_on_grid(n.z);
}

/* The bone's joint, and near its ends a share of the joint before or behind. */
static void bind_vertex(const character *c, const tube *t, mesh_builder *m, size_t vertex)
{
    double u;
    const size_t bone = bone_at(t, along_of(t, &m->vertex[vertex]), &u);
    const int *joint = t->limb->joint + bone, parent = c->joint[joint[0]].parent;
    const bool last = bone + 1 == t->limb->n_joints;
    const double before = parent < 0 ? 0 : fmax(0, 0.5 * (1 - u / BLEND)),
                 behind = last ? 0 : fmax(0, 0.5 * (1 - (1 - u) / BLEND));
    const int shares[2] = {(int)(255 * before), (int)(255 * behind)};
    m->joint[vertex][0] = (uint8_t)joint[0];
    m->weight[vertex][0] = (uint8_t)(255 - shares[0] - shares[1]);
    m->joint[vertex][1] = (uint8_t)(parent < 0 ? 0 : parent);
    m->weight[vertex][1] = (uint8_t)shares[0];
    m->joint[vertex][2] = (uint8_t)(last ? 0 : joint[1]);
    m->weight[vertex][2] = (uint8_t)shares[1];
}

static void make_mesh(const character *c, mesh_builder *m)
{
    mesh_begin(m, MESH_UVS);
    for (size_t i = 0; i < c->n_limbs; i++) {
        const tube t = tube_of(c, &c->limb[i]);
        const size_t first = m->n_vertices;
        add_faces(c, &t, m);
        for (size_t v = first; v < m->n_vertices; v++) {
            if (!c->faceted) set_normal(&t, &m->vertex[v]);
            bind_vertex(c, &t, m, v);
        }
    }
    m->attributes |= MESH_JOINTS | (c->faceted ? 0U : (unsigned)MESH_NORMALS);
}

/* ---- The skeleton ------------------------------------------------------------------------------------------------ */

/* From the last joint to the root, which stands at a place: a node names its children. */
static void add_joints(gltf_document *d, const character *c, mesh_point place, size_t *node)
{
    for (size_t i = c->n_joints; i-- > 0;) {
        const character_joint *j = &c->joint[i];
        const mesh_point at = j->parent < 0 ? mesh_add(j->at, place) : mesh_sub(j->at, c->joint[j->parent].at);
        char children[256] = "";
        size_t n = 0;
        for (size_t k = i + 1; k < c->n_joints; k++) {
            if (c->joint[k].parent != (int)i) continue;
            gltf_mark_child(d, node[k]);
            n += (size_t)snprintf(children + n, sizeof children - n, "%s%zu", n ? ", " : "", node[k]);
        }
        node[i] = gltf_add_node(d, j->name, "\"translation\": [%.6g, %.6g, %.6g]%s%s%s", at.x, at.y, at.z,
                                n ? ", \"children\": [" : "", children, n ? "]" : "");
    }
}

/* The keys of joints that swing, and their nodes. */
typedef struct {
    gltf_rotation key[CHARACTER_MAX_SWINGS][KEYS];
    size_t node[CHARACTER_MAX_SWINGS], n;
} swings;

static void add_swings(swings *s, const character *c, double phase, const size_t *node)
{
    for (size_t i = 0; i < c->n_joints; i++) {
        const character_joint *j = &c->joint[i];
        if (j->swing_deg == 0) continue;
        if (s->n < CHARACTER_MAX_SWINGS) {
            for (int k = 0; k < KEYS; k++)
                s->key[s->n][k] =
                    gltf_turn((mesh_point){1, 0, 0},
                              j->swing_deg * sin(2 * MESH_PI * ((double)k / (KEYS - 1) + j->phase + phase)));
            s->node[s->n] = node[i];
        }
        s->n++;
    }
}

void character_add(gltf_document *d, const character *c, mesh_builder *m, size_t material_idx,
                   const character_place *place, size_t n_places)
{
    static swings s;
    size_t node[CHARACTER_MAX_JOINTS], mesh = 0;
    mesh_point at[CHARACTER_MAX_JOINTS];
    make_mesh(c, m);
    s.n = 0;
    for (size_t i = 0; i < c->n_joints; i++) at[i] = c->joint[i].at;
    for (size_t i = 0; i < n_places; i++) {
        add_joints(d, c, place[i].at, node);
        const size_t skin = gltf_add_skin(d, c->name, node, at, c->n_joints);
        if (!i) mesh = gltf_add_mesh(d, c->name, &(gltf_surface){m, material_idx}, 1);
        gltf_add_node(d, c->name, "\"mesh\": %zu, \"skin\": %zu", mesh, skin);
        add_swings(&s, c, place[i].phase, node);
    }
    d->overflow |= s.n > CHARACTER_MAX_SWINGS;
    if (!d->overflow) gltf_add_clip(d, "walk", s.node, s.n, c->step_s / (KEYS - 1), &s.key[0][0], KEYS);
}

/* ---- The scene --------------------------------------------------------------------------------------------------- */

int character_write(const character_scene *s, FILE *file)
{
    static const character_place middle = {{0, 0, 0}, 0};
    static gltf_document d;
    static mesh_builder ground, body;
    const double far = 4;
    gltf_begin(&d);
    mesh_begin(&ground, MESH_FACE_NORMALS);
    mesh_quad(&ground, (mesh_point){-far, 0, far}, (mesh_point){far, 0, far}, (mesh_point){far, 0, -far},
              (mesh_point){-far, 0, -far});
    gltf_add_object(&d, "ground", &ground,
                    gltf_add_material(&d, "ground", (double[]){0.4, 0.42, 0.38}, "\"casts\": 0"));
    const size_t texture = gltf_add_texture(&d, &(gltf_image){"skin", s->side, s->rgba, false, false});
    character_add(
        &d, s->of, &body,
        gltf_add_surface_material(
            &d, &(gltf_material_text){.name = "skin", .rgb = {1, 1, 1}, .has_texture = true, .texture_idx = texture}),
        s->place ? s->place : &middle, s->place ? s->n_places : 1);
    gltf_add_light_node(
        &d, (mesh_point){0, 3, 0}, gltf_look((mesh_point){-0.6, -1, -0.5}),
        &(gltf_light_text){.name = "sun", .kind = GLTF_DIRECTIONAL, .rgb = {1, 0.95, 0.85}, .intensity = 3});
    gltf_add_camera(&d, &s->camera);
    return gltf_write(&d,
                      &(gltf_scene_text){.comment = s->comment,
                                         .settings = "\"cascades\": 1, \"max_distance\": 12, \"filter\": \"3x3\", "
                                                     "\"ambient\": [0.25, 0.28, 0.33], "
                                                     "\"background\": [0.35, 0.5, 0.75]"},
                      file);
}
