# Have a program count its operations: from LLVM's intermediate text to the same with a call of lane_count
# (lane_counter.h) at the end of every basic block, which says how many operations of each kind (lane_operation in
# lane.h) the block has.
#
#     clang -S -emit-llvm -include host/lane_counter.h FILE.c -o FILE.ll; awk -f host/count_operations.awk FILE.ll
#
# Known is what clang 14 to 19 make of C without vectors, atomics, floating point and debug information. What is not
# known is an error with its line and exit status 1: counts that leave something out are worth nothing.

BEGIN {
    know("multiply", "mul")
    know("divide", "udiv sdiv urem srem")
    know("add", "add sub")
    know("load", "load")
    know("store", "store")
    know("other", "icmp and or xor shl lshr ashr select br switch ret")
    # addresses are part of loads and stores; conversions and copies are mostly of nothing
    know("none", "getelementptr phi zext sext trunc bitcast ptrtoint inttoptr freeze alloca extractvalue insertvalue")
    know("none", "unreachable")
    know("multiply", "llvm.umul.with.overflow llvm.smul.with.overflow")
    know("add", "llvm.uadd.sat llvm.usub.sat llvm.sadd.sat llvm.ssub.sat llvm.uadd.with.overflow")
    know("add", "llvm.usub.with.overflow llvm.sadd.with.overflow llvm.ssub.with.overflow")
    know("other", "llvm.ctlz llvm.cttz llvm.abs llvm.smin llvm.smax llvm.umin llvm.umax llvm.ucmp llvm.scmp")
    know("other", "llvm.fshl llvm.fshr llvm.bswap llvm.trap")
    know("none", "llvm.lifetime.start llvm.lifetime.end llvm.assume llvm.expect llvm.experimental.noalias.scope.decl")
    for (count = split("br switch ret unreachable", words, " "); count > 0; count--)
        ends_block[words[count]] = 1
}

function know(what, words, list, i) {
    for (i = split(words, list, " "); i > 0; i--)
        kind[list[i]] = what
}

function fail(message) {
    printf "%s:%d: %s; expected what count_operations.awk knows\n", FILENAME, FNR, message >"/dev/stderr"
    failed = 1
    exit 1
}

function start_block() {
    of["multiply"] = of["divide"] = of["add"] = of["load"] = of["store"] = of["other"] = 0
    open = 1
}

function end_block() {
    printf "  call void @lane_count(i64 %d, i64 %d, i64 %d, i64 %d, i64 %d, i64 %d)\n", of["multiply"], of["divide"],
        of["add"], of["load"], of["store"], of["other"]
    open = 0
}

# memcpy and memset, of `reads` blocks: the third argument's bytes in words of 32 bits.
function count_block_move(text, reads) {
    if (!match(text, /, i(32|64) [0-9]+[,)]/))
        fail("a block of a size that is no constant: " text)
    text = substr(text, RSTART + 6, RLENGTH - 7)
    of["store"] += int((text + 3) / 4)
    of["load"] += reads * int((text + 3) / 4)
}

# What is called stands before its first bracket; where it is a pointer, nothing does.
function count_call(text, name) {
    if (!match(text, /@[-a-zA-Z$._0-9"]+\(/)) {
        of["other"]++
        return
    }
    name = substr(text, RSTART + 1, RLENGTH - 2)
    if (name ~ /^(llvm\.)?mem(cpy|move)(\.|$)/)
        count_block_move(text, 1)
    else if (name ~ /^(llvm\.)?memset(\.|$)/)
        count_block_move(text, 0)
    else if (name !~ /^llvm\./)
        of["other"]++
    else {
        while (!(name in kind) && sub(/\.[^.]*$/, "", name)) # its types: llvm.abs of llvm.abs.i32
            ;
        if (!(name in kind))
            fail("an unknown function of the compiler's own: " text)
        of[kind[name]]++
    }
}

# A division by a constant becomes a multiplication, or shifts.
function count_instruction(word, text) {
    if (!(word in kind))
        fail("an unknown instruction: " text)
    sub(/(, ![a-zA-Z._0-9]+ ![0-9]+)+$/, "", text)
    if (kind[word] == "divide" && text ~ /, -?[0-9]+$/)
        of["multiply"]++
    else
        of[kind[word]]++
}

/^define / {
    inside = $0 !~ /@lane_count\(/
    has_counter = has_counter || !inside
    start_block()
}

inside && /^}/ {
    if (open)
        fail("a function's end within a block")
    inside = 0
}

inside && /^[-a-zA-Z$._0-9"]+:/ {
    if (open && !at_start)
        fail("a block without an end")
    start_block()
}

# Is this line a function's first, or a remark?
{ at_start = /^define / || (at_start && /^($|;)/) }

# An instruction: two spaces, then perhaps what its result is called. The cases of a switch are indented by more, its
# last line is a bracket.
inside && /^  [^ \]]/ {
    if (!open)
        fail("an instruction outside of a block: " $0)
    if (/<[0-9]+ x |<vscale /)
        fail("a vector: " $0)
    text = substr($0, 3)
    sub(/^%[^ ]+ = /, "", text)
    word = text
    sub(/ .*$/, "", word)
    if (word ~ /^(call|tail|notail)$/)
        count_call(text)
    else
        count_instruction(word, text)
    if (word in ends_block)
        end_block()
}

{ print }

END {
    if (!failed && !has_counter) {
        printf "%s: no function lane_count; expected the text of a file that includes lane_counter.h\n", FILENAME \
            >"/dev/stderr"
        exit 1
    }
}
