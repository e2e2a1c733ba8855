#!/bin/sh
# The short tables of cost in README.md and docs/COST.md, from the committed baselines: it measures nothing.
#   sh docs/cost.sh --table sizes|speed     prints one: flash, RAM and stack by configuration; instructions and frames per second by scene
#   sh docs/cost.sh                         writes them into the documents
# Frames per second: the board's clock / (counted instructions × cycles per instruction), both as in host/web/boards.txt.
cd "$(dirname "$0")/.." || exit 1

sizes() {
    awk '
        /^#/ { next }
        { figure[$1, $2, $3, $4] = $5 }
        END {
            print "| configuration | flash, Cortex-M0+ | flash, Cortex-M3 | flash, RV32IMAC | RAM | stack, Cortex-M3 |"
            print "| --- | --- | --- | --- | --- | --- |"
            n = split("smallest small tiny fast balanced accurate full", name, " ")
            for (i = 1; i <= n; i++) {
                c = name[i]
                printf "| %s | %d | %d | %d | %d | %d |\n", c, figure["flash", "Cortex-M0+", c, "linked"], figure["flash", "Cortex-M3", c, "linked"],
                    figure["flash", "RV32IMAC", c, "linked"], figure["ram", "Cortex-M3", c, "total"], figure["stack", "Cortex-M3", c, "gn_render"]
            }
        }' tests/firmware/size_baseline.txt
}

speed() {
    awk '
        NR == FNR {
            if ($1 == "board") clock[$2] = $3
            if ($1 == "core") cycles[$2] = $4
            next
        }
        $1 != "scene" || $13 != 320 * 240 { next }
        {
            total = 0
            for (i = 5; i <= 12; i++) total += $i
            at[$2, $3, $4] = total; pixels = $13
            if (!($3 in seen)) { seen[$3]; scene[++n] = $3 }
        }
        function per_px(core, s, preset) { return (core, s, preset) in at ? sprintf("%.0f", at[core, s, preset] / pixels) : "·" }
        function per_second(core, s, board, kind) { return sprintf("%.1f", clock[board] * 1e6 / (at[core, s, "balanced"] * cycles[kind])) }
        END {
            print "| scene, 320×240 | tiny | fast | balanced | accurate | balanced, Cortex-M0 | frames per second: Pico, 125 MHz | nRF52840, 64 MHz | STM32F411, 100 MHz | STM32F429, 168 MHz |"
            print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
            for (i = 1; i <= n; i++) {
                s = scene[i]
                printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", s, per_px("M3", s, "tiny"), per_px("M3", s, "fast"), per_px("M3", s, "balanced"),
                    per_px("M3", s, "accurate"), per_px("M0", s, "balanced"), per_second("M0", s, "pico", "cortex-m0"), per_second("M4", s, "nrf52840-dk", "cortex"), per_second("M4", s, "black-pill", "cortex"),
                    per_second("M4", s, "stm32f429-discovery", "cortex")
            }
        }' host/web/boards.txt tests/bench/bench_target_baseline.txt
}

if [ "${1:-}" = --table ]; then "$2"; exit; fi
mkdir -p build/tmp
work=$(mktemp -d build/tmp/cost.XXXXXX)
trap 'rm -rf "$work"' EXIT
for name in sizes speed; do
    $name >"$work/table"
    for document in README.md docs/COST.md; do
        awk -v name="$name" -v file="$work/table" '
            $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
            $0 == "<!-- end -->" { skip = 0 }
            !skip { print }' "$document" >"$work/next"
        cp "$work/next" "$document"
    done
done
