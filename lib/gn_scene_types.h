/* What a caller describes: meshes, textures, objects, lights, the camera, the scene, and their defaults. A part of
 * gnomon.h, which includes it; its comment on pointers says how long each must live. Nothing here is written to by the
 * library, but for what gn_pose places. */
#ifndef GN_SCENE_TYPES_H
#define GN_SCENE_TYPES_H

/* With quality knobs as data, the wide types are used: every narrow value fits. */
#if GN_SHORT_VERTICES % 2 && !GN_RUNTIME_KNOBS
typedef int16_t gn_position;
#else
typedef int32_t gn_position;
#endif
#if GN_SHORT_VERTICES >= 2 && !GN_RUNTIME_KNOBS
typedef int8_t gn_normal;
#else
typedef int16_t gn_normal;
#endif

typedef struct {
    const gn_position *pos;   /* 3 per vertex, |pos| <= 2^30, `pos_frac_bits` fraction bits */
    const gn_normal *nrm_q15; /* 3 per vertex, a direction (its length does not matter), or NULL: face normals */
    const uint16_t *rgb_uq16; /* 3 per vertex, linear, 65535 = 1, or NULL: white */
    const int16_t *uv; /* 2 per vertex, texture coordinates with `uv_frac_bits` fraction bits, v downwards, or NULL */
    const uint16_t *mask_uv_uq16; /* 2 per vertex, of the mask image, 65535 = 1, or NULL */
    const uint16_t *idx;          /* 3 per triangle */
    uint16_t n_vertices;
    uint16_t n_triangles;
    uint8_t pos_frac_bits; /* 0..30; 16 for positions written with GN_Q16 */
    uint8_t uv_frac_bits;  /* 0..15 */
} gn_mesh;

/* What moves an object's vertices before its to_world: each to the mean of where its joints take it, by its weights. */
typedef struct {
    /* n_joints: from the mesh's space, as stored, to the object's, as posed now. Each takes its vertices to within
     * +-16384 units; it may flatten. Joints that mirror turn all triangles: the first that has an inverse tells. */
    const gn_affine *joint;
    const uint8_t *joint_idx; /* per_vertex for each of the mesh's vertices */
    const uint8_t *weight_u8; /* the same; 255 is 1, and those of a vertex are 255 in all */
    uint16_t n_joints;
    uint8_t per_vertex; /* 1 .. GN_VERTEX_JOINTS */
} gn_skin;

/* gn_texture.flags */
enum {
    GN_TEXTURE_CLAMP_U = 1, /* else it repeats */
    GN_TEXTURE_CLAMP_V = 2,
    GN_TEXTURE_BILINEAR = 4, /* else nearest */
    GN_TEXTURE_MASK_1 = 8,   /* mask images only: one byte per texel, channel 0; the others are lit */
    GN_TEXTURE_MASK_2 = 16,  /* two */
    /* Behind the texels come those of half the size, a quarter and so on, down to one texel: sides are halved and
     * rounded down, and at least 1. Colours are read from the level whose texels are nearest to a pixel's size; alpha
     * always from the first. Not of mask images. */
    GN_TEXTURE_MIPMAPPED = 32
};

/* gn_texture.format; GN_TEXTURE_FORMATS says which are built. Colours are sRGB, alpha is linear. Where a texel is less
 * than a byte, the first one is in the highest bits, and each row begins with a byte of its own. */
typedef enum {
    GN_TEXTURE_RGBA8888, /* 4 bytes: red, green, blue, alpha */
    GN_TEXTURE_RGB565,   /* 2 bytes, the lower one first: red in bits 15..11, green 10..5, blue 4..0; alpha is 1 */
    GN_TEXTURE_RGB565A1, /* the same, but bit 5, green's lowest, is the alpha: red, green and blue have 5 bits each */
    GN_TEXTURE_PALETTE8, /* an index of the palette: 8, 4 or 1 bit */
    GN_TEXTURE_PALETTE4,
    GN_TEXTURE_PALETTE1,
    GN_TEXTURE_GREY8, /* red, green and blue are equal, alpha is 1: 8 or 4 bits */
    GN_TEXTURE_GREY4,
    GN_TEXTURE_ALPHA8, /* white, and an alpha of 8 or 4 bits */
    GN_TEXTURE_ALPHA4,
    GN_TEXTURE_FORMAT_COUNT
} gn_texture_format;

typedef struct {
    const uint8_t *rgba;             /* texels of any format, rows from the top; smaller levels */
    uint8_t width_log2, height_log2; /* 0..12; not looked at where width and height are set */
    uint8_t flags;
    uint8_t format;         /* gn_texture_format */
    uint16_t width, height; /* 1..4096 texels; 0: 2^width_log2, 2^height_log2 */
    const uint8_t *palette; /* palettes: 4 bytes per entry, as in GN_TEXTURE_RGBA8888; 256, 16 or 2 entries */
} gn_texture;

/* gn_object.flags */
enum {
    GN_OBJECT_CASTS = 1,
    GN_OBJECT_RECEIVES = 2,
    GN_OBJECT_TWO_SIDED = 4,
    GN_OBJECT_UNLIT = 8,
    GN_OBJECT_HIDDEN = 16,          /* casts, but is not seen */
    GN_OBJECT_CASTS_TWO_SIDED = 32, /* two-sided as a caster only */
    GN_OBJECT_MOVING = 64,          /* with GN_INCREMENTAL 3 its shadow is drawn over a kept one of the others */
    GN_OBJECT_DEFAULT = GN_OBJECT_CASTS | GN_OBJECT_RECEIVES
};

typedef enum { GN_ALPHA_OPAQUE, GN_ALPHA_CLIP, GN_ALPHA_DITHER, GN_ALPHA_BLEND } gn_alpha;

/* Colours here are linear, and 65536 is 1: write GN_UQ16(0.5). Values of 0..255 are allowed, and as good as black. */
typedef struct {
    const gn_mesh *mesh;
    gn_affine to_world;      /* |position| <= 8192 units; may mirror; without an inverse (scale 0) nothing is drawn */
    uint32_t albedo_uq16[3]; /* linear, 0..65536 */
    uint32_t flags;
    gn_alpha visible_alpha; /* clip: no surface where alpha is below the cutoff; dither: where it is below the noise;
                               blend: mixed with what is behind it, dithered without GN_TRANSPARENT_LAYERS */
    gn_alpha caster_alpha;  /* the same for its shadow; not blend */
    uint32_t alpha_uq16;    /* 0..65536, times the texture's; matters where an alpha mode does */
    uint32_t alpha_cutoff_uq16; /* 0..65536 */
    uint32_t specular_uq16[3];  /* linear, 0..65536; 0: none */
    uint8_t shininess_log2;     /* exponent 2^0 .. 2^7 */
    uint32_t emissive_uq16[3];  /* linear, 0..255.99: light of its own, over what it reflects; not if unlit */
    const gn_texture *texture;  /* or NULL */
    const gn_texture
        *emissive_texture;        /* its colour times emissive_uq16, or NULL; clamps as `texture`, if there is one */
    const gn_texture *mask_image; /* shadow masks at the mesh's mask_uv_uq16, bilinear and clamped, or NULL */
    const uint8_t *mask_u8;       /* shadow masks, 4 per vertex of the mesh, or NULL */
    const uint16_t *baked_uq12;   /* 3 per vertex of the mesh, irradiance of the baked lights, 4.12, or NULL */
    const gn_skin *skin;          /* or NULL */
} gn_object;

typedef enum { GN_LIGHT_DIRECTIONAL, GN_LIGHT_SPOT, GN_LIGHT_POINT } gn_light_kind;
/* Mixed is realtime with a shadow mask; baked costs nothing. */
typedef enum { GN_LIGHT_REALTIME, GN_LIGHT_MIXED, GN_LIGHT_BAKED } gn_light_mode;
/* A light's filter: that of its atlas; 2x2; that of its atlas, but at least 5x5. */
typedef enum { GN_SOFTNESS_DEFAULT, GN_SOFTNESS_HARD, GN_SOFTNESS_SOFT } gn_softness;
typedef enum {
    GN_AUTO_BIAS_DEFAULT, /* depth; off if bias_normal_q16 or bias_receiver_q16 is set. Where automatic bias is not
                             built, a light that casts shadows must set another bias, or say off */
    GN_AUTO_BIAS_DEPTH,   /* less depth: nearest to exact shadows */
    GN_AUTO_BIAS_NORMAL,  /* along the face's normal: the smallest gap at a caster's foot, but corners between walls
                             are dark */
    GN_AUTO_BIAS_OFF
} gn_auto_bias;

typedef struct {
    gn_light_kind kind;
    gn_light_mode mode;
    int32_t direction[3];    /* directional: of travel, spot: of the axis; any length but zero */
    int32_t position_q16[3]; /* spot, point */
    uint32_t colour_uq16[3]; /* linear colour * intensity, 0..255.99; spot, point: at distance 1 */
    int32_t colour_exp; /* times 2^colour_exp, -100..100: spots and points need a wide range; directional: up to 255.99
                           in all */
    uint32_t range_q16; /* spot, point: no light beyond; 0: unlimited */
    int32_t near_q16;   /* spot, point: nothing nearer than this light-plane distance casts; > 0 */
    uint16_t inner_turn, outer_turn; /* spot: full light within, none beyond; edge to edge, 1..179 degrees */
    uint32_t shadow_strength_uq16;   /* 0: casts no shadow and costs nothing; 65536: full */
    gn_softness softness;
    int32_t mask_channel;         /* of the shadow masks, 0..3; -1: none; mixed lights only */
    int32_t bias_constant_q16;    /* of casters, texels, 0..64 */
    int32_t bias_slope_q16;       /* of casters, times their slope, 0..64 */
    int32_t bias_normal_q16;      /* receivers move along their normals, texels * sqrt(2) * (filter index + 1), 0..8 */
    int32_t bias_receiver_q16[4]; /* along the light, its tangent, the normal, its sine; 0..8 each */
    int32_t bias_caster_q16;      /* casters shrink along their normals, texels, 0..8 */
    uint32_t receiver_plane;      /* 1: every tap compares with the depth of the receiver's plane */
    gn_auto_bias auto_bias;  /* the smallest bias that leaves a plane no acne, in place of normal and receiver bias */
    int32_t near_offset_q16; /* directional: pulls the light's near plane back, world units, 0..8192 */
} gn_light;

typedef struct {
    gn_affine to_world;      /* a rotation (exp 0) and a position; looks along its local -Z */
    uint32_t focal_q24;      /* 1 / tan(vertical fov / 2), 1/32 .. 255.99; not used by an orthographic camera */
    int32_t half_height_q16; /* orthographic: half of what the picture shows from top to bottom, 1/256 .. 8192 units;
                                0: perspective. Every pixel is shaded for itself, whatever GN_PERSP_STEP */
    int32_t near_q16;        /* surfaces nearer than this are clipped */
    int32_t far_q16;         /* only limits the shadow distance */
} gn_camera;

typedef enum { GN_FILTER_HARD, GN_FILTER_2X2, GN_FILTER_3X3, GN_FILTER_5X5, GN_FILTER_7X7, GN_FILTER_DISK } gn_filter;
/* Of baked and realtime shadows. */
typedef enum { GN_MIXING_NONE, GN_MIXING_ALWAYS, GN_MIXING_DISTANCE } gn_mixing;
typedef enum { GN_TILES_EQUAL, GN_TILES_IMPORTANCE, GN_TILES_WORTH } gn_tile_sizes;
/* What a directional light's tile covers: the sphere around its cascade, or what is visible in it where something
 * casts. */
typedef enum { GN_FIT_STABLE, GN_FIT_TIGHT } gn_fit;

/* Between cascades. */
typedef enum { GN_BLEND_HARD, GN_BLEND_SOFT, GN_BLEND_DITHER } gn_blend;
/* What the shadow distance is measured by: view depth, or distance from the camera. */
typedef enum { GN_DISTANCE_DEPTH, GN_DISTANCE_RADIUS } gn_distance_mode;

#define GN_OBJECT_LIGHTS_MAX 8

/* A box that stands still in the world: a tight tile of a directional light covers it in every frame that sees nothing
 * outside of it. Along the light's u, v, w from the world's origin. */
typedef struct {
    uint16_t light_idx;
    uint8_t cascade_idx; /* of a single tile: 0 */
    int32_t lo_q16[3], hi_q16[3];
    uint32_t worth_px; /* pixels that its tile is worth */
} gn_fixed_fit;

typedef struct {
    int32_t max_distance_q16;    /* no shadows beyond */
    uint32_t distance_fade_uq16; /* the last part of that distance, 66 (0.001) .. 65536 */
    uint32_t cascade_fade_uq16;  /* the last part of the last cascade, 66 .. 65536 */
    gn_filter filter;            /* of the directional atlas */
    gn_filter other_filter;      /* of the local-light atlas: spot and point lights, and single tiles (main_light) */
    uint32_t penumbra_uq16;      /* disk radius: directional in 0.02 units, spot and point in 0.004 tiles; 0 .. 64.0 */
    uint32_t disk_samples;       /* disk filter: 1..64 */
    gn_mixing mixing;
    gn_tile_sizes tile_sizes; /* worth: by pixels that are looked up; needs the knob tile_sizes 2. Default of all
                                 presets but accurate */
    gn_fit fit;               /* tight needs that, too. Default of all presets but accurate */
    uint32_t main_light;      /* 1: only the brightest directional light has cascades; others take one tile of the
                                 local-light atlas */
    uint32_t caster_culling;  /* 1: the same pixels, fewer casters */
    uint32_t object_lights;   /* maximum of spot and point lights per object, 0 (no limit) .. 8 */
    uint32_t refresh[4];      /* cascade i is drawn anew every refresh[i]th frame; 0 as 1 */
    uint32_t n_cascades;      /* 0 (as 1) .. 4; each takes a tile of the atlas */
    uint32_t cascades_unused; /* bit i: cascade i has no tile, and pixels in it look into the next: for scenes that
                                 never do */
    uint32_t cascade_ratio_uq16[3]; /* where cascades 0, 1, 2 end, as fractions of the max distance, ascending; the last
                                       ends there */
    gn_blend blend;                 /* anything but hard needs GN_MANY_CASCADES 2 */
    gn_distance_mode distance_mode;
    const gn_fixed_fit *fixed_fits; /* or NULL: by `gnomon compile`, for a whole animation; of tight fits alone */
    uint32_t n_fixed_fits;
} gn_shadow_settings;

/* Drawing of the caller's into a screen tile: w * h pixels in the picture's format, laid out as they are flushed
 * (gn_flush_fn), top left at (x, y) of the picture. What it writes must depend on the pixels' places in the picture
 * alone, and not on the tile: tiles begin anywhere. Bits behind a row's last pixel (GREY4, MONO1) must stay as they
 * are. It is called once per tile and frame, by the core that draws the tile. */
typedef void (*gn_draw_fn)(void *user, int x, int y, int w, int h, void *pixels);

typedef struct {
    const gn_object *objects;
    const gn_light *lights;
    uint32_t n_objects; /* up to 65535 */
    uint32_t n_lights;
    gn_camera camera;
    int32_t unit_log2; /* one unit of length is 2^-unit_log2 of the model's: scales the minimum squared distance 10^-4
                          of spot and point lights, and the penumbra; -30 .. 30 */
    uint32_t ambient_uq16[3];           /* 0..255.99 */
    uint32_t background_uq20[3];        /* 0..2^20; with a gradient, at the picture's upper edge */
    uint32_t background_bottom_uq20[3]; /* at its lower edge */
    uint32_t background_gradient;       /* 1: from the one to the other, row by row, in linear light */
    gn_draw_fn draw_behind; /* over the background, before surfaces: pixels without one keep what it wrote; or NULL */
    gn_draw_fn draw_over;   /* over the finished tile, before it is flushed; or NULL. Neither is called for raw views */
    void *draw_user;        /* what both are given */
    gn_shadow_settings shadow;
} gn_scene;

/* ---- Defaults: what a user need not set -------------------------------------------------------------------------- */

/* Every field gets a value that gives a visible picture: white or light grey, lit, casting and receiving shadows.
 * Change what should differ afterwards. What is passed by pointer must not be NULL: these functions return no status;
 * but `mesh` may be set later, and `objects` and `lights` may be NULL if there are none. */

/* A mesh of two arrays (not pointers): 3 coordinates per vertex, 3 indices per triangle. Face normals. GN_MESH: the
 * coordinates are written with GN_Q16. With GN_SHORT_VERTICES 1 those end at half a unit: give fewer fraction bits with
 * GN_MESH_FRAC, such as 8 for coordinates GN_Q16(x) / 256 up to 127.99. */
#define GN_MESH(pos, idx) GN_MESH_FRAC(pos, idx, 16)
#define GN_MESH_FRAC(pos, idx, pos_frac_bits)                                                                          \
    {                                                                                                                  \
        pos, NULL, NULL, NULL, NULL, idx, sizeof(pos) / (3 * sizeof((pos)[0])), sizeof(idx) / (3 * sizeof((idx)[0])),  \
            pos_frac_bits, 0                                                                                           \
    }

/* Grey of albedo 0.8 at the origin, opaque, casts and receives shadows. */
gn_object gn_object_default(const gn_mesh *mesh);

/* Lights are white and cast full shadows with automatic bias (or a normal bias of 1, where that is not built).
 * The sun shines along a direction of any length, with irradiance 1. Spots and points have intensity 16: irradiance 1
 * at a distance of 4; their range is unlimited, and what is nearer than 0.1 casts no shadow. A spot shines from a
 * position at a target; `outer_turn` is its whole cone, edge to edge, of which the inner half has the full light.
 * A point takes six tiles of the local-light atlas, and a spot one: of the 8 that there are by default
 * (GN_MAX_OTHER_TILES) a second point gets none and casts no shadow, which gn_get_light_shadow tells. */
gn_light gn_light_sun(int32_t x, int32_t y, int32_t z);
gn_light gn_light_spot(const int32_t position_q16[3], const int32_t target_q16[3], uint16_t outer_turn);
gn_light gn_light_point(const int32_t position_q16[3]);

/* At `eye` towards `target`, which must differ (gn_camera_look_at), +Y up, 45 degrees high, near plane 0.1, far plane
 * 100. */
gn_camera gn_camera_default(const int32_t eye_q16[3], const int32_t target_q16[3]);

/* Ambient light 0.15, a dark blue background. Shadows up to a distance of 100 (the last tenth fades), by four cascades
 * where every sun can have four tiles, else one; filtered 2x2 where that is built. */
gn_scene gn_scene_default(const gn_camera *camera, const gn_object *objects, uint32_t n_objects, const gn_light *lights,
                          uint32_t n_lights);

#endif
