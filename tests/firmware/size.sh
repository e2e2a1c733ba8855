#!/bin/sh
# What the library takes on the targets: flash, RAM by part, worst-case stack.
#   sh tests/firmware/size.sh                     measures all of it; prints it as tables
#   sh tests/firmware/size.sh --figures [some]    one figure per line: flash|whole|ram|stack|fault CORE CONFIGURATION NAME VALUE; some: what the test needs
#   sh tests/firmware/size.sh --tables FILE       tables, in Markdown, of figures measured before
#   sh tests/firmware/size.sh --write             makes the figures tests/firmware/size_baseline.txt, and writes docs/data/SIZES.md, COST and README
#   sh tests/firmware/size.sh --files CORE CONFIGURATION        flash by file of lib/
#   sh tests/firmware/size.sh --list FILE CORE...    figures of configurations of a file: lines NAME FLAGS...
#   sh tests/firmware/size.sh --o2 CORE          figures of flash with -O2 alone, for the baseline
#   sh tests/firmware/size.sh --flags CONFIGURATION   its compiler flags
#   sh tests/firmware/size.sh --document          writes the documents alone
#   sh tests/firmware/size.sh --functions CORE CONFIGURATION    the largest functions and tables of an image
# Cores are those of boards/*/board.mk, but Xtensa. Everything is compiled as boards/boards.mk does it, but with -Os; flash with -O2, the default of boards, too.
set -eu
cd "$(dirname "$0")/../.."
BASELINE=tests/firmware/size_baseline.txt
DOC=docs/data/SIZES.md
mkdir -p build/tmp
work=$(mktemp -d build/tmp/size.XXXXXX)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# ---- Cores and configurations -----------------------------------------------------------------------------------------------

# core NAME: "prefix flags"; each kind of core once, by the first board that has it
board_value() { sed -n "s/^$2 *:= *//p" "$1"; }
cores() {
    for board in boards/*/board.mk; do
        cpu=$(board_value "$board" BOARD_CPU)
        case $(board_value "$board" BOARD_CROSS) in xtensa-*) continue ;; esac # whose calls go through registers: no graph
        [ -z "$cpu" ] || echo "$(board_value "$board" BOARD_CORE | tr ' ' _) $(board_value "$board" BOARD_CROSS) $cpu"
    done | sort -u -k 1,1
}

features=$(sed -n '/GN_FEATURE_KNOBS/,$s/^    X([a-z_0-9]*, \([A-Z_0-9]*\), .*/\1/p' lib/gn_knobs.h)
off() { for feature in $features; do [ "$feature" = "${1:-}" ] || echo "-DGN_$feature=0"; done; }
CONFIGURATIONS="smallest small tiny fast balanced accurate full"
flags_of() {
    case $1 in
    smallest) # one directional light, hard shadow, flat colours, in 32 bits
        echo "-DGN_COMPACT=1 -DGN_BIASES=0 -DGN_VALIDATION=0 -DGN_PRESET=GN_PRESET_TINY -DGN_SRGB=0 -DGN_MAX_WIDTH=128 -DGN_MAX_HEIGHT=128 -DGN_MAX_TRIANGLES=64 -DGN_MAX_OBJECTS=8" ;;
    small) # the same as the library does it, without clipping
        echo "$(off SHADOWS) -DGN_SHADOWS=1 -DGN_PRESET=GN_PRESET_TINY -DGN_PERSP_STEP=1 -DGN_SRGB=0 -DGN_MAX_LIGHTS=1 -DGN_SURFACE_LIGHTS=1 -DGN_MAX_SHADOW_TILES=1" \
            "-DGN_MAX_WIDTH=128 -DGN_MAX_HEIGHT=128 -DGN_MAX_TRIANGLES=64 -DGN_MAX_TILE_REFS=256 -DGN_MAX_OBJECTS=8" ;;
    tiny | fast | balanced | accurate) echo "-DGN_PRESET=GN_PRESET_$(echo "$1" | tr a-z A-Z)" ;;
    full) # every feature of the specification, in one way each: without cells and windows, bounds of depth and boxes, which only save time
        for feature in $features; do
            case $feature in
            OBJECT_BOXES) echo "-DGN_$feature=0" ;;
            SHADOWS) echo "-DGN_$feature=6" ;;
            VERTEX_JOINTS) echo "-DGN_$feature=4" ;;
            MANY_CASCADES | BIASES | OTHER_LIGHTS | VERTEX_VALUES) echo "-DGN_$feature=3" ;;
            PICTURES) echo "-DGN_$feature=7" ;;
            MATERIALS) echo "-DGN_$feature=15" ;;
            TEXTURE_FORMATS) echo "-DGN_$feature=1025" ;;
            INCREMENTAL) echo "-DGN_$feature=3" ;;
            TILE_SIZES | CLIPPING) echo "-DGN_$feature=2" ;;
            *) echo "-DGN_$feature=1" ;;
            esac
        done
        echo "-DGN_PERSP_STEP=1" ;;
    *) sed -n "s|^$1 ||p" "$list" ;;
    esac
}

# ---- Measuring --------------------------------------------------------------------------------------------------------------

optimise=-Os
# By lines, flash is found by file: slower to compile, and the same code.
debug=
case ${1:-} in --write | --document | --files) debug=-g ;; esac

# object SOURCE FILE: compiled, or a copy of what the same lines came to before
object() {
    same=$work/same.$prefix$($compile -E -P "$1" | { echo "$core_flags $optimise"; cat; } | cksum | tr " " .)
    if [ ! -e "$same.o" ]; then
        own=$dir/new
        $compile -fstack-usage -c "$1" -o "$own.o"
        mv "$own.su" "$same.su"
        mv "$own.o" "$same.o"
    fi
    cp "$same.o" "$2.o"
    cp "$same.su" "$2.su"
}

# image CORE CONFIGURATION: $work/CORE.CONFIGURATION/image and what belongs to it
image() {
    dir=$work/$1.$2
    mkdir -p "$dir"
    set -- "$1" "$2" $(cores | sed -n "s/^$1 //p")
    prefix=$3
    compile="$prefix"
    core_flags=$(shift 3 && echo "$*")
    compile="${prefix}gcc $core_flags -std=c99 $optimise $debug -ffreestanding -isystem boards/common/include -ffunction-sections -fdata-sections -Ilib $(flags_of "$2")"
    (cd "$dir" && for source in ../../../../lib/*.c ../../../../tests/firmware/size_app.c; do echo "$source"; done) | sed 's|^\(../\)*||' >"$dir/sources"
    while read -r source; do
        object "$source" "$dir/$(basename "$source" .c)"
    done <"$dir/sources"
    $compile -fno-tree-loop-distribute-patterns -fno-builtin -c boards/common/memory.c -o "$dir/memory.o"
    $compile -c tests/firmware/size_parts.c -o "$dir/parts.obj"
    ${prefix}gcc $core_flags $optimise -nostdlib -nostartfiles -Wl,--gc-sections -Wl,-e,size_main -Wl,--no-warn-rwx-segments -o "$dir/image" "$dir"/*.o -lgcc
    ${prefix}objdump -d --no-show-raw-insn "$dir/image" | awk -f tests/firmware/call_graph.awk "$dir"/gnomon.su - >"$dir/graph"
    ${prefix}nm -S --radix=d "$dir/image" | awk '{ print $2 + 0, $3, $4 }' >"$dir/symbols"
}

# flash CORE CONFIGURATION NAME: of the image, all but the program and the four functions of string.h
flash() {
    ${prefix}size "$dir/image" | awk -v f="flash $1 $2 $3" -v app="$(awk '$3 ~ /^(size_.*|mem(set|cpy|move|cmp))$/ && $2 ~ /[tTrR]/ { n += $1 } END { print n + 0 }' "$dir/symbols")" 'NR == 2 { print f, $1 - app }'
}

ROOTS="gn_init gn_begin gn_shadow_tile gn_prepare gn_screen_tile gn_render"
figures() { # figures CORE CONFIGURATION
    image "$1" "$2"
    flash "$1" "$2" linked
    ${prefix}size -A "$dir"/gnomon.o | awk -v f="whole $1 $2 all" '/^\.(text|rodata|srodata)/ { n += $2 } END { print f, n }'
    ${prefix}size "$dir"/gnomon.o | awk -v f="fault $1 $2 data+bss" 'NR > 1 { n += $2 + $3 } END { print f, n }'
    ${prefix}nm -S --radix=d "$dir/parts.obj" | sed -n 's/^[0-9]* 0*\([0-9][0-9]*\) . ram_/\1 /p' | awk -v f="ram $1 $2" '{ print f, $2, $1 }'
    for root in $ROOTS; do awk -v f="stack $1 $2" -v root="$root" '$1 == "stack" && $2 == root { print f, root, $3 }' "$dir/graph"; done
    for fault in recursion unbounded; do
        awk -v f="fault $1 $2 $fault" -v fault="$fault" '$1 == fault { n++ } END { print f, n + 0 }' "$dir/graph"
    done
    # what calls through a pointer, but for the callbacks of the caller
    awk -v f="fault $1 $2 pointers" '$1 == "indirect" && $2 !~ /^(flush_tile|draw_tile|draw_over|draw_behind|clear_background|screen_tile|gn_shade_tile|gn_screen_tile|gn_render)/ { n++ } END { print f, n + 0 }' "$dir/graph"
    awk -v f="fault $1 $2 soft-float" '$3 ~ /^__(aeabi_[fd]|[a-z]*[sd]f[23]?$|[a-z]*(add|sub|mul|div|neg|cmp)[sd]f)/ { n++ } END { print f, n + 0 }' "$dir/symbols"
    awk -v f="fault $1 $2 malloc" '$3 ~ /^(malloc|calloc|realloc|free|_sbrk|sbrk)$/ { n++ } END { print f, n + 0 }' "$dir/symbols"
    slow_divisions "$1" "$2"
}

# 64-bit divisions that a pixel can come to: hundreds of cycles each
PER_PIXEL="gn_corner_pixel gn_corner_find gn_corner_share gn_cascade_at gn_filter_attenuation gn_pixel_pack gn_pixel_fill gn_plane_recip gn_bary_at \
gn_texture_colour gn_texture_mask gn_punctual_at gn_alpha_keeps gn_blocks_over shade_pixel raster_span"
slow_divisions() {
    awk -v f="fault $1 $2 divisions" -v per_pixel="$PER_PIXEL" '
        $1 == "call" { to[$2, ++n[$2]] = $3 }
        function reaches(g,    i) {
            if (g ~ /^(__aeabi_u?ldivmod|__u?divmoddi4|__u?(div|mod)di3|gn_u?div64)/) return 1
            if (seen[g]++) return 0
            for (i = 1; i <= n[g]; i++) if (reaches(to[g, i])) return 1
            return 0
        }
        END {
            count = split(per_pixel, name, " ")
            for (p = 1; p <= count; p++) { split("", seen); found += reaches(name[p]) }
            print f, found + 0
        }' "$dir/graph"
}

# Flash of the image by the file that a function or table comes from; of names that several files have, the first.
files() {
    ${prefix}nm -l --defined-only "$dir/gnomon.o" |
        sed -n 's|^[0-9a-f]* . \([^\t ]*\)[\t ].*/lib/\(.*\)\.[ch]:[0-9]*$|in \1 \2|p' | awk '
        $1 == "in" { if (!($2 in file)) file[$2] = $3; next }
        $2 ~ /[tTrR]/ && $3 !~ /^(size_|mem(set|cpy|move|cmp)$)/ { n[$3 in file ? file[$3] : "runtime"] += $1 }
        END { for (f in n) print n[f], f }' - "$dir/symbols" | sort -rn
}

two_at_a_time() { # the figures of $work/wanted
    for half in 0 1; do
        awk -v half=$half 'NR % 2 == half' "$work/wanted" | while read -r core configuration; do
            [ "$wanted" = o2 ] || figures "$core" "$configuration"
            case $wanted in
            all | o2)
                optimise=-O2
                image "$core" "$configuration"
                flash "$core" "$configuration" linked-O2
                optimise=-Os ;;
            esac
            rm -rf "$dir"
        done >"$work/figures$half" &
    done
    wait
    sort "$work/figures0" "$work/figures1"
}

wanted=all
measure() { # measure [some]
    for core in $(cores | cut -d ' ' -f 1); do
        for configuration in $CONFIGURATIONS; do
            case ${1:-}${THOROUGH:-}$core.$configuration in someCortex-M3.tiny | someCortex-M3.fast) ;; some*Cortex-M3.* | some*.smallest | [!s]*) echo "$core $configuration" ;; esac
        done
    done >"$work/wanted"
    two_at_a_time
}

measure_list() { # measure_list FILE CORE...
    list=$1 wanted=list
    shift
    for core; do awk -v core="$core" '{ print core, $1 }' "$list"; done >"$work/wanted"
    two_at_a_time
}

# ---- Documents --------------------------------------------------------------------------------------------------------------

tables() { # tables FILE
    awk -v configurations="$CONFIGURATIONS" '
        /^#/ { next }
        { figure[$1, $2, $3, $4] = $5 }
        !($2 in known) { known[$2]; core[++n_cores] = $2 }
        $1 == "ram" && !($4 in part) { part[$4]; parts[++n_parts] = $4 }
        function head(title,    i, line) {
            line = "| " title " |"
            for (i = 1; i <= n_cores; i++) line = line " " core[i] " |"
            print line
            gsub(/[^|]+/, " --- ", line)
            print line
        }
        function table(kind, what, names,    n, name, i, c, line) {
            n = split(configurations, name, " ")
            head(names)
            for (i = 1; i <= n; i++) {
                line = "| " name[i] " |"
                for (c = 1; c <= n_cores; c++) line = line " " ((kind, core[c], name[i], what) in figure ? figure[kind, core[c], name[i], what] : "·") " |"
                print line
            }
        }
        END {
            print "With -Os. Flash in bytes, of a program that renders (code, constants and the compiler'"'"'s helpers; without the program and the functions of `string.h`):\n"
            table("flash", "linked", "configuration")
            print "\nThe same with -O2, as boards are built by default:\n"
            table("flash", "linked-O2", "configuration")
            print "\nOf everything in `lib/`, used or not, with -Os:\n"
            table("whole", "all", "configuration")
            print "\nWorst-case stack of `gn_render` in bytes with -Os, without that of the flush callback:\n"
            table("stack", "gn_render", "configuration")
            n = split("gn_init gn_begin gn_shadow_tile gn_prepare gn_screen_tile", root, " ")
            step = ("Cortex-M3" in known) ? "Cortex-M3" : core[1]
            print "\nBy step, on " step ":\n"
            line = "| configuration |"
            for (r = 1; r <= n; r++) line = line " `" root[r] "` |"
            print line
            gsub(/[^|]+/, " --- ", line)
            print line
            m = split(configurations, name, " ")
            for (i = 1; i <= m; i++) {
                line = "| " name[i] " |"
                for (r = 1; r <= n; r++) line = line " " figure["stack", step, name[i], root[r]] " |"
                print line
            }
            print "\nRAM in bytes, by part of a `gn_renderer`:\n"
            line = "| configuration |"
            for (p = 1; p <= n_parts; p++) if (parts[p] != "total") line = line " " parts[p] " |"
            line = line " rest | total |"
            gsub(/_/, " ", line)
            print line
            gsub(/[^|]+/, " --- ", line)
            print line
            for (i = 1; i <= m; i++) {
                line = "| " name[i] " |"
                rest = total = figure["ram", core[1], name[i], "total"]
                for (p = 1; p <= n_parts; p++) {
                    if (parts[p] == "total") continue
                    value = figure["ram", core[1], name[i], parts[p]] + 0
                    rest -= value
                    line = line " " (value ? value : "–") " |"
                }
                print line " " rest " | " total " |"
            }
        }' "$1"
}

by_file() {
    for configuration in full smallest; do
        image Cortex-M3 $configuration
        files | sed "s/^/$configuration /"
    done | awk '
        { n[$1, $3] = $2; if (!($3 in seen)) { seen[$3]; file[++n_files] = $3 } }
        END {
            print "| file | full | smallest |\n| --- | --- | --- |"
            for (i = 1; i <= n_files; i++) {
                f = file[i]
                if (n["full", f] + n["smallest", f])
                    print "| `" f "` | " (n["full", f] ? n["full", f] : "–") " | " (n["smallest", f] ? n["smallest", f] : "–") " |"
            }
        }'
}

document() { # from the baseline, and the files as they are
    tables "$BASELINE" >"$work/sizes"
    by_file >"$work/files"
    cp "$DOC" "$work/doc"
    for part in sizes files; do
        awk -v begin="<!-- generated: $part -->" -v file="$work/$part" '
            $0 == begin { print; while ((getline line < file) > 0) print line; skip = 1; next }
            $0 == "<!-- end -->" { skip = 0 }
            !skip { print }' "$work/doc" >"$work/next"
        mv "$work/next" "$work/doc"
    done
    cp "$work/doc" "$DOC"
    sh docs/cost.sh
}

case ${1:-} in
--flags) echo $(flags_of "$2") ;;
--figures)
    wanted=${2:-all}
    measure "$wanted" ;;
--o2)
    wanted=o2
    for configuration in $CONFIGURATIONS; do echo "$2 $configuration"; done >"$work/wanted"
    two_at_a_time ;;
--list) shift && measure_list "$@" ;;
--tables) tables "$2" ;;
--document) document ;;
--write)
    { echo "# Written by sh tests/firmware/size.sh --write: bytes."; measure all; } >"$work/baseline"
    cp "$work/baseline" "$BASELINE"
    document ;;
--functions)
    image "$2" "$3"
    sort -rn "$dir/symbols" | awk '$2 ~ /[tTrR]/ { print $1, $3 }' ;;
--files)
    image "$2" "$3"
    files ;;
*)
    measure all >"$work/all"
    tables "$work/all" ;;
esac
