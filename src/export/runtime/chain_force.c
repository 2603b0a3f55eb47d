
/* Drives act from the outermost link inwards, forces from the law outwards. */
static double force_of(const double *p, const double *s, const motion_point *in, double speed, double acceleration) {
  motion_point seen[LINKS];
  double force = 0.0;
  (void)speed;
  (void)acceleration;
  seen[LINKS - 1] = *in;
  for (int i = LINKS - 1; i > 0; --i) {
    const link *here = &links[i];
    seen[i - 1] = seen[i];
    if (here->drive) here->drive(p + here->parameter, s + here->state, &seen[i - 1]);
  }
  for (int i = 0; i < LINKS; ++i) {
    const link *here = &links[i];
    force = here->force(p + here->parameter, s + here->state, &seen[i], force);
  }
  return force;
}
