/* Knobs of quality in tests that are built with run-time knobs and with constants. With constants a test takes what the
 * build has: setting does nothing, and who depends on a value asks whether there is such a thing. GN_K reads. */
#ifndef KNOBS_H
#define KNOBS_H

#include "gnomon.h"

#if GN_RUNTIME_KNOBS

#define SET_KNOB(frame, name, value)  ((void)((frame)->knobs.name = (value)))
#define COPY_KNOBS(to, from)          ((void)((to)->knobs = (from)->knobs))
#define MAX_OF_KNOB(name, at_runtime) (at_runtime)

#else

#define SET_KNOB(frame, name, value)  ((void)(frame), (void)(value))
#define COPY_KNOBS(to, from)          ((void)(to), (void)(from))
#define MAX_OF_KNOB(name, at_runtime) ((int32_t)gn_knob_##name)

#endif

/* Whether a frame has this value now: always with knobs at run time. */
#define TAKES_KNOB(frame, name, value) (SET_KNOB(frame, name, value), GN_K(frame, name) == (value))

#endif
