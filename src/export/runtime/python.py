"""@title@

Force of a damper from its motion, sample by sample. SI units, the drive in @drive@; nothing but the standard
library.

    damper = Damper(frequency=@frequency@)
    for time, x, v, i in samples:
        force = damper.step(time, x, v, drive=i)

Written by hysteron.
"""

import math

STATES = @states@
SETTLES = @settles@  # some state may rest at its bound
ALONE = @alone@  # no other link bends the motion that the law sees
SERIES = @series@  # links share their force, or states are driven by it
STEP_LIMIT = @step_limit@  # largest rate times step
MOST_SUBSTEPS = @most_substeps@  # between two samples
SUBSTEPS = @substeps@  # always so many, twice at a reversal; 0: as many as the stiffness asks for

tanh = math.tanh


def quotient(a, b):
    if b != 0.0:
        return a / b
    return math.nan if a == 0.0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1.0, b)


def lesser(a, b):
    return b if b < a else a


def greater(a, b):
    return b if a < b else a


def square_root(a):
    return math.sqrt(a) if a >= 0.0 else math.nan


def exponential(a):
    return 8.218407461554972e307 if a > 709.0 else 3.307553003638408e-308 if a < -708.0 else math.exp(a)


def logarithm(a):
    return math.log(1e-300 if a < 1e-300 else a)


def power(a, n):
    """a^n for a >= 0."""
    return 0.0 if a < 1e-300 else exponential(n * math.log(a))


def power_law(a, n):
    return a if n == 1.0 else a * a if n == 2.0 else power(a, n)


class Seen:
    """What the equations see of the motion."""

    __slots__ = ("x", "v", "drive", "time", "age", "a", "jerk")

    def __init__(self, x, v, drive, time, age, a, jerk):
        self.x, self.v, self.drive, self.time, self.age, self.a, self.jerk = x, v, drive, time, age, a, jerk

    def copy(self):
        return Seen(self.x, self.v, self.drive, self.time, self.age, self.a, self.jerk)


class Link:
    """A law or an effect in its place: its functions, and where its parameters and states begin."""

    __slots__ = ("parameter", "state", "states", "settles", "drive", "rate", "force", "stiffness", "towards", "slack",
                 "stiffness_near", "bend")

    def __init__(self, parameter, state, states, settles, drive, rate, force, stiffness, towards, slack,
                 stiffness_near, bend):
        self.parameter, self.state, self.states, self.settles = parameter, state, states, settles
        self.drive, self.rate, self.force, self.stiffness = drive, rate, force, stiffness
        self.towards, self.slack, self.stiffness_near, self.bend = towards, slack, stiffness_near, bend

    def own(self, p, s):
        return p[self.parameter:], s[self.state:self.state + self.states]


# ---- The equations of the law and the effects
@equations@

# The law first, then the effects from it outwards.
LINKS = [
@links@]


@parameters_at@

# ---- The march between two samples: Runge-Kutta of fourth order


def cubic(c, theta):
    return ((c[3] * theta + c[2]) * theta + c[1]) * theta + c[0]


def hermite(h, y0, y1, slope0, slope1):
    rise = y1 - y0
    return y0, h * slope0, 3.0 * rise - h * (2.0 * slope0 + slope1), h * (slope0 + slope1) - 2.0 * rise


class Interval:
    """Polynomials in theta from 0 to 1 between two samples."""

    def __init__(self, last, now, begun, lead, reversed_before):
        h = now.time - last.time
        self.length = h
        self.start = last.time - begun
        self.lead = lead
        self.x = hermite(h, last.displacement, now.displacement, last.velocity, now.velocity)
        self.v = hermite(h, last.velocity, now.velocity, last.slope, now.slope)
        self.a = hermite(h, last.acceleration, now.acceleration, last.jerk, now.jerk)
        self.drives = last.drive, now.drive
        self.speed = max(abs(last.velocity), abs(now.velocity)) + 4.0 / 27.0 * h * (abs(last.slope) + abs(now.slope))
        self.reversal = last.velocity * now.velocity < 0.0
        self.reversal_at = 1.0
        if self.reversal:
            low, high = 0.0, 1.0
            for _ in range(60):
                middle = 0.5 * (low + high)
                if (cubic(self.v, middle) < 0.0) == (self.v[0] < 0.0):
                    low = middle
                else:
                    high = middle
            self.reversal_at = 0.5 * (low + high)
        # The interval after this one is not known yet: the velocity is expected to go on as it does.
        to_come = now.velocity + h * (now.slope + 0.5 * h * now.jerk)
        near = self.reversal or reversed_before or now.velocity * to_come < 0.0
        self.coarse = 1.0 + 3.0 * min(1.0, h / 5e-3)
        self.finer = max(4.0, self.coarse) if near else self.coarse
        self.change = abs(self.v[1]) + 2.0 * abs(self.v[2]) + 3.0 * abs(self.v[3])

    def at(self, theta):
        a = self.a
        time = self.start + self.length * theta
        return Seen(cubic(self.x, theta), cubic(self.v, theta),
                    self.drives[0] + (self.drives[1] - self.drives[0]) * theta, time, time + self.lead,
                    cubic(a, theta), ((3.0 * a[3] * theta + 2.0 * a[2]) * theta + a[1]) / self.length)


def at_bound(state, towards):
    """A state of bound 1 that is driven on there rests: nothing is left to follow until what drives it turns."""
    return 1.0 - 1e-10 < abs(state) < 1.0 + 1e-10 and state * towards > 0.0


def rests(rate):
    return abs(rate) < 1e-300


def woken(before, now, little):
    for link in LINKS:
        if link.settles >= 0:
            k = link.state + link.settles
            if rests(before[k]) and abs(now[k]) > little:
                return True
    return False


def weighted(h, k, s):
    return [s[i] + h * k[i] for i in range(STATES)]


# -- without series links


def rates_of(p, s, seen, resting=False):
    seen = seen.copy()
    rates = [0.0] * STATES
    for link in reversed(LINKS):
        own, state = link.own(p, s)
        if link.rate:
            rates[link.state:link.state + link.states] = link.rate(own, state, seen, 0.0)
            if resting and link.settles >= 0 and at_bound(state[link.settles], link.towards(own, state, seen)):
                rates[link.state + link.settles] = 0.0
        if link.drive:
            link.drive(own, state, seen)
    return rates


def stiffness_of(p, s, rates, seen, speed, change):
    bound = 0.0
    for link in LINKS:
        if not link.stiffness:
            continue
        own, state = link.own(p, s)
        if rates and link.settles >= 0 and rests(rates[link.state + link.settles]):
            bound += link.slack(own)
        elif rates and ALONE and link.stiffness_near:
            bound += link.stiffness_near(own, state, seen, speed, change)
        else:
            bound += link.stiffness(own, speed)
    return bound


def kinked(p, before, seen_before, now, seen_now):
    for link in LINKS if ALONE else ():
        if link.settles >= 0:
            k = link.state + link.settles
            own = p[link.parameter:]
            if (link.towards(own, before[link.state:], seen_before) * link.towards(own, now[link.state:], seen_now)
                    < 0.0 or before[k] * now[k] < 0.0):
                return True
    return False


def sub_steps(p, over, start, span, count, watched, s):
    """`count` equal steps; None where something that was watched woke up or passed a kink."""
    h = over.length * span / count
    theta = start
    before = s

    def rates_at(state, seen):
        rates = rates_of(p, state, seen, watched is not None)
        if watched is None:
            return rates, False
        rates_before, seen_before, little = watched
        return rates, woken(rates_before, rates, little) or kinked(p, before, seen_before, state, seen)

    for k in range(int(count)):
        middle = over.at(start + span * (k + 0.5) / count)
        end = start + span * (k + 1.0) / count
        k1, failed_1 = (watched[0], False) if k == 0 and watched else rates_at(s, over.at(theta))
        k2, failed_2 = rates_at(weighted(0.5 * h, k1, s), middle)
        k3, failed_3 = rates_at(weighted(0.5 * h, k2, s), middle)
        k4, failed_4 = rates_at(weighted(h, k3, s), over.at(end))
        if failed_1 or failed_2 or failed_3 or failed_4:
            return None
        s = [s[i] + h / 6.0 * (k1[i] + k4[i] + 2.0 * (k2[i] + k3[i])) for i in range(STATES)]
        theta = end
    return s


def substeps(stiffness, length, finer):
    bound = stiffness * (length * finer / STEP_LIMIT)
    return float(min(math.ceil(bound), MOST_SUBSTEPS)) if 1.0 < bound < math.inf else 1.0


def chain_part(p, over, start, to, s):
    span = to - start
    length = over.length * span
    if SUBSTEPS:
        return sub_steps(p, over, start, span, float(SUBSTEPS), None, s)
    count = substeps(stiffness_of(p, s, None, None, over.speed, 0.0), length, over.finer)
    if SETTLES and count > 2.0:
        seen = over.at(start)
        rates = rates_of(p, s, seen, True)
        bound = stiffness_of(p, s, rates, seen, over.speed, over.change * span)
        fewer = substeps(bound, length, math.sqrt(over.coarse) if ALONE else over.finer)
        if fewer < count:
            trial = sub_steps(p, over, start, span, fewer, (rates, seen, 1e-9 / length), s)
            if trial is not None:
                return trial
    return sub_steps(p, over, start, span, count, None, s)


# -- with series links: the step follows the state

BALANCE_TOLERANCE = 1e-11
BALANCE_ITERATIONS = 40
ELEMENT_RATE_LIMIT = 5e4  # 1/s
ELEMENT_MARGIN = 1.25
LEAST_PROGRESS = 1e-15


class Relief:
    """What a step holds of its series links: a factor on the gain, dF/dv of the links below, and their speed."""

    def __init__(self):
        self.factor, self.resistance, self.speed = [1.0] * len(LINKS), [0.0] * len(LINKS), [0.0] * len(LINKS)


class Bounds:
    """A parameter set with the bounds of its links' stiffness: still at rest, slack while a state rests at its bound."""

    def __init__(self, p):
        self.p = p
        self.still, self.slack = [0.0] * len(LINKS), [0.0] * len(LINKS)
        for i, link in enumerate(LINKS):
            if link.stiffness:
                own = p[link.parameter:]
                self.still[i] = link.stiffness(own, 0.0)
                if link.settles >= 0:
                    self.slack[i] = link.slack(own)


def moved(seen, speed):
    result = seen.copy()
    result.v = seen.v - speed
    return result


def rate_of_element(top, p, s, seen, q, law, gain, relief):
    """Rate u of an element's state above the links [0, top): u = gain (F_below(v - slope u) - hold q)."""
    slope, hold_back = law[1], law[4]

    def imbalance(u):
        force = evaluate(top, p, s, moved(seen, slope * u), relief, None)
        tolerance = BALANCE_TOLERANCE * (abs(u) + gain * (abs(force) + abs(hold_back * q)))
        return u - gain * (force - hold_back * q), tolerance

    hold = gain * slope * relief.resistance[top]
    before = (seen.v - relief.speed[top]) / slope if hold > 0.1 else 0.0
    g_before, _ = imbalance(before)
    low, high = min(before, before - g_before), max(before, before - g_before)
    u = before - g_before / (1.0 + hold)
    g, tolerance = imbalance(u)
    k = 0
    while True:
        if g < 0.0:
            low = max(low, u)
        if g > 0.0:
            high = min(high, u)
        if k == BALANCE_ITERATIONS or not abs(g) > tolerance:
            return u
        following = 0.5 * (low + high)
        if k % 4 != 3 and g != g_before:
            secant = u - g * (u - before) / (g - g_before)
            if low < secant < high:
                following = secant
        before, g_before, u = u, g, following
        g, tolerance = imbalance(u)
        k += 1


def evaluate(top, p, s, seen, relief, rates):
    """Force of the links [0, top), and their rates unless None."""
    link = LINKS[top - 1]
    own, state = link.own(p, s)
    if link.bend:
        law = link.bend(own, state)
        gain = law[3] * relief.factor[top - 1]
        shifted = seen.copy()
        shifted.x = seen.x - law[0]
        u = rate_of_element(top - 1, p, s, shifted, state[0], law, gain, relief)
        if rates is not None:
            rates[link.state] = u
        return evaluate(top - 1, p, s, moved(shifted, law[1] * u), relief, rates)
    force = 0.0
    if top > 1:
        below = seen
        if link.drive:
            below = seen.copy()
            link.drive(own, state, below)
        force = evaluate(top - 1, p, s, below, relief, rates)
    if rates is not None and link.rate:
        rates[link.state:link.state + link.states] = link.rate(own, state, seen, force)
        if link.settles >= 0 and at_bound(state[link.settles], link.towards(own, state, seen)):
            rates[link.state + link.settles] = 0.0
    return link.force(own, state, seen, force)


def damping_of(top, p, s, seen, relief):
    h = abs(seen.v) * 1e-3 + 1e-6
    above, below = moved(seen, -h), moved(seen, h)
    return (evaluate(top, p, s, above, relief, None) - evaluate(top, p, s, below, relief, None)) / (above.v - below.v)


def instantaneous_stiffness(top, p, s, seen, speed, relief):
    """Slope of the force of the links [0, top) when they are moved with their states following; sets resistance."""
    moment = 1e-7
    below = LINKS[top].state
    relief.resistance[top] = max(damping_of(top, p, s, seen, relief), 0.0)
    fast = abs(seen.v) + 0.01 * speed + 1e-9
    stiffness = 0.0
    at_rest = [0.0] * STATES
    evaluate(top, p, s, moved(seen, seen.v), relief, at_rest)
    force = evaluate(top, p, s, seen, relief, None)
    for direction in (1.0, -1.0):
        rates = [0.0] * STATES
        evaluate(top, p, s, moved(seen, seen.v - direction * fast), relief, rates)
        shifted = [s[i] + moment * (rates[i] - at_rest[i]) if i < below else s[i] for i in range(STATES)]
        after = seen.copy()
        after.x = seen.x + moment * direction * fast
        rise = evaluate(top, p, shifted, after, relief, None) - force
        stiffness = max(stiffness, abs(rise / (moment * fast)))
    return stiffness


def survey(bounds, s, seen, rates, speed, acceleration, relief):
    """Stiffness of the elements, of all else, and of all else but what rests; slows elements down in `relief`."""
    elements = stiffness = at_rest = 0.0
    seen = seen.copy()
    for i in range(len(LINKS) - 1, -1, -1):
        link = LINKS[i]
        own, state = link.own(bounds.p, s)
        if link.bend:
            deflection, slope, bend, gain, hold, width = link.bend(own, state)
            u = rates[link.state]
            seen.x -= deflection
            seen.v -= slope * u
            relief.speed[i] = seen.v
            below = instantaneous_stiffness(i, bounds.p, s, seen, speed, relief)
            resistance = relief.resistance[i]
            gain = gain / (gain * slope * resistance + 1.0)
            rate = gain * (hold + slope * below)
            relief.factor[i] = ELEMENT_RATE_LIMIT / rate if rate > ELEMENT_RATE_LIMIT else 1.0
            passing = 0.0
            if width > 0.0:
                span = abs(state[0]) + width
                push = gain * (resistance * acceleration + below * (abs(seen.v) + speed))
                passing = abs(u) / span + square_root(push / span)
            elements += min(rate, ELEMENT_RATE_LIMIT) + passing + gain * abs(bend * u) * resistance
            continue
        if link.stiffness:
            # Linear in the speed or rising ever less: beyond a speed it stays below the line from rest to there.
            known = max(speed, 1e-9)
            moving = link.stiffness(bounds.p[link.parameter:], known)
            whole = (moving - bounds.still[i]) * (1.0 / known) * max(abs(seen.v) - known, 0.0) + moving
            stiffness += whole
            at_rest += bounds.slack[i] if link.settles >= 0 and rests(rates[link.state + link.settles]) else whole
        if link.drive:
            link.drive(own, state, seen)
    return elements, stiffness, at_rest


def begin(bounds, s, seen, speed, acceleration, relief):
    """Force, rates and stiffness at the start of a step."""
    relief.factor = [1.0] * len(LINKS)
    rates = [0.0] * STATES
    force = evaluate(len(LINKS), bounds.p, s, seen, relief, rates)
    stiffness = survey(bounds, s, seen, rates, speed, acceleration, relief)
    if min(relief.factor) < 1.0:
        force = evaluate(len(LINKS), bounds.p, s, seen, relief, rates)
    return force, rates, stiffness


def series_part(bounds, over, start, to, relief, s):
    limit = STEP_LIMIT / over.length
    acceleration = over.change / over.length
    shortest = max((to - start) / MOST_SUBSTEPS, LEAST_PROGRESS)
    little = 1e-9 / (over.length * (to - start))
    theta = start
    careful = False
    top = len(LINKS)
    p = bounds.p
    while theta < to:
        _, k1, (elements, whole, at_rest) = begin(bounds, s, over.at(theta), over.speed, acceleration, relief)
        left = to - theta
        stiffness = whole if careful else at_rest
        step = quotient(limit, over.finer * stiffness + ELEMENT_MARGIN * elements)
        if SUBSTEPS:
            step = (to - start) / SUBSTEPS
            stiffness = whole
        step = max(step, shortest)
        if not step < left:
            step = left
        reached = theta + step if step < left * (1.0 - 1e-9) else to
        h = step * over.length
        middle = over.at(theta + 0.5 * step)
        k2, k3, k4 = [0.0] * STATES, [0.0] * STATES, [0.0] * STATES
        evaluate(top, p, weighted(0.5 * h, k1, s), middle, relief, k2)
        evaluate(top, p, weighted(0.5 * h, k2, s), middle, relief, k3)
        evaluate(top, p, weighted(h, k3, s), over.at(reached), relief, k4)
        if stiffness < whole and any(woken(k1, k, little) for k in (k2, k3, k4)):
            careful = True  # what was to rest woke up: the step is taken again, shorter
            continue
        s = [s[i] + h / 6.0 * (k1[i] + k4[i] + 2.0 * (k2[i] + k3[i])) for i in range(STATES)]
        theta = reached
    return s


def march(p_last, p, over, s):
    if SERIES:
        relief = Relief()
        begin(Bounds(p_last), s, over.at(0.0), over.speed, over.change / over.length, relief)
        bounds = Bounds(p)
        s = series_part(bounds, over, 0.0, over.reversal_at, relief, s)
        return series_part(bounds, over, over.reversal_at, 1.0, relief, s) if over.reversal else s
    s = chain_part(p, over, 0.0, over.reversal_at, s)
    return chain_part(p, over, over.reversal_at, 1.0, s) if over.reversal else s


def force_of(p, s, seen, speed, acceleration):
    if SERIES:
        return begin(Bounds(p), s, seen, speed, acceleration, Relief())[0]
    forces = []
    seen = seen.copy()
    for link in reversed(LINKS):
        own, state = link.own(p, s)
        forces.append((link.force, own, state, seen))
        if link.drive:
            seen = seen.copy()
            link.drive(own, state, seen)
    result = 0.0
    for force, own, state, at in reversed(forces):
        result = force(own, state, at, result)
    return result


# ---- The damper


class Sample:
    __slots__ = ("time", "displacement", "velocity", "slope", "acceleration", "jerk", "drive")

    def __init__(self, time, displacement, velocity, slope, acceleration, jerk, drive):
        self.time, self.displacement, self.velocity, self.slope = time, displacement, velocity, slope
        self.acceleration, self.jerk, self.drive = acceleration, jerk, drive


class Damper:
    """At rest; `frequency` is that of the motion in Hz, where parameters follow it."""

    def __init__(self, frequency=@frequency@):
        self.frequency = frequency
        self.state = [0.0] * STATES
        self.memory = [[0.0, 0.0] for _ in range(@memories@)]
        self.lead = 0.0
        self.force = 0.0
        self._forget()

    def _forget(self):
        self.samples = []  # the last two
        self.history = []  # (time, drive)
        self.parameters = None
        self.begun = 0.0
        self.reversed = False

    def go_on(self):
        """What follows is a new recording, whose time counts from its own start, in the state reached."""
        if self.samples:
            self.lead += self.samples[-1].time - self.begun
        self._forget()

    def drive_before(self, lag):
        """The drive `lag` seconds ago: linear between samples, held before the first and after the last."""
        wanted = self.history[-1][0] - lag
        if not wanted > self.history[0][0]:
            return self.history[0][1]
        for (t0, d0), (t1, d1) in zip(reversed(self.history[:-1]), reversed(self.history[1:])):
            if wanted >= t0:
                return d0 + (d1 - d0) * min((wanted - t0) / (t1 - t0), 1.0)
        return self.history[0][1]

    def _derive(self, now):
        """Slope, acceleration and jerk from this sample and the two before it."""
        now.slope = now.jerk = 0.0
        if self.samples:
            last = self.samples[-1]
            h = now.time - last.time
            after = (now.velocity - last.velocity) / h
            now.slope = last.slope = after
            if len(self.samples) > 1:
                first = self.samples[-2]
                h_before = last.time - first.time
                before = (last.velocity - first.velocity) / h_before
                now.slope = after + (after - before) * h / (h_before + h)
                last.slope = (before * h + after * h_before) / (h_before + h)
                now.jerk = last.jerk = (now.slope - last.slope) / h
            last.acceleration = last.slope
        now.acceleration = now.slope

    def step(self, time, displacement, velocity, slope=None, acceleration=None, jerk=0.0, drive=0.0):
        """Force in N at this sample: s, m, m/s, the drive in @drive@.

        `slope` is that of the velocity and `acceleration` what the equations see (m/s^2), `jerk` the latter's (m/s^3);
        without a slope all three are derived. A sample that is not later than the last one, or holds a number that is
        not finite, changes nothing.
        """
        given = (time, displacement, velocity, slope or 0.0, acceleration or 0.0, jerk, drive)
        if not all(map(math.isfinite, given)) or (self.samples and not time > self.samples[-1].time):
            return self.force
        now = Sample(time, displacement, velocity, slope, slope if acceleration is None else acceleration, jerk, drive)
        if slope is None:
            self._derive(now)
        if not self.samples:
            self.begun = time
        last = self.samples[-1] if self.samples else None
        p = self._acting_parameters(now, -1.0 if last is None else time - last.time)
        if last is not None and STATES:
            between = [0.5 * (a + b) for a, b in zip(self.parameters, p)]
            over = Interval(last, now, self.begun, self.lead, self.reversed)
            self.state = march(self.parameters, between, over, self.state)
            self.reversed = over.reversal
        since = time - self.begun
        seen = Seen(displacement, velocity, drive, since, since + self.lead, now.acceleration, now.jerk)
        h = 0.0 if last is None else time - last.time
        speed = max(abs(velocity), abs(velocity + h * now.slope)) + 8.0 / 27.0 * h * abs(now.slope)
        self.force = force_of(p, self.state, seen, speed, abs(now.slope))
        self.parameters = p
        self.samples = self.samples[-1:] + [now]
        return self.force

    def _acting_parameters(self, now, elapsed):
        """The drive passes the effects on it, then the parameters follow it."""
@acting@
