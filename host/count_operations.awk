# Have a program count its operations: from LLVM's intermediate text to the same with a call of lane_count
# (lane_counter.h) at the end of every basic block, which says how many operations of each kind the block has.
#
#     clang -S -emit-llvm -include host/lane_counter.h FILE.c -o FILE.ll; awk -f host/count_operations.awk FILE.ll
#
# The text of clang 14 is known, with typed pointers or plain ones. What is not known (an instruction, an intrinsic
# function, vectors) is an error with its line and exit status 1, for counts that leave something out are worth nothing.
# Kinds are those of lane_operation in lane.h.

BEGIN {
    known("multiply", "mul")
    known("divide", "udiv sdiv urem srem")
    known("add", "add sub")
    known("load", "load")
    known("store", "store")
    known("other", "icmp and or xor shl lshr ashr select br switch ret")
    # addresses are part of loads and stores, conversions and copies mostly of nothing
    known("none", "getelementptr phi zext sext trunc bitcast ptrtoint inttoptr freeze alloca extractvalue insertvalue")
    known("none", "unreachable")
    known("add", "llvm.uadd.sat llvm.usub.sat llvm.sadd.sat llvm.ssub.sat llvm.uadd.with.overflow")
    known("add", "llvm.usub.with.overflow llvm.sadd.with.overflow llvm.ssub.with.overflow")
    known("multiply", "llvm.umul.with.overflow llvm.smul.with.overflow")
    known("other", "llvm.ctlz llvm.cttz llvm.abs llvm.smin llvm.smax llvm.umin llvm.umax llvm.fshl llvm.fshr llvm.bswap")
    known("other", "llvm.trap")
    known("none", "llvm.lifetime.start llvm.lifetime.end llvm.assume llvm.experimental.noalias.scope.decl llvm.expect")
    split("br switch ret unreachable", words, " ")
    for (i in words)
        ends[words[i]] = 1
}

function known(what, words, list, count, i) {
    count = split(words, list, " ")
    for (i = 1; i <= count; i++)
        kind[list[i]] = what
}

function fail(message) {
    printf "%s:%d: %s; expected what is listed in count_operations.awk\n", FILENAME, FNR, message >"/dev/stderr"
    failed = 1
    exit 1
}

function start_block() {
    delete count
}

# The names behind %: none of the program's own has this form.
function print_counts() {
    printf "  call void @lane_count(i64 %d, i64 %d, i64 %d, i64 %d, i64 %d, i64 %d)\n", count["multiply"], count["divide"],
        count["add"], count["load"], count["store"], count["other"]
}

# Words of 32 bits that memcpy or memset moves: the third argument, a number or a variable.
function count_block_move(text, reads, size) {
    size = text
    if (!sub(/^.*, i64 (noundef )?/, "", size) || !sub(/[,)].*$/, "", size))
        fail("a size that is not an i64: " text)
    if (size ~ /^[0-9]+$/) {
        count["store"] += int((size + 3) / 4)
        count["load"] += reads * int((size + 3) / 4)
        return
    }
    moves++
    printf "  %%lane.words.%d = lshr i64 %s, 2\n", moves, size
    printf "  call void @lane_count(i64 0, i64 0, i64 0, i64 %s, i64 %%lane.words.%d, i64 0)\n", \
        reads ? "%lane.words." moves : 0, moves
}

# A call's function by its name without types: llvm.memcpy of @llvm.memcpy.p0i8.p0i8.i64.
function count_call(text, name) {
    name = text
    if (!sub(/^[^@(]*@/, "", name) || !sub(/\(.*$/, "", name)) { # by a pointer
        count["other"]++
        return
    }
    if (name ~ /^(llvm\.)?mem(cpy|move)(\.|$)/)
        return count_block_move(text, 1)
    if (name ~ /^(llvm\.)?memset(\.|$)/)
        return count_block_move(text, 0)
    if (name !~ /^llvm\./) {
        count["other"]++
        return
    }
    while (!(name in kind) && sub(/\.[^.]*$/, "", name))
        ;
    if (!(name in kind))
        fail("an unknown intrinsic function: " text)
    count[kind[name]]++
}

# A division by a constant becomes a multiplication, or a shift.
function count_instruction(word, text) {
    if (!(word in kind))
        fail("an unknown instruction: " text)
    sub(/(, ![a-z.]+ ![0-9]+)+$/, "", text)
    if (kind[word] == "divide" && text ~ /, -?[0-9]+$/)
        count["multiply"]++
    else
        count[kind[word]]++
}

/^define / {
    inside = $0 !~ / @lane_count\(/
    has_counter = has_counter || !inside
    start_block()
    ended = 0
}

/^}/ {
    if (inside && !ended)
        fail("a function that does not end")
    inside = 0
}

inside && /^[-a-zA-Z$._0-9"]+:/ {
    start_block()
    ended = 0
}

# An instruction: two spaces, then perhaps a result. The cases of a switch are indented by more.
inside && /^  [^ \]]/ {
    if ($0 ~ /<[0-9]+ x /)
        fail("a vector: " $0)
    text = $0
    sub(/^  /, "", text)
    sub(/^%[^ ]+ = /, "", text)
    word = text
    sub(/ .*$/, "", word)
    if (word ~ /^(tail|notail)$/)
        word = "call"
    print_before_end = word in ends
    if (word != "call")
        count_instruction(word, text)
    if (print_before_end) {
        print_counts()
        ended = 1
    }
    print
    if (word == "call")
        count_call(text)
    next
}

{ print }

END {
    if (!failed && !has_counter) {
        printf "%s: no function lane_count; expected the text of a file that includes lane_counter.h\n", FILENAME \
            >"/dev/stderr"
        exit 1
    }
}
