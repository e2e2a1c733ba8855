#!/bin/sh
# The short tables of cost in README.md and docs/COST.md, from the committed baselines: it measures nothing. Each header names its build.
#   sh docs/cost.sh --table NAME            prints one. sizes: flash, RAM and stack by configuration. speed: instructions, flash and frames per second
#                                           by scene, with -O2. builds: instructions and flash by scene, with -O2 and with -Os
#   sh docs/cost.sh                         writes them into the documents
# Frames per second: the board's clock / (counted instructions × cycles per instruction), both as in host/web/boards.txt. A dot: not measured.
cd "$(dirname "$0")/.." || exit 1

sizes() {
    awk '
        /^#/ { next }
        { figure[$1, $2, $3, $4] = $5 }
        function flash(core, c, what) { return ("flash", core, c, what) in figure ? figure["flash", core, c, what] : "·" }
        END {
            print "| configuration | flash, Cortex-M3, -O2 | flash, Cortex-M3, -Os | flash, Cortex-M0+, -Os | flash, RV32IMAC, -Os | RAM | stack, Cortex-M3, -Os |"
            print "| --- | --- | --- | --- | --- | --- | --- |"
            n = split("smallest small tiny fast balanced accurate full", name, " ")
            for (i = 1; i <= n; i++) {
                c = name[i]
                printf "| %s | %s | %s | %s | %s | %d | %d |\n", c, flash("Cortex-M3", c, "linked-O2"), flash("Cortex-M3", c, "linked"), flash("Cortex-M0+", c, "linked"),
                    flash("RV32IMAC", c, "linked"), figure["ram", "Cortex-M3", c, "total"], figure["stack", "Cortex-M3", c, "gn_render"]
            }
        }' tests/firmware/size_baseline.txt
}

# scenes END: the counts of the own scenes, read into total, per_px and flash by core, scene and preset; then END
scenes() {
    awk '
        NR == FNR {
            if ($1 == "board") clock[$2] = $3
            if ($1 == "core") cycles[$2] = $4
            next
        }
        $1 != "scene" || $13 != 320 * 240 { next }
        {
            sum = 0
            for (i = 5; i <= 12; i++) sum += $i
            total[$2, $3, $4] = sum
            per_px[$2, $3, $4] = sprintf("%.0f", sum / $13)
            if (NF > 16) flash[$2, $3, $4] = $17
            if (!($3 in seen)) { seen[$3]; scene[++n] = $3 }
        }
        function px(core, s, preset) { return (core, s, preset) in per_px ? per_px[core, s, preset] : "·" }
        function bytes(core, s, preset) { return (core, s, preset) in flash ? flash[core, s, preset] : "·" }
        function per_second(core, s, board, kind) { return sprintf("%.1f", clock[board] * 1e6 / (total[core, s, "balanced"] * cycles[kind])) }
        '"$1" host/web/boards.txt tests/bench/bench_target_baseline.txt
}

speed() {
    scenes 'END {
        print "| scene, 320×240, -O2 | tiny | fast | balanced | accurate | flash, balanced | balanced, Cortex-M0 | frames per second: Pico, 125 MHz | nRF52840, 64 MHz | STM32F411, 100 MHz | STM32F429, 168 MHz |"
        print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
        for (i = 1; i <= n; i++) {
            s = scene[i]
            printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", s, px("M3", s, "tiny"), px("M3", s, "fast"), px("M3", s, "balanced"), px("M3", s, "accurate"),
                bytes("M3", s, "balanced"), px("M0", s, "balanced"), per_second("M0", s, "pico", "cortex-m0"), per_second("M4", s, "nrf52840-dk", "cortex"),
                per_second("M4", s, "black-pill", "cortex"), per_second("M4", s, "stm32f429-discovery", "cortex")
        }
    }'
}

builds() {
    scenes 'END {
        print "| scene, 320×240, balanced, Cortex-M3 | instructions per pixel, -O2 | flash, -O2 | instructions per pixel, -Os | flash, -Os |"
        print "| --- | --- | --- | --- | --- |"
        for (i = 1; i <= n; i++) {
            s = scene[i]
            printf "| %s | %s | %s | %s | %s |\n", s, px("M3", s, "balanced"), bytes("M3", s, "balanced"), px("M3-Os", s, "balanced"), bytes("M3-Os", s, "balanced")
        }
    }'
}

if [ "${1:-}" = --table ]; then "$2"; exit; fi
mkdir -p build/tmp
work=$(mktemp -d build/tmp/cost.XXXXXX)
trap 'rm -rf "$work"' EXIT
for name in sizes speed builds; do
    $name >"$work/table"
    for document in README.md docs/COST.md; do
        awk -v name="$name" -v file="$work/table" '
            $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
            $0 == "<!-- end -->" { skip = 0 }
            !skip { print }' "$document" >"$work/next"
        cp "$work/next" "$document"
    done
done
