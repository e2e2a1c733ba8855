/* Triangle meshes for the scene generator: right-handed, +Y up, counter-clockwise seen from outside.
 *
 * Every coordinate is rounded to MESH_GRID when it enters a mesh: a last bit that differs between compilers or C libraries does
 * not reach the file, and equal points become the same vertex, so that neighbouring faces meet without a crack. */
#ifndef GNOMON_HOST_MESH_BUILDER_H
#define GNOMON_HOST_MESH_BUILDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MESH_GRID (1.0 / 65536)
#define MESH_PI   3.14159265358979323846

enum { MESH_MAX_VERTICES = 1024, MESH_MAX_CORNERS = 3072 };

typedef struct {
    double x, y, z;
} mesh_point;
typedef struct {
    double r, y;
} mesh_profile; /* of a solid of revolution about +Y */

typedef enum { MESH_FACE_NORMALS = 0, MESH_NORMALS = 1, MESH_COLOURS = 2 } mesh_attributes;

typedef struct {
    float pos[3], nrm[3], rgb[3]; /* unused attributes stay zero */
} mesh_vertex;

typedef struct {
    unsigned attributes; /* MESH_NORMALS | MESH_COLOURS */
    bool overflow;       /* something did not fit: the mesh is no good */
    float paint[3];      /* COLOR_0 of what is added next */
    size_t n_vertices, n_corners;
    mesh_vertex vertex[MESH_MAX_VERTICES];
    uint16_t idx[MESH_MAX_CORNERS];
} mesh_builder;

double mesh_on_grid(double v);

void mesh_begin(mesh_builder *m, unsigned attributes);
void mesh_paint(mesh_builder *m, double r, double g, double b);

/* Convex, without vertex normals, cut into a fan from its first point. Repeated points are left out. */
void mesh_polygon(mesh_builder *m, const mesh_point *p, size_t n);
void mesh_triangle(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c);
void mesh_quad(mesh_builder *m, mesh_point a, mesh_point b, mesh_point c, mesh_point d);

/* Point k of a ring of n_segments about +Y; k may be n_segments, which is 0 again. */
mesh_point mesh_ring_point(double r, double y, size_t k, size_t n_segments);

/* Solid of revolution. The profile runs from the bottom outwards, up and inwards. With MESH_NORMALS each of its sections is smooth
 * around the axis, and the edges between sections are sharp. */
void mesh_lathe(mesh_builder *m, const mesh_profile *profile, size_t n, size_t n_segments);

/* All six faces. */
void mesh_box(mesh_builder *m, mesh_point low, mesh_point high);

#endif
