#!/usr/bin/env bash
# Fuzzes the readers of files of strangers, with AddressSanitizer and UndefinedBehaviorSanitizer (clang):
#
#   scripts/fuzz.sh MINUTES [TARGET ...]     MINUTES in all, in equal shares; without a TARGET all of tests/fuzz
#
# One process, nice. An input that ends a target, takes longer than 10 s or more than 2 GB, or leaks, is a finding: it is
# kept in out/fuzz/findings/TARGET and the exit status is 1. What reaches new code is kept in out/fuzz/live, minimised
# together with tests/fuzz/corpus, and added to that where it is no longer than 2 kB; the corpus is replayed by the
# tests. Prints executions, inputs and covered edges of every target.
set -euo pipefail
cd "$(dirname "$0")/.."

[[ "${1:-}" =~ ^[1-9][0-9]*$ ]] || { echo "error: expected scripts/fuzz.sh MINUTES [TARGET ...]" >&2; exit 2; }
minutes=$1
shift
known=$(sed -n 's/^set(fuzz_targets \(.*\))$/\1/p' tests/fuzz/CMakeLists.txt)
read -r -a targets <<< "${*:-$known}"
for target in "${targets[@]}"; do
  [[ " $known " == *" $target "* ]] || { echo "error: unknown target $target, expected one of $known" >&2; exit 2; }
done

largest=2048         # bytes of an input of the corpus
largest_corpus=40    # inputs of a target
work=out/fuzz
mkdir -p "$work"
scripts/setup.sh clang libclang-rt-dev libomp-dev llvm
cmake --preset fuzz > "$work/configure.log"
nice cmake --build --preset fuzz > "$work/build.log" || { tail -n 20 "$work/build.log" >&2; exit 1; }

share=$((minutes * 60 / ${#targets[@]}))
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
limits=(-timeout=10 -rss_limit_mb=2048 -max_len=16384)
total=0
findings=0
printf '%-10s %12s %8s %8s %8s %9s\n' target executions seconds edges inputs findings
for target in "${targets[@]}"; do
  program=build/fuzz/tests/fuzz/fuzz_$target
  live=$work/live/$target
  found=$work/findings/$target
  log=$work/$target.log
  mkdir -p "$live" "$found" "tests/fuzz/corpus/$target"
  : > "$log"
  begun=$SECONDS
  executions=0
  edges=0
  of_target=$(find "$found" -type f | wc -l)
  # What was found does not end the search.
  while [ $((SECONDS - begun)) -lt "$share" ]; do
    status=0
    nice "$program" "${limits[@]}" -max_total_time=$((share - (SECONDS - begun))) -print_final_stats=1 \
      -artifact_prefix="$found/" "$live" "tests/fuzz/corpus/$target" > "$log.part" 2>&1 || status=$?
    cat "$log.part" >> "$log"
    count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log.part" | tail -n 1)
    executions=$((executions + ${count:-0}))
    now=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log.part" | tail -n 1)
    if [ "${now:-0}" -gt "$edges" ]; then edges=$now; fi
    [ "$status" -lt 128 ] || exit "$status"  # interrupted
    before=$of_target
    of_target=$(find "$found" -type f | wc -l)
    # Again what was found before, or enough of it.
    if [ "$status" -ne 0 ] && { [ "$of_target" -eq "$before" ] || [ "$of_target" -ge 20 ]; }; then break; fi
  done
  seconds=$((SECONDS - begun))

  # The least of both that reaches as much; where nothing was found only, since a finding would end the merging.
  if [ "$of_target" -eq 0 ]; then
    least=$work/least/$target
    rm -rf "$least"
    mkdir -p "$least"
    nice "$program" "${limits[@]}" -max_len="$largest" -merge=1 "$least" "tests/fuzz/corpus/$target" "$live" \
      > "$work/merge-$target.log" 2>&1
    room=$((largest_corpus - $(find "tests/fuzz/corpus/$target" -type f | wc -l)))
    # Evenly over their sizes; libFuzzer names them by their SHA-1.
    while read -r input; do
      sha1sum "tests/fuzz/corpus/$target"/* | grep -q "^$(basename "$input")" && continue
      cp "$input" "tests/fuzz/corpus/$target/$(basename "$input" | cut -c 1-12)"
    done < <(find "$least" -type f -size "-$((largest + 1))c" -printf '%s %p\n' | sort -n |
      awk -v room="$room" '{ all[NR] = $2 } END { n = NR < room ? NR : room; for (k = 0; k < n; ++k) print all[int(k * NR / n) + 1] }')
  fi
  total=$((total + executions))
  findings=$((findings + of_target))
  printf '%-10s %12d %8d %8d %8d %9d\n' "$target" "$executions" "$seconds" "$edges" \
    "$(find "tests/fuzz/corpus/$target" -type f | wc -l)" "$of_target"
  echo "$(date +%F) $target $executions $seconds $edges $of_target" >> "$work/runs.txt"
done
echo "$total executions, $findings findings$([ "$findings" -eq 0 ] || echo ", in $work/findings")"
[ "$findings" -eq 0 ]
