#!/usr/bin/env python3
"""Writes simulated rigs of known physics, several missing effects each, to be diagnosed and scored by second_hand.py.

    scripts/rigs.py OUT [--specimens N] [--seed S]
    scripts/second_hand.py OUT DIAGNOSES --page results/rigs.md

Six kinds of device as they stand in laboratories, N specimens of each with sizes drawn about those of real ones. The
equations share nothing with models/ or src/challenge, and each device also has something that no effect of the
catalogue describes. Nothing is learned on
them: they are judged only. OUT gets one folder a specimen and answers.json; a device's `effects` are those of the
catalogue that it has, whatever their equations. Only the standard library is used; the same seed gives the same bytes.
"""
import argparse
import json
import math
import random
from pathlib import Path

substeps = 4


def begun(part):
    """From 0 to 1 without a jump of the speed."""
    part = min(max(part, 0.0), 1.0)
    return part * part * (3 - 2 * part)


def sine(amplitude, frequency, seconds, centre=0.0):
    w = 2 * math.pi * frequency

    def at(t):
        return centre + amplitude * begun(t * frequency) * math.sin(w * t)
    return at, seconds


def multisine(rng, amplitude, low, high, seconds):
    lines = [(f, rng.uniform(0, 2 * math.pi)) for f in (low + (high - low) * k / 9 for k in range(10))]
    scale = amplitude / 4.5

    def at(t):
        return scale * sum(math.sin(2 * math.pi * f * t + p) for f, p in lines) * begun(t)
    return at, seconds


def triangle(amplitude, speed, seconds):
    """With corners as round as a controller makes them."""
    w, sharp = 0.5 * math.pi * speed / amplitude, 0.995

    def at(t):
        return amplitude * math.asin(sharp * math.sin(w * t)) / math.asin(sharp)
    return at, seconds


def softened_sign(v, over):
    return math.tanh(v / over)


class Rig:
    """A device: its states, how a step under displacement x, velocity v and acceleration a moves them, and its force."""

    states = 0

    def advance(self, x, v, a, state, step):
        return state


class Axis(Rig):
    """A positioning axis: moving mass, friction with a Stribeck bump, viscous bearing, a drive that cogs."""

    told, effects, foreign = "viscous", ["inertia", "coulomb-friction", "seal-friction"], ["cogging"]

    def __init__(self, rng):
        self.mass = rng.uniform(60, 130)
        self.friction = rng.uniform(15, 35)
        self.bump = self.friction * rng.uniform(0.05, 0.25)
        self.viscous = rng.uniform(150, 320)
        self.cog, self.pitch = 0.06 * self.friction, 0.016
        self.noise = 0.02 * self.friction
        amplitude = rng.uniform(0.05, 0.12)
        self.motions = [sine(amplitude, 0.5, 8), sine(0.6 * amplitude, 1.0, 6), sine(0.3 * amplitude, 2.0, 5),
                        triangle(amplitude, 0.05, 10), multisine(rng, 0.6 * amplitude, 0.2, 2.5, 8),
                        sine(0.5 * amplitude, 1.5, 5)]
        self.rate = 500

    def force(self, x, v, a, state):
        dry = (self.friction + self.bump * math.exp(-(v / 0.01) ** 2)) * softened_sign(v, 0.0008)
        return self.mass * a + dry + self.viscous * v + self.cog * math.sin(2 * math.pi * x / self.pitch)


class Telescope(Rig):
    """A car damper: blow-off valves of both strokes, rod gas, rod seal, rubber bushing, a base valve that chatters."""

    told, effects = "viscous", ["asymmetry", "compliance", "gas-spring", "coulomb-friction", "seal-friction", "shear-thinning",
                                "offset-force"]
    foreign = ["valve-chatter"]
    states = 1

    def __init__(self, rng):
        self.bleed = rng.uniform(2500, 4500)
        self.opens = {1: rng.uniform(0.12, 0.2), -1: rng.uniform(0.08, 0.15)}
        self.after = {1: rng.uniform(0.25, 0.4), -1: rng.uniform(0.12, 0.25)}
        self.gas, self.length = rng.uniform(90, 220), rng.uniform(0.12, 0.2)
        self.seal = rng.uniform(25, 60)
        self.bushing = 1 / rng.uniform(0.8e6, 2e6)
        self.chatter = rng.uniform(2, 6)
        self.noise = rng.uniform(1.5, 4)
        self.motions = [sine(0.02, f, s) for f, s in ((0.5, 6), (1.5, 4), (3.0, 3), (5.0, 2), (7.0, 2))]
        self.motions += [sine(0.04, 1.0, 5), sine(0.008, 8.0, 2), multisine(rng, 0.03, 0.3, 6, 8)]
        self.rate = 1000

    def inner(self, x, v):
        way = 1 if v > 0 else -1
        speed, knee = abs(v), self.opens[way]
        fluid = self.bleed * (speed if speed < knee else knee + self.after[way] * (speed - knee))
        return way * fluid + self.seal * softened_sign(v, 0.002)

    def advance(self, x, v, a, state, step):
        # The piston moves at v less the rate of the bushing; implicit in the deflection, whose time is a millisecond.
        before = state[0]
        low, high = -0.01, 0.01
        for _ in range(36):
            y = (low + high) / 2
            piston = v - (y - before) / step
            low, high = (y, high) if self.inner(x, piston) * self.bushing > y else (low, y)
        return [(low + high) / 2]

    def force(self, x, v, a, state):
        rod = self.gas * (self.length / (self.length - x)) ** 1.25
        return state[0] / self.bushing + rod + self.chatter * math.sin(2 * math.pi * 73 * x / 0.02) * softened_sign(v, 0.05)


class Brace(Rig):
    """A friction brace of a building: pads that slip one by one, a pin with play, a pad that wears."""

    told, effects, foreign = "bouc-wen", ["clearance", "degradation", "self-heating"], ["grip-place"]
    pads = 12
    states = pads + 1

    def __init__(self, rng):
        self.slip = rng.uniform(8e3, 20e3)
        self.stiffness = self.slip / rng.uniform(4e-4, 9e-4)
        self.yields = [0.5 + 1.0 * k / (self.pads - 1) for k in range(self.pads)]
        self.play = rng.uniform(4e-4, 12e-4)
        self.wear = rng.uniform(0.1, 0.3)
        self.grip = rng.uniform(0.01, 0.03)
        self.noise = rng.uniform(0.004, 0.01) * self.slip
        size = rng.uniform(0.008, 0.015)
        self.motions = [sine(size, 0.5, 12), sine(0.5 * size, 0.5, 12), sine(0.25 * size, 1.0, 8), sine(size, 1.0, 8),
                        multisine(rng, size, 0.1, 1.2, 15), sine(0.7 * size, 0.3, 12)]
        self.rate = 200

    def pads_at(self, state, follower):
        change = self.stiffness / self.slip * (follower - state[-1])
        return [min(max(state[k] + change, -self.yields[k]), self.yields[k]) for k in range(self.pads)]

    def advance(self, x, v, a, state, step):
        # state: forces of the pads' springs over the slip, then where the pin holds them. The pin pulls at one end of
        # its play, pushes at the other, and between them carries nothing.
        low, high = x - self.play / 2, x + self.play / 2
        if sum(self.pads_at(state, low)) >= 0:
            high = low
        elif sum(self.pads_at(state, high)) <= 0:
            low = high
        for _ in range(40 if low < high else 0):
            middle = (low + high) / 2
            low, high = (low, middle) if sum(self.pads_at(state, middle)) > 0 else (middle, high)
        return [*self.pads_at(state, high), high]

    def force(self, x, v, a, state):
        worn = 1 - self.wear * (1 - math.exp(-self.travelled / 0.4))
        return self.slip * worn * (1 + self.grip * math.sin(x / 0.003)) * sum(state[:-1]) / self.pads


class Maxwell(Rig):
    """An oil damper of a building: a relief valve behind an elastic frame, oil that is compressed, air in one chamber."""

    told, effects, foreign = "viscous", ["compliance", "shear-thinning", "quadratic-damping"], ["air-in-one-chamber"]
    states = 1

    def __init__(self, rng):
        self.c1 = rng.uniform(0.6e6, 1.6e6)
        self.relief = self.c1 * rng.uniform(0.03, 0.07)
        self.c2 = self.c1 * rng.uniform(0.05, 0.15)
        self.frame = 1 / (self.c1 * rng.uniform(25, 60))
        self.air = rng.uniform(0.02, 0.06)
        self.noise = 0.004 * self.relief
        self.motions = [sine(0.03, 0.25, 16), sine(0.02, 0.5, 12), sine(0.02, 1.0, 6), sine(0.008, 2.0, 5),
                        multisine(rng, 0.03, 0.1, 1.5, 20), sine(0.01, 0.5, 12)]
        self.rate = 200

    def inner(self, v):
        way, speed = (1 if v > 0 else -1), abs(v)
        knee = self.relief / self.c1
        smooth = 0.15 * knee
        open_by = smooth * math.log1p(math.exp(min((speed - knee) / smooth, 60.0)))
        return way * (self.c1 * speed - (self.c1 - self.c2) * open_by)

    def advance(self, x, v, a, state, step):
        before = state[0]
        low, high = -0.05, 0.05
        for _ in range(40):
            y = (low + high) / 2
            low, high = (y, high) if self.inner(v - (y - before) / step) * self.frame > y else (low, y)
        return [(low + high) / 2]

    def force(self, x, v, a, state):
        pressed = state[0] / self.frame
        return pressed * (1 - self.air * (pressed < 0) * math.exp(-abs(pressed) / self.relief))


class Warm(Rig):
    """A magnetorheological damper at full current that warms: an arctangent of a shifted velocity, accumulator, play."""

    told, effects, foreign = "bouc-wen", ["self-heating", "gas-spring", "linear-stiffness", "offset-force"], ["phase-of-loop"]
    states = 1

    def __init__(self, rng):
        self.yield_force = rng.uniform(400, 900)
        self.viscous = rng.uniform(500, 1200)
        self.shift = rng.uniform(0.15, 0.35)
        self.knee = rng.uniform(0.006, 0.012)
        self.gas, self.stroke = rng.uniform(60, 140), 0.09
        self.loss = rng.uniform(0.08, 0.2)
        self.capacity = rng.uniform(600, 1500)
        self.noise = rng.uniform(1.5, 5)
        self.motions = [sine(0.015, f, s) for f, s in ((0.5, 12), (1.0, 12), (2.0, 8), (3.0, 8))]
        self.motions += [sine(0.025, 1.0, 12), multisine(rng, 0.02, 0.3, 3, 12)]
        self.rate = 500

    def advance(self, x, v, a, state, step):
        power = abs(self.yield_force * v * math.atan((v + self.shift * x) / self.knee))
        return [state[0] + step * (power / self.capacity - state[0] / 40)]

    def force(self, x, v, a, state):
        cool = 1 - self.loss * min(state[0], 4.0)
        loop = math.atan((v + self.shift * 0.5 * x - 0.0004 * a) / self.knee) * 2 / math.pi
        return cool * (self.yield_force * loop + self.viscous * v) + self.gas * (self.stroke / (self.stroke - x)) ** 1.3


class Mount(Rig):
    """A filled rubber mount: chains that relax and a stiffness that falls with the amplitude. No effect of the catalogue
    is the whole of it: what is named must at least be a friction or a stiffness."""

    told, effects, foreign = "viscous", ["pre-yield-hysteresis", "coulomb-friction", "linear-stiffness", "series-dashpot",
                                         "cubic-stiffness"], ["payne", "fractional"]
    chains = 5
    states = chains + 3

    def __init__(self, rng):
        self.stiffness = rng.uniform(2e5, 5e5)
        self.hard = self.stiffness * rng.uniform(0.5, 3) / 0.01 ** 2 * 0.05
        self.branch = self.stiffness * rng.uniform(0.08, 0.2)
        self.friction = self.stiffness * rng.uniform(1e-4, 3e-4)
        self.noise = self.stiffness * 1e-5
        self.motions = [sine(0.005, f, s) for f, s in ((0.3, 12), (1.0, 8), (3.0, 5), (10.0, 3))]
        self.motions += [sine(0.001, 1.0, 8), multisine(rng, 0.005, 0.2, 8, 10)]
        self.rate = 1000

    def advance(self, x, v, a, state, step):
        result = []
        for k in range(self.chains):
            tau = 0.005 * 5 ** k
            result.append((state[k] + step * v) / (1 + step / tau))
        for k in range(3):
            slip = 3e-4 * 2 ** k
            result.append(min(max(state[self.chains + k] + step * v, -slip), slip))
        return result

    def force(self, x, v, a, state):
        slow = sum(state[:self.chains]) * self.branch
        dry = sum(s / (3e-4 * 2 ** k) for k, s in enumerate(state[self.chains:])) * self.friction
        return self.stiffness * x + self.hard * x ** 3 + slow + dry


devices = {"axis": Axis, "telescope": Telescope, "brace": Brace, "maxwell": Maxwell, "warm": Warm, "mount": Mount}


def recorded(rig, motion, seconds, rng):
    """Rows of time, displacement and force, as a chain with noise and quantised force would give."""
    step = 1 / rig.rate
    fine = step / substeps
    state = [0.0] * rig.states
    rig.travelled = 0.0
    rows = []
    h = 1e-5
    bit = 0.2 * rig.noise
    for n in range(int(seconds * rig.rate)):
        t = n * step
        for k in range(substeps if n else 0):
            at = t - step + (k + 1) * fine
            x = motion(at)
            v = (motion(at + h) - motion(at - h)) / (2 * h)
            a = (motion(at + h) - 2 * x + motion(at - h)) / h ** 2
            rig.travelled += abs(v) * fine
            state = rig.advance(x, v, a, state, fine)
        x = motion(t)
        v = (motion(t + h) - motion(t - h)) / (2 * h)
        a = (motion(t + h) - 2 * x + motion(t - h)) / h ** 2
        force = rig.force(x, v, a, state) + rng.gauss(0, rig.noise)
        rows.append(f"{t:.6g},{1e3 * x + rng.gauss(0, 2e-5):.6g},{bit * round(force / bit):.6g}")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--specimens", type=int, default=4, help="of each kind")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    answers = {}
    for kind, make in devices.items():
        for number in range(1, given.specimens + 1):
            rng = random.Random(f"{given.seed} {kind} {number}")
            rig = make(rng)
            name = f"{kind}/{number:02d}"
            folder = given.out / name
            folder.mkdir(parents=True, exist_ok=True)
            text = f'schema = "hysteron.campaign/1"\nmodel = "{rig.told}"\n'
            for k, (motion, seconds) in enumerate(rig.motions, 1):
                rows = recorded(rig, motion, seconds, rng)
                head = "time [s],displacement [mm],force [N]\n"
                (folder / f"r{k}.csv").write_text(head + "\n".join(rows) + "\n", encoding="utf-8")
                text += f'[[recording]]\nfile = "r{k}.csv"\n'
            (folder / "campaign.toml").write_text(text, encoding="utf-8")
            answers[name] = {"effects": rig.effects, "foreign": rig.foreign, "level": "rig"}
            sizes = {key: value for key, value in vars(rig).items() if isinstance(value, float)}
            answers[name]["sizes"] = {key: float(f"{value:.4g}") for key, value in sizes.items()}
    (given.out / "answers.json").write_text(json.dumps(answers, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
