#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
cmake --preset release -DHYSTERON_TESTS=ON -DHYSTERON_BENCH=ON
cmake --build --preset release
ctest --preset release --no-tests=error "$@"
