#!/bin/sh
# Prints one C file that includes the whole library: compiles in a third of the time. What several files name alike for
# themselves (static functions, types and tables) is told apart by a macro. usage: one_file.sh LIB_DIR
own_names() {
    sed -n -E -e 's/^static [^=;(]*[ *]([A-Za-z_0-9]+)(\(|\[| =).*/\1/p' -e 's/^\} ([A-Za-z_0-9]+);$/\1/p' "$@" | sort | uniq
}
for file in "$1"/*.c; do own_names "$file"; done | sort | uniq -d >"${TMPDIR:-/tmp}/one_file.$$"
for file in "$1"/*.c; do
    name=$(basename "$file" .c)
    shared=$(own_names "$file" | grep -F -x -f "${TMPDIR:-/tmp}/one_file.$$")
    for own in $shared; do echo "#define $own ${own}_of_$name"; done
    echo "#include \"$name.c\""
    for own in $shared $(sed -n 's/^#define \([A-Za-z_0-9]*\).*/\1/p' "$file" | sort -u); do echo "#undef $own"; done
done
rm -f "${TMPDIR:-/tmp}/one_file.$$"
