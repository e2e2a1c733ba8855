# Prints a C file with every #include "..." replaced by what it names, for build systems that compile each file of a folder.
#   awk -f one_file.awk -v root=lib lib/gnomon.c >gnomon.c
# Names are looked up in `root`. A file is left out where it was put in before: in the same branch of an #if, or in one around it.
# In another branch it comes again, as its include guard expects.

function leave_branch(    name) {
    for (name in branch) if (branch[name] == depth) delete branch[name]
}

function expand(path,    line, name, guard, outer) {
    outer = depth
    while ((getline line < path) > 0) {
        if (line ~ /^ *# *if/) {
            if (guard == "" && line ~ /^#ifndef GN[A-Z0-9_]*_H$/) guard = line # not a condition
            else depth++
        }
        if (line ~ /^ *# *(else|elif|endif)/ && depth > outer) leave_branch()
        if (line ~ /^ *# *endif/ && depth > outer) depth--
        if (line !~ /^ *# *include "/) { print line; continue }
        name = line
        gsub(/^[^"]*"|"[^"]*$/, "", name)
        if (name in branch) continue
        branch[name] = depth
        expand(root "/" name)
    }
    close(path)
}

FNR == 1 { expand(FILENAME); exit }
