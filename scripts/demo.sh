#!/usr/bin/env bash
# Installs what is missing, builds, identifies a damper with three solvers from the same seed and budget, and says where
# the report is. Real recordings where ../shared/recordings holds them, else the twin dataset that ships.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
echo "building (a few minutes the first time)" >&2
cmake --preset release >build-demo.log 2>&1 &&
  cmake --build --preset release --target hysteron >>build-demo.log 2>&1 ||
  { tail -n 30 build-demo.log >&2; echo "error: the build failed, see build-demo.log" >&2; exit 1; }
rm -f build-demo.log
hysteron=build/release/hysteron
out=out/demo
if [ -d ../shared/recordings/utfsm-mr-damper ]; then
  data=../shared/recordings/utfsm-mr-damper
  echo "data: real recordings of an MR damper, $data" >&2
else
  data=out/twin
  "$hysteron" generate rd8040-twin --only 2.0Hz --out "$data" >&2
  echo "data: the twin dataset rd8040-twin at 2 Hz, $data" >&2
fi
"$hysteron" fit "$data" --model modified-bouc-wen --effects offset-force --by-current alpha:1,c0:1,c1:1 \
  --solver pso,ga,multistart-lm --budget 2500 --seed 1 --out "$out"
