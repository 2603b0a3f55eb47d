#!/bin/sh
# Makes results/NAME.md again from bench/studies/NAME.toml; rerun the command to resume.
#   scripts/results.sh NAME [BINARY [RECORDS]]      NAME: models-real
# The records stay in RECORDS, build/results/NAME. The page names the commit checked out, or what COMMIT in the environment
# says the program was built from. The identifiability of the best fits is left out, as it takes longer than the runs.
set -eu
name=$1
root=$(cd "$(dirname "$0")/.." && pwd)
hysteron=${2:-$root/build/release/hysteron}
out=${3:-$root/build/results/$name}
commit=${COMMIT:-$(git -C "$root" describe --always)}
left_out=$(sed -n 's/^# Left out: \([^.]*\)\..*/ Left out: \1./p' "$root/bench/studies/$name.toml")
# In shards: a whole study ends with the identifiability.
for part in 1/2 2/2; do
  "$hysteron" bench "$root/bench/studies/$name.toml" --out "$out" --quiet --shard "$part"
done
"$hysteron" report "$out" --times > /dev/null
{
  head -n 2 "$out/report.md"
  # shellcheck disable=SC2016
  printf 'Made by `scripts/results.sh %s`. Program: commit %s. The identifiability of the best fits was not run.%s\n\n' "$name" "$commit" "$left_out"
  tail -n +3 "$out/report.md"
} > "$root/results/$name.md"
