/* What a file lacks: ground, camera, light, and the picture's settings. */
#include "loader.h"

#include <math.h>
#include <string.h>

#include "place.h"
#include "seen.h"
#include "vec.h"

static const double camera_azimuth_deg = 30; /* from +Z towards +X */
static const double camera_elevation_deg = 25;
static const double camera_fov_deg = 40;
static const double camera_fill = 0.7; /* of the smaller picture dimension */
static const double ground_albedo = 0.55;
static const double ground_half_size_radii = 8;
static const double ground_below_radii = 0.01;
static const double floor_steepness = 0.7;        /* of a floor: the least share of its normal that points up */
static const double floor_radii = 0.03;           /* it lies so low, or lower: the bottom of a box lies higher ... */
static const double floor_cover = 0.5;            /* ... under this share of the width and depth, or more */
static const double standing = 0.05;              /* on a plane: as near as this to it, of the size */
static const double inside = 0.2;                 /* away from both ends, of the size */
static const double shadow_extent_radii = 3;      /* behind the object's centre, at most: a low sun casts without end */
static const double shadow_fade = 6554.0 / 65536; /* scene_share(0.1) */
static const double usual_distance = 100;         /* of shadows: for a file's camera no more, ... */
static const double few = 1.0 / 10;               /* ... unless only this share of what is seen is nearer */
static const double most = 0.98;                  /* of what is seen has shadows: the rest is about the horizon */
static const double one_cascade = 3, two_cascades = 10; /* the deepest to the nearest of what is seen, at most */
/* Of the depth of what is seen: steps of depth there are a 1024th of it at good_near with the most triangles, whose
 * identities leave 16 bits, and a 16384th with 4000. */
static const double tiny_near = 1.0 / 1024, good_near = 1.0 / 64;
static const double least_near = 1.0 / (1 << 18); /* of the scene's extent: the library has no nearer planes */

static bool check_object(loader *l, const scene_object *object)
{
    const scene_mesh *mesh = &l->s->meshes[object->mesh_idx];
    for (size_t i = 0; i < mesh->n_vertices; i++) {
        double p[3];
        scene_vertex(p, l->s, object, i);
        for (int k = 0; k < 3; k++) {
            if (fabs(p[k]) <= LOADER_MAX_COORDINATE) continue;
            return loader_fail(l, "%s: object '%s', vertex %zu: world coordinate %g is out of range", l->path,
                               object->name, i, p[k]);
        }
    }
    return true;
}

static bool check_objects(loader *l)
{
    for (size_t i = 0; i < l->s->n_objects; i++) {
        if (!check_object(l, &l->s->objects[i])) return false;
    }
    return true;
}

/* Of the whole animation: what is made from it stands still. */
static bool find_bounds(loader *l, bool placed, bounds *b)
{
    scene_seen *kept = l->options->seen;
    if (!check_objects(l)) return false;
    if (kept && kept->knows_bounds[placed]) {
        *b = kept->of_all[placed];
        return true;
    }
    for (size_t i = 0; i < l->poses.n; i++) {
        poses_apply(&l->poses, i, l->s);
        if (!check_objects(l)) return false;
    }
    poses_apply(&l->poses, l->poses.n, l->s);
    if (!bounds_of_poses(b, l->s, &l->poses, NULL)) return loader_fail(l, "%s: the scene has no triangles", l->path);
    if (!kept) return true;
    kept->knows_bounds[placed] = true;
    kept->of_all[placed] = *b;
    return true;
}

/* Adds up the up-facing area near the lowest point, as seen from above: what lies there like a floor. *lies: some
 * surface does, or shows a back, at the very height of a ground. */
typedef struct {
    double area;
    bool coplanar;
} floor_parts;

static void add_floor_triangle(floor_parts *parts, const scene_object *object, double p[3][3], int sign,
                               const bounds *b)
{
    double u[3], v[3], normal[3];
    vec_sub(u, p[1], p[0]);
    vec_sub(v, p[2], p[0]);
    vec_cross(normal, u, v);
    normal[1] *= sign;
    double length = sqrt(vec_dot(normal, normal)), height = (p[0][1] + p[1][1] + p[2][1]) / 3 - b->low[1];
    if (!(fabs(normal[1]) > floor_steepness * length)) return;
    bool is_up = normal[1] > 0;
    if (is_up && height <= floor_radii * b->radius && object->receives && !object->unlit) parts->area += normal[1] / 2;
    if ((is_up || object->two_sided) && height < ground_below_radii * b->radius) parts->coplanar = true;
}

/* As the first frame has it. */
static floor_parts find_floor(loader *l, const bounds *b)
{
    scene *s = l->s;
    floor_parts parts = {0};
    poses_apply(&l->poses, 0, s);
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_object *object = &s->objects[i];
        const scene_mesh *mesh = &s->meshes[object->mesh_idx];
        const int sign = scene_object_sign(object);
        for (size_t t = 0; t < mesh->n_triangles; t++) {
            double p[3][3];
            for (int k = 0; k < 3; k++) scene_vertex(p[k], s, object, mesh->idx[3 * t + (size_t)k]);
            add_floor_triangle(&parts, object, p, sign, b);
        }
    }
    poses_apply(&l->poses, l->poses.n, s);
    return parts;
}

/* A ground where shadows would fall on nothing: not under a floor, not in a scene that somebody lit and filmed. */
static bool decide_ground(const loader *l, const bounds *b, const floor_parts *parts)
{
    const scene *s = l->s;
    if (l->options->ground != SCENE_GROUND_AUTO) return l->options->ground == SCENE_GROUND_ON;
    if (l->file_has_camera && s->n_lights > 0) return false;
    double footprint = (b->high[0] - b->low[0]) * (b->high[2] - b->low[2]);
    return !(parts->area > 0 && parts->area >= floor_cover * footprint);
}

/* At the height of the lowest point; below it where a surface lies there: two in one plane would flicker. */
static bool add_ground(loader *l, const bounds *b, bool coplanar)
{
    double half = ground_half_size_radii * b->radius, y = b->low[1] - (coplanar ? ground_below_radii * b->radius : 0);
    double x = b->centre[0], z = b->centre[2];
    double pos[12] = {x - half, y, z - half, x - half, y, z + half, x + half, y, z + half, x + half, y, z - half};
    uint32_t idx[6] = {0, 1, 2, 0, 2, 3};
    char name[] = "ground";
    scene_mesh quad = {.name = name, .n_vertices = 4, .n_triangles = 2, .pos = pos, .idx = idx};
    scene_object object = object_defaults();
    object.name = name;
    object.caster = SCENE_CASTER_OFF;
    for (int i = 0; i < 3; i++) object.albedo[i] = ground_albedo;
    mesh_splitter splitter;
    size_t first, n_meshes;
    return mesh_splitter_init(&splitter, l, &quad) && mesh_split(&splitter, name, idx, 2, &first, &n_meshes) &&
           loader_add_objects(l, &object, first, n_meshes);
}

static void direction_of(double azimuth, double elevation, double *out)
{
    out[0] = cos(elevation) * sin(azimuth);
    out[1] = sin(elevation);
    out[2] = cos(elevation) * cos(azimuth);
}

/* Distance from the centre at which every vertex projects into the middle `fill` of the smaller picture dimension. */
static double fit_pose(const scene *s, const bounds *b, const scene_affine *camera, double focal_over_half)
{
    double distance = 1.25 * b->radius; /* at least outside the sphere */
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_mesh *mesh = &s->meshes[s->objects[i].mesh_idx];
        for (size_t v = 0; v < mesh->n_vertices; v++) {
            double p[3], axis[3], local[3];
            scene_vertex(p, s, &s->objects[i], v);
            vec_sub(p, p, b->centre);
            for (int k = 0; k < 3; k++) {
                affine_column(axis, camera, k);
                local[k] = vec_dot(p, axis);
            }
            distance = fmax(distance, fmax(fabs(local[0]), fabs(local[1])) * focal_over_half + local[2]);
        }
    }
    return distance;
}

static double fit_distance(loader *l, const bounds *b, const scene_affine *camera, double focal_over_half)
{
    double distance = 0;
    for (size_t i = 0; i < (l->poses.n ? l->poses.n : 1); i++) {
        poses_apply(&l->poses, i, l->s);
        distance = fmax(distance, fit_pose(l->s, b, camera, focal_over_half));
    }
    poses_apply(&l->poses, l->poses.n, l->s);
    return distance;
}

/* How far ahead the ground at the bottom of the picture is, measured as depth: the camera is `above` it and looks down
 * by `elevation`. No ground there: infinity. */
static double ground_depth(double above, double elevation, double half_fov)
{
    double down = fmin(elevation + half_fov, VEC_PI / 2);
    return down > 0 && above > 0 ? above / sin(down) * cos(down - elevation) : HUGE_VAL;
}

static void turn_camera(scene_camera *camera, double azimuth, double elevation)
{
    double right[3] = {cos(azimuth), 0, -sin(azimuth)}, up[3], back[3];
    direction_of(azimuth, elevation, back);
    vec_cross(up, back, right);
    for (int i = 0; i < 3; i++) {
        camera->to_world.m[i][0] = right[i];
        camera->to_world.m[i][1] = up[i];
        camera->to_world.m[i][2] = back[i];
    }
}

/* Frames what is there before the ground is added. glTF models, and most others, face +Z: that is where it stands, a
 * bit to the side and above. */
static bool make_camera(loader *l, const bounds *b)
{
    scene_camera *camera = &l->s->camera;
    const scene_options *options = l->options;
    double azimuth = (options->orbit ? options->yaw : camera_azimuth_deg) * VEC_PI / 180;
    double elevation = (options->orbit ? options->pitch : camera_elevation_deg) * VEC_PI / 180;
    double half_fov = camera_fov_deg * VEC_PI / 360;
    turn_camera(camera, azimuth, elevation);
    camera->focal = 1 / tan(half_fov);
    double smaller = fmin(options->width, options->height);
    double distance = fit_distance(l, b, &camera->to_world, camera->focal * options->height / (camera_fill * smaller));
    for (int i = 0; i < 3; i++) camera->to_world.m[i][3] = b->centre[i] + distance * camera->to_world.m[i][2];
    if (options->orbit) camera->focal *= options->zoom; /* as a lens: the camera stays outside */
    if (!loader_limit_focal(l, &camera->focal)) return false;
    camera->far = distance + sqrt(2) * ground_half_size_radii * b->radius;
    double ground = ground_depth(camera->to_world.m[1][3] - b->low[1], elevation, atan(1 / camera->focal));
    double near = fmin(0.5 * (distance - b->radius), 0.9 * ground);
    camera->near = fmax(near, camera->far / 1000);
    return true;
}

/* How deep behind the middle objects are, and their shadows on the ground if there is one. */
static double find_depth(const loader *l, const bounds *b, const double *back)
{
    const scene *s = l->s;
    const double *light = s->lights[0].direction;
    double deepest = 0, farthest = shadow_extent_radii * b->radius;
    for (size_t i = 0; i < s->n_objects; i++) {
        const scene_mesh *mesh = &s->meshes[s->objects[i].mesh_idx];
        for (size_t v = 0; v < mesh->n_vertices; v++) {
            double p[3];
            scene_vertex(p, s, &s->objects[i], v);
            double fall = l->wants_ground && light[1] < 0 ? (b->low[1] - p[1]) / light[1] : 0;
            vec_sub(p, p, b->centre);
            double depth = -vec_dot(p, back);
            deepest = fmax(deepest, fmax(depth, fmin(depth - fall * vec_dot(light, back), farthest)));
        }
    }
    return deepest;
}

/* For the default camera: the depth up to which they are to be seen whole. The fade starts behind it. No farther: the
 * texels of the shadow map spread over this distance. */
static double find_shadow_distance(loader *l, const bounds *b)
{
    const scene_affine *camera = &l->s->camera.to_world;
    double deepest = 0, back[3], eye[3];
    affine_column(back, camera, 2);
    affine_column(eye, camera, 3);
    vec_sub(eye, eye, b->centre);
    for (size_t i = 0; i < (l->poses.n ? l->poses.n : 1); i++) {
        poses_apply(&l->poses, i, l->s);
        deepest = fmax(deepest, find_depth(l, b, back));
    }
    poses_apply(&l->poses, l->poses.n, l->s);
    return (vec_dot(eye, back) + deepest) / (1 - shadow_fade);
}

static scene_mixing default_mixing(const scene *s)
{
    for (size_t i = 0; i < s->n_objects; i++) {
        if (s->objects[i].mask || s->objects[i].mask_texture_idx != SCENE_NONE) return SCENE_MIX_DISTANCE;
    }
    return SCENE_MIX_NONE;
}

/* What stands on z = 0, and has y = 0 well inside, is likely to be a model whose z points up. Flat ones are left alone.
 */
static bool remark_on_up(loader *l, const bounds *b)
{
    const double *low = b->low, *high = b->high;
    const double depth = high[1] - low[1], height = high[2] - low[2];
    if (!l->any_axis_up || l->options->up != SCENE_UP_DEFAULT || !(height > standing * b->radius)) return true;
    if (fabs(low[2]) > standing * height || -low[1] < inside * depth || high[1] < inside * depth) return true;
    return loader_remark(l, "the model stands on z = 0 and not on y = 0: if it lies on its side, --set up=z");
}

static void default_shadow(const loader *l, scene_shadow *out)
{
    *out = (scene_shadow){.distance_fade = shadow_fade,
                          .cascade_fade = scene_share(0.1),
                          .filter = SCENE_FILTER_3X3,
                          .other_filter = SCENE_FILTER_3X3,
                          .penumbra = 1,
                          .disk_samples = 16,
                          .mixing = default_mixing(l->s),
                          .tiles = SCENE_TILES_WORTH,
                          .fit = SCENE_FIT_TIGHT,
                          .refresh = {1, 1, 1, 1},
                          .object_lights = 8,
                          .n_cascades = 1,
                          .blend = SCENE_BLEND_HARD,
                          .distance_mode = SCENE_DISTANCE_DEPTH};
    scene_default_ratios(out);
}

/* ---- A file's camera -------------------------------------------------------------------------------------------- */

static void find_view_range(loader *l, bool with_ground, view_range *r)
{
    scene_seen *kept = l->options->seen;
    if (kept && kept->knows_range[with_ground]) {
        *r = kept->range[with_ground];
        return;
    }
    const double aspect = (double)l->options->width / l->options->height;
    view_range_begin(r);
    if (l->poses.n == 0) view_range_add(r, l->s, &l->s->camera.to_world, aspect);
    for (size_t i = 0; i < l->poses.n; i++) {
        poses_apply(&l->poses, i, l->s);
        view_range_add(r, l->s, &l->poses.camera[i], aspect);
    }
    poses_apply(&l->poses, l->poses.n, l->s);
    if (!kept) return;
    kept->knows_range[with_ground] = true;
    kept->range[with_ground] = *r;
}

/* As far as what is seen. Of a wide view that is the usual distance: the texels of the shadow map spread over it. */
static double seen_distance(const scene_camera *camera, const view_range *r)
{
    double distance = r->area > 0 ? view_range_depth(r, most) / (1 - shadow_fade) : usual_distance;
    if (distance > usual_distance && view_range_share(r, usual_distance) >= few) distance = usual_distance;
    return fmin(fmax(distance, 2 * camera->near), camera->far);
}

/* No more cascades than have something to show: of two the first ends in the geometric mean of what is seen. */
static void set_cascades(scene_shadow *shadow, const view_range *r)
{
    const double near = fmax(view_range_depth(r, 1 - most), r->nearest);
    const double range = r->area > 0 ? shadow->max_distance / near : HUGE_VAL;
    shadow->n_cascades = range < one_cascade ? 1 : range < two_cascades ? 2 : 4;
    scene_default_ratios(shadow);
    if (shadow->n_cascades == 2) shadow->cascade_ratio[0] = scene_share(sqrt(1 / range));
}

/* Of everything, from the origin. */
static double extent_of(const loader *l, const bounds *b)
{
    const scene *s = l->s;
    double extent = fmax(s->camera.half_height, s->shadow.max_distance);
    for (int k = 0; k < 3; k++)
        extent = fmax(extent, fmax(fabs(s->camera.to_world.m[k][3]), fmax(fabs(b->low[k]), fabs(b->high[k]))));
    return extent;
}

/* A near plane that is hardly before the eye, as files have that nobody thought about, is moved towards what is seen.
 */
static bool move_near(loader *l, const bounds *b, const view_range *r)
{
    scene_camera *camera = &l->s->camera;
    const double was = camera->near, least = least_near * extent_of(l, b);
    if (was >= least && was >= tiny_near * r->deepest) return true;
    camera->near = fmax(fmax(was, least), fmin(r->nearest / 2, good_near * r->deepest));
    camera->far = fmax(camera->far, 2 * camera->near);
    if (r->nearest >= camera->near)
        return loader_note(l, "the camera's near plane is moved from %g to %g: nothing is nearer", was, camera->near);
    return loader_remark(l, "the camera's near plane is moved from %g to %g, and what is nearer is cut off", was,
                         camera->near);
}

static void adapt_shadow(loader *l, const view_range *r)
{
    l->s->shadow.max_distance = seen_distance(&l->s->camera, r);
    set_cascades(&l->s->shadow, r);
}

/* ---- All of it -------------------------------------------------------------------------------------------------- */

bool loader_add_defaults(loader *l)
{
    static const double ambient[3] = {0.18, 0.18, 0.18}, background[3] = {0.35, 0.45, 0.6};
    scene *s = l->s;
    bounds b;
    view_range seen; /* by the file's camera */
    bool changed;
    if (!find_bounds(l, false, &b) || !place_objects(l, &b, &changed) || (changed && !find_bounds(l, true, &b)) ||
        !remark_on_up(l, &b) || !lights_dim(l, b.centre, b.radius))
        return false;
    const floor_parts parts = find_floor(l, &b);
    l->wants_ground = decide_ground(l, &b, &parts);
    s->added = (scene_added){.ground = l->wants_ground, .camera = !l->has_camera, .light = s->n_lights == 0};
    memcpy(s->ambient, ambient, sizeof ambient);
    memcpy(s->background, background, sizeof background);
    default_shadow(l, &s->shadow);
    if (l->has_camera) {
        find_view_range(l, false, &seen);
        adapt_shadow(l, &seen);
    } else {
        if (!make_camera(l, &b)) return false;
        s->stage.camera = s->camera.to_world;
    }
    if (s->n_lights == 0 && !lights_add(l, "default", SCENE_LIGHT_DIRECTIONAL)) return false;
    lights_set_near(s, &l->poses, b.low, b.high);
    if (!l->has_camera) s->shadow.max_distance = find_shadow_distance(l, &b);
    lights_find_stage(l);
    if (l->wants_ground && !add_ground(l, &b, parts.coplanar)) return false;
    if (l->has_camera && l->wants_ground) find_view_range(l, true, &seen);
    return !l->has_camera || move_near(l, &b, &seen);
}
