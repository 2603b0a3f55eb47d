#!/usr/bin/env python3
"""Tests the devices of scripts/rigs.py against what their physics says in closed form."""
import math
import random
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import rigs  # noqa: E402


def pulled(rig, motion, seconds, step=1e-4):
    """(time, displacement, force) of a device under a motion of constant speed between samples."""
    state, rig.travelled, rows = [0.0] * rig.states, 0.0, []
    x = motion(0.0)
    for n in range(1, int(seconds / step)):
        ahead = motion(n * step)
        v = (ahead - x) / step
        rig.travelled += abs(ahead - x)
        x = ahead
        state = rig.advance(x, v, 0.0, state, step)
        rows.append((n * step, x, rig.force(x, v, 0.0, state)))
    return rows


class Devices(unittest.TestCase):
    def test_the_brace_carries_nothing_over_its_play(self):
        rig = rigs.Brace(random.Random(1))
        rig.grip = 0.0
        rows = pulled(rig, lambda t: 0.01 * t if t < 1 else 0.01 * (2 - t), 1.9)
        free = [x for t, x, force in rows if t > 1 and abs(force) < 1e-3 * rig.slip]
        self.assertAlmostEqual(max(free) - min(free), rig.play, delta=0.02 * rig.play)

    def test_the_framed_damper_relaxes_with_its_compliance(self):
        rig = rigs.Maxwell(random.Random(1))
        slow = 0.02 * rig.relief / rig.c1
        rows = pulled(rig, lambda t: slow * min(t, 0.5), 1.0, 2e-5)
        full = next(force for t, x, force in reversed(rows) if t < 0.5)
        self.assertAlmostEqual(full, rig.c1 * slow, delta=0.03 * full)
        later = next(force for t, x, force in rows if t > 0.5 + rig.frame * rig.c1)
        self.assertAlmostEqual(later / full, math.exp(-1), delta=0.03)

    def test_the_car_damper_is_softer_in_compression_and_its_bushing_gives_way(self):
        rig = rigs.Telescope(random.Random(1))
        rig.chatter = rig.gas = 0.0
        for way in (1, -1):
            force = pulled(rig, lambda t: 0.3 * way * min(t, 0.2), 0.19)[-1][2]
            knee = rig.opens[way]
            self.assertAlmostEqual(force, way * (rig.bleed * (knee + rig.after[way] * (0.3 - knee)) + rig.seal),
                                   delta=1e-3 * abs(force))
        held = pulled(rig, lambda t: 0.3 * min(t, 0.1), 0.2)[-1][2]
        self.assertLess(abs(held), 2 * rig.seal, "the bushing lets go of all but the friction")

    def test_the_same_seed_gives_the_same_bytes(self):
        def rows():
            rng = random.Random("1 axis 1")
            rig = rigs.Axis(rng)
            return rigs.recorded(rig, rig.motions[0][0], 0.3, rng)
        self.assertEqual(rows(), rows())


if __name__ == "__main__":
    unittest.main()
