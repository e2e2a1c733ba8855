# What the shell tests share, as check.h is for programs: counters, and a folder $tmp that goes away. Sourced from the project's root.
mkdir -p build/tmp
tmp=$(mktemp -d build/tmp/check.XXXXXX) || exit 1
trap 'chmod -R u+rwx "$tmp"; rm -rf "$tmp"' EXIT
trap 'exit 1' HUP INT TERM
export FW_DEBUG= # of firmware: it changes no code, and a fifth of the time goes there
passed=0 failed=0

pass() { passed=$((passed + 1)); }
fail() {
    failed=$((failed + 1))
    echo "$*"
}
