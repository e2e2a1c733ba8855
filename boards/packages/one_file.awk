# Prints a C file with every #include "..." replaced by what it names, for build systems that compile each file of a folder.
#   awk -f one_file.awk -v root=lib lib/gnomon.c >gnomon.c
# Names are looked up in `root`. A file that was put in unconditionally is left out later; one that an #if depends on comes
# again, as its include guard expects.

function expand(path, conditional,    line, name, guard, depth) {
    while ((getline line < path) > 0) {
        if (line ~ /^ *# *if/) {
            if (guard == "" && line ~ /^#ifndef GN[A-Z0-9_]*_H$/) guard = line # not a condition
            else depth++
        }
        if (line ~ /^ *# *endif/ && depth) depth--
        if (line !~ /^ *# *include "/) { print line; continue }
        name = line
        gsub(/^[^"]*"|"[^"]*$/, "", name)
        if (name in whole) continue
        if (!conditional && !depth) whole[name] = 1
        expand(root "/" name, conditional || depth)
    }
    close(path)
}

FNR == 1 { expand(FILENAME, 0); exit }
