#!/bin/sh
# Writes the catalogue pages docs/models/, docs/effects/ and docs/solvers/, with the figures of models and solvers, from
# what the program says of itself.
#   scripts/generate_docs.sh [--check [--without-convergence]] BINARY OUTDIR
#   scripts/generate_docs.sh build/release/hysteron docs
# --check writes nothing and fails when a page of OUTDIR is missing, out of date or left over.
set -eu
exec "${PYTHON:-python3}" "$(dirname "$0")/generate_docs.py" "$@"
