#!/usr/bin/env bash
# kill_resume.sh HYSTERON [KILLS]: kills fit, diagnose, bench and challenge at random instants, calls the same command
# again, and compares what it ends with and what stood there before with an undisturbed run, byte for byte. KILLS are
# spread evenly over the four. RANDOM is seeded, so that a failure can be repeated on the same machine.
set -euo pipefail
hysteron=$(realpath "$1")
kills=$((${2:-100} / 4))
RANDOM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# killed LONGEST CHECK COMMAND...: so many kills within LONGEST ms, CHECK after each. Counts those that met the program.
killed() {
  local longest=$1 check=$2 landed=0 k child status
  shift 2
  for ((k = 0; k < kills; ++k)); do
    # A process group of its own: what it starts is killed too.
    setsid "$@" > /dev/null 2>&1 &
    child=$!
    sleep "$(printf '%d.%03d' $((RANDOM % longest / 1000)) $((RANDOM % longest % 1000)))"
    kill -9 -- "-$child" 2> /dev/null || true
    status=0
    wait "$child" 2> /dev/null || status=$?
    if [ "$status" -eq 137 ]; then landed=$((landed + 1)); fi
    $check
  done
  met="$landed of $kills kills met it"
}

# Every file of `whole` that is in `killed` too is the same, half-written ones among them.
equal_so_far() {
  local file
  [ -d killed ] || return 0
  while IFS= read -r file; do
    if [ -e "killed/$file" ] && ! cmp -s "whole/$file" "killed/$file"; then
      echo "killed/$file is not whole/$file" >&2
      exit 1
    fi
  done < <(cd whole && find . -type f ! -name environment.json)
}
# And the set is complete where the last one is there.
equal_and_complete() {
  equal_so_far
  if [ -e killed/diagnosis.json ]; then
    [ -e killed/model.json ] && [ -e killed/report.html ]
  fi
}
# Temporary files of killed processes may stay, nothing else.
same_in_the_end() { diff -r --exclude environment.json --exclude '*.tmp-*' whole killed; }

"$hysteron" generate rd8040-twin --only 2.0Hz --out data > /dev/null
laws=(--model bouc-wen --by-current alpha:1,c0:1)

fit=("$hysteron" fit data "${laws[@]}" --budget 4000 --quiet)
"${fit[@]}" --out whole > /dev/null 2>&1
killed 1500 equal_so_far "${fit[@]}" --out killed
"${fit[@]}" --out killed > /dev/null 2>&1
same_in_the_end
echo "fit: $met; the results are equal"
rm -rf whole killed

diagnose=("$hysteron" diagnose data "${laws[@]}" --effects sensor-delay,inertia,coulomb-friction --quiet)
"${diagnose[@]}" --out whole > /dev/null
killed 3000 equal_and_complete "${diagnose[@]}" --out killed
"${diagnose[@]}" --out killed > /dev/null
same_in_the_end
echo "diagnose: $met; the results are equal"
rm -rf whole killed

cat > study.toml <<'TOML'
schema = "hysteron.study/1"
models = ["viscous", "bingham"]
solvers = ["pso", "cma-es", "de", "multistart-lm"]
budgets = [100, 200]
seeds = 150
[[data]]
dataset = "rd8040-twin"
label = "twin"
only = ["2.0Hz_1.0A", "0.4Hz_0.0A"]
each = true
TOML
bench=("$hysteron" bench study.toml --quiet)
"${bench[@]}" --out whole-study > /dev/null
killed 200 true "${bench[@]}" --out killed-study
"${bench[@]}" --out killed-study > /dev/null
"$hysteron" report whole-study --out whole > /dev/null
"$hysteron" report killed-study --out killed > /dev/null
same_in_the_end
echo "bench: $met; the reports are equal"
rm -rf whole killed

# Recordings of their own, so that a campaign takes seconds.
challenge=("$hysteron" challenge --in data "${laws[@]}" --effect inertia --sizes 1 --placebos 1 --jobs 2 --quiet)
# The command that a diagnosis was called with is in its result: one name of the folder.
"${challenge[@]}" --out out > /dev/null
mv out whole
killed 4000 true "${challenge[@]}" --out out
"${challenge[@]}" --out out > /dev/null
mv out killed
diff -r --exclude environment.json --exclude '*.tmp-*' --exclude messages.txt whole killed
echo "challenge: $met; campaigns, diagnoses and score are equal"
