/* By what gn_init tells that program and library were compiled with one configuration. Private; included by gnomon.h.
 */
#ifndef GN_CONFIG_SIGNATURE_H
#define GN_CONFIG_SIGNATURE_H

/* gn_init compares this signature: a sum over all knobs, the version, and the sizes of the caller's structs. */
#define GN_SIGN_(index, value)                                                                                         \
    (((uint64_t)(value) + 1U) * ((0x9E3779B97F4A7C15U * (uint64_t)(index) ^ 0xD1B54A32D192ED03U) | 1U))
#define GN_KNOB_INDEX_(name, MACRO, lo, hi, meaning, cost) gn_knob_index_##name,
#define GN_KNOB_SIGN_(name, MACRO, lo, hi, meaning, cost)  +GN_SIGN_(gn_knob_index_##name, GN_##MACRO)
enum {
    gn_knob_index_none,
    gn_knob_index_version,
    gn_knob_index_scene,
    gn_knob_index_object,
    gn_knob_index_light,
    gn_knob_index_mesh,
    GN_QUALITY_KNOBS(GN_KNOB_INDEX_) GN_CAPACITY_KNOBS(GN_KNOB_INDEX_) GN_FEATURE_KNOBS(GN_KNOB_INDEX_)
        gn_knob_index_compact,
    gn_knob_index_runtime
};
#define GN_CONFIG_SIGNATURE                                                                                            \
    (GN_SIGN_(gn_knob_index_version, GN_VERSION_MAJOR * 65536 + GN_VERSION_MINOR * 256 + GN_VERSION_PATCH) +           \
     GN_SIGN_(gn_knob_index_scene, sizeof(gn_scene)) + GN_SIGN_(gn_knob_index_object, sizeof(gn_object)) +             \
     GN_SIGN_(gn_knob_index_light, sizeof(gn_light)) + GN_SIGN_(gn_knob_index_mesh, sizeof(gn_mesh)) +                 \
     GN_SIGN_(gn_knob_index_compact, GN_COMPACT) +                                                                     \
     GN_SIGN_(gn_knob_index_runtime, GN_RUNTIME_KNOBS) GN_QUALITY_KNOBS(GN_KNOB_SIGN_)                                 \
         GN_CAPACITY_KNOBS(GN_KNOB_SIGN_) GN_FEATURE_KNOBS(GN_KNOB_SIGN_))

#endif
