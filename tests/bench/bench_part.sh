# For the two benchmarks: their parts of docs/data/SPEED.md. Sourced; they define tables, BASELINE, DIR, DOC, BEGIN_MARK and END_MARK.

# The document with its generated part made from the baseline.
document() {
    tables "$BASELINE" >"$DIR/tables.md"
    awk -v begin="$BEGIN_MARK" -v end="$END_MARK" -v part="$DIR/tables.md" '
        $0 == end { inside = 0; closed = 1 }
        !inside { print }
        $0 == begin { inside = 1; while ((getline line < part) > 0) print line }
        END { if (!closed) exit 1 }' "$DOC"
}

rewrite_document() {
    document >"$DIR/speed.md"
    cp "$DIR/speed.md" "$DOC"
    sh docs/cost.sh
}

# finish STATUS: of the comparison; and the document must be what the baseline makes it
finish() {
    status=$1
    document >"$DIR/speed.md"
    cmp -s "$DIR/speed.md" "$DOC" || { echo "bench: FAILED: $DOC is not what $BASELINE makes it"; status=1; }
    [ "$status" = 0 ] && echo "bench: ok"
    exit "$status"
}
