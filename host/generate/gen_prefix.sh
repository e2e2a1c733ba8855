#!/bin/sh
# Writes lib/gn_prefix.h to stdout: a macro for every symbol that lib/gnomon.c defines in any configuration. make prefix
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

for flags in "" "-DGN_VALIDATION=2" "-DGN_SIZE_FIRST=1" "-DGN_COMPACT=1" "-DGN_SIZE_FIRST=1 -DGN_COMPACT=1" "-DGN_RUNTIME_KNOBS=1 -DGN_PICTURES=15 -DGN_INCREMENTAL=3 -DGN_MANY_CASCADES=3" \
    "-DGN_PERSP_STEP=1"; do
    ${CC:-gcc} -std=c99 -w -O0 -Ilib $flags -c lib/gnomon.c -o "$work/gnomon.o" || exit 1
    nm -g --defined-only "$work/gnomon.o" | awk '{ print $NF }'
done >"$work/found" || exit 1
LC_ALL=C sort -u "$work/found" >"$work/symbols"

cat <<'HEAD'
/* Written by host/generate/gen_prefix.sh (make prefix): do not edit.
 *
 * With -DGN_PREFIX=small_ every symbol of the library begins with small_: two libraries of different configurations can
 * be linked into one program. A source file that includes gnomon.h with the same flags calls gn_render() as ever. The
 * functions of a port (gn_port_...) are not of the library: they keep their names, and both share them. */
#ifndef GN_PREFIX_H
#define GN_PREFIX_H

/* clang-format off */
#define GN_PASTE_(prefix, name)    prefix##name
#define GN_PREFIXED_(prefix, name) GN_PASTE_(prefix, name)
HEAD
sed 's/.*/#define & GN_PREFIXED_(GN_PREFIX, &)/' "$work/symbols"
printf '/* clang-format on */\n\n#endif\n'
