#!/bin/sh
# Counts the instructions of the workload (tests/bench/bench_workload.c) and of characters (tests/bench/scenes/) with callgrind and holds them
# against tests/bench/bench_baseline.txt. The workload is built with constants; characters are drawn by the host tool.
#   sh tests/bench/bench.sh           fails if a total is more than 2 % above the baseline
#   sh tests/bench/bench.sh --document writes the baseline's figures into docs/data/SPEED.md; --check: whether they are there
#   sh tests/bench/bench.sh --write   makes the new figures the baseline, and writes them into docs/data/SPEED.md
# Environment: CC, BUILD.
set -eu
cd "$(dirname "$0")/../.."

CC=${CC:-gcc}
DIR=${BUILD:-build}/bench
BASELINE=tests/bench/bench_baseline.txt
DOC=docs/data/SPEED.md
CASES="flat gouraud flat-shadow gouraud-shadow"
MODELS="hound walker crowd"
TOOL=${BUILD:-build}/gnomon
CFLAGS="-std=c11 -D_POSIX_C_SOURCE=200809L -O2 -gdwarf-4 -Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow \
  -Wundef -Werror -Ilib -Itests"
ROOM="-DGN_MAX_TRIANGLES=1000 -DGN_MAX_TILE_REFS=8000"
SOURCES="tests/bench/bench_workload.c tests/bench/bench_gen.c host/scene/image/zlib_tables.c"

mkdir -p "$DIR"

# run CASE SET, then instructions: all of the drawing, its stages, the shadow tiles; and the number of shadow lookups
# (glibc's memset of a screen tile: without the limit it may be one rep instruction, which callgrind counts once per byte)
count_run() {
    GLIBC_TUNABLES=glibc.cpu.x86_rep_stosb_threshold=1000000000 valgrind -q --tool=callgrind --compress-strings=no --compress-pos=no --toggle-collect=bench_draw \
        --toggle-collect=bench_shadow_tiles --callgrind-out-file="$DIR/callgrind.$1.$2" "$DIR/workload" draw "$1" "$2"
    awk -v name="run $1 $2" '
        /^cfn=/ { callee = substr($0, 5) }
        /^calls=/ { split($1, part, "="); n[callee] += part[2]; getline; cost[callee] += $NF }
        END {
            if (!cost["bench_draw"] || !cost["gn_shade_tile"]) exit 1
            print name, cost["bench_draw"], cost["gn_setup_triangles"] + cost["gn_bin_triangles"], cost["gn_raster_tile"],
                cost["gn_shade_tile"], cost["bench_shadow_tiles"] + 0, n["gn_filter_attenuation"] + 0
        }' "$DIR/callgrind.$1.$2"
}

# model NAME, then instructions of the whole frame, its shadow tiles, views and setup, rasterising, shading
count_model() {
    GLIBC_TUNABLES=glibc.cpu.x86_rep_stosb_threshold=1000000000 valgrind -q --tool=callgrind --compress-strings=no --compress-pos=no --toggle-collect=gn_render \
        --callgrind-out-file="$DIR/callgrind.$1" "$TOOL" render "tests/bench/scenes/$1.gltf" --size 240x320 --set preset=fast --set output=rgb565 -o "$DIR/$1.png" >/dev/null
    awk -v name="model $1" '
        /^cfn=/ { callee = substr($0, 5) }
        /^calls=/ { getline; cost[callee] += $NF }
        END {
            if (!cost["gn_render"] || !cost["gn_shade_tile"]) exit 1
            print name, cost["gn_render"], cost["gn_atlas_render_tile"], cost["gn_views_setup"] + cost["gn_setup_triangles"] + cost["gn_bin_triangles"],
                cost["gn_raster_tile"], cost["gn_shade_tile"]
        }' "$DIR/callgrind.$1"
}

measure() {
    # shellcheck disable=SC2086
    $CC $CFLAGS $ROOM -o "$DIR/workload" $SOURCES lib/*.c -lm
    # shellcheck disable=SC2086
    $CC $CFLAGS -o "$DIR/workload-default" $SOURCES lib/*.c -lm
    echo "# Written by tests/bench/bench.sh --write. run: case, set, instructions of drawing, setup and binning, rasterising, shading,"
    echo "# shadow tiles; shadow lookups. count: sets L and S. ram: bytes of the benchmark's and of the default gn_renderer."
    echo "# model: instructions of a first frame of 240x320 in preset fast, shadow tiles, views and setup, rasterising, shading."
    echo "compiler $($CC -dumpmachine) $($CC --version | sed 1q)"
    echo "ram $("$DIR/workload" ram) $("$DIR/workload-default" ram)"
    "$DIR/workload" count
    for set in L S; do
        for case in $CASES; do count_run "$case" "$set"; done
    done
    count_run flat-shadow empty
    for model in $MODELS; do count_model "$model"; done
}

# The generated part of docs/data/SPEED.md, from a file of measurements.
tables() {
    awk '
        $1 == "run" { for (i = 4; i <= 9; i++) run[$2, $3, i] = $i }
        $1 == "count" { n[$2, "L"] = $3; n[$2, "S"] = $4 }
        $1 == "ram" { ram = $2; ram_default = $3 }
        $1 == "compiler" { compiler = substr($0, 10) }
        # instructions of a column of a run, without the clearing of what stays background
        function net(name, set, column,    background) {
            background = 1 - n["visible_px", set] / (320 * 240)
            return run[name, set, column] - run["flat-shadow", "empty", column] * background
        }
        # cost_l = a * tri + b * work in set L, cost_s in set S
        function solve(cost_l, cost_s, tri, work,    det) {
            det = n[tri, "L"] * n[work, "S"] - n[tri, "S"] * n[work, "L"]
            a = (cost_l * n[work, "S"] - cost_s * n[work, "L"]) / det
            b = (n[tri, "L"] * cost_s - n[tri, "S"] * cost_l) / det
        }
        function fit(name, column, work) { solve(net(name, "L", column), net(name, "S", column), "triangles", work) }
        function pair() { return sprintf("%.0f + %.1f", a, b) }
        function million(a, b, set) { return sprintf("%.2f", (a * n["triangles", set] + b * n["exact_px", set]) / 1e6) }
        function renderer(name, a1, b1, a2, b2) {
            printf "| %s | %d + %.1f | %d + %.1f | %s | %s | %s | %s |\n", name, a1, b1, a2, b2, million(a1, b1, "L"),
                million(a1, b1, "S"), million(a2, b2, "L"), million(a2, b2, "S")
            note(1, a1); note(2, b1); note(3, a2); note(4, b2)
        }
        function note(i, v) {
            if (!(i in best) || v < best[i]) best[i] = v
            if (!(i in worst) || v > worst[i]) worst[i] = v
        }
        function against(v, i,    verdict) {
            verdict = "better than all"
            if (v > best[i]) verdict = sprintf("%.1f times the best", v / best[i])
            if (v > worst[i]) verdict = "worse than all, " verdict
            return sprintf("%.0f against %s to %s: %s", v, best[i], worst[i], verdict)
        }
        END {
            print "Compiler: " compiler ", -O2.\n"
            print "Instructions per triangle + per covered pixel, and millions of instructions for a whole set:\n"
            print "| x86-64 | flat | Gouraud | flat, L | flat, S | Gouraud, L | Gouraud, S |"
            print "| --- | --- | --- | --- | --- | --- | --- |"
            fit("flat", 4, "covered_px"); a1 = a; b1 = b
            fit("gouraud", 4, "covered_px"); a2 = a; b2 = b
            printf "| Gnomon | %.0f + %.1f | %.0f + %.1f | %.2f | %.2f | %.2f | %.2f |\n", a1, b1, a2, b2, net("flat", "L", 4) / 1e6,
                net("flat", "S", 4) / 1e6, net("gouraud", "L", 4) / 1e6, net("gouraud", "S", 4) / 1e6
            renderer("small3dlib", 1756, 35.5, 2123, 55.0)
            renderer("tgx", 1369, 16.5, 1962, 22.5)
            renderer("TinyGL", 1668, 13.6, 1989, 24.2)
            print "\nGnomon against the three:\n"
            print "- flat, per triangle: " against(a1, 1)
            print "- flat, per covered pixel: " against(b1, 2)
            print "- Gouraud, per triangle: " against(a2, 3)
            print "- Gouraud, per covered pixel: " against(b2, 4)
            print "\nGnomon by stage. Setup and binning in instructions per triangle of each set; rasterising per triangle + per covered"
            print "pixel; shading per triangle + per *visible* pixel, for each is shaded once. All stages are clear of what stays background.\n"
            print "| case | everything, as above | setup, L | setup, S | rasterise | shade | lookups per visible pixel, L |"
            print "| --- | --- | --- | --- | --- | --- | --- |"
            split("flat gouraud flat-shadow gouraud-shadow", name, " ")
            split("flat;Gouraud;flat, shadow;Gouraud, shadow", title, ";")
            for (i = 1; i <= 4; i++) {
                fit(name[i], 4, "covered_px"); all = pair()
                fit(name[i], 6, "covered_px"); raster = pair()
                fit(name[i], 7, "visible_px"); shade = pair()
                printf "| %s | %s | %.0f | %.0f | %s | %s | %.2f |\n", title[i], all, net(name[i], "L", 5) / n["triangles", "L"],
                    net(name[i], "S", 5) / n["triangles", "S"], raster, shade, run[name[i], "L", 9] / n["visible_px", "L"]
            }
            empty = run["flat-shadow", "empty", 8]
            solve(run["flat-shadow", "L", 8] - empty, run["flat-shadow", "S", 8] - empty, "triangles", "caster_texels")
            printf "\nShadow tile, not in any figure above: %.0f per triangle + %.1f per covered texel, and %d for an empty one", a, b, empty
            printf " (clearing 128 x 128\ntexels and building their depth blocks; L: %d triangles face the light and cover %d texels, S: %d and %d).\n", n["casters", "L"],
                n["caster_texels", "L"], n["casters", "S"], n["caster_texels", "S"]
            printf "\nAn empty picture (clearing and background, 320 x 240): %.2f million instructions, %.1f per pixel.\n",
                run["flat-shadow", "empty", 4] / 1e6, run["flat-shadow", "empty", 4] / (320 * 240)
            print "\n| | L | S |\n| --- | --- | --- |"
            print "| triangles | " n["triangles", "L"] " | " n["triangles", "S"] " |"
            print "| covered pixels, library | " n["covered_px", "L"] " | " n["covered_px", "S"] " |"
            print "| covered pixels, exact | " n["exact_px", "L"] " | " n["exact_px", "S"] " |"
            print "| visible pixels, library | " n["visible_px", "L"] " | " n["visible_px", "S"] " |"
            printf "| covered per visible | %.2f | %.2f |\n", n["covered_px", "L"] / n["visible_px", "L"],
                n["covered_px", "S"] / n["visible_px", "S"]
            printf "\nRAM, `sizeof(gn_renderer)`: %d bytes here (1000 triangles, 8000 tile references), %d as configured by default,\n", ram, ram_default
            print "shadow atlas and screen tile included. For the same picture the others need 76,800 to 307,200 bytes (small3dlib, by its"
            print "depth buffer) and 307,200 (tgx, TinyGL: 16-bit colour and depth)."
        }' "$1"
}

BEGIN_MARK='<!-- begin: generated by tests/bench/bench.sh --write -->'
END_MARK='<!-- end: generated -->'

. tests/bench/bench_part.sh

case ${1:-} in
--document) rewrite_document; exit ;;
--check) finish 0 ;;
esac
command -v valgrind >/dev/null || { echo "bench: valgrind is not installed" >&2; exit 1; }
measure >"$DIR/measured.txt"

if [ "${1:-}" = --write ]; then
    cp "$DIR/measured.txt" "$BASELINE"
    rewrite_document
    echo "bench: wrote $BASELINE and $DOC"
    exit 0
fi

[ "$(grep '^compiler' "$BASELINE")" = "$(grep '^compiler' "$DIR/measured.txt")" ] ||
    echo "bench: the baseline is of another compiler: $(grep '^compiler' "$BASELINE")"

status=0
awk '
    BEGIN { printf "%-28s %12s %12s\n", "instructions", "baseline", "now" }
    $1 == "model" && FNR == NR { model[$2] = $3; next }
    $1 == "model" { compare("model " $2, $3, model[$2]); next }
    $1 != "run" { next }
    FNR == NR { drawing[$2, $3] = $4; shadow[$2, $3] = $8; next }
    function compare(what, now, then,    change) {
        compared++
        change = then ? 100 * (now - then) / then : 100
        printf "%-28s %12d %12d %+7.2f %%", what, then, now, change
        print (change > 2 ? "  WORSE" : change < -2 ? "  better: --write" : "")
        worse += change > 2; stale += change < -10
    }
    { compare($2 " " $3, $4, drawing[$2, $3]) }
    $2 ~ /shadow/ { compare("shadow tile, " $2 " " $3, $8, shadow[$2, $3]) }
    END {
        if (stale) print "bench: " stale " figures are more than 10 % below the baseline, which is out of date: --write"
        exit (worse > 0 || stale > 0 || compared < 16)
    }' "$BASELINE" "$DIR/measured.txt" || status=1
[ $status = 0 ] || echo "bench: FAILED: worse than $BASELINE by more than 2 % (sh tests/bench/bench.sh --write accepts it)"

finish $status
