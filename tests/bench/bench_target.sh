#!/bin/sh
# Counts the instructions of firmware in the emulator, stage by stage, and holds them against tests/bench/bench_target_baseline.txt.
#   sh tests/bench/bench_target.sh            fails if a total is more than 2 % above the baseline
#   sh tests/bench/bench_target.sh --quick    the workload on the Cortex-M3 alone
#   sh tests/bench/bench_target.sh --document writes the baseline's figures into docs/data/SPEED.md; --check: whether they are there
#   sh tests/bench/bench_target.sh --lines CORE PRESET...    lines of the baseline: the own scenes on one core
#   sh tests/bench/bench_target.sh --lines CORE models FILE...    the same of characters: those of tests/bench/scenes, or other models, as tests/bench/bench_models.txt has them
#   sh tests/bench/bench_target.sh --lines CORE changes      the same of frames that change little
#   sh tests/bench/bench_target.sh --write    makes the new figures the baseline, and writes them into docs/data/SPEED.md
# Environment: BUILD, GNOMON.
set -eu
cd "$(dirname "$0")/../.."

BUILD=${BUILD:-build}
DIR=$BUILD/bench
BASELINE=tests/bench/bench_target_baseline.txt
DOC=docs/data/SPEED.md
CASES="flat gouraud flat-shadow gouraud-shadow"
SCENES="sundial avenue desk room fence mixed"
MODELS="tests/bench/scenes/hound.gltf tests/bench/scenes/walker.gltf tests/bench/scenes/crowd.gltf"
CHANGES="tests/bench/scenes/gauge.gltf tests/bench/scenes/game.gltf:3 host/scenes/cube.gltf host/scenes/sundial.gltf host/scenes/desk.gltf host/scenes/mixed.gltf"
STAGES=$(sh boards/tools/count.sh --stages)

# core, board, and what it is configured by: built with -O2, or as the core's name ends; light found at vertices alone, the longest steps, bands as wide as the picture
CORES="M3 mps2-an385
M3-Os mps2-an385
M3-fast mps2-an385 -DGN_VERTEX_LIGHT=1 -DGN_PERSP_STEP=16 -DGN_TILE_WIDTH=320 -DGN_TILE_HEIGHT=16
M0 nrf51-large
M4 mps2-an386
RV32 rv32-virt"

mkdir -p "$DIR"

board_of() { echo "$CORES" | sed -n "s/^$1 \\([^ ]*\\).*/\\1/p"; }
flags_of() { echo "$CORES" | sed -n "s/^$1 [^ ]* *//p"; }
opt_of() { case $1 in *-O?) echo "-${1##*-}" ;; *) echo -O2 ;; esac; }

# Bytes of lib/ in an image: code and constants, from the linker's map
flash_of() {
    awk '/^Linker script and memory map/ { on = 1 } !on { next }
        /^ \.[a-zA-Z]/ { section = $1 }
        $NF ~ /lib\/gnomon\.o$/ && section !~ /^\.(bss|debug|comment|ARM\.attributes)/ { for (i = 1; i < NF; i++) if ($i ~ /^0x/ && $(i + 1) ~ /^0x/) print $(i + 1) }' "$1" |
        while read -r hex; do echo $((hex)); done | awk '{ n += $1 } END { print n + 0 }'
}

# one "run CORE NAME" IMAGE CORE ARGS VARIABLE...: a line with the instructions of every stage, in the order of STAGES, then the
# counts that the app prints, and of lib/ the bytes of flash
one() {
    label=$1 image=$2 core=$3 args=$4
    shift 4
    sh boards/tools/count.sh "$(board_of "$core")" "$image" "$args" FW_OPT="$(opt_of "$core")" FW_FLAGS="$(flags_of "$core")" LINK_FLAGS="-Wl,-Map=$DIR/$image.map" "$@" </dev/null >"$DIR/log"
    echo "$label $(awk '$1 == "stage" { printf "%s ", $3 } /^[a-z_]+ [0-9]+$/ { printf "%s ", $2 }' "$DIR/log")$(flash_of "$DIR/$image.map")" | sed 's, *$,,'
}

workload() { # workload CORE
    for case in $CASES; do
        for set in L S; do one "work $1 $case $set" "bench-$1" "$1" "$case $set"; done
    done
    one "work $1 flat-shadow empty" "bench-$1" "$1" "flat-shadow empty"
}

scenes() { # scenes CORE PRESET...
    core=$1
    shift
    presets=$*
    for scene in $SCENES; do
        for preset in $presets; do
            one "scene $core $scene $preset" "bench-$core-$scene-$preset" "$core" 0 SCENE="host/scenes/$scene.gltf" PRESET="$preset"
        done
    done
}

# Compact arithmetic beside the general one with the same shadows, in a small picture
small() {
    for scene in sundial avenue; do
        flags="--size 128x96 --set output=rgb565 --set cascades=1 --set filter=hard"
        one "scene M3 $scene,128x96,hard balanced" "bench-M3-$scene-hard" M3 0 SCENE="host/scenes/$scene.gltf" SCENE_FLAGS="$flags"
        one "scene M3 $scene,128x96,hard compact" "bench-M3-$scene-compact" M3 0 SCENE="host/scenes/$scene.gltf" SCENE_FLAGS="$flags --set compact=1"
    done
}

# Characters: first frames
models() { # models CORE FILE...
    core=$1
    shift
    for model in "$@"; do
        name=$(basename "${model%.*}")
        one "model $core $name fast" "bench-$core-$name" "$core" 0 SCENE="$model" PRESET=fast \
            SCENE_FLAGS="--size 240x320 --frames 0-1 --set output=rgb565 --set filter=3x3 --set texture_size=128"
    done
}

# Frames by gn_render_changes: the first alone; with four later ones; and with the last of these four times more. Behind a scene: `incremental`
changes() { # changes CORE
    for scene in $CHANGES; do
        name=$(basename "${scene%.*}")
        level=2
        case $scene in *:?) level=${scene##*:} ;; esac
        for frames in first:0 later:0+4 still:0+4+4; do
            one "changes $1 $name ${frames%%:*}" "bench-$1-$name-changes" "$1" "$(echo "${frames#*:}" | tr + ' ')" SCENE="${scene%:?}" PRESET=balanced \
                SCENE_FLAGS="--frames 0-4 --set incremental=$level --set fit=compiled"
        done
    done
}

measure() { # measure QUICK
    echo "# Written by tests/bench/bench_target.sh --write. Instructions of: $STAGES; then pixels, triangles, caster triangles, shadow texels drawn, bytes of lib/ in the image."
    echo "compiler $(arm-none-eabi-gcc --version | sed 1q); $(riscv64-unknown-elf-gcc --version | sed 1q)"
    "$BUILD/firmware/bench/workload" count
    workload M3
    [ "$1" = quick ] && return
    for core in M3-fast M0 M4 RV32; do workload "$core"; done
    scenes M3 tiny fast balanced accurate
    scenes M3-Os balanced
    small
    for core in M0 M4 RV32; do scenes "$core" balanced; done
    for core in M3 M0 RV32; do models "$core" $MODELS; done
    changes M3
}

# The total leaves out what runs before the first stage.
tables() {
    awk '
        function total(    i, sum) { sum = 0; for (i = 5; i <= 12; i++) sum += $i; return sum }
        $1 == "compiler" { compiler = substr($0, 10) }
        $1 == "count" { n[$2, "L"] = $3; n[$2, "S"] = $4 }
        $1 == "work" {
            for (i = 5; i <= 12; i++) work[$2, $3, $4, i] = $i
            if (!(($2) in core_seen)) { core_seen[$2] = 1; core[++n_cores] = $2 }
        }
        $1 == "scene" {
            key = $3 " " $4
            if (!(key in seen)) { seen[key] = 1; name[++n_names] = key }
            sum[$2, key] = total(); pixels = $13
            shadow[$2, key] = $7; begin[$2, key] = $5 + $6; prep[$2, key] = $8 + $9; raster[$2, key] = $10; shade[$2, key] = $11
            px[key] = $13; tri[key] = $14; caster[key] = $15; texels[key] = $16
        }
        $1 == "model" { if ($2 == "M3") { row[++n_rows] = $3; triangles[$3] = $14; casters[$3] = $15 } stage[$2, $3, 0] = total(); for (i = 5; i <= 11; i++) stage[$2, $3, i] = $i }
        $1 == "changes" { if ($4 == "first") changing[++n_changing] = $3; frames[$3, $4] = total() }
        function million(n) { return sprintf("%.2f", n / 1e6) }
        function net(c, what, set, i) {
            return work[c, what, set, i] - work[c, "flat-shadow", "empty", i] * (1 - n["visible_px", set] / (320 * 240))
        }
        function drawing(c, what, set,    i, s) { s = 0; for (i = 8; i <= 11; i++) s += net(c, what, set, i); return s }
        function solve(l, s, pixels,    det) {
            det = n["triangles", "L"] * n[pixels, "S"] - n["triangles", "S"] * n[pixels, "L"]
            a = (l * n[pixels, "S"] - s * n[pixels, "L"]) / det
            b = (n["triangles", "L"] * s - n["triangles", "S"] * l) / det
            return sprintf("%.0f + %.1f", a, b)
        }
        END {
            print "Compilers: " compiler "; -O2, preset balanced for the workload. M3-fast has `vertex_light` 1 (Gouraud shading: light is"
            print "found at vertices), `persp_step` 16 and screen tiles of 320x16, which take 28 KB more than those of 64x16.\n"
            print "The workload. Instructions per triangle + per covered pixel of everything from `gn_prepare` to the last flush; visible surfaces"
            print "are setup, binning and rasterising; shading is per triangle + per *visible* pixel.\n"
            print "| core | case | everything | visible surfaces | shading | shading, L, per visible pixel | shadow tile, L, per caster | everything, L | everything, S |"
            print "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
            split("flat gouraud flat-shadow gouraud-shadow", cases, " ")
            for (c = 1; c <= n_cores; c++) for (k = 1; k <= 4; k++) {
                q = core[c]; w = cases[k]
                l = s = 0
                for (i = 8; i <= 10; i++) { l += net(q, w, "L", i); s += net(q, w, "S", i) }
                printf "| %s | %s | %s | %s | %s | %.1f | %s | %.2f M | %.2f M |\n", q, w, solve(drawing(q, w, "L"), drawing(q, w, "S"), "covered_px"),
                    solve(l, s, "covered_px"), solve(net(q, w, "L", 11), net(q, w, "S", 11), "visible_px"), net(q, w, "L", 11) / n["visible_px", "L"],
                    w ~ /shadow/ ? sprintf("%.0f", (work[q, w, "L", 7] - work[q, "flat-shadow", "empty", 7]) / n["casters", "L"]) : "",
                    drawing(q, w, "L") / 1e6, drawing(q, w, "S") / 1e6
            }
            if (n_rows) {
                print "\nCharacters (`tests/bench/scenes`), a first frame of 240×320 in preset fast, with ground, sun and shadow (3×3). Millions of instructions:\n"
                print "| character | M3 | RV32 | M0 | views, M3 | shadow tiles, M3 | setup and bins, M3 | raster, M3 | shading, M3 | visible triangles | caster triangles |"
                print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
                for (i = 1; i <= n_rows; i++) {
                    k = row[i]
                    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %d | %d |\n", k, million(stage["M3", k, 0]), million(stage["RV32", k, 0]), million(stage["M0", k, 0]),
                        million(stage["M3", k, 5] + stage["M3", k, 6]), million(stage["M3", k, 7]), million(stage["M3", k, 8] + stage["M3", k, 9]),
                        million(stage["M3", k, 10]), million(stage["M3", k, 11]), triangles[k], casters[k]
                }
            }
            if (n_changing) {
                print "\nWhat changed (`incremental` 2, of the game 3; `fit=compiled`): frames by `gn_render_changes`, 320×240, preset balanced, Cortex-M3. Millions of instructions:\n"
                print "| scene | first | mean of the next four | of the first | nothing changed |\n| --- | --- | --- | --- | --- |"
                for (i = 1; i <= n_changing; i++) {
                    k = changing[i]; first = frames[k, "first"]; later = (frames[k, "later"] - first) / 4
                    printf "| %s | %s | %s | %.0f %% | %.3f |\n", k, million(first), million(later), 100 * later / first, (frames[k, "still"] - frames[k, "later"]) / 4e6
                }
            }
            if (!n_names) exit
            print "\nThe own scenes, frame 0 as `gnomon compile` configures it: a first frame, with every shadow tile drawn. Instructions per picture pixel:\n"
            head = "| scene | preset |"; rule = "| --- | --- |"
            for (c = 1; c <= n_cores; c++) { head = head " " core[c] " |"; rule = rule " --- |" }
            print head " begin, M3 | shadow tiles, M3: per caster triangle | setup and bins, M3: per triangle | raster, M3: per pixel | shading, M3: per pixel | triangles | caster triangles | texels drawn |"
            print rule " --- | --- | --- | --- | --- | --- | --- | --- |"
            for (i = 1; i <= n_names; i++) {
                k = name[i]; split(k, part, " ")
                line = "| " part[1] " | " part[2] " |"
                for (c = 1; c <= n_cores; c++) line = line ((core[c], k) in sum ? sprintf(" %.0f |", sum[core[c], k] / px[k]) : " |")
                printf "%s %.0f K | %s | %.0f | %.1f | %.1f | %d | %d | %d |\n", line, begin["M3", k] / 1e3,
                    caster[k] ? sprintf("%.0f", shadow["M3", k] / caster[k]) : "", tri[k] ? prep["M3", k] / tri[k] : 0,
                    raster["M3", k] / px[k], shade["M3", k] / px[k], tri[k], caster[k], texels[k]
            }
        }' "$1"
}

BEGIN_MARK='<!-- begin: generated by tests/bench/bench_target.sh --write -->'
END_MARK='<!-- end: target -->'

. tests/bench/bench_part.sh

case ${1:-} in
--document) rewrite_document; exit ;;
--check) finish 0 ;;
esac
for core in M3 RV32; do sh boards/tools/count.sh --ready "$(board_of $core)"; done
make -s BOARD=mps2-an385 APP=bench BUILD="$BUILD" "$BUILD/firmware/bench/bench_meshes.h" >/dev/null # makes the workload
if [ "${1:-}" = --lines ]; then
    shift
    core=$1
    shift
    case $1 in
    models)
        shift
        models "$core" "$@"
        ;;
    changes) changes "$core" ;;
    *) scenes "$core" "$@" ;;
    esac
    exit
fi
if [ "${1:-}" = --write ]; then
    measure all >"$DIR/target.txt"
    cp "$DIR/target.txt" "$BASELINE"
    rewrite_document
    echo "bench: wrote $BASELINE and $DOC"
    exit 0
fi
quick=all
[ "${1:-}" = --quick ] && quick=quick
measure $quick >"$DIR/target.txt"

status=0
[ "$(grep '^compiler' "$BASELINE")" = "$(grep '^compiler' "$DIR/target.txt")" ] || echo "bench: the baseline is of other compilers"
awk '
    function total(    i, sum) { sum = 0; for (i = 5; i <= 12; i++) sum += $i; return sum }
    $1 != "work" && $1 != "scene" && $1 != "model" && $1 != "changes" { next }
    { key = $1 " " $2 " " $3 " " $4 }
    FNR == NR { then[key] = total(); next }
    {
        compared++
        now = total()
        change = then[key] ? 100 * (now - then[key]) / then[key] : 100
        if (change > 2 || change < -2) printf "%-36s %12d %12d %+7.2f %%%s\n", key, then[key], now, change, change > 2 ? "  WORSE" : "  better: --write"
        worse += change > 2; stale += change < -10
    }
    END {
        printf "bench: %d runs on targets, %d worse than the baseline by more than 2 %%\n", compared, worse
        if (stale) print "bench: " stale " figures are more than 10 % below the baseline, which is out of date: --write"
        exit worse > 0 || stale > 0 || compared < 9
    }' "$BASELINE" "$DIR/target.txt" || status=1
finish $status
