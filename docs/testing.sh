#!/bin/sh
# The generated parts of docs/TESTING.md, from the tests' own files. usage: testing.sh [OUT_DIR]
set -e
out=${1:-docs}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() { find tests/"$1" -maxdepth 1 -name "test_*.$2" | wc -l; }
{
    echo "| folder of tests/ | what | programs | scripts |"
    echo "|---|---|---|---|"
    sed -n 's|^#   \([a-z]*\)/  *\(.*\)|\1 \2|p' tests/run.sh | while read -r folder what; do
        echo "| \`$folder/\` | $what | $(count "$folder" c) | $(count "$folder" sh) |"
    done
} >"$work/folders"
{
    echo "| campaign of make soak | what |"
    echo "|---|---|"
    sed -n '/^$/q; s/^# \([a-z]*\(, [a-z]*\)*\)   *\(.*\)/| \1 | \3 |/p' tests/soak.sh
} >"$work/campaigns"
# /* FUNCTIONS: OPERANDS */ above void prove_NAME(void)
{
    echo "| harness | functions, and for which operands |"
    echo "|---|---|"
    cat tests/prove/prove_*.c | awk '
        /^\/\* [a-z]/ { said = "" }
        /^\/\* [a-z]/, /\*\/$/ { line = $0; gsub(/^ *\/?\* ?| *\*\/$/, "", line); said = said (said == "" ? "" : " ") line }
        /^void prove_/ { name = $2; sub(/\(.*/, "", name); sub(/prove_/, "", name); gsub(/\|/, "\\|", said); print "| " name " | " said " |"; n++
            sub(/:.*/, "", said); functions += split(said, one, ", ") }
        END { print "\n" functions " functions in " n " harnesses." }'
} >"$work/proofs"
{ echo '```'; cat tests/mutation/result.txt; echo '```'; } >"$work/mutants"

{ echo '```'; cat tests/soak.txt; echo '```'; } >"$work/log"

for name in folders campaigns log proofs mutants; do
    awk -v name="$name" -v file="$work/$name" '
        $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
        $0 == "<!-- end -->" { skip = 0 }
        !skip { print }' "$([ -f "$work/next" ] && echo "$work/next" || echo docs/TESTING.md)" >"$work/now"
    mv "$work/now" "$work/next"
done
cp "$work/next" "$out/TESTING.md"
