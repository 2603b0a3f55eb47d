#!/usr/bin/env bash
# Times whole diagnoses of an earlier program and of today's, in turn on this machine, and writes the page:
#
#   scripts/diagnosis_speed.sh [--parts press,crank,rotary,long,challenge] [--campaigns FOLDER] [--count N]
#                              [--threads 2] [--repeats 1] [--before 316fbf0] [--page results/diagnosis-speed.md]
#
# press, crank: the recordings of the two magnetorheological dampers; rotary: the six of the rotary device with the
# lowest three tensions; long: two recordings of 66,000 samples at 3 kHz, made by the program; challenge: N campaigns
# (20) of FOLDER, an --out of `hysteron challenge`, evenly spread over it. Times are kept in build/diagnosis-speed, by
# program: rerun the command to resume; the page holds every part that has been timed with today's program.
# The earlier program is built from the repository's history, which has to be complete.
set -euo pipefail
cd "$(dirname "$0")/.."

parts=press,crank,rotary,long,challenge campaigns='' count=20 threads=2 repeats=1 before=316fbf0
page=results/diagnosis-speed.md
while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || { echo "error: $1: expected a value" >&2; exit 2; }
  case $1 in
    --parts) parts=$2 ;;
    --campaigns) campaigns=$2 ;;
    --count) count=$2 ;;
    --threads) threads=$2 ;;
    --repeats) repeats=$2 ;;
    --before) before=$2 ;;
    --page) page=$2 ;;
    *) echo "error: unknown option $1" >&2; exit 2 ;;
  esac
  shift 2
done
for part in ${parts//,/ }; do
  case $part in
    press | crank | rotary | long) ;;
    challenge) [ -d "$campaigns" ] || { echo "error: the part challenge wants --campaigns FOLDER" >&2; exit 2; } ;;
    *) echo "error: unknown part $part, expected press, crank, rotary, long or challenge" >&2; exit 2 ;;
  esac
done

work=build/diagnosis-speed
earlier=$work/$before
mkdir -p "$work"

if ! git cat-file -e "$before^{commit}" 2> "$work/git.log"; then
  echo "error: commit $before is not in this repository; a shallow clone gets it by: git fetch --unshallow" >&2
  exit 1
fi
if [ ! -x "$earlier/build/release/hysteron" ]; then
  echo "building the program of $before" >&2
  mkdir -p "$earlier"
  git archive "$before" | tar -x -C "$earlier"
  (cd "$earlier" && cmake --preset release -DHYSTERON_TESTS=OFF -DHYSTERON_BENCH=OFF &&
    cmake --build --preset release --target hysteron) > "$work/build.log" 2>&1 ||
    { echo "error: the program of $before could not be built, see $work/build.log" >&2; exit 1; }
fi
cmake --build --preset release --target hysteron > "$work/build-now.log" 2>&1 ||
  { echo "error: today's program could not be built, see $work/build-now.log" >&2; exit 1; }

# A copy, which builds meanwhile leave as it is; its times are its own.
now=$(git rev-parse --short HEAD)
git diff --quiet HEAD -- src models algorithms || now+=-changed
now+=+$(sha256sum build/release/hysteron | cut -c 1-8)
mkdir -p "$work/programs"
cp build/release/hysteron "$work/programs/$now"

# time_one PROGRAM LABEL PART CASE REPEAT WORDS...: one diagnosis, unless its line is there. A line of times.csv:
# part,case,repeat,program,threads,wall s,processor s,load before,exit status
times=$work/times.csv
touch "$times"
time_one() {
  local program=$1 label=$2 part=$3 case=$4 repeat=$5 load status=0
  shift 5
  grep -q "^$part,$case,$repeat,$label,$threads," "$times" && return
  load=$(cut -d ' ' -f 1 /proc/loadavg)
  local TIMEFORMAT='%R %U %S'
  { time "$program" diagnose "$@" --threads "$threads" --quiet --out "$work/out" > "$work/said" 2>&1; } \
    2> "$work/time" || status=$?
  [ "$status" -lt 128 ] || exit "$status"  # interrupted
  local wall user system
  read -r wall user system < "$work/time"
  printf '%s,%s,%s,%s,%s,%s,%s,%s,%s\n' "$part" "$case" "$repeat" "$label" "$threads" "$wall" \
    "$(awk "BEGIN { print $user + $system }")" "$load" "$status" >> "$times"
  echo "$part $case: ${label%+*} $wall s" >&2
}

# in_turn PART CASE WORDS...
in_turn() {
  local part=$1 case=$2 repeat
  shift 2
  for repeat in $(seq "$repeats"); do
    time_one "$earlier/build/release/hysteron" "$before" "$part" "$case" "$repeat" "$@"
    time_one "$work/programs/$now" "$now" "$part" "$case" "$repeat" "$@"
  done
}

# Two recordings of 22 s at 3 kHz: three sines of displacement, the published modified Bouc-Wen damper at two voltages,
# 1 % noise. The law told, Bouc-Wen, lacks its second dashpot.
make_long() {
  local folder=$work/long level
  [ -d "$folder" ] && return
  rm -rf "$folder.part"
  mkdir -p "$folder.part"
  for level in 0.5 1.5; do
    python3 - "$level" > "$work/motion.csv" << 'MOTION'
import math, random, sys
phases = random.Random(f"speed {sys.argv[1]}")
parts = [(0.008, 0.7), (0.004, 1.9), (0.001, 5.3)]  # m, Hz
turned = [(a, 2 * math.pi * f, 2 * math.pi * phases.random()) for a, f in parts]
print("time [s],displacement [m]")
for n in range(66000):
    t = n / 3000
    print(f"{t:.9g},{sum(a * math.sin(w * t + p) for a, w, p in turned):.9g}")
MOTION
    build/release/hysteron simulate --preset spencer-1997 --drive "$level" "$work/motion.csv" --out "$work/force.csv" \
      > "$work/said"
    python3 - "$level" "$work/motion.csv" "$work/force.csv" > "$folder.part/$level.csv" << 'NOISE'
import csv, random, sys
level, motion, force = sys.argv[1:]
with open(motion) as a, open(force) as b:
    rows = [(*x, float(f)) for x, (_, f) in zip(list(csv.reader(a))[1:], list(csv.reader(b))[1:], strict=True)]
noise = random.Random(f"noise {level}")
sigma = 0.01 * max(abs(f) for *_, f in rows)
print("time [s],displacement [m],force [N],voltage [V]")
for t, x, f in rows:
    print(f"{t},{x},{f + noise.gauss(0, sigma):.7g},{level}")
NOISE
  done
  mv "$folder.part" "$folder"
}

for part in ${parts//,/ }; do
  case $part in
    press) in_turn press all datasets/utfsm-mr-damper --model bouc-wen --by-current alpha:1,c0:1 ;;
    crank) in_turn crank all datasets/utfpr-mr-damper --model bouc-wen --by-current alpha:1,c0:1 ;;
    rotary) in_turn rotary six datasets/rotary-friction-damper/*{20,22,25}lb*.csv --model lugre ;;
    long)
      make_long
      in_turn long two "$work/long" --model bouc-wen --by-current alpha:1,c0:1
      ;;
    challenge)
      mapfile -t all < <(find "$campaigns" -maxdepth 1 -type d -name 'campaign-*' | sort)
      [ ${#all[@]} -gt 0 ] || { echo "error: $campaigns: no campaign-NNNN" >&2; exit 2; }
      chosen=$((count < ${#all[@]} ? count : ${#all[@]}))
      for k in $(seq 0 $((chosen - 1))); do
        campaign=${all[$((k * ${#all[@]} / chosen))]}
        in_turn challenge "$(basename "$campaigns")/$(basename "$campaign")" "$campaign"
      done
      ;;
  esac
done

python3 scripts/diagnosis_speed_page.py "$times" "$before" "$now" "$threads" > "$work/page.md"
mv "$work/page.md" "$page"
