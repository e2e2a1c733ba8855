/* A horizontal sundial. Its dial lies flat in the plate: hour lines, plate and outer band are cut out of one plane, so
 * that nothing lies on anything. Plans of the plate are drawn in (east, north) about its centre. */
#include <math.h>

#include "gltf_writer.h"
#include "scenes.h"

#define RAD (MESH_PI / 180)

enum {
    N_SEGMENTS = 32,
    N_SLABS = 24,
    N_LINES = 6,
    N_SOUTH = 9,
    N_EAST = 1 + 3 * N_LINES,
    N_CIRCLE = 2 * N_EAST + N_SOUTH
};

static const double plate_bottom = 0.341, drum_top = 0.345, plate_radius = 1.045, band_outer = 0.965, band_inner = 0.83;
static const double line_width = 0.03, style_length = 1.0;

typedef struct {
    double e, n;
} plan;

static mesh_point on_plate(plan p)
{
    return (mesh_point){p.e, SUNDIAL_PLATE_TOP, -p.n};
}

static plan mirrored(plan p)
{
    return (plan){-p.e, p.n};
}

/* The east half of the hour fan. Line h = 0 is the noon bar, as wide as the style, of which this is the half; it has no
 * left edge. */
typedef struct {
    plan corner;            /* where the lines meet: the foot of the style's edge */
    plan left[N_LINES + 1]; /* ends of the line's edges on the band's inner circle, seen looking outwards */
    plan right[N_LINES + 1];
    plan middle[N_LINES]; /* on the circle, between line h and h + 1 */
    plan fork[N_LINES];   /* where the facing edges of line h and h + 1 meet */
    plan foot;            /* below the corner, on the right edge of the last line */
} hour_fan;

/* A line's edge: a point on it and its direction. */
typedef struct {
    plan at, along;
} edge;

static double hour_angle(int h)
{
    return h == N_LINES ? MESH_PI / 2 : atan(sin(SUNDIAL_LATITUDE_DEG * RAD) * tan(15 * h * RAD));
}

/* to_right: distance of the edge from the line's axis. */
static edge line_edge(int h, double to_right)
{
    double angle = hour_angle(h), e = sin(angle), n = cos(angle);
    return (edge){{SUNDIAL_STYLE_HALF_WIDTH + to_right * n, SUNDIAL_STYLE_FOOT_NORTH - to_right * e}, {e, n}};
}

static plan meet_circle(edge x)
{
    double b = x.at.e * x.along.e + x.at.n * x.along.n;
    double c = x.at.e * x.at.e + x.at.n * x.at.n - band_inner * band_inner, t = sqrt(b * b - c) - b;
    return (plan){x.at.e + t * x.along.e, x.at.n + t * x.along.n};
}

static plan meet_edges(edge x, edge y)
{
    double de = y.at.e - x.at.e, dn = y.at.n - x.at.n;
    double t = (de * y.along.n - dn * y.along.e) / (x.along.e * y.along.n - x.along.n * y.along.e);
    return (plan){x.at.e + t * x.along.e, x.at.n + t * x.along.n};
}

static hour_fan make_fan(void)
{
    hour_fan f = {.corner = {SUNDIAL_STYLE_HALF_WIDTH, SUNDIAL_STYLE_FOOT_NORTH}};
    for (int h = 0; h <= N_LINES; h++) {
        edge left = line_edge(h, -line_width / 2), right = line_edge(h, h == 0 ? 0 : line_width / 2);
        f.left[h] = meet_circle(left);
        f.right[h] = meet_circle(right);
        if (h < N_LINES) f.fork[h] = meet_edges(right, line_edge(h + 1, -line_width / 2));
    }
    for (int h = 0; h < N_LINES; h++) {
        double e = f.right[h].e + f.left[h + 1].e, n = f.right[h].n + f.left[h + 1].n,
               stretch = band_inner / sqrt(e * e + n * n);
        f.middle[h] = (plan){e * stretch, n * stretch};
    }
    f.foot = (plan){f.corner.e, f.corner.n - line_width / 2};
    return f;
}

/* Counter-clockwise east of noon; its mirror image west of it. */
static void add_plan(mesh_builder *m, bool mirror, const plan *p, size_t n)
{
    mesh_point corner[8];
    for (size_t i = 0; i < n; i++) corner[i] = on_plate(mirror ? mirrored(p[n - 1 - i]) : p[i]);
    mesh_polygon(m, corner, n);
}

static void add_lines(mesh_builder *m, const hour_fan *f, bool mirror)
{
    for (int h = 1; h <= N_LINES; h++) {
        plan outer_side = h < N_LINES ? f->fork[h] : f->foot;
        add_plan(m, mirror, (plan[]){f->corner, outer_side, f->right[h], f->left[h], f->fork[h - 1]}, 5);
    }
}

static void add_noon_bar(mesh_builder *m, const hour_fan *f)
{
    const plan east[4] = {f->foot, f->corner, f->fork[0], f->right[0]};
    for (int i = 0; i < 3; i++) {
        mesh_quad(m, on_plate(mirrored(east[i])), on_plate(east[i]), on_plate(east[i + 1]),
                  on_plate(mirrored(east[i + 1])));
    }
}

/* Counter-clockwise round the band's inner circle, from the noon bar's west end over the south to its east end. */
static void make_circle(const hour_fan *f, plan *out)
{
    plan east[N_EAST]; /* from noon on */
    size_t n = 0;
    for (int h = 0; h <= N_LINES; h++) {
        if (h > 0) east[n++] = f->left[h];
        east[n++] = f->right[h];
        if (h < N_LINES) east[n++] = f->middle[h];
    }
    for (size_t i = 0; i < n; i++) *out++ = mirrored(east[i]);
    double first = atan2(east[n - 1].n, -east[n - 1].e) + 2 * MESH_PI,
           last = atan2(east[n - 1].n, east[n - 1].e) + 2 * MESH_PI;
    for (int i = 1; i <= N_SOUTH; i++) {
        double angle = first + (last - first) * i / (N_SOUTH + 1);
        *out++ = (plan){band_inner * cos(angle), band_inner * sin(angle)};
    }
    for (size_t i = n; i-- > 0;) *out++ = east[i];
}

/* The plate inside the band: the fields between the lines, and the south. */
static void add_fields(mesh_builder *m, const hour_fan *f, const plan *circle)
{
    for (int h = 0; h < N_LINES; h++) {
        const plan field[4] = {f->fork[h], f->left[h + 1], f->middle[h], f->right[h]};
        add_plan(m, false, field, 4);
        add_plan(m, true, field, 4);
    }
    const plan *south = circle + N_EAST - 1; /* N_SOUTH + 2 points */
    enum { MIDDLE = (N_SOUTH + 1) / 2 };
    mesh_point west = on_plate(mirrored(f->foot)), east = on_plate(f->foot);
    for (int i = 0; i <= N_SOUTH; i++)
        mesh_triangle(m, i < MIDDLE ? west : east, on_plate(south[i]), on_plate(south[i + 1]));
    mesh_triangle(m, west, on_plate(south[MIDDLE]), east);
}

/* Between the uneven inner circle and the even outer one, both walked counter-clockwise from north. */
static void add_band(mesh_builder *m, const plan *circle)
{
    const double tie = 0.01; /* points at equal angles: not for the last bit to decide */
    size_t i = 0, j = 0;
    while (i < N_CIRCLE || j < N_SEGMENTS) {
        plan next = circle[(i + 1) % N_CIRCLE];
        double turn = atan2(-next.e, next.n), outer_turn = 2 * MESH_PI * (double)(j + 1) / N_SEGMENTS;
        if (turn < 0) turn += 2 * MESH_PI;
        bool inner = i + 1 < N_CIRCLE ? turn + tie < outer_turn : i < N_CIRCLE && j == N_SEGMENTS;
        mesh_point a = on_plate(circle[i % N_CIRCLE]);
        mesh_point b = mesh_ring_point(band_outer, SUNDIAL_PLATE_TOP, 3 * N_SEGMENTS / 4 + N_SEGMENTS - j, N_SEGMENTS);
        if (inner) mesh_triangle(m, a, b, on_plate(circle[++i % N_CIRCLE]));
        else
            mesh_triangle(
                m, a, b,
                mesh_ring_point(band_outer, SUNDIAL_PLATE_TOP, 3 * N_SEGMENTS / 4 + N_SEGMENTS - ++j, N_SEGMENTS));
    }
}

static void make_plate(mesh_builder *rim, mesh_builder *band, mesh_builder *fields, mesh_builder *lines)
{
    static const mesh_profile profile[] = {
        {0, plate_bottom}, {plate_radius, plate_bottom}, {band_outer, SUNDIAL_PLATE_TOP}};
    hour_fan fan = make_fan();
    plan circle[N_CIRCLE];
    make_circle(&fan, circle);
    mesh_begin(rim, MESH_NORMALS);
    mesh_lathe(rim, profile, 3, N_SEGMENTS);
    mesh_begin(band, MESH_FACE_NORMALS);
    add_band(band, circle);
    mesh_begin(fields, MESH_FACE_NORMALS);
    add_fields(fields, &fan, circle);
    mesh_begin(lines, MESH_FACE_NORMALS);
    add_lines(lines, &fan, false);
    add_lines(lines, &fan, true);
    add_noon_bar(lines, &fan);
}

/* A corner of the gnomon in its plane (north, up), on its east (1) or west (-1) face. */
static mesh_point on_gnomon(plan corner, double side)
{
    return (mesh_point){side * SUNDIAL_STYLE_HALF_WIDTH, corner.n, -corner.e};
}

/* A quadratic Bezier curve. */
static plan on_curve(plan a, plan b, plan c, double t)
{
    double wa = (1 - t) * (1 - t), wb = 2 * t * (1 - t), wc = t * t;
    return (plan){wa * a.e + wb * b.e + wc * c.e, wa * a.n + wb * b.n + wc * c.n};
}

/* Its upper edge, the style, passes through the fan's corners on the plate and points to the celestial pole; the foot
 * is sunk into the plate along the style. The back is hollow, so that the faces are fans about the foot. */
static void make_gnomon(mesh_builder *m)
{
    enum { N_CURVE = 6, N_OUTLINE = N_CURVE + 2 };
    const double sunk = 0.025, foot = SUNDIAL_STYLE_FOOT_NORTH, top = SUNDIAL_PLATE_TOP;
    const double north = cos(SUNDIAL_LATITUDE_DEG * RAD), up = sin(SUNDIAL_LATITUDE_DEG * RAD);
    const plan base = {foot + 0.63, top - sunk}, hollow = {foot + 0.4, top + 0.22};
    const plan tip = {foot + style_length * north, top + style_length * up};
    plan outline[N_OUTLINE + 1] = {{foot - sunk * north / up, top - sunk}}; /* counter-clockwise seen from the east */
    for (int i = 0; i <= N_CURVE; i++) outline[i + 1] = on_curve(base, hollow, tip, (double)i / N_CURVE);
    outline[N_OUTLINE] = outline[0];
    mesh_begin(m, MESH_FACE_NORMALS);
    for (int i = 0; i < N_OUTLINE; i++) {
        plan p = outline[i], q = outline[i + 1];
        mesh_triangle(m, on_gnomon(outline[0], 1), on_gnomon(p, 1), on_gnomon(q, 1));
        mesh_triangle(m, on_gnomon(outline[0], -1), on_gnomon(q, -1), on_gnomon(p, -1));
        mesh_quad(m, on_gnomon(p, 1), on_gnomon(p, -1), on_gnomon(q, -1), on_gnomon(q, 1));
    }
}

/* A flat pyramid, sunk into what it stands on; `along` is the unit direction of its length. */
static void add_stud(mesh_builder *m, mesh_point at, plan along, double half_length, double half_width, double height)
{
    const double sunk = 0.01;
    const double le = along.e * half_length, ln = along.n * half_length, we = -along.n * half_width,
                 wn = along.e * half_width;
    const mesh_point apex = {at.x, at.y + height, at.z};
    const mesh_point base[4] = {{at.x + le, at.y - sunk, at.z - ln},
                                {at.x + we, at.y - sunk, at.z - wn},
                                {at.x - le, at.y - sunk, at.z + ln},
                                {at.x - we, at.y - sunk, at.z + wn}};
    for (int i = 0; i < 4; i++) mesh_triangle(m, base[i], base[(i + 1) % 4], apex);
    mesh_quad(m, base[3], base[2], base[1], base[0]);
}

/* The cardinal points on the drum, the north's the longest, and noon on the band. */
static void make_studs(mesh_builder *m)
{
    static const plan cardinal[4] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
    const double ring = 1.085, noon = (band_inner + band_outer) / 2;
    mesh_begin(m, MESH_FACE_NORMALS);
    for (int i = 0; i < 4; i++) {
        mesh_point at = {ring * cardinal[i].e, drum_top, -ring * cardinal[i].n};
        add_stud(m, at, cardinal[i], i == 0 ? 0.05 : 0.04, i == 0 ? 0.045 : 0.03, 0.035);
    }
    add_stud(m, on_plate((plan){0, noon}), cardinal[0], 0.055, SUNDIAL_STYLE_HALF_WIDTH, 0.02);
}

static void make_drum(mesh_builder *m)
{
    static const mesh_profile profile[] = {{0, -0.02}, {1.2, -0.02}, {1.2, drum_top}, {0, drum_top}};
    mesh_begin(m, MESH_NORMALS);
    mesh_lathe(m, profile, sizeof profile / sizeof *profile, N_SEGMENTS);
}

/* Two rings of slabs with a sloping edge; every slab its own shade. */
static void make_paving(mesh_builder *m)
{
    static const mesh_profile profile[] = {{2.24, -0.02}, {2.2, 0.04}, {1.65, 0.04}, {1.1, 0.04}};
    mesh_begin(m, MESH_COLOURS);
    for (size_t ring = 0; ring < 3; ring++) {
        for (size_t k = 0; k < N_SLABS; k++) {
            double shade = ring == 0 ? 0.8 : 0.84 + 0.02 * (double)((k * 5 + ring * 3 + k * k) % 9);
            double warm = (k + ring) % 2 ? 0.02 : 0;
            mesh_profile low = profile[ring], high = profile[ring + 1];
            mesh_paint(m, shade, shade - warm / 2, shade - warm);
            mesh_quad(m, mesh_ring_point(low.r, low.y, k, N_SLABS), mesh_ring_point(high.r, high.y, k, N_SLABS),
                      mesh_ring_point(high.r, high.y, k + 1, N_SLABS), mesh_ring_point(low.r, low.y, k + 1, N_SLABS));
        }
    }
}

static void make_lawn(mesh_builder *m)
{
    const double half = 16;
    mesh_begin(m, MESH_FACE_NORMALS);
    mesh_quad(m, (mesh_point){-half, 0, -half}, (mesh_point){-half, 0, half}, (mesh_point){half, 0, half},
              (mesh_point){half, 0, -half});
}

static void add_node_with_mesh(gltf_document *d, const char *name, const gltf_surface *surfaces, size_t n)
{
    size_t mesh = gltf_add_mesh(d, name, surfaces, n);
    gltf_add_node(d, name, "\"mesh\": %zu", mesh);
}

static void add_one(gltf_document *d, const char *name, const mesh_builder *m, size_t material)
{
    add_node_with_mesh(d, name, &(gltf_surface){m, material}, 1);
}

static void add_plate(gltf_document *d, size_t brass)
{
    static mesh_builder rim, band, fields, lines, gnomon, studs;
    size_t plate = gltf_add_material(d, "plate", (double[]){0.66, 0.62, 0.52}, NULL);
    size_t bronze = gltf_add_material(d, "band", (double[]){0.42, 0.37, 0.28}, NULL);
    size_t inlay = gltf_add_material(d, "inlay", (double[]){0.1, 0.09, 0.09}, NULL);
    make_plate(&rim, &band, &fields, &lines);
    add_node_with_mesh(d, "plate", (gltf_surface[]){{&rim, bronze}, {&band, bronze}, {&fields, plate}, {&lines, inlay}},
                       4);
    make_gnomon(&gnomon);
    add_one(d, "gnomon", &gnomon, brass);
    make_studs(&studs);
    add_one(d, "studs", &studs, brass);
}

static void add_base(gltf_document *d)
{
    static mesh_builder drum, paving, lawn;
    size_t stone = gltf_add_material(d, "stone", (double[]){0.5, 0.47, 0.43}, NULL);
    size_t slabs = gltf_add_material(d, "slabs", (double[]){0.52, 0.5, 0.46}, "\"casts\": 0");
    size_t grass = gltf_add_material(d, "grass", (double[]){0.2, 0.27, 0.14}, "\"casts\": 0");
    make_lawn(&lawn);
    add_one(d, "lawn", &lawn, grass);
    make_paving(&paving);
    add_one(d, "paving", &paving, slabs);
    make_drum(&drum);
    add_one(d, "drum", &drum, stone);
}

/* A mount that points to the celestial pole, a clockwork that turns about it, and on that the sun at its declination:
 * so the light moves at an even rate between keys, however few. Frame 0 is 06:00 solar time; an hour is a second of the
 * animation. */
static void add_sun(gltf_document *d)
{
    static const mesh_point x_axis = {1, 0, 0}, y_axis = {0, 1, 0};
    enum { N_KEYS = SUNDIAL_LAST_HOUR - SUNDIAL_FIRST_HOUR + 1 };
    gltf_rotation keys[N_KEYS];
    for (int i = 0; i < N_KEYS; i++) keys[i] = gltf_turn(y_axis, 15.0 * (12 - SUNDIAL_FIRST_HOUR - i));
    size_t light = gltf_add_light(
        d, &(gltf_light_text){
               .name = "sun", .rgb = {1, 0.95, 0.86}, .intensity = 2.9, .knobs = "\"auto_bias\": \"depth\""});
    gltf_rotation tilt = gltf_turn(x_axis, -SUNDIAL_DECLINATION_DEG),
                  mount = gltf_turn(x_axis, SUNDIAL_LATITUDE_DEG - 90);
    size_t sun = gltf_add_node(
        d, "sun", "\"rotation\": [%.6g, 0, 0, %.6g], \"extensions\": {\"KHR_lights_punctual\": {\"light\": %zu}}",
        tilt.x, tilt.w, light);
    size_t clock = gltf_add_node(d, "hour angle", "\"rotation\": [0, 0, 0, 1], \"children\": [%zu]", sun);
    gltf_add_node(d, "celestial pole", "\"rotation\": [%.6g, 0, 0, %.6g], \"children\": [%zu]", mount.x, mount.w,
                  clock);
    gltf_mark_child(d, sun);
    gltf_mark_child(d, clock);
    gltf_add_rotation_keys(d, "day", clock, 1, keys, N_KEYS);
}

int sundial_write(FILE *file)
{
    static gltf_document d;
    static const gltf_scene_text text = {
        .comment = "A sundial at 48 degrees north on the day of the summer solstice. Frame N is 06:00 + 5 N minutes, "
                   "solar time: "
                   "frame 0 06:00, 72 noon, 144 18:00.",
        .settings = "\"fps\": 12, \"max_distance\": 5.8, \"distance_fade\": 0.1, \"filter\": \"3x3\", \"cascades\": 1, "
                    "\"ambient\": [0.2, 0.21, 0.25], \"background\": [0.35, 0.5, 0.75]",
    };
    gltf_begin(&d);
    add_base(&d);
    add_plate(&d, gltf_add_material(&d, "brass", (double[]){0.72, 0.5, 0.17}, NULL));
    add_sun(&d);
    gltf_add_camera(&d, &(gltf_camera){.fov_deg = 35,
                                       .near_distance = 2.5,
                                       .far_distance = 12,
                                       .target = {0.02, 0.27, -0.03},
                                       .yaw_deg = 142,
                                       .pitch_deg = -37,
                                       .distance = 3.8});
    return gltf_write(&d, &text, file);
}
