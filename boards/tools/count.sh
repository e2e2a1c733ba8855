#!/bin/sh
# Counts the instructions that firmware takes for its picture, stage by stage: builds boards/apps/bench.c, and runs it in the emulator under
# stage_plugin.c.
#   sh boards/tools/count.sh BOARD IMAGE ARGS[,ARGS...] [VARIABLE=VALUE...]
#                                                 for each of ARGS: "args: ARGS", "stage NAME INSTRUCTIONS" for each stage, in their order, and what
#                                                 the app prints. ARGS are the app's: a frame, or the first and the last; VARIABLEs are those of
#                                                 boards/boards.mk, IMAGE the name of the image
#   sh boards/tools/count.sh --ready BOARD        makes what every count needs. Status 3 with a line that says why, if this machine
#                                                                   cannot count; 1 with a line, if nothing counts on this board
#   sh boards/tools/count.sh --remove BOARD IMAGE  its files
#   sh boards/tools/count.sh --stages             their names: where several are given, the first that the image has. What runs before the first,
#                                                 and from scene_frame to the next, is none
# Environment: BUILD, JOBS (compilers at a time: 2).
set -eu
cd "$(dirname "$0")/../.."

BUILD=${BUILD:-build}
STAGES="gn_scene_validate|gn_changes_sign gn_views_setup gn_atlas_render_tile gn_setup_triangles gn_bin_triangles gn_raster_tile gn_shade_tile bench_flush"

board() { make -s --no-print-directory -j"${JOBS:-2}" BOARD="$board" APP=bench BUILD="$BUILD" "$@" </dev/null; }
setting() { board --eval="setting: ; @echo \$($1)" setting; } # setting VARIABLE

need() { command -v "$1" >/dev/null || { echo "$1 is not installed"; exit 3; }; }

ready() {
    [ -e "boards/$board/board.mk" ] || { echo "there is no board '$board': make boards lists those that there are"; exit 1; }
    [ "$(setting BOARD_RUNS)" = qemu ] || { echo "QEMU does not run $board: there is nothing to count with"; exit 1; }
    need make
    need "$(setting BOARD_CROSS)gcc"
    need "$(setting 'firstword $(BOARD_EMULATOR)')"
    board "$BUILD/gnomon" "$BUILD/libstages.so" >&2
}

count() { # count ARGS[,ARGS...] VARIABLE...
    all=$1
    shift
    dir=$BUILD/firmware/$board
    log=$dir/$image.log
    mkdir -p "$dir"
    board firmware IMAGE="$image" "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
    "$(setting BOARD_CROSS)nm" "$dir/$image.elf" >"$dir/$image.symbols"
    plugin=
    for stage in $STAGES scene_frame; do
        at=$(awk -v f="$stage" 'BEGIN { n = split(f, name, "|") } { for (i = 1; i <= n; i++) if ($3 == name[i]) at[i] = $1 }
            END { for (i = 1; i <= n && at[i] == ""; i++) continue; print at[i] }' "$dir/$image.symbols")
        plugin=$plugin,stage=${at:-ffffffff}
    done
    while [ -n "$all" ]; do
        args=${all%%,*}
        all=${all#"$args"}
        all=${all#,}
        echo "args: $args"
        board emulate IMAGE="$image" "$@" ARGS="$args" TIMEOUT=300 \
            EMULATOR_FLAGS="-display none -monitor none -serial none -plugin $BUILD/libstages.so,out=$dir/$image.stages$plugin" >"$log" 2>&1 ||
            { cat "$log" >&2; exit 1; }
        awk -v names="$STAGES" 'BEGIN { n = split(names, name, " ") } { sub(/[|].*/, "", name[$2]) } $2 > 0 && $2 <= n { print "stage", name[$2], $3 }' "$dir/$image.stages"
        tr -d '\r' <"$log"
    done
}

case ${1:-} in
--stages) echo "$STAGES" ;;
--ready)
    board=$2
    ready
    ;;
--remove)
    rm -rf "$BUILD/firmware/$2/$3".*
    ;;
*)
    board=$1 image=$2
    shift 2
    count "$@"
    ;;
esac
