#!/bin/sh
# Operations that a counting lane counts: the text of a function against counts made by hand, a compiled program against
# what its loops do, and refusals. Without clang the program is left out. LANE_CLANG, CC: the compilers.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tap.sh

clang=${LANE_CLANG-$(command -v clang)}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# ---- a text by hand ------------------------------------------------------------------------------------------------

# As newer compilers write it (plain pointers, words between instruction and type), then with typed pointers.
cat >"$folder/new.ll" <<'END'
define internal void @lane_count(i64 noundef %0, i64 noundef %1) #0 {
  %3 = load i64, ptr @lane_counters, align 8
  ret void
}

define dso_local i32 @by_hand(ptr nocapture noundef readonly %0, i32 noundef %1) local_unnamed_addr #1 {
  %3 = alloca [10 x i32], align 4
  call void @llvm.lifetime.start.p0(i64 40, ptr nonnull %3) #2
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 4 %3, ptr noundef %0, i64 38, i1 false), !tbaa !3
  %4 = icmp samesign ugt i32 %1, 1
  br i1 %4, label %5, label %17

5:                                                ; preds = %2
  %6 = getelementptr inbounds nuw i8, ptr %0, i64 4
  %7 = load i32, ptr %6, align 4, !tbaa !3
  %8 = mul nsw i32 %7, 3
  %9 = udiv i32 %8, %1, !srcloc !4
  %10 = urem i32 7, %1
  %11 = sdiv i32 %9, -10, !srcloc !4
  %12 = sub nsw i32 %11, %10
  %13 = add i32 %12, %1
  %14 = tail call range(i32 0, 33) i32 @llvm.ctlz.i32(i32 %13, i1 true)
  %15 = tail call i32 @llvm.usub.sat.i32(i32 %14, i32 2)
  %16 = zext nneg i32 %15 to i64
  store volatile i32 %13, ptr %6, align 4
  switch i32 %15, label %17 [
    i32 1, label %5
    i32 2, label %21
  ]

17:                                               ; preds = %2, %5
  %18 = phi i32 [ %13, %5 ], [ 0, %2 ]
  call void @llvm.memset.p0.i64(ptr noundef %3, i8 0, i64 8, i1 false)
  %19 = call i32 %0(ptr noundef nonnull %3)
  %20 = tail call i32 @other(i32 %19)
  ret i32 %20

21:                                               ; preds = %5
  tail call void @llvm.trap()
  unreachable
}

declare i32 @other(i32)
END
sed 's/\([ (]\)ptr /\1i8* /g; s/p0/p0i8/g; s/ samesign / /; s/ nuw / /; s/ nneg / /; s/ range(i32 0, 33)//' "$folder/new.ll" >"$folder/old.ll"

# memcpy of 38 bytes reads and writes 10 words. Then icmp and br; ctlz and switch; the other function, the one by a
# pointer and ret; trap. The saturated subtraction and the division by a constant count as what they become.
cat >"$folder/expected" <<'END'
  call void @lane_count(i64 0, i64 0, i64 0, i64 10, i64 10, i64 2)
  call void @lane_count(i64 2, i64 2, i64 3, i64 1, i64 1, i64 2)
  call void @lane_count(i64 0, i64 0, i64 0, i64 0, i64 2, i64 3)
  call void @lane_count(i64 0, i64 0, i64 0, i64 0, i64 0, i64 1)
END

counts() {
    awk -f host/count_operations.awk "$folder/$1" >"$folder/counted" || return 1
    grep '^  call void @lane_count' "$folder/counted" | diff "$folder/expected" - &&
        grep -v '^  call void @lane_count' "$folder/counted" | diff "$folder/$1" -
}
check "counts_are_those_made_by_hand_and_the_rest_stays" counts new.ll
check "so_are_they_with_typed_pointers" counts old.ll

# refused LINE EXPRESSION: new.ll, changed by sed, is refused for this line.
refused() {
    sed "$2" "$folder/new.ll" >"$folder/bad.ll"
    exits 1 awk -f host/count_operations.awk "$folder/bad.ll" >"$folder/counted" 2>"$folder/err" || return 1
    cat "$folder/err"
    grep -q "bad.ll:$1: .*; expected" "$folder/err"
}
check "an_unknown_instruction_is_refused" refused 16 "s/mul nsw/fmul/"
check "an_unknown_function_of_the_compiler_is_refused" refused 22 s/llvm.ctlz/llvm.sideeffect/
check "a_block_of_any_size_is_refused" refused 9 "s/i64 38/i64 %1/"
check "a_vector_is_refused" refused 21 "s/add i32/add <4 x i32>/"
check "a_block_without_an_end_is_refused" refused 38 "s/^  ret i32.*/;/"
check "a_function_without_an_end_is_refused" refused 41 "s/^  unreachable/;/"
check "an_instruction_outside_of_a_block_is_refused" refused 41 "39s/$/\n  unreachable/"
sed 1,5d "$folder/new.ll" >"$folder/none.ll"
check "a_text_without_lane_count_is_refused" exits 1 awk -f host/count_operations.awk "$folder/none.ll"

# ---- a program -----------------------------------------------------------------------------------------------------

cat >"$folder/loops.c" <<'END'
#include <stdint.h>
typedef struct block { uint32_t words[12]; } block;
uint32_t sum(const uint32_t *v, uint32_t n, uint32_t d)
{
    uint32_t s = 0;
    for (uint32_t i = 0; i < n; i++)
        s += v[i] / d * (s ^ 5);
    return s;
}
void fill(uint32_t *v, uint32_t n, uint32_t value)
{
    for (uint32_t i = 0; i < n; i++)
        v[i] = value;
}
void copy(block *to, const block *from)
{
    *to = *from;
}
END
cat >"$folder/main.c" <<'END'
#include "lane_counter.h"
#include <stdio.h>
#include <string.h>
typedef struct block { uint32_t words[12]; } block;
uint32_t sum(const uint32_t *v, uint32_t n, uint32_t d);
void fill(uint32_t *v, uint32_t n, uint32_t value);
void copy(block *to, const block *from);
__thread uint64_t lane_counters[LANE_COUNTERS];
static void print(const char *name, int jumps)
{
    printf("%s", name);
    for (int i = 0; i < 5; i++)
        printf(" %d", (int)lane_counters[i]);
    puts(lane_counters[5] >= (uint64_t)jumps && lane_counters[5] <= (uint64_t)jumps + 8 ? " good" : " bad");
    memset(lane_counters, 0, sizeof lane_counters);
}
int main(void)
{
    static uint32_t v[1000];
    static block a, b;
    fill(v, 1000, 77);
    print("fill", 2 * 1000);
    sum(v, 1000, 3);
    print("sum", 3 * 1000);
    copy(&a, &b);
    print("copy", 0);
    return 0;
}
END

# A turn of fill stores and adds one to i; one of sum loads, divides, multiplies, and adds to s and i. Beside these a
# turn compares and jumps, and sum has ^: 2 and 3 others, and a few about the loop. Twelve words are copied.
cat >"$folder/expected" <<'END'
fill 0 0 1000 0 1000 good
sum 1000 1000 2000 1000 0 good
copy 0 0 0 12 12 good
END

compiled() {
    "$clang" -std=c99 -ffreestanding -w -fPIE -O1 -fno-unroll-loops -fno-vectorize -fno-slp-vectorize \
        -include host/lane_counter.h -S -emit-llvm "$folder/loops.c" -o "$folder/loops.ll" || return 1
    awk -f host/count_operations.awk "$folder/loops.ll" >"$folder/counted.ll" || return 1
    "$clang" -w -fPIE -O1 -c "$folder/counted.ll" -o "$folder/loops.o" &&
        "${CC:-cc}" -Ihost "$folder/main.c" "$folder/loops.o" -o "$folder/loops" &&
        "$folder/loops" | diff "$folder/expected" -
}
if [ -n "$clang" ]; then
    check "a_program_counts_what_its_loops_do" compiled
else
    echo "# no clang: no program is compiled"
fi
finish
