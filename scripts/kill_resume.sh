#!/usr/bin/env bash
# kill_resume.sh HYSTERON [KILLS]: kills a study at random instants, resumes it, and compares its report with that of an
# undisturbed run, byte for byte. RANDOM is seeded, so that a failure can be repeated on the same machine.
set -euo pipefail
hysteron=$(realpath "$1")
kills=${2:-100}
RANDOM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
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
"$hysteron" bench study.toml --out whole --quiet > /dev/null
landed=0
for ((k = 0; k < kills; ++k)); do
  "$hysteron" bench study.toml --out killed --quiet > /dev/null &
  child=$!
  sleep "0.$(printf '%03d' $((RANDOM % 200)))"
  kill -9 "$child" 2> /dev/null || true
  status=0
  wait "$child" 2> /dev/null || status=$?
  if [ "$status" -eq 137 ]; then landed=$((landed + 1)); fi
done
"$hysteron" bench study.toml --out killed --quiet > /dev/null
"$hysteron" report whole --out whole-report > /dev/null
"$hysteron" report killed --out killed-report > /dev/null
diff -r --exclude environment.json whole-report killed-report
echo "ok: $landed of $kills kills met a running study; the reports are equal"
