#!/usr/bin/env bash
# Makes the page that fits and diagnoses in a browser, one file: build/browser/hysteron.html. Installs the Debian packages
# it takes beside those of scripts/setup.sh, only those that are missing; root or sudo then.
#     scripts/browser.sh
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh emscripten libc++-16-dev
# The system's python before others, which start slower: the compiler driver is a script.
export PATH="/usr/bin:$PATH" EMCC_SKIP_SANITY_CHECK=1
cmake --preset browser
cmake --build --preset browser
ls -l build/browser/hysteron.html
