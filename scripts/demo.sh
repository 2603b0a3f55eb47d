#!/usr/bin/env bash
# Installs what is missing, builds, identifies a damper with three solvers from the same seed and budget, and says where
# the report is. The recordings are those of a measured magnetorheological damper that ship in datasets/.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
echo "building (about twenty minutes on two cores the first time)" >&2
cmake --preset release >build-demo.log 2>&1 &&
  cmake --build --preset release --target hysteron >>build-demo.log 2>&1 ||
  { tail -n 30 build-demo.log >&2; echo "error: the build failed, see build-demo.log" >&2; exit 1; }
rm -f build-demo.log
hysteron=build/release/hysteron
out=out/demo
data=out/press
"$hysteron" generate utfsm-mr-damper --only 2mm5Hz --out "$data" >&2
echo "data: five recordings of a measured MR damper, $data/README.md" >&2
"$hysteron" fit "$data" --model modified-bouc-wen --effects offset-force --by-current alpha:1,c0:1,c1:1 \
  --solver pso,ga,multistart-lm --budget 2500 --seed 1 --out "$out"
