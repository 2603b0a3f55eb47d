#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests; words given go to ctest. Then ratios of times, which no
# test measures, have to lie within their bounds (docs/development.md). Reports are also looked at in
# headless Chromium where it is installed, and so is the page of scripts/browser.sh where it was made; screenshots are then in
# out/pages.
set -euo pipefail
cd "$(dirname "$0")/.."
# With Open MPI, the Python package and Octave, so that their tests run too.
scripts/setup.sh libopenmpi-dev openmpi-bin pybind11-dev python3-dev python3-numpy python3-pandas python3-matplotlib \
  python3-sklearn python3-nbclient python3-ipykernel octave
cmake --preset release -DHYSTERON_TESTS=ON -DHYSTERON_BENCH=ON -DHYSTERON_PYTHON=ON
cmake --build --preset release
ctest --preset release --no-tests=error "$@"
build/release/bench/hysteron_ratios
# 77: no Chromium, which has been said.
scripts/check_reports.py build/release/hysteron out/pages || [ $? -eq 77 ]
scripts/check_browser.py build/release/hysteron build/browser/hysteron.html out/pages || [ $? -eq 77 ]
