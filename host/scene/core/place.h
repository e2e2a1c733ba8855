/* Where objects are, as far as the engines could not take it. */
#ifndef GNOMON_HOST_PLACE_H
#define GNOMON_HOST_PLACE_H

#include "bounds.h"
#include "loader.h"

/* Moves meshes whose vertices are far from their own origin, and a scene that is far from the origin, to it, and gives
 * transforms that are flat a thickness that nobody sees: in all poses alike. b: before that; *changed: it is another.
 */
bool place_objects(loader *l, const bounds *b, bool *changed);

#endif
