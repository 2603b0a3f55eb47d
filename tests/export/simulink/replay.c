/* Runs the S-function over rows of time, x, v, slope, a, jerk, drive from standard input as Simulink calls it, with the
 * outputs asked for twice a step. Argument: frequency. Writes the force. */
#include SFUNCTION

#include <stdio.h>

int main(int count, char **arguments) {
  static SimStruct block;
  double t, x, v, slope, a, jerk, drive;
  block.parameters[SAMPLE_TIME] = 1e-3;
  block.parameters[FREQUENCY] = count > 1 ? atof(arguments[1]) : 0.0;
  block.parameters[DERIVE] = 0.0;
  block.parameter_count = 3;
  mdlInitializeSizes(&block);
  mdlInitializeSampleTimes(&block);
  if (block.inputs != 4 || block.outputs != 1 || block.sample_time != 1e-3) return 1;
  block.work = (double *)calloc((size_t)block.work_width, sizeof(double));
  mdlInitializeConditions(&block);
  while (scanf("%lf %lf %lf %lf %lf %lf %lf", &t, &x, &v, &slope, &a, &jerk, &drive) == 7) {
    block.time = t;
    block.input[DISPLACEMENT][0] = x;
    block.input[VELOCITY][0] = v;
    block.input[DRIVE][0] = drive;
    block.input[SLOPES][0] = slope;
    block.input[SLOPES][1] = a;
    block.input[SLOPES][2] = jerk;
    mdlOutputs(&block, 0);
    mdlOutputs(&block, 0);
    printf("%.17g\n", block.output[0][0]);
    mdlUpdate(&block, 0);
  }
  mdlTerminate(&block);
  free(block.work);
  return 0;
}
