"""Replays a motion, compares the force with what `hysteron` gives in the same steps, and times the steps.

    python3 @name@_test.py
"""

import sys
import time

from @name@ import Damper

# time, displacement, velocity, slope, acceleration, jerk, drive
LEAD_IN = [
@lead_in@]
MOTION = [
@samples@]
# N
FORCE = [
@force@]


def replay():
    damper = Damper(frequency=@frequency@)
    for sample in LEAD_IN:
        damper.step(*sample)
    if LEAD_IN:
        damper.go_on()
    return [damper.step(*sample) for sample in MOTION]


def main():
    begun = time.perf_counter()
    force = replay()
    seconds = time.perf_counter() - begun
    difference = max(abs(a - b) for a, b in zip(force, FORCE))
    peak = max(abs(f) for f in FORCE)
    right = difference <= @allowed@ * peak
    print(f"{len(force)} samples, largest difference {difference:.3g} N, {difference / peak if peak else 0.0:.3g} of the "
          f"largest force: {'right' if right else 'WRONG'}")
    print(f"{1e6 * seconds / (len(LEAD_IN) + len(MOTION)):.0f} us a step")
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
