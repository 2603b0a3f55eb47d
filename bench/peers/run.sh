#!/bin/sh
# The same identification by Hysteron, pagmo2, NLopt and SciPy: CPU time to target in one run, see peers.cpp.
#   bench/peers/run.sh [--seeds N] [--budget N] [--only WORD] [--out FILE.md]
# Needs pagmo2 and NLopt (libpagmo-dev, libnlopt-dev, libnlopt-cxx-dev), and SciPy for its rows (python3-scipy; without
# it they are left out). HYSTERON_BUILD names the build folder (build/release), HYSTERON_PEERS an already built program
# (nothing is built then), PYTHON the interpreter.
# --only WORD takes the methods whose name holds the word. One thread throughout; takes 5 to 15 minutes. Leave the
# machine alone meanwhile: the times are CPU times, but caches and clocks are shared.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${HYSTERON_BUILD:-$root/build/release}
python=${PYTHON:-/usr/bin/python3}
seeds=11
budget=60000
only=
out=
while [ $# -gt 0 ]; do
  case "$1" in
    --seeds) seeds=$2; shift 2 ;;
    --budget) budget=$2; shift 2 ;;
    --only) only=$2; shift 2 ;;
    --out) out=$2; shift 2 ;;
    -h | --help) sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "error: unknown option $1, expected --seeds, --budget, --only or --out" >&2; exit 2 ;;
  esac
done
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

program=${HYSTERON_PEERS:-}
if [ -z "$program" ]; then
  if [ ! -f "$build/CMakeCache.txt" ]; then
    cmake --preset release -S "$root" >&2
    build=$root/build/release
  fi
  cmake --build "$build" --target hysteron_peers -j1 >&2
  program=$(find "$build" -type f -name hysteron_peers | head -n 1)
  [ -n "$program" ] || { echo "error: hysteron_peers was not built: are pagmo2 and NLopt installed?" >&2; exit 1; }
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" --prepare --folder "$work" --seeds "$seeds" --budget "$budget"
scipy=
if "$python" -c 'import scipy.optimize' 2>/dev/null; then
  # The same compiler flags as the C++ peers: SciPy is not to pay for Python in its objective.
  ${CC:-cc} -O3 -march=x86-64-v3 -ffp-contract=off -fno-math-errno -fno-trapping-math -fPIC -shared \
    -o "$work/libplain_rk4.so" "$here/plain_rk4_library.c" -lm
  "$python" "$here/scipy_peers.py" "$work/libplain_rk4.so" "$work" "$only"
  scipy=$work/scipy.csv
else
  echo "SciPy is not installed for $python: its rows are left out" >&2
fi
set -- --seeds "$seeds" --budget "$budget"
[ -z "$only" ] || set -- "$@" --only "$only"
[ -z "$scipy" ] || set -- "$@" --scipy "$scipy"
[ -z "$out" ] || set -- "$@" --out "$out"
"$program" "$@"
