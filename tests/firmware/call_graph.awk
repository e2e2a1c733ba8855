# Worst-case stack of every function of a linked image, and who calls whom.
#   awk -f tests/firmware/call_graph.awk FILE.su... - <disassembly
#
# Frames are the compiler's (-fstack-usage); of what comes without, the runtime library's helpers, everything that is pushed counts. Calls
# are what the image's disassembly shows (objdump -d), so that nothing the linker put in is missed. Prints, one per line:
#   stack FUNCTION BYTES CHAIN   the deepest chain that starts there
#   call FUNCTION CALLEE
#   indirect FUNCTION            it calls through a pointer: what lies behind is not counted
#   recursion FUNCTION           it can come back to itself
#   unbounded FUNCTION           its frame has no bound that the compiler knows
FILENAME != "-" && FILENAME != "" && FILENAME ~ /\.su$/ {
    n = split($1, at, ":")
    if (!(at[n] in su) || $2 > su[at[n]]) su[at[n]] = $2
    if ($3 !~ /^static/ && $3 !~ /bounded/) dynamic[at[n]] = 1
    next
}
/^[0-9a-f]+ <.*>:$/ {
    at_address = address($1)
    here = substr($2, 2, length($2) - 3)
    name[at_address] = here
    current = at_address
    functions[++n_functions] = current
    next
}
$1 !~ /:$/ { next }
{ op = $2; operands = $0; sub(/^[^\t]*\t[^\t]*\t?/, "", operands) }
# frames of what has no .su: Arm, RISC-V
op ~ /^push/ || (op ~ /^stmdb/ && operands ~ /^sp!/) { pushed[current] += 4 * registers(operands) }
op ~ /^sub/ && operands ~ /^sp, (sp, )?#/ { sub(/.*#/, "", operands); pushed[current] += operands + 0 }
op ~ /^(c\.)?addi/ && operands ~ /^sp,(sp,)?-/ { sub(/.*,-/, "", operands); pushed[current] += operands + 0 }
# calls; a branch to another function is a call in tail position, after the frame is gone
op == "bl" || op == "jal" { calls(0) }
(op ~ /^b/ && op !~ /^(bl|bx|bic|bfi|bfc|bkpt)/) || op == "j" || op == "tail" { calls(1) }
op == "blx" || op == "jalr" { indirect[current] = 1 }
op == "bx" && operands !~ /^lr/ { indirect[current] = 1 }

function address(s) { sub(/^0+/, "", s); sub(/:$/, "", s); return s }

# of a list such as {r4, r5, r6, r7, lr} or {r4-r7, lr}
function registers(list,    n, part, i, ends, total) {
    gsub(/[{} ]|^sp!,/, "", list)
    n = split(list, part, ",")
    for (i = 1; i <= n; i++) {
        if (split(part[i], ends, "-") == 2) { gsub(/[a-z]/, "", ends[1]); gsub(/[a-z]/, "", ends[2]); total += ends[2] - ends[1] + 1 }
        else total++
    }
    return total
}

function calls(tail,    target, where) {
    if (!match(operands, /[0-9a-f]+ <[^>]*>/)) return
    target = substr(operands, RSTART, RLENGTH)
    where = address(substr(target, 1, index(target, " ") - 1))
    if (target ~ /\+0x/ || (tail && where == current)) return
    if ((current, where) in edge) { if (!tail) edge[current, where] = 1; return }
    edge[current, where] = tail ? 2 : 1
    callee[current, ++n_callees[current]] = where
}

function frame(f,    base) {
    base = name[f]
    if (base in su) return su[base]
    sub(/\.[0-9]+$/, "", base)
    if (base in su) return su[base]
    sub(/\.(constprop|isra|part|cold).*/, "", base)
    if (base in su) return su[base]
    return pushed[f] + 0
}

function own(f,    base) {
    base = name[f]
    sub(/\.(constprop|isra|part|cold|[0-9]).*/, "", base)
    return base in su || name[f] in su
}

function depth(f,    i, to, below, best, most) {
    if (state[f] == 2) return deepest[f]
    if (state[f] == 1) { print "recursion", name[f]; return 0 }
    state[f] = 1
    most = frame(f)
    chain[f] = name[f] ":" frame(f)
    best = ""
    for (i = 1; i <= n_callees[f]; i++) {
        to = callee[f, i]
        below = depth(to) + (edge[f, to] == 2 ? 0 : frame(f))
        if (below > most) { most = below; best = to }
    }
    if (best != "") chain[f] = (edge[f, best] == 2 ? "" : chain[f] " ") chain[best]
    state[f] = 2
    return deepest[f] = most
}

END {
    for (i = 1; i <= n_functions; i++) {
        f = functions[i]
        depth(f)
        print "stack", name[f], deepest[f], chain[f]
        for (k = 1; k <= n_callees[f]; k++) print "call", name[f], name[callee[f, k]]
        if (indirect[f] && own(f)) print "indirect", name[f]
        base = name[f]
        sub(/\.(constprop|isra|part|cold|[0-9]).*/, "", base)
        if (base in dynamic) print "unbounded", name[f]
    }
}
