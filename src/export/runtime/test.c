/* Replays a motion, compares the force with what `hysteron` gives in the same steps, and times the steps.
 *   cc -std=c99 -O2 @name@_test.c @name@.c -lm && ./a.out
 */
#include "@name@.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#define LEAD_IN @lead_in_count@
#define COUNT @count@

/* time, displacement, velocity, slope, acceleration, jerk, drive */
static const @name@_input lead_in[] = {
@lead_in@};
static const @name@_input motion[COUNT] = {
@samples@};
/* N */
static const double force[COUNT] = {
@force@};

static @name@_model begin(void) {
  @name@_model damper;
  @name@_start(&damper, @frequency@);
  for (int n = 0; n < LEAD_IN; ++n) @name@_step(&damper, &lead_in[n]);
  if (LEAD_IN > 0) @name@_go_on(&damper);
  return damper;
}

int main(void) {
  @name@_model damper = begin();
  double peak = 0.0, difference = 0.0, seconds = 0.0, sum = 0.0;
  long steps = 0;
  int wrong = 0;
  for (int n = 0; n < COUNT; ++n) {
    const double apart = fabs(@name@_step(&damper, &motion[n]) - force[n]);
    if (!(apart <= difference)) difference = apart;
    peak = fmax(peak, fabs(force[n]));
  }
  wrong = !(difference <= @allowed@ * peak);
  printf("%d samples, largest difference %.3g N, %.3g of the largest force: %s\n", COUNT, difference,
         peak > 0.0 ? difference / peak : 0.0, wrong ? "WRONG" : "right");
  for (const clock_t begun = clock(); seconds < 0.2;
       seconds = (double)(clock() - begun) / CLOCKS_PER_SEC, steps += COUNT) {
    damper = begin();
    for (int n = 0; n < COUNT; ++n) sum += @name@_step(&damper, &motion[n]);
  }
  printf("%.0f ns a step (mean force %.6g N)\n", 1e9 * seconds / (double)steps, sum / (double)steps);
  return wrong;
}
