/* Written by host/generate/gen_prefix.sh (make prefix): do not edit.
 *
 * With -DGN_PREFIX=small_ every symbol of the library begins with small_: two libraries of different configurations can
 * be linked into one program. A source file that includes gnomon.h with the same flags calls gn_render() as ever.
 */
#ifndef GN_PREFIX_H
#define GN_PREFIX_H

/* clang-format off */
#define GN_PASTE_(prefix, name)    prefix##name
#define GN_PREFIXED_(prefix, name) GN_PASTE_(prefix, name)
/* clang-format on */

#endif
