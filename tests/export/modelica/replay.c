/* Calls the external functions as a Modelica tool does, over rows of time, x, v, slope, a, jerk, drive from standard
 * input. Argument: frequency. Writes the force. */
#include WRAPPER

#include <stdio.h>

int main(int count, char **arguments) {
  double t, x, v, slope, a, jerk, drive;
  void *model = NEW(count > 1 ? atof(arguments[1]) : 0.0);
  while (scanf("%lf %lf %lf %lf %lf %lf %lf", &t, &x, &v, &slope, &a, &jerk, &drive) == 7) {
    printf("%.17g\n", FORCE(model, t, x, v, slope, a, jerk, drive, 0));
  }
  DELETE(model);
  return 0;
}
