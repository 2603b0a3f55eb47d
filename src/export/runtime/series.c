
/* ---- Links in series share their force, and states may be driven by it: the step follows the state ---------------- */

#define BALANCE_TOLERANCE 1e-11
#define BALANCE_ITERATIONS 40
#define ELEMENT_RATE_LIMIT 5e4 /* 1/s */
#define ELEMENT_MARGIN 1.25
#define LEAST_PROGRESS 1e-15

/* A parameter set with the bounds of its links' stiffness: still at rest, slack while a state rests at its bound. */
typedef struct {
  const double *p;
  double still[LINKS], slack[LINKS];
} assembly;

/* What a step holds of its series links: a factor on the gain, dF/dv of the links below, and their speed. */
typedef struct {
  double factor[LINKS], resistance[LINKS], speed[LINKS];
} relief;

typedef struct {
  double force;
  double rates[STATES];
  double elements;  /* stiffness of the series elements, 1/s */
  double stiffness; /* of all other links */
  double at_rest;   /* likewise without states that rest at their bounds */
  relief slowed;
} beginning;

static void assemble(assembly *of, const double *p) {
  of->p = p;
  for (int i = 0; i < LINKS; ++i) {
    const link *here = &links[i];
    of->still[i] = of->slack[i] = 0.0;
    if (!here->stiffness) continue;
    of->still[i] = here->stiffness(p + here->parameter, 0.0);
    if (here->settles >= 0) of->slack[i] = here->slack(p + here->parameter);
  }
}

static double evaluate(int top, const double *p, const double *s, motion_point in, const relief *slowed, double *rates);

static double imbalance(int top, const double *p, const double *s, motion_point in, double q, const yield_law *law,
                        const relief *slowed, double u, double *tolerance) {
  double force;
  in.v -= law->slope * u;
  force = evaluate(top, p, s, in, slowed, 0);
  *tolerance = BALANCE_TOLERANCE * (fabs(u) + law->gain * (fabs(force) + fabs(law->hold * q)));
  return u - law->gain * (force - law->hold * q);
}

/* Rate u of an element's state above the links [0, top): u = gain (F_below(v - slope u) - hold q), by secants kept
 * within the bracket. */
static double rate_of_element(int top, const double *p, const double *s, const motion_point *in, double q,
                              const yield_law *law, const relief *slowed) {
  const double hold = law->gain * law->slope * slowed->resistance[top];
  double tolerance;
  double before = hold > 0.1 ? (in->v - slowed->speed[top]) / law->slope : 0.0;
  double g_before = imbalance(top, p, s, *in, q, law, slowed, before, &tolerance);
  double low = fmin(before, before - g_before);
  double high = fmax(before, before - g_before);
  double u = before - g_before / (1.0 + hold);
  double g = imbalance(top, p, s, *in, q, law, slowed, u, &tolerance);
  for (int k = 0;; ++k) {
    double change, next;
    if (g < 0.0 && u > low) low = u;
    if (g > 0.0 && u < high) high = u;
    if (k == BALANCE_ITERATIONS || !(fabs(g) > tolerance)) return u;
    change = g - g_before;
    next = 0.5 * (low + high);
    if (k % 4 != 3 && fabs(change) > 0.0) {
      const double secant = u - g * (u - before) / change;
      if (secant > low && secant < high) next = secant;
    }
    before = u;
    g_before = g;
    u = next;
    g = imbalance(top, p, s, *in, q, law, slowed, u, &tolerance);
  }
}

/* Force of the links [0, top), and their rates unless null. */
static double evaluate(int top, const double *p, const double *s, motion_point in, const relief *slowed,
                       double *rates) {
  const link *here = &links[top - 1];
  const double *own = p + here->parameter;
  const double *state = s + here->state;
  double force = 0.0;
  if (here->yield) {
    yield_law law;
    double u = 0.0;
    here->yield(own, state, &law);
    law.gain *= slowed->factor[top - 1];
    in.x -= law.deflection;
    u = rate_of_element(top - 1, p, s, &in, *state, &law, slowed);
    if (rates) rates[here->state] = u;
    in.v -= law.slope * u;
    return evaluate(top - 1, p, s, in, slowed, rates);
  }
  if (top > 1) {
    motion_point seen = in;
    if (here->drive) here->drive(own, state, &seen);
    force = evaluate(top - 1, p, s, seen, slowed, rates);
  }
  if (rates && here->rate) {
    here->rate(own, state, &in, force, rates + here->state);
    if (here->settles >= 0 && at_bound(state[here->settles], here->towards(own, state, &in))) {
      rates[here->state + here->settles] = 0.0;
    }
  }
  return here->force(own, state, &in, force);
}

/* dF/dv of the links [0, top). */
static double damping_of(int top, const double *p, const double *s, const motion_point *in, const relief *slowed) {
  const double h = fabs(in->v) * 1e-3 + 1e-6;
  motion_point above = *in;
  motion_point below = *in;
  above.v = in->v + h;
  below.v = in->v - h;
  return (evaluate(top, p, s, above, slowed, 0) - evaluate(top, p, s, below, slowed, 0)) / (above.v - below.v);
}

/* Slope of the force of the links [0, top) when they are moved with their states following, in both directions; sets
 * their resistance. */
static double instantaneous_stiffness(int top, const double *p, const double *s, const motion_point *in, double speed,
                                      relief *slowed) {
  const double moment = 1e-7; /* s */
  const int below = links[top].state;
  const double fast = fabs(in->v) + 0.01 * speed + 1e-9;
  double at_rest[STATES], rates[STATES], shifted[STATES];
  double stiffness = 0.0;
  double force;
  motion_point probe = *in;
  for (int i = 0; i < STATES; ++i) shifted[i] = s[i];
  slowed->resistance[top] = fmax(damping_of(top, p, s, in, slowed), 0.0);
  probe.v = 0.0;
  evaluate(top, p, s, probe, slowed, at_rest);
  force = evaluate(top, p, s, *in, slowed, 0);
  for (int direction = 1; direction >= -1; direction -= 2) {
    motion_point after = *in;
    double rise;
    probe.v = direction * fast;
    evaluate(top, p, s, probe, slowed, rates);
    for (int i = 0; i < below; ++i) shifted[i] = s[i] + moment * (rates[i] - at_rest[i]);
    after.x = in->x + moment * probe.v;
    rise = evaluate(top, p, shifted, after, slowed, 0) - force;
    stiffness = fmax(stiffness, fabs(rise / (moment * fast)));
  }
  return stiffness;
}

/* Stiffness of all rates at a state whose rates are known; slows elements down to ELEMENT_RATE_LIMIT. */
static void survey(const assembly *of, const double *s, motion_point in, double speed, double acceleration,
                   beginning *result) {
  relief *slowed = &result->slowed;
  result->elements = result->stiffness = result->at_rest = 0.0;
  for (int i = LINKS - 1; i >= 0; --i) {
    const link *here = &links[i];
    const double *own = of->p + here->parameter;
    const double *state = s + here->state;
    if (here->yield) {
      const double u = result->rates[here->state];
      double stiffness, resistance, gain, lambda, passing = 0.0;
      yield_law law;
      here->yield(own, state, &law);
      in.x -= law.deflection;
      in.v -= law.slope * u;
      slowed->speed[i] = in.v;
      stiffness = instantaneous_stiffness(i, of->p, s, &in, speed, slowed);
      resistance = slowed->resistance[i];
      gain = law.gain / (law.gain * law.slope * resistance + 1.0);
      lambda = gain * (law.hold + law.slope * stiffness);
      slowed->factor[i] = lambda > ELEMENT_RATE_LIMIT ? ELEMENT_RATE_LIMIT / lambda : 1.0;
      if (law.width > 0.0) {
        const double span = fabs(*state) + law.width;
        const double push = gain * (resistance * acceleration + stiffness * (fabs(in.v) + speed));
        passing = fabs(u) / span + sqrt(push / span);
      }
      result->elements += fmin(lambda, ELEMENT_RATE_LIMIT) + passing + gain * fabs(law.bend * u) * resistance;
      continue;
    }
    if (here->stiffness) {
      /* Linear in the speed or rising ever less: beyond a speed it stays below the line from rest to there. */
      const double known = fmax(speed, 1e-9);
      const double moving = here->stiffness(of->p + here->parameter, known);
      const double whole = (moving - of->still[i]) * (1.0 / known) * fmax(fabs(in.v) - known, 0.0) + moving;
      const int rested = here->settles >= 0 && rests(result->rates[here->state + here->settles]);
      result->stiffness += whole;
      result->at_rest += rested ? of->slack[i] : whole;
    }
    if (here->drive) here->drive(own, state, &in);
  }
}

static void begin(const assembly *of, const double *s, const motion_point *in, double speed, double acceleration,
                  beginning *result) {
  int slowed = 0;
  for (int i = 0; i < LINKS; ++i) result->slowed.factor[i] = 1.0;
  result->force = evaluate(LINKS, of->p, s, *in, &result->slowed, result->rates);
  survey(of, s, *in, speed, acceleration, result);
  for (int i = 0; i < LINKS; ++i) slowed = slowed || result->slowed.factor[i] < 1.0;
  if (slowed) result->force = evaluate(LINKS, of->p, s, *in, &result->slowed, result->rates);
}

/* Whether a state that was at rest moves on. */
static int woken(const double *before, const double *now, double little) {
  for (int i = 0; i < LINKS; ++i) {
    const int k = links[i].state + links[i].settles;
    if (links[i].settles >= 0 && rests(before[k]) && fabs(now[k]) > little) return 1;
  }
  return 0;
}

static void march_part(const assembly *of, const interval *over, double from, double to, beginning *at, double *state) {
  const double finer = finer_in(over);
  const double limit = STEP_LIMIT / over->length;
  const double acceleration = change_of_velocity(over) / over->length;
  const double shortest = fmax((to - from) / @NAME@_MOST_SUBSTEPS, LEAST_PROGRESS);
  const double little = 1e-9 / (over->length * (to - from));
  double theta = from;
  int careful = 0;
  while (theta < to) {
    const motion_point in = point_at(over, theta);
    const double left = to - theta;
    double k2[STATES], k3[STATES], k4[STATES], trial[STATES];
    double stiffness, step, reached, h;
    motion_point middle;
    begin(of, state, &in, over->speed, acceleration, at);
    stiffness = careful ? at->stiffness : at->at_rest;
    step = limit / (finer * stiffness + ELEMENT_MARGIN * at->elements);
    if (@NAME@_SUBSTEPS > 0) {
      step = (to - from) / (@NAME@_SUBSTEPS + 0.0);
      stiffness = at->stiffness;
    }
    if (step < shortest) step = shortest;
    if (!(step < left)) step = left;
    reached = step < left * (1.0 - 1e-9) ? theta + step : to;
    h = step * over->length;
    middle = point_at(over, theta + 0.5 * step);
    for (int i = 0; i < STATES; ++i) trial[i] = state[i] + 0.5 * h * at->rates[i];
    evaluate(LINKS, of->p, trial, middle, &at->slowed, k2);
    for (int i = 0; i < STATES; ++i) trial[i] = state[i] + 0.5 * h * k2[i];
    evaluate(LINKS, of->p, trial, middle, &at->slowed, k3);
    for (int i = 0; i < STATES; ++i) trial[i] = state[i] + h * k3[i];
    evaluate(LINKS, of->p, trial, point_at(over, reached), &at->slowed, k4);
    if (stiffness < at->stiffness && (woken(at->rates, k2, little) || woken(at->rates, k3, little) ||
                                      woken(at->rates, k4, little))) {
      careful = 1; /* what was to rest woke up: the step is taken again, shorter */
      continue;
    }
    for (int i = 0; i < STATES; ++i) state[i] += h / 6.0 * (at->rates[i] + k4[i] + 2.0 * (k2[i] + k3[i]));
    theta = reached;
  }
}

/* `p_last` acts at the last sample, p between it and this one. */
static void march(const double *p_last, const double *p, const interval *over, double *state) {
  static const beginning nothing; /* zeros */
  beginning at = nothing;
  assembly of;
  const motion_point in = point_at(over, 0.0);
  assemble(&of, p_last); /* where the elements' balance is looked for first */
  begin(&of, state, &in, over->speed, change_of_velocity(over) / over->length, &at);
  assemble(&of, p);
  march_part(&of, over, 0.0, over->reversal_at, &at, state);
  if (over->reversal) march_part(&of, over, over->reversal_at, 1.0, &at, state);
}

/* Speed and acceleration are those expected of the interval to come. */
static double force_of(const double *p, const double *s, const motion_point *in, double speed, double acceleration) {
  static const beginning nothing; /* zeros */
  beginning at = nothing;
  assembly of;
  assemble(&of, p);
  begin(&of, s, in, speed, acceleration, &at);
  return at.force;
}
