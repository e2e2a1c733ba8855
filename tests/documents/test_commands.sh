#!/bin/sh
# Every target of the Makefile is run by a test, or at least can be: a table below says by which. Every command that README and docs/
# tell people to type has what it needs. START and TUTORIAL have tests of their own. usage: test_commands.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

# ---- Targets: by TEST WORD, a test that has this word; here COMMAND, which says SAYS; dry, what takes minutes ------------------

make -s help >"$tmp/help"
target_is() { # target_is TARGET HOW ...
    target=$1 how=$2
    echo "$target" >>"$tmp/known"
    shift 2
    case $how in
    by) grep -q -e "$2" "$1" && pass || fail "make $target: $1 does not run it ($2)" ;;
    here)
        said=$1
        shift
        "$@" >"$tmp/log" 2>&1
        grep -q -e "$said" "$tmp/log" && pass || fail "$*: $(tail -n 1 "$tmp/log")"
        ;;
    dry) # its prerequisites have rules, its scripts have no wrong syntax and name no script that is not there
        make -n "$target" >"$tmp/log" 2>&1 && pass || fail "make -n $target: $(grep -m 1 'make' "$tmp/log")"
        grep -o 'sh [a-z][a-zA-Z_0-9/]*\.sh' "$tmp/log" | sort -u | while read -r _ script; do
            sh -n "$script" || echo "$script"
            sed 's/ *#.*//' "$script" | grep -o '\(tests\|docs\|boards\|host\)/[a-zA-Z_0-9/]*\.\(sh\|awk\|js\|c\)' | while read -r file; do [ -e "$file" ] || echo "$script: $file"; done
        done >"$tmp/lacking" 2>&1
        [ -s "$tmp/lacking" ] && fail "make $target: $(head -n 1 "$tmp/lacking")" || pass
        ;;
    esac
}
target_is all by tests/run.sh 'build all'
target_is help by tests/documents/test_rules.sh 'make -s help'
target_is run by tests/run.sh 'make -s run'
target_is deps by Makefile '^test: deps'
target_is test by Makefile 'sh tests/run.sh'
target_is soak here 'no such campaign: none' make soak CAMPAIGNS=none
target_is mutate dry
target_is prove here 'nothing proved\|passed, 0 failed' make prove NAMES=prove_clz
target_is machines here 'no such machine: none' make machines MACHINES=none
target_is coverage dry
target_is bench by tests/run.sh 'sh tests/bench/bench.sh'
target_is bench by tests/documents/test_tables.sh 'for bench in bench bench_target'
target_is firmware by tests/tool/test_compile.sh 'make -s firmware'
target_is emulate by tests/firmware/test_port.sh 'emulate APP=port'
target_is screen by tests/firmware/test_displays.sh 'make -s screen'
target_is boards here '^  pico  *Raspberry' make boards
target_is size by tests/firmware/test_size.sh 'size.sh --figures'
target_is dist by tests/tool/test_packages.sh 'dist.sh'
target_is test-packages by Makefile 'sh tests/tool/test_packages.sh'
target_is docs dry
target_is matrix by tests/documents/test_matrix.sh 'matrix.sh --scene'
target_is report by tests/tool/test_report.sh 'report.sh'
target_is playground by tests/web/test_wasm.sh 'playground.html'
target_is test-playground dry
target_is tables by tests/documents/test_rules.sh 'build/gen_tables >'
target_is prefix by tests/property/test_mixed.sh 'gen_prefix.sh'
target_is scenes here '^same$' sh -c 'make -s build/make_scenes >/dev/null && mkdir "$0/own" "$0/docs" "$0/bench" && build/make_scenes "$0/own" "$0/docs" "$0/bench" && diff -r "$0/bench" tests/bench/scenes && diff -r "$0/own" host/scenes && diff -r -x "*.md" "$0/docs" docs/scenes && echo same' "$tmp"
target_is clean by tests/documents/test_rules.sh 'make -s clean'
sed -n 's/^  make \([a-z-]*\) .*/\1/p' "$tmp/help" | grep -v -x -F -f "$tmp/known" >"$tmp/found"
[ -s "$tmp/found" ] && fail "no test runs these targets: $(tr '\n' ' ' <"$tmp/found")" || pass

# the campaigns that take hours, and the mutants: their programs choose what to do
ok() { "$@" >"$tmp/log" 2>&1 && pass || fail "$*: $(tail -n 1 "$tmp/log")"; }
for name in $(sed -n 's/^    \([a-z |]*\)) campaign .*/\1/p' tests/soak.sh | tr '|' ' '); do
    case $name in extremes) name=extremes_many ;; files) name=fuzz ;; panels) name=panel_fuzz ;; models) name=accuracy ;; esac
    [ -n "$(find tests -name "test_$name.c")" ] && pass || fail "make soak: there is no test_$name.c"
done
ok gcc -std=c11 -O1 -o "$tmp/mutants" tests/mutation/mutants.c
[ "$("$tmp/mutants" 1 3 lib/base/gn_math.c | grep -c '^lib/base/gn_math.c [0-9]* [0-9]* ')" = 3 ] && pass || fail "make mutate chooses no mutants"

# ---- Commands of documents ---------------------------------------------------------------------------------------------------

# The commands that begin with a word: lines, also indented ones, and what stands between backticks. Remarks behind them go.
typed() {
    cat $(ls README.md docs/*.md lib/README.md host/README.md boards/README.md port/README.md | grep -v -e START -e TUTORIAL -e CHANGELOG) |
        awk -v word="$1" '
            function show(text) { sub(/  +#.*/, "", text); sub(/   .*/, "", text); if (index(text, word " ") == 1) print text }
            { line = $0; sub(/^ +/, "", line); show(line); n = split($0, part, "`"); for (i = 2; i <= n; i += 2) show(part[i]) }' | sort -u
}

# Dry: files that a reader has, and names that the reader gives, are those of the project.
typed make | grep '=' | sed -e 's/\(SCENE\|SCENES\)=\(FILE\|\(my\|scene\|mesh\)\.[a-z]*\)/\1=host\/scenes\/cube.gltf/; s/BOARD=\(NAME\|yours\)/BOARD=mps2-an385/' >"$tmp/typed"
grep 'BOARD=\|WRITE=\|SCENES=\|CAMPAIGNS=' "$tmp/typed" >"$tmp/make"
[ "$(wc -l <"$tmp/make")" -gt 15 ] && pass || fail "documents have $(wc -l <"$tmp/make") commands of make"
while read -r command; do
    sh -c "$(echo "$command" | sed 's/^make /make -n /')" >"$tmp/log" 2>&1 </dev/null && pass || fail "$command: $(tail -n 1 "$tmp/log")"
done <"$tmp/make"
# what costs seconds is done: programs of this machine
sed -n "/BOARD=host/s|\([ =]\)\([a-z]*\.\(rgb565\|ppm\)\)|\1$tmp/\2|p" "$tmp/make" | while read -r command; do
    sh -c "$command FW_OPT=-O0 IMAGE=test-typed-$(echo "$command" | cksum | cut -d " " -f 1)" >"$tmp/log" 2>&1 </dev/null || echo "$command: $(tail -n 1 "$tmp/log")"
done >"$tmp/found"
[ -s "$tmp/found" ] && fail "$(head -n 1 "$tmp/found")" || pass

# The tool's: as they stand, in small pictures.
tool=$(realpath "$tool")
mkdir -p "$tmp/work/boards" "$tmp/bin"
ln -s "$tool" "$tmp/bin/gnomon"
cp -r boards/pico "$tmp/work/boards/"
cp docs/scenes/edge.gltf "$tmp/work/scene.gltf"
cp docs/scenes/edge.gltf "$tmp/work/my.gltf"
printf 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 2 0\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n' >"$tmp/work/mesh.obj"
"$tool" bake docs/scenes/edge.gltf -o "$tmp/work/scene.glb" --size 32x24 --still --texels 0 >"$tmp/log" 2>&1 || fail "no scene.glb: $(tail -n 1 "$tmp/log")"
{ typed build/gnomon | sed 's/^build.//' && typed gnomon; } | grep ' \(scene\|mesh\|my\)\.[a-z]* \|^gnomon help$' | grep -v -e --target -e --show | sort -u >"$tmp/tool"
[ "$(wc -l <"$tmp/tool")" -gt 7 ] && pass || fail "documents have $(wc -l <"$tmp/tool") commands of the tool"
while read -r command; do
    case $command in gnomon\ help) small= ;; *\ advise\ * | *\ sweep\ *) small="--size 32x24 --quick" ;; *) small="--size 32x24" ;; esac
    (cd "$tmp/work" && PATH=$PWD/../bin:$PATH sh -c "$command $small") >"$tmp/log" 2>&1 </dev/null && pass || fail "$command: $(tail -n 1 "$tmp/log")"
done <"$tmp/tool"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
