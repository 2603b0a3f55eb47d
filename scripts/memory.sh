#!/bin/sh
# Peak memory and time of `hysteron fit` on long recordings, and how fast the page of 10,000 recordings loads.
# Usage: scripts/memory.sh HYSTERON [MILLIONS...]     default: 1 5 100; writes Markdown to standard output.
# 100 million samples take 3.9 GB of TMPDIR while they are read.
set -eu
program=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- 1 5 100
scripts=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# SAMPLES: four channels over 500 s, a sweeping sine of 10 mm and a drive that steps.
samples() {
  awk -v n="$1" 'BEGIN {
    srand(1); print "time [s],displacement [mm],force [N],current [A]"; w = 4 * 3.14159265358979
    for (i = 0; i < n; i++) {
      t = 500 * i / n; p = w * t + 3 * sin(0.7 * t); v = 0.01 * (w + 2.1 * cos(0.7 * t)) * cos(p); c = int(t / 20) % 2 ? 1 : 0.5
      e = exp(-2 * (v < 0 ? -v : v) / 0.01); s = (1 - e) / (1 + e) * (v < 0 ? -1 : 1)
      printf "%.6f,%.6f,%.4f,%.2f\n", t, 10 * sin(p), 800 * v + 40 * sin(p) + (50 + 300 * c) * s + 4 * (rand() - 0.5), c
    }
  }'
}

# LABEL FILE OPTIONS...
measure() {
  label=$1
  file=$2
  shift 2
  /usr/bin/time -f '%M %e' -o used "$program" fit "$file" --model hyperbolic-tangent --by-current f0:1 --budget 60 \
    --threads 2 --quiet --out out "$@" > /dev/null 2> said || { cat said >&2; exit 1; }
  said=$(sed -n 's/^warning: [^:]*: //p' said)
  awk -v label="$label" -v said="${said:-all kept}" '{ printf "| %s | %.0f | %.0f | %s |\n", label, $1 / 1024, $2, said }' used
  rm -rf out
}

echo '| samples | peak memory [MB] | time [s] | what was said |'
echo '|---|---|---|---|'
for millions; do
  samples "${millions}000000" > run.csv
  measure "$millions million" run.csv
  if [ "$millions" -gt 4 ] && [ "$millions" -lt 20 ]; then
    measure "$millions million, \`--keep-samples ${millions}000000\`" run.csv --keep-samples "${millions}000000"
  fi
  rm run.csv
done

mkdir many
awk 'BEGIN {
  for (r = 0; r < 10000; r++) {
    file = sprintf("many/r%05d.csv", r); print "time [s],displacement [mm],force [N]" > file
    f = 0.5 + r % 7 * 0.25; a = 5 + r % 11
    for (i = 0; i < 200; i++) { t = i * 0.01; p = 6.2831853 * f * t; printf "%.2f,%.5f,%.3f\n", t, a * sin(p), 6.2831853 * f * a * 0.8 * cos(p) + 3 * a * sin(p) > file }
    close(file)
  }
}'
/usr/bin/time -f '%M %e' -o used "$program" fit many --model viscous --budget 60 --threads 2 --quiet --out out > /dev/null
echo
awk '{ printf "10,000 recordings of 200 samples: %.0f MB, %.0f s.\n", $1 / 1024, $2 }' used
python3 "$scripts/page_load.py" out/report.html
