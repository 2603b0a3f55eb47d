#!/usr/bin/env bash
# Compares what two builds make of the same inputs and seed, byte for byte: fits by every solver, fits and simulations
# of every model and effect, a diagnosis. Prints a table; exit status 1 when anything differs.
#   scripts/compare_presets.sh [PROGRAM PROGRAM]     default: build/release/hysteron build/native/hysteron
# Some minutes on one core. Solvers of other libraries are left out: those are the same machine code for both programs.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
programs=("${1:-$root/build/release/hysteron}" "${2:-$root/build/native/hysteron}")
for k in 0 1; do
  [ -x "${programs[k]}" ] || { echo "error: ${programs[k]} is missing: build it, or name two programs" >&2; exit 2; }
  programs[k]=$(realpath "${programs[k]}")
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# The command line without the program's name and --out is part of the results, so both run the same one.
data=twin/2.0Hz_1.0A.csv
compared=0
differing=0

ids() { "${programs[0]}" list "$1" --json | python3 -c 'import json, sys; print(*(e["id"] for e in json.load(sys.stdin)))'; }

# row NAME FILE...: compares 0/FILE with 1/FILE; with a model.json also its parameters.
row() {
  local name=$1 same=yes largest="" file
  shift
  for file in "$@"; do
    cmp -s "0/$file" "1/$file" || same=no
    [ "${file##*/}" != model.json ] || largest=$(python3 - "0/$file" "1/$file" <<'PYTHON'
import json, sys
first, second = ([p["value"] for p in json.load(open(path))["parameters"]] for path in sys.argv[1:])
print(f"{max(abs(a - b) / (max(abs(a), abs(b)) or 1.0) for a, b in zip(first, second, strict=True)):.2g}")
PYTHON
)
  done
  compared=$((compared + 1))
  [ $same = yes ] || differing=$((differing + 1))
  echo "| $name | $same | $largest |"
}

# both FOLDER ARGUMENT...: by both programs into 0/FOLDER and 1/FOLDER.
both() {
  local folder=$1 k
  shift
  for k in 0 1; do
    OMP_NUM_THREADS=1 "${programs[k]}" "$@" --out "$k/$folder" >/dev/null 2>messages ||
      { cat messages >&2; exit 1; }
  done
}

# The simulations are compared at the first program's parameters, so that they do not depend on the fits being equal.
fit_and_simulate() {
  local name=$1 k
  shift
  both "$name" fit "$data" "$@" --budget 200
  row "fit $name" "$name"/{model.json,fit.json,report.html}
  mkdir -p at && cp "0/$name/model.json" at/
  both "$name.csv" simulate at/model.json "$data"
  row "simulate $name" "$name.csv"
}

"${programs[0]}" generate rd8040-twin --only 2.0Hz --out twin >/dev/null
echo "| what | same bytes | largest relative difference of a parameter |"
echo "|---|---|--:|"
for solver in $(ids solvers); do
  case "$solver" in *:*) continue ;; esac
  both "$solver" fit "$data" --model bouc-wen --solver "$solver" --budget 1000
  row "fit by $solver" "$solver"/{model.json,fit.json,report.html}
done
both campaign fit twin --model modified-bouc-wen --by-current alpha:1,c0:1 --solver pso,ga,multistart-lm --budget 500
row "fit of a campaign by pso, ga, multistart-lm" campaign/{model.json,fit.json,report.html}
for model in $(ids models); do
  fit_and_simulate "$model" --model "$model"
done
for effect in $(ids effects); do
  fit_and_simulate "bouc-wen+$effect" --model bouc-wen --effects "$effect"
done
both diagnosis diagnose twin --model bouc-wen --by-current alpha:1,c0:1
row diagnose diagnosis/{model.json,diagnosis.json,report.html}
echo
echo "$compared compared, $differing differ"
[ $differing -eq 0 ]
