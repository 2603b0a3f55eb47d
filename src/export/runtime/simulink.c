/* @title@ as a Simulink S-function around @name@.c. Written by hysteron.
 *
 *   mex @name@_sfun.c @name@.c
 *
 * Block "S-Function", name @name@_sfun, parameters: sample time [s], frequency of the motion [Hz], 1 to derive the
 * slopes of the motion or 0 to take them from the fourth port.
 * Inputs: displacement [m], velocity [m/s], drive [@drive@],
 * [slope of the velocity, acceleration, jerk].
 * Output: force [N].
 */
#define S_FUNCTION_NAME @name@_sfun
#define S_FUNCTION_LEVEL 2

#include "simstruc.h"

#include "@name@.h"

enum { SAMPLE_TIME, FREQUENCY, DERIVE, PARAMETERS };
enum { DISPLACEMENT, VELOCITY, DRIVE, SLOPES, INPUTS };

static real_T parameter(SimStruct *S, int which) { return mxGetScalar(ssGetSFcnParam(S, which)); }

static void mdlInitializeSizes(SimStruct *S) {
  int k;
  ssSetNumSFcnParams(S, PARAMETERS);
  if (ssGetNumSFcnParams(S) != ssGetSFcnParamsCount(S)) return;
  for (k = 0; k < PARAMETERS; ++k) ssSetSFcnParamTunable(S, k, 0);
  if (!ssSetNumInputPorts(S, INPUTS)) return;
  for (k = 0; k < INPUTS; ++k) {
    ssSetInputPortWidth(S, k, k == SLOPES ? 3 : 1);
    ssSetInputPortRequiredContiguous(S, k, 1);
    ssSetInputPortDirectFeedThrough(S, k, 1);
  }
  if (!ssSetNumOutputPorts(S, 1)) return;
  ssSetOutputPortWidth(S, 0, 1);
  ssSetNumSampleTimes(S, 1);
  if (!ssSetNumDWork(S, 1)) return;
  /* In doubles, so that it is aligned. */
  ssSetDWorkWidth(S, 0, (int)((sizeof(@name@_model) + sizeof(real_T) - 1) / sizeof(real_T)));
  ssSetDWorkDataType(S, 0, SS_DOUBLE);
}

static void mdlInitializeSampleTimes(SimStruct *S) {
  ssSetSampleTime(S, 0, parameter(S, SAMPLE_TIME));
  ssSetOffsetTime(S, 0, 0.0);
}

#define MDL_INITIALIZE_CONDITIONS
static void mdlInitializeConditions(SimStruct *S) {
  @name@_start((@name@_model *)ssGetDWork(S, 0), parameter(S, FREQUENCY));
}

static double advance(SimStruct *S, @name@_model *model) {
  const real_T *slopes = (const real_T *)ssGetInputPortSignal(S, SLOPES);
  @name@_input now;
  now.time = ssGetT(S);
  now.displacement = *(const real_T *)ssGetInputPortSignal(S, DISPLACEMENT);
  now.velocity = *(const real_T *)ssGetInputPortSignal(S, VELOCITY);
  now.drive = *(const real_T *)ssGetInputPortSignal(S, DRIVE);
  now.slope = slopes[0];
  now.acceleration = slopes[1];
  now.jerk = slopes[2];
  if (parameter(S, DERIVE) != 0.0) @name@_derive(model, &now);
  return @name@_step(model, &now);
}

/* Simulink may ask more than once at a time: the state moves on in mdlUpdate only. */
static void mdlOutputs(SimStruct *S, int_T tid) {
  @name@_model copy = *(const @name@_model *)ssGetDWork(S, 0);
  (void)tid;
  *(real_T *)ssGetOutputPortSignal(S, 0) = advance(S, &copy);
}

#define MDL_UPDATE
static void mdlUpdate(SimStruct *S, int_T tid) {
  (void)tid;
  advance(S, (@name@_model *)ssGetDWork(S, 0));
}

static void mdlTerminate(SimStruct *S) { (void)S; }

#ifdef MATLAB_MEX_FILE
#include "simulink.c"
#else
#include "cg_sfun.h"
#endif
