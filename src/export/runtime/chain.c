
static double driven_towards(const link *of, const double *p, const double *s, const motion_point *in) {
  return of->towards(p + of->parameter, s + of->state, in);
}

static void rates_of(const double *p, const double *s, motion_point in, double *rates) {
  for (int i = LINKS - 1; i >= 0; --i) {
    const link *here = &links[i];
    if (here->rate) here->rate(p + here->parameter, s + here->state, &in, 0.0, rates + here->state);
    if (here->drive) here->drive(p + here->parameter, s + here->state, &in);
  }
}

/* Sets the rates of states that rest at their bounds to 0. */
static void rest(const double *p, const double *s, motion_point in, double *rates) {
  for (int i = LINKS - 1; i >= 0; --i) {
    const link *here = &links[i];
    if (here->settles >= 0 && at_bound(s[here->state + here->settles], driven_towards(here, p, s, &in))) {
      rates[here->state + here->settles] = 0.0;
    }
    if (here->drive) here->drive(p + here->parameter, s + here->state, &in);
  }
}

/* Bounds of the rates' change with the states in 1/s; `rates`, if given, tells what is at rest. */
static double stiffness_of(const double *p, const double *s, const double *rates, const motion_point *in, double speed,
                           double change) {
  double bound = 0.0;
  for (int i = 0; i < LINKS; ++i) {
    const link *here = &links[i];
    const double *own = p + here->parameter;
    if (!here->stiffness) continue;
    if (rates && here->settles >= 0 && rests(rates[here->state + here->settles])) {
      bound += here->slack(own);
    } else if (rates && ALONE && here->stiffness_near) {
      bound += here->stiffness_near(own, s + here->state, in, speed, change);
    } else {
      bound += here->stiffness(own, speed);
    }
  }
  return bound;
}

/* Whether a state that was at rest moves on, or an equation passed a kink, since the step began. */
static int woken(const double *before, const double *now, double little) {
  for (int i = 0; i < LINKS; ++i) {
    const int k = links[i].state + links[i].settles;
    if (links[i].settles >= 0 && rests(before[k]) && fabs(now[k]) > little) return 1;
  }
  return 0;
}
static int kinked(const double *p, const double *before, const motion_point *in_before, const double *now,
                  const motion_point *in_now) {
  if (!ALONE) return 0;
  for (int i = 0; i < LINKS; ++i) {
    const link *here = &links[i];
    const int k = here->state + here->settles;
    if (here->settles >= 0 &&
        (driven_towards(here, p, before, in_before) * driven_towards(here, p, now, in_now) < 0.0 ||
         before[k] * now[k] < 0.0)) {
      return 1;
    }
  }
  return 0;
}

/* What is watched while steps are spared. */
typedef struct {
  const double *before, *rates_before;
  const motion_point *in_before;
  double little;
  int failed;
} watch;

static void rates_watched(const double *p, const double *s, motion_point in, watch *over, double *rates) {
  rates_of(p, s, in, rates);
  if (over) {
    rest(p, s, in, rates);
    over->failed = over->failed || woken(over->rates_before, rates, over->little) ||
                   kinked(p, over->before, over->in_before, s, &in);
  }
}

static double substeps(double stiffness, double length, double finer) {
  const double bound = stiffness * (length * finer / STEP_LIMIT);
  return bound > 1.0 ? fmin(ceil(bound), @NAME@_MOST_SUBSTEPS) : 1.0;
}

/* Steps of equal length over the part [from, from + span]. */
static void sub_steps(const double *p, const interval *over, double from, double span, double count, watch *watched,
                      double *state) {
  double k1[STATES], k2[STATES], k3[STATES], k4[STATES], trial[STATES];
  const double h = over->length * span / count;
  double theta = from;
  for (int k = 0; k < count; ++k) {
    const motion_point middle = point_at(over, from + span * (k + 0.5) / count);
    const double end_at = from + span * (k + 1.0) / count;
    if (k == 0 && watched) {
      for (int i = 0; i < STATES; ++i) k1[i] = watched->rates_before[i];
    } else {
      rates_watched(p, state, point_at(over, theta), watched, k1);
    }
    for (int i = 0; i < STATES; ++i) trial[i] = state[i] + 0.5 * h * k1[i];
    rates_watched(p, trial, middle, watched, k2);
    for (int i = 0; i < STATES; ++i) trial[i] = state[i] + 0.5 * h * k2[i];
    rates_watched(p, trial, middle, watched, k3);
    for (int i = 0; i < STATES; ++i) trial[i] = state[i] + h * k3[i];
    rates_watched(p, trial, point_at(over, end_at), watched, k4);
    for (int i = 0; i < STATES; ++i) state[i] += h / 6.0 * (k1[i] + k4[i] + 2.0 * (k2[i] + k3[i]));
    if (watched && watched->failed) return;
    theta = end_at;
  }
}

/* Up to so many steps are not worth sparing. */
#define FEW_SUBSTEPS 2.0

/* Takes the few steps that do where nothing wakes up or passes a kink. 0, and nothing done, where that is not so. */
static int fewer_sub_steps(const double *p, const interval *over, double from, double span, double finer, double count,
                           double *state) {
  double trial[STATES], rates_before[STATES];
  const motion_point in_before = point_at(over, from);
  watch watched;
  double bound, fewer;
  if (!SETTLES || !(count > FEW_SUBSTEPS)) return 0;
  rates_of(p, state, in_before, rates_before);
  rest(p, state, in_before, rates_before);
  bound = stiffness_of(p, state, rates_before, &in_before, over->speed, change_of_velocity(over) * span);
  fewer = substeps(bound, over->length * span, ALONE ? sqrt(coarseness(over->length)) : finer);
  if (!(fewer < count)) return 0;
  for (int i = 0; i < STATES; ++i) trial[i] = state[i];
  watched.before = state;
  watched.rates_before = rates_before;
  watched.in_before = &in_before;
  watched.little = 1e-9 / (over->length * span);
  watched.failed = 0;
  sub_steps(p, over, from, span, fewer, &watched, trial);
  if (watched.failed) return 0;
  for (int i = 0; i < STATES; ++i) state[i] = trial[i];
  return 1;
}

static void march_part(const double *p, const interval *over, double from, double to, double *state) {
  const double span = to - from;
  const double finer = finer_in(over);
  const double length = over->length * span;
  double count = @NAME@_SUBSTEPS;
  if (@NAME@_SUBSTEPS == 0) {
    count = substeps(stiffness_of(p, state, 0, 0, over->speed, 0.0), length, finer);
    if (fewer_sub_steps(p, over, from, span, finer, count, state)) return;
  }
  sub_steps(p, over, from, span, count, 0, state);
}

static void march(const double *p_last, const double *p, const interval *over, double *state) {
  (void)p_last;
  march_part(p, over, 0.0, over->reversal_at, state);
  if (over->reversal) march_part(p, over, over->reversal_at, 1.0, state);
}
