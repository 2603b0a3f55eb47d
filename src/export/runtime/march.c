
/* ---- The march between two samples: Runge-Kutta of fourth order --------------------------------------------------- */

/* Polynomials in theta from 0 to 1. */
typedef struct {
  double length; /* s */
  double start;  /* s since the first sample */
  double lead;
  double x[4], v[4], a[4];
  double drive_before, drive_after;
  double speed; /* bound of |v| */
  double reversal_at;
  int reversal;
  int near_reversal;
} interval;

static double cubic(const double *c, double theta) { return ((c[3] * theta + c[2]) * theta + c[1]) * theta + c[0]; }

static void hermite(double h, double y0, double y1, double slope0, double slope1, double *c) {
  const double rise = y1 - y0;
  c[0] = y0;
  c[1] = h * slope0;
  c[2] = 3.0 * rise - h * (2.0 * slope0 + slope1);
  c[3] = h * (slope0 + slope1) - 2.0 * rise;
}

static void make_interval(const @name@_model *model, const @name@_input *now, interval *result) {
  const @name@_input *last = &model->last;
  const double h = now->time - last->time;
  const double next = now->velocity + h * (now->slope + 0.5 * h * now->jerk);
  result->length = h;
  result->start = last->time - model->begun;
  result->lead = model->lead;
  hermite(h, last->displacement, now->displacement, last->velocity, now->velocity, result->x);
  hermite(h, last->velocity, now->velocity, last->slope, now->slope, result->v);
  hermite(h, last->acceleration, now->acceleration, last->jerk, now->jerk, result->a);
  result->drive_before = last->drive;
  result->drive_after = now->drive;
  result->speed = fmax(fabs(last->velocity), fabs(now->velocity)) +
                  4.0 / 27.0 * h * (fabs(last->slope) + fabs(now->slope));
  result->reversal = last->velocity * now->velocity < 0.0;
  result->reversal_at = 1.0;
  if (result->reversal) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      if ((cubic(result->v, middle) < 0.0) == (result->v[0] < 0.0)) {
        low = middle;
      } else {
        high = middle;
      }
    }
    result->reversal_at = 0.5 * (low + high);
  }
  /* The interval after this one is not known yet: the velocity is expected to go on as it does. */
  result->near_reversal = result->reversal || model->reversed || now->velocity * next < 0.0;
}

static motion_point point_at(const interval *over, double theta) {
  motion_point result;
  result.x = cubic(over->x, theta);
  result.v = cubic(over->v, theta);
  result.drive = over->drive_before + (over->drive_after - over->drive_before) * theta;
  result.time = over->start + over->length * theta;
  result.age = result.time + over->lead;
  result.a = cubic(over->a, theta);
  result.jerk = ((3.0 * over->a[3] * theta + 2.0 * over->a[2]) * theta + over->a[1]) / over->length;
  return result;
}

/* How much finer the steps are: long intervals and those near a reversal hide kinks. */
static double coarseness(double length) { return 1.0 + 3.0 * fmin(1.0, length / 5e-3); }
static double finer_in(const interval *over) {
  const double coarse = coarseness(over->length);
  return over->near_reversal ? fmax(4.0, coarse) : coarse;
}
static double change_of_velocity(const interval *over) {
  return fabs(over->v[1]) + 2.0 * fabs(over->v[2]) + 3.0 * fabs(over->v[3]);
}

/* A state of bound 1 that is driven on there rests: nothing is left to follow until what drives it turns. */
static int at_bound(double state, double towards) {
  const double reached = fabs(state);
  return reached > 1.0 - 1e-10 && reached < 1.0 + 1e-10 && state * towards > 0.0;
}
static int rests(double rate) { return fabs(rate) < 1e-300; }
