#!/usr/bin/env bash
# Diagnoses the three measured dampers that ship and writes what the program says of them:
#   scripts/diagnose_devices.sh results/devices.md [BINARY]
# and, where there is a Chromium, draws the tops of the reports beside the page. The program is build/release/hysteron
# unless BINARY says otherwise; the recordings are those of datasets/. The page names the commit checked out, or what
# COMMIT in the environment says the program was built from.
set -euo pipefail
cd "$(dirname "$0")/.."
page=${1:?expected the file to write}
program=${2:-build/release/hysteron}
commit=${COMMIT:-$(git describe --always)}
recordings=datasets
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# One tension of the rotary device: the band tension is no channel of its recordings.
mkdir "$folder/rotary-35lb"
cp "$recordings"/rotary-friction-damper/*35lb*.csv "$folder/rotary-35lb/"

diagnose() {
  local title=$1 data=$2 picture=devices-$3.png
  shift 3
  printf '\n## %s\n\n    hysteron diagnose %s %s --out out\n\n```\n' "$title" "${data/$folder/RECORDINGS}" "$*"
  "$program" diagnose "$data" "$@" --out "$folder/out" --quiet | sed '/^report:/d'
  printf '```\n'
  if scripts/make_picture.py "$folder/out/report.html" "$(dirname "$page")/$picture" > /dev/null; then
    printf '\n![Places of the misfit, before and after](%s)\n' "$picture"
  fi
}

{
  printf '# What `diagnose` says of three measured dampers\n\nMade by `scripts/diagnose_devices.sh results/devices.md`. Nothing is hidden in these recordings by us; what is\nmissing in the models is not known for certain. Program: commit %s.\n' "$commit"
  diagnose "Magnetorheological damper, servo-hydraulic press" "$recordings/utfsm-mr-damper" utfsm --model bouc-wen --by-current alpha:1,c0:1
  diagnose "Small magnetorheological damper, crank table" "$recordings/utfpr-mr-damper" utfpr --model bouc-wen --by-current alpha:1,c0:1
  diagnose "Rotary friction device, 35 lb band tension" "$folder/rotary-35lb" rotary --model lugre
} > "$folder/page.md"
mv "$folder/page.md" "$page"
