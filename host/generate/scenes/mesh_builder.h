/* Triangle meshes for the scene generator: right-handed, +Y up, counter-clockwise seen from outside.
 *
 * Every coordinate is rounded to MESH_GRID when it enters a mesh: a last bit that differs between compilers or C
 * libraries does not reach the file, and equal points become the same vertex, so that neighbouring faces meet without a
 * crack. */
#ifndef GNOMON_HOST_MESH_BUILDER_H
#define GNOMON_HOST_MESH_BUILDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MESH_GRID (1.0 / 65536)
#define MESH_PI   3.14159265358979323846

enum { MESH_MAX_VERTICES = 2560, MESH_MAX_CORNERS = 13200 };

typedef struct {
    double x, y, z;
} mesh_point;
typedef struct {
    double r, y;
} mesh_profile; /* of a solid of revolution about +Y */

typedef struct {
    double u, v;
} mesh_uv; /* v downwards */

/* Where a part stands in its mesh: orthonormal axes, x cross y = z. */
typedef struct {
    mesh_point origin, x, y, z;
} mesh_frame;

typedef enum {
    MESH_FACE_NORMALS = 0,
    MESH_NORMALS = 1,
    MESH_COLOURS = 2,
    MESH_UVS = 4,
    MESH_MASKS = 8,
    MESH_BAKED = 16,
    MESH_JOINTS = 32
} mesh_attributes;

typedef struct {
    float pos[3], nrm[3], rgb[3], uv[2]; /* unused attributes stay zero */
} mesh_vertex;

typedef struct {
    unsigned attributes; /* a set of mesh_attributes */
    bool overflow;       /* something did not fit: the mesh is no good */
    float paint[3];      /* COLOR_0 of what is added next */
    mesh_frame place;    /* of what is added next */
    size_t n_vertices, n_corners;
    mesh_vertex vertex[MESH_MAX_VERTICES];
    uint8_t mask[MESH_MAX_VERTICES][4]; /* with MESH_MASKS: filled by mask_bake when the mesh is done */
    float baked[MESH_MAX_VERTICES][3];  /* with MESH_BAKED, likewise */
    uint8_t joint[MESH_MAX_VERTICES][4], weight[MESH_MAX_VERTICES][4]; /* with MESH_JOINTS; of a vertex 255 in all */
    uint16_t idx[MESH_MAX_CORNERS];
} mesh_builder;

double mesh_on_grid(double v);

mesh_point mesh_add(mesh_point a, mesh_point b);
mesh_point mesh_sub(mesh_point a, mesh_point b);
mesh_point mesh_scale(mesh_point a, double s);
mesh_point mesh_cross(mesh_point a, mesh_point b);
double mesh_dot(mesh_point a, mesh_point b);
mesh_point mesh_unit(mesh_point a);

void mesh_begin(mesh_builder *m, unsigned attributes);
void mesh_paint(mesh_builder *m, double r, double g, double b);

/* Paints every vertex that is there by its position. */
void mesh_repaint(mesh_builder *m, void (*paint)(mesh_point at, double *rgb));

/* What is added next stands there; mesh_begin puts it at the origin. */
void mesh_place(mesh_builder *m, mesh_frame place);
/* Tipped from +Y towards +Z first, then turned from +Z towards +X. */
mesh_frame mesh_frame_at(mesh_point origin, double yaw_deg, double tip_deg);

/* +Y along a unit vector, the other axes anyhow. */
mesh_frame mesh_frame_along(mesh_point origin, mesh_point unit_y);

/* Convex, cut into a fan from its first point. Repeated points are left out. MESH_NORMALS: every corner has the face's
 * normal. */
void mesh_polygon(mesh_builder *m, const mesh_point *p, size_t n);
/* uv: of each point, for MESH_UVS. */
void mesh_polygon_uv(mesh_builder *m, const mesh_point *p, const mesh_uv *uv, size_t n);
void mesh_triangle(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c);
void mesh_quad(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c, mesh_point d);

/* Point k of a ring of n_segments about +Y; k may be n_segments, which is 0 again. */
mesh_point mesh_ring_point(double r, double y, size_t k, size_t n_segments);

/* Solid of revolution. The profile runs from the bottom outwards, up and inwards. With MESH_NORMALS each of its
 * sections is smooth around the axis, and the edges between sections are sharp. */
void mesh_lathe(mesh_builder *m, const mesh_profile *profile, size_t n, size_t n_segments);

/* All six faces. */
void mesh_box(mesh_builder *m, mesh_point low, mesh_point high);

/* Smooth with MESH_NORMALS; n_rings sections from pole to pole. */
void mesh_ball(mesh_builder *m, mesh_point centre, double radius, size_t n_rings, size_t n_segments);

/* A closed cylinder from a to b. */
void mesh_rod(mesh_builder *m, mesh_point a, mesh_point b, double radius, size_t n_segments);

#endif
