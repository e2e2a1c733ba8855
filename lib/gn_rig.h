/* Models and their animation: what gnomon asset writes, and the call that poses it. A part of gnomon.h, which includes
 * it. */
#ifndef GN_RIG_H
#define GN_RIG_H

enum { GN_RIG_TRANSLATION, GN_RIG_ROTATION, GN_RIG_SCALE }; /* gn_rig_channel.what */
enum { GN_RIG_OBJECT, GN_RIG_LIGHT, GN_RIG_CAMERA };        /* gn_rig_link.kind */

/* Keys of one property of a node; between them linear, or with `step` the earlier one. */
typedef struct {
    const uint16_t *tick;          /* of each key, ascending: 2^(tick_log2 - 16) seconds; NULL: there is one key */
    const int32_t *xyz;            /* 3 per key: translation Q15.16, scale Q1.30; or NULL */
    const int16_t *quaternion_q15; /* x y z w per key, of length 1; neighbours less than 30 degrees apart; or NULL */
    uint16_t n_keys, node;
    uint8_t what, step;
} gn_rig_channel;

typedef struct {
    const gn_rig_channel *channels; /* ascending by node, then by `what` */
    uint16_t n_channels;
    uint8_t tick_log2;
    uint32_t duration_q16; /* seconds */
} gn_rig_clip;

typedef struct {
    const gn_affine *fixed;     /* to its parent; NULL: channels say it */
    const gn_rig_channel *rest; /* its three channels, one key each, where a clip has none */
    int16_t parent;             /* an earlier node, or -1 */
} gn_rig_node;

/* What stands on a node. Its own scale is that of the node times 2^exp: objects alone. */
typedef struct {
    uint16_t node, idx;
    uint8_t kind;
    int8_t exp;
} gn_rig_link;

typedef struct {
    const gn_rig_node *nodes;
    const gn_rig_link *links;
    const gn_rig_clip *clips;
    uint16_t n_nodes, n_links, n_clips;
} gn_rig;

/* Places everything that stands on the rig's nodes as a clip has it at a time. Beyond the end of the clip is its end; a
 * clip that is not there is the pose at rest. A scale of 0, or of another sign, is as gn_affine says. The result
 * depends on nothing else, so that nothing drifts: within 2 units per node above, beside the rounding of the keys.
 * `nodes`: n_nodes, written. Nothing is checked: the rig is as the tool wrote it. Arguments need live no longer than
 * the call; but joints of a skin may point into `nodes`, which then must live as long as the object. A gn_rig and all
 * that it leads to: as long as it is posed. */
void gn_pose(const gn_rig *rig, uint32_t clip_idx, uint32_t time_q16, gn_affine *nodes, gn_object *objects,
             gn_light *lights, gn_camera *cameras);

#endif
