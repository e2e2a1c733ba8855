/* Gnomon: lit 3D scenes with real shadows, in fixed point, in static memory, one screen tile at a time.
 *
 * The only public header. Conventions:
 * - right-handed world, +Y up; a camera looks along its local -Z; row-major 3x4 transforms, column vectors
 * - lengths and coordinates are Q15.16 (`_q16`); unit quantities Q1.30 (`_q30`); fractions 0..1 are 0..65536 (`_uq16`)
 * - angles are in turns, Q0.16 unsigned (`_turn`): they wrap
 * - pixel (0, 0) is the top left one, its centre at (1/2, 1/2); top-left fill rule; front faces are counter-clockwise
 * - colours are linear light; the output is sRGB-encoded unless GN_SRGB is 0
 * - every call returns a status; gn_status_text() says it in words, gn_detail names what and where
 *
 * A frame: describe a gn_scene, call gn_render() with a flush callback. Nothing is allocated, nothing is global: all
 * state is in gn_renderer (one static object, about 110 KB as configured by default, of which 34 KB serve the atlas of
 * spot and point lights: 73 KB with GN_OTHER_LIGHTS 0), so several can run in one program.
 */
#ifndef GNOMON_H
#define GNOMON_H

#include <limits.h>
#include <stddef.h>
#include <stdint.h>

#if INT_MAX < 2147483647
#error "Gnomon needs a core of 32 bits, whose int has 32: AVR (Arduino Uno, Nano, Mega) and MSP430 have 16"
#endif

#include "gn_knobs.h"
#ifdef GN_PREFIX
#include "gn_prefix.h"
#endif

/* The version of this library. */
#define GN_VERSION_MAJOR  0
#define GN_VERSION_MINOR  2
#define GN_VERSION_PATCH  0
#define GN_VERSION_STRING "0.2.0"

#ifdef __cplusplus
extern "C" {
#endif

/* Constants in user code: folded at compile time, round to nearest. */
#define GN_FIX_(x, one)  ((x) * (one) + ((x) < 0 ? -0.5 : 0.5))
#define GN_Q16(x)        ((int32_t)GN_FIX_(x, 65536.0))      /* -32768 .. 32767.99 */
#define GN_Q30(x)        ((int32_t)GN_FIX_(x, 1073741824.0)) /* -2 .. 1.99 */
#define GN_Q24(x)        ((uint32_t)GN_FIX_(x, 16777216.0))  /* 0 .. 255.99 */
#define GN_UQ16(x)       ((uint32_t)GN_FIX_(x, 65536.0))
#define GN_UQ20(x)       ((uint32_t)GN_FIX_(x, 1048576.0)) /* 0 .. 4095.99 */
#define GN_TURN(degrees) ((uint16_t)(int32_t)GN_FIX_((degrees) / 360.0, 65536.0))

/* ---- Status ------------------------------------------------------------------------------------------------------ */

#define GN_STATUS_LIST(X)                                                                                              \
    X(GN_OK, "ok")                                                                                                     \
    X(GN_ERR_NULL, "a required pointer is null")                                                                       \
    X(GN_ERR_PICTURE_SIZE, "picture width or height is 0 or above GN_MAX_WIDTH x GN_MAX_HEIGHT")                       \
    X(GN_ERR_FORMAT, "unknown pixel format or view, or one that is not built in")                                      \
    X(GN_ERR_KNOB, "a run-time knob is out of its range")                                                              \
    X(GN_ERR_NO_INIT, "call out of order: gn_init must be called before, and succeed")                                 \
    X(GN_ERR_NO_BEGIN, "call out of order: gn_begin must be called before, for each frame anew, and succeed")          \
    X(GN_ERR_NO_SHADOW_TILE, "call out of order: gn_shadow_tile must be called before for every tile, and succeed")    \
    X(GN_ERR_NO_PREPARE, "call out of order: gn_prepare or gn_render must be called before, and succeed")              \
    X(GN_ERR_INDEX, "no such tile or light")                                                                           \
    X(GN_ERR_CAMERA_FOCAL,                                                                                             \
      "camera focal length outside 1/32 .. 255.99, or half_height outside 1/256 .. 8192 units or not built in")        \
    X(GN_ERR_CAMERA_DEPTH, "camera near plane outside 1/256 .. 8192 units, or far not beyond near")                    \
    X(GN_ERR_CAMERA_TRANSFORM, "camera transform is not a rotation with a position inside +-8192, or the camera is "   \
                               "at its own target")                                                                    \
    X(GN_ERR_OBJECT_TRANSFORM,                                                                                         \
      "object transform has exponent outside 0..14, an entry above 1.0, or a position outside +-8192")                 \
    X(GN_ERR_MESH, "mesh has no vertices, no triangles, a null array, more than 30 fraction bits, or normals or "      \
                   "colours that gnomon config left out")                                                              \
    X(GN_ERR_MESH_INDEX, "mesh index is not below its vertex count")                                                   \
    X(GN_ERR_VERTEX_RANGE, "vertex position is beyond +-2^30, or +-16384 units from the camera or a spot or point "    \
                           "light, or a triangle would have to "                                                       \
                           "be clipped and that is not built in")                                                      \
    X(GN_ERR_COLOUR, "colour, albedo, ambient or background out of range")                                             \
    X(GN_ERR_BACKGROUND, "background_gradient is neither 0 nor 1; or a gradient, draw_behind or draw_over, which are " \
                         "not built in")                                                                               \
    X(GN_ERR_TEXTURE, "texture without texels or palette, or above 4096 per side, or texture coordinates are missing " \
                      "or have more than 15 fraction bits, or an emissive texture that clamps otherwise")              \
    X(GN_ERR_TEXTURE_FORMAT,                                                                                           \
      "unknown format of a texture, or one not built in (GN_TEXTURE_FORMATS), or smaller levels that are not "         \
      "(1024 more), or a mask image that is not RGBA8888")                                                             \
    X(GN_ERR_MATERIAL, "alpha, cutoff, specular or emissive colour or shininess out of range, or an alpha mode, "      \
                       "caster mode or such a colour or emissive texture that is not built in")                        \
    X(GN_ERR_MASK, "mask image without coordinates, or masks or baked light where they are not built in")              \
    X(GN_ERR_SKIN, "skin: a null array, a joint transform out of range, or too many joints per vertex")                \
    X(GN_ERR_SKIN_JOINT, "skin: joint index out of range")                                                             \
    X(GN_ERR_SKIN_WEIGHTS, "skin: weights of a vertex are not 255 in all")                                             \
    X(GN_ERR_TOO_MANY_OBJECTS, "more objects than GN_MAX_OBJECTS")                                                     \
    X(GN_ERR_TOO_MANY_LIGHTS, "more lights than GN_MAX_LIGHTS")                                                        \
    X(GN_ERR_LIGHT_KIND, "unknown kind, mode or softness of light, or one that is not built in")                       \
    X(GN_ERR_LIGHT_DIRECTION, "light direction is zero")                                                               \
    X(GN_ERR_LIGHT_POSITION, "light position outside +-8192 units")                                                    \
    X(GN_ERR_LIGHT_RANGE,                                                                                              \
      "light range, or distance of its near plane, below 1/256 unit, or near above 8192 units or not below range")     \
    X(GN_ERR_LIGHT_ANGLE, "spot angles outside 1 .. 179 degrees, or inner above outer")                                \
    X(GN_ERR_LIGHT_BIAS, "light strength, bias, near offset, colour exponent or mask channel out of range, or a bias " \
                         "or a shadow that is not built in")                                                           \
    X(GN_ERR_SURFACE_LIGHTS, "more lights can affect one surface than GN_SURFACE_LIGHTS")                              \
    X(GN_ERR_SHADOW_DISTANCE, "shadow distance outside 1/256 .. 8192 units, or not beyond the camera's near plane")    \
    X(GN_ERR_SHADOW_FADE, "distance fade or cascade fade outside 0.001 .. 1")                                          \
    X(GN_ERR_SHADOW_FILTER, "unknown shadow filter, one that is not built in, or disk samples outside 1..64")          \
    X(GN_ERR_SHADOW_MODE, "unknown mixing, tile sizes, refresh or list length, or one that is not built in")           \
    X(GN_ERR_SHADOW_CASCADES,                                                                                          \
      "more than 4 cascades, ratios above 1 or not ascending, or a blend that is not built in")                        \
    X(GN_ERR_SHADOW_TILE, "shadow tile would be smaller than 8 texels")                                                \
    X(GN_ERR_ATLAS_FULL, "shadow tiles take more texels than GN_ATLAS_TEXELS or GN_OTHER_ATLAS_TEXELS")                \
    X(GN_ERR_TRIANGLES_FULL, "more visible triangles than GN_MAX_TRIANGLES")                                           \
    X(GN_ERR_TILE_REFS_FULL, "more tile references than GN_MAX_TILE_REFS")                                             \
    X(GN_ERR_CONFIG,                                                                                                   \
      "program and library were compiled with different configurations: the size of gn_renderer or a knob differs")    \
    X(GN_ERR_REENTERED, "the flush callback called the renderer that was drawing")

#define GN_STATUS_ENUM_(name, text) name,
typedef enum { GN_STATUS_LIST(GN_STATUS_ENUM_) GN_STATUS_COUNT } gn_status;

#include "gn_field.h"

/* What the last failing call was about. */
typedef struct {
    gn_status status;
    gn_field field;     /* that is wrong, with GN_VALIDATION 2; GN_FIELD_NONE: no single one */
    uint32_t index;     /* of the object, light, triangle or tile it concerns; 0 where there is only one */
    uint32_t needed;    /* capacity errors: how much would have been enough; otherwise 0 */
    uint32_t available; /* capacity errors: how much there is */
} gn_detail;

const char *gn_status_text(gn_status status);

/* ---- Transforms -------------------------------------------------------------------------------------------------- */

/* p' = m * 2^(exp - 30) * p + t. Entries |m| <= 2^30 (1.0); the shared exponent 0..14 carries scales up to 16384.
 * An object whose m mirrors (its determinant is negative) is drawn right: its triangles are clockwise on the screen.
 * One whose m has no inverse (a scale of 0 along some axis) is not drawn, casts nothing, and is no error. */
typedef struct {
    int32_t m_q30[3][3];
    int32_t t_q16[3];
    int32_t exp;
} gn_affine;

/* Rotations are exact to 8 units of Q1.30. Results are rounded to nearest; translations saturate at the Q15.16 range.
 * Products of many rotations drift by about one unit each: turn by absolute angles, or orthonormalise now and then. */
void gn_affine_identity(gn_affine *out);
/* Ry * Rx * Rz: roll acts first, yaw last. */
void gn_affine_rotation(gn_affine *out, uint16_t yaw_turn, uint16_t pitch_turn, uint16_t roll_turn);
void gn_affine_scale(gn_affine *inout, int32_t scale_q16); /* object space, |scale| < 8192; negative: mirrors */
void gn_affine_mul(gn_affine *out, const gn_affine *a, const gn_affine *b); /* out = a * b; out may be a or b */
/* A rotation (exp 0) back to right angles; the third axis keeps its direction. */
void gn_affine_orthonormalise(gn_affine *inout);
/* +Y up. Eye and target must differ: else *out is no rotation, and gn_begin refuses it (GN_ERR_CAMERA_TRANSFORM). */
void gn_camera_look_at(gn_affine *out, const int32_t eye_q16[3], const int32_t target_q16[3]);
uint32_t gn_focal_from_fov_q24(uint16_t vertical_fov_turn); /* 1 / tan(fov / 2), Q8.24, saturates */
/* |error| <= 2 LSB. Times a radius r_q16: (int32_t)((int64_t)gn_sin_q30(a) * r_q16 >> 30). */
int32_t gn_sin_q30(uint16_t angle_turn);
int32_t gn_cos_q30(uint16_t angle_turn);

/* ---- Scene: described by the caller ------------------------------------------------------------------------------
 *
 * Pointers. Each argument of a call need live no longer than the call, but:
 * - gn_renderer, gn_frame, gn_scratch: from gn_init to the last call; most programs have them static
 * - a gn_scene, its lights and fixed_fits, draw_user: from gn_begin to the frame's last screen tile; with gn_render
 *   until it returns: they may be local variables
 * - its objects, and what they lead to (meshes, textures, palettes, masks, skins, joints): as long, and as they were
 *   until the last gn_pick of that frame. Make them static or const
 * - mesh and texture arrays are known again by their addresses: after their contents change, gn_forget_shadows()
 * - what gn_get_stats and gn_get_detail return: as long as the renderer; gn_init and gn_begin write it anew. The depth
 *   of a gn_tile_info: until the next gn_begin. Texts of gn_status_text and gn_field_text: always
 * - the pixels that a callback gets: until it returns. A gn_panel: as long as the panel shows what was drawn by it */

#include "gn_scene_types.h"

/* ---- Models and their animation: what gnomon asset writes ---------------------------------------------------------
 */

#include "gn_rig.h"

/* ---- Rendering --------------------------------------------------------------------------------------------------- */

typedef enum {
    GN_FORMAT_RGB565,         /* uint16_t per pixel, native byte order, red in the high bits */
    GN_FORMAT_RGB888,         /* 3 bytes per pixel: red, green, blue */
    GN_FORMAT_RGB565_SWAPPED, /* RGB565 with its two bytes exchanged, as many panels want it */
    GN_FORMAT_GREY8,          /* a byte per pixel */
    GN_FORMAT_GREY4,          /* two pixels per byte, the left one in the high bits; rows begin on a byte */
    GN_FORMAT_MONO1, /* eight pixels per byte, the left one in the highest bit, 1 = light; rows begin on a byte; ordered
                        dither */
    GN_FORMAT_RAW32  /* with GN_PICTURES 8: uint32_t per pixel, see gn_view; all ones where there is no surface */
} gn_format;

typedef enum {
    GN_VIEW_COLOUR,
    GN_VIEW_SHADOW,  /* raw: shadow factor of light `view_light`, 0..65536, 0 where the surface faces away */
    GN_VIEW_DEPTH,   /* raw: view depth, Q15.16 */
    GN_VIEW_CASCADE, /* raw: cascade of the surface point, 4: none */
    GN_VIEW_NORMAL,  /* raw: shading normal, 10 bits per axis (x high), offset 512, 511 = 1 */
    GN_VIEW_TRIANGLE /* raw: object index << 16 | triangle index */
} gn_view;

typedef struct {
    uint16_t width, height;
    gn_format format;
    gn_view view; /* anything but colour needs GN_FORMAT_RAW32 */
    uint8_t view_light;
} gn_picture;

/* A finished screen tile: w * h pixels, row after row without gaps (GREY4 and MONO1: rows of whole bytes), top left at
 * (x, y), x a multiple of the tile's width. The buffer is reused after the call returns. */
typedef void (*gn_flush_fn)(void *user, int x, int y, int w, int h, const void *pixels);

/* Bytes of w * h pixels as they are flushed, rows of whole bytes; w and h below 2^15. */
static inline size_t gn_format_bytes(gn_format format, uint32_t w, uint32_t h)
{
    switch (format) {
    case GN_FORMAT_RGB565:
    case GN_FORMAT_RGB565_SWAPPED:
        return (size_t)2 * w * h;
    case GN_FORMAT_GREY8:
        return (size_t)w * h;
    case GN_FORMAT_GREY4:
        return (size_t)((w + 1) / 2) * h;
    case GN_FORMAT_MONO1:
        return (size_t)((w + 7) / 8) * h;
    case GN_FORMAT_RAW32:
        return (size_t)4 * w * h;
    default:
        return (size_t)3 * w * h;
    }
}

typedef struct {
    uint32_t n_triangles; /* visible, after culling and clipping */
    uint32_t n_tile_refs;
    uint32_t n_clipped; /* triangles that met the near plane or the guard band */
    uint32_t n_shadow_tiles;
    uint32_t n_caster_triangles;    /* drawn into shadow tiles */
    uint32_t n_reach_clamped;       /* views whose filter radius and bias exceed their tile: taps are clamped */
    uint32_t n_lights_without_room; /* lights that requested a shadow and got no tile */
    uint32_t n_lights_left_out;     /* lights dropped from the objects' light lists, summed over all objects */
    uint32_t n_tiles_drawn;         /* shadow tiles that were drawn, not kept */
    uint32_t n_texels_drawn;        /* of those tiles */
    uint32_t n_casters_culled;      /* objects not drawn into a cascade */
#if GN_TIGHT_FIT || GN_RUNTIME_KNOBS
    uint32_t n_outside_fixed_fit; /* views that see more than their fixed box holds: fitted to what they see */
#endif
#if GN_GROUPS
    uint32_t n_tile_triangles; /* with triangle_groups: of the screen tile that has most */
#endif
#if GN_CHANGES || GN_RUNTIME_KNOBS
    uint32_t n_screen_tiles_drawn;   /* by gn_render_changes; 0: nothing changed, and nothing was done */
    uint32_t n_screen_tiles_flushed; /* of those: the others look as they did */
#endif
} gn_stats;

#if GN_RUNTIME_KNOBS
#define GN_KNOB_FIELD_(name, MACRO, lo, hi, meaning, cost) int32_t name;
typedef struct {
    GN_QUALITY_KNOBS(GN_KNOB_FIELD_)
} gn_knobs;
#endif

/* The layout of the state is private. It is included here so that the caller can declare it static. */
#include "frame/gn_state.h"

typedef struct gn_renderer {
    gn_frame frame;
    gn_scratch scratch;
} gn_renderer;

#include "frame/gn_config_signature.h"

/* gn_init below, with the caller's configuration. */
gn_status gn_init_as(gn_renderer *r, const gn_picture *picture, size_t renderer_bytes, uint64_t config_signature);

/* Clears the renderer and sets what it draws. Must be the first call. A program and a library that were compiled with
 * different configurations would overwrite each other's memory: GN_ERR_CONFIG, and nothing is written. */
static inline gn_status gn_init(gn_renderer *r, const gn_picture *picture)
{
    return gn_init_as(r, picture, sizeof(gn_renderer), GN_CONFIG_SIGNATURE);
}

/* One frame: begin, all shadow tiles, prepare, all screen tiles. Nothing is flushed if it fails. Calls of the renderer
 * in its flush callback are refused; gn_init there ends the frame with GN_ERR_REENTERED. */
gn_status gn_render(gn_renderer *r, const gn_scene *scene, gn_flush_fn flush, void *user);

/* The same in steps, for time slicing and several cores. The scene and all that it leads to must live and stay
 * unchanged until the last screen tile. */
gn_status gn_begin(gn_renderer *r, const gn_scene *scene); /* validates; fits the lights' views */
uint32_t gn_shadow_tile_count(const gn_renderer *r);
gn_status gn_shadow_tile(gn_renderer *r, uint32_t tile_idx); /* each once, any order */
gn_status gn_prepare(gn_renderer *r);                        /* visible triangles, binned */
uint32_t gn_screen_tile_count(const gn_renderer *r);
/* After gn_prepare the frame is read only: cores may draw different tiles at once, each with its own scratch. */
gn_status gn_screen_tile(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, gn_flush_fn flush, void *user);

const gn_stats *gn_get_stats(const gn_renderer *r);
const gn_detail *gn_get_detail(const gn_renderer *r);

/* Whether a light got a shadow map in the frame that was begun last, and why it has none. NOT_WANTED: it is baked, or
 * its shadow_strength is 0. NO_CASTER: requested, but within its range nothing casts, or nothing receives. NO_ROOM:
 * requested, but its atlas has too few tiles left. tile_texels: the longest side of its tiles; gn_get_shadow_tile tells
 * each, and why. */
typedef enum { GN_SHADOW_NOT_WANTED, GN_SHADOW_REALTIME, GN_SHADOW_NO_ROOM, GN_SHADOW_NO_CASTER } gn_shadow_state;
gn_shadow_state gn_get_light_shadow(const gn_renderer *r, uint32_t light_idx, uint32_t *n_tiles, uint32_t *tile_texels);

/* Whether a view, a light's cascade or face, has a tile, and why it has none. */
typedef enum {
    GN_TILE_GRANTED,
    GN_TILE_NO_SHADOW, /* the light has no shadow map or no such view: see gn_get_light_shadow */
    GN_TILE_NO_SLICE,  /* the cascade covers no view depths */
    GN_TILE_UNSEEN     /* tiles by worth: no visible receiver looks into it */
} gn_tile_state;

/* The shadow tile of a view: texels, 0 if it has none, and depths row by row, all ones = empty. */
typedef struct {
    uint32_t texels;     /* per row */
    uint32_t depth_bits; /* 8, 16 or 32: uint8_t, uint16_t or uint32_t per texel */
    const void *depth;
    uint32_t rows;
    gn_tile_state state;
    uint64_t worth_q16; /* tiles by worth: pixels of its receivers on the screen, Q48.16, which decide its share of the
                           atlas; else 0 */
} gn_tile_info;
uint32_t gn_get_shadow_tile(const gn_renderer *r, uint32_t light_idx, uint32_t view_idx, gn_tile_info *info);

#if !GN_COMPACT
/* The object and its triangle that a pixel of the frame prepared last shows; both GN_NOTHING where there is none.
 * Either pointer may be NULL. The objects, and what they lead to, must live and be as they were when the frame was
 * begun; gn_scene, its lights and its camera are not read: they may be gone. It takes the time of one screen tile's
 * visible surfaces and uses the renderer's scratch: not while another core draws with that. */
#define GN_NOTHING UINT32_MAX
gn_status gn_pick(gn_renderer *r, uint32_t x, uint32_t y, uint32_t *object_idx, uint32_t *triangle_idx);
#endif

/* Forgets what is kept from earlier frames: call it after changing mesh or texture data in place. */
void gn_forget_shadows(gn_renderer *r);

/* What the panel shows: signatures of each screen tile, by which only what differs is sent. Clear it (memset 0) when
 * the panel's content is unknown, after gn_init, and when another renderer takes the panel over. Two different tiles
 * have the same signature with probability 2^-64.
 *
 * With GN_INCREMENTAL 2 a tile is not even drawn if nothing changed that it depends on: camera, settings, its objects
 * and their joints, lights, texels of shadow maps that it looked up. That nothing changed at all takes less than 3 % of
 * a frame to find: then gn_stats.n_screen_tiles_drawn is 0, and firmware may sleep. Two things are not looked at:
 * contents of arrays (gn_forget_shadows), and what draw_behind and draw_over draw (gn_touch). */
typedef struct {
    uint64_t signature[GN_TILES_MAX]; /* of its bytes */
#if GN_CHANGES
    uint64_t inputs[GN_TILES_MAX];    /* of what it depends on; 0: it is to be drawn */
    gn_squares squares[GN_TILES_MAX]; /* of shadow maps, that it looked up */
#endif
} gn_panel;
/* A tile sets *flushed to 1 or 0; `flushed` may be NULL. */
gn_status gn_screen_tile_if_changed(const gn_frame *frame, gn_scratch *scratch, uint32_t tile_idx, gn_panel *panel,
                                    gn_flush_fn flush, void *user, uint32_t *flushed);
/* A whole frame like that. *n_flushed counts flushed tiles; n_flushed may be NULL. What draw_behind and draw_over draw
 * counts as pixels, of the tiles that are drawn. */
gn_status gn_render_changes(gn_renderer *r, const gn_scene *scene, gn_panel *panel, gn_flush_fn flush, void *user,
                            uint32_t *n_flushed);
#if GN_CHANGES
/* A rectangle of the picture is to be drawn and sent again in the next frame, as something in it changes that the
 * renderer does not know of: what draw_over draws, such as a gauge's figures; what the caller itself drew onto the
 * panel, once it is gone. Parts outside the picture are left out. The first frame needs none. */
void gn_touch(const gn_renderer *r, gn_panel *panel, int x, int y, int w, int h);
#endif

#ifdef __cplusplus
}
#endif

#endif
