/* The OBJ loader's inside: obj_text.c reads lines, obj_mtl.c materials, obj.c statements, obj_polygon.c cuts faces,
 * obj_inside_out.c looks at how they are wound, obj_mesh.c makes the meshes.
 */
#ifndef GNOMON_HOST_OBJ_H
#define GNOMON_HOST_OBJ_H

#include "../core/loader.h"

/* A cursor over a text file, one logical line at a time. */
typedef struct {
    loader *l;
    const char *path;
    char *next; /* behind the current line */
    char *end;
    char *at;        /* within the current line, which is zero-terminated */
    size_t line;     /* number of its first line */
    size_t n_lines;  /* lines read so far */
    bool any_number; /* obj_numbers: NAN for what is not finite, or too large */
    bool forgiving;  /* obj_fail does not end the load: it sets ... */
    char wrong[512]; /* ... what is wrong with the line, or the file; else empty */
} obj_text;

bool obj_open(obj_text *t, loader *l, const char *path, uint8_t *bytes, size_t n_bytes, bool forgiving);
/* The next line that is not empty, without comment, which begins with a # behind a blank; backslash at a line's end
 * joins it with the next. */
bool obj_next_line(obj_text *t);
/* The next blank-separated word, or NULL. */
char *obj_next_word(obj_text *t);
/* The rest of the line without surrounding blanks. */
char *obj_rest(obj_text *t);
/* Up to n_max numbers; *n tells how many the line has. Anything else on the line is an error. */
bool obj_numbers(obj_text *t, double *out, size_t n_max, size_t *n);
bool obj_fail(obj_text *t, const char *format, ...) LOADER_PRINTF(2, 3);
bool obj_remark(obj_text *t, const char *format, ...) LOADER_PRINTF(2, 3);
bool obj_spend(obj_text *t, budget_kind kind, size_t n);

typedef struct {
    const char *name;
    double albedo[3], alpha, emissive[3];
    size_t texture_idx, emissive_texture_idx; /* of the scene, or SCENE_NONE */
    bool defined;                             /* by a material library */
    bool glows;                               /* it has a Ke */
    uint32_t next;                            /* of its bucket, 1 + index; 0: none */
} obj_material;

typedef struct {
    const char *name;
    uint32_t next; /* as above */
} obj_object;

enum { OBJ_BUCKETS = 1024 };

#define OBJ_NONE UINT32_MAX

enum { OBJ_MAX_CORNERS = 4096 }; /* of a face */

typedef struct {
    uint32_t v, vt, vn; /* indices; vt, vn OBJ_NONE where the corner has none */
} obj_corner;

/* A face in its plane: corners of which each knows its neighbours. */
typedef struct {
    double at[OBJ_MAX_CORNERS][2];
    uint32_t next[OBJ_MAX_CORNERS], prev[OBJ_MAX_CORNERS];
} obj_outline;

typedef struct {
    loader *l;
    size_t n_v, n_vt, n_vn, n_triangles, n_materials; /* v, vt, vn: all of the file */
    obj_corner so_far;                                /* those before the statement that is being read */
    double *v, *vt, *rgb,
        *vn;                /* vt: 2 each, v upwards as in the file; rgb: per v, white where a vertex has no colour */
    bool has_rgb, has_vn;   /* a vertex has a colour; a corner has a normal */
    obj_corner *corner;     /* 3 * n_triangles */
    uint32_t *material_of;  /* per triangle */
    obj_material *material; /* in order of first use or definition; [0]: triangles before any usemtl */
    uint32_t current_material;
    obj_object *object;  /* [0]: what is before any, or all of a file whose objects are not told apart */
    uint32_t *object_of; /* per triangle */
    size_t n_objects;
    size_t n_crossing;        /* faces */
    size_t n_lost, lost_line; /* faces that name no vertex, or one without a place; the first */
    size_t n_compared;        /* corners with ears, see obj_polygon.c */
    obj_outline *flat;        /* of the face that is being cut; NULL: none was yet */
    uint32_t current_object;
    char object_word; /* of the statements that begin objects: 'o', of files without them 'g'; 0: none does */
    uint32_t bucket[OBJ_BUCKETS]; /* materials by name: the first of each, 1 + index */
    uint32_t object_bucket[OBJ_BUCKETS];
    const char **library; /* paths of the material libraries that were read */
    size_t n_libraries;
} obj_file;

/* obj_mtl.c */
uint32_t *obj_bucket(uint32_t bucket[OBJ_BUCKETS], const char *name);
bool obj_find_material(obj_file *o, obj_text *t, const char *name, uint32_t *out); /* makes it if need be */
bool obj_read_libraries(obj_file *o, obj_text *t);
bool obj_finish_materials(obj_file *o);

/* obj.c */
bool obj_add_triangle(obj_file *o, const obj_corner *a, const obj_corner *b, const obj_corner *c);

/* obj_inside_out.c: says so if the closed surfaces of the file show their backs to the outside. */
bool obj_remark_inside_out(const obj_file *o);

/* obj_polygon.c: a face of n >= 3 corners as triangles. *crosses: it
 * crosses itself, so that none are right; or finding them would take too long. */
bool obj_cut_polygon(obj_file *o, const obj_corner *corners, size_t n, bool *crosses);

/* obj_mesh.c: one object and mesh (more if too large) per object and its material. */
bool obj_emit(obj_file *o);

#endif
