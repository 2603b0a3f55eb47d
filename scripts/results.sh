#!/bin/sh
# Makes results/NAME.md again from bench/studies/NAME.toml; rerun the command to resume.
#   scripts/results.sh NAME [BINARY]      NAME: models-real
# The records stay in build/results/NAME.
set -eu
name=$1
root=$(cd "$(dirname "$0")/.." && pwd)
hysteron=${2:-$root/build/release/hysteron}
out=$root/build/results/$name
"$hysteron" bench "$root/bench/studies/$name.toml" --out "$out" --quiet
"$hysteron" report "$out" --times > /dev/null
{
  head -n 2 "$out/report.md"
  # shellcheck disable=SC2016
  printf 'Made by `scripts/results.sh %s`.\n\n' "$name"
  tail -n +3 "$out/report.md"
} > "$root/results/$name.md"
