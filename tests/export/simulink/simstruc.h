/* The few functions of Simulink's simstruc.h that the exported S-function calls, enough to run it without MATLAB. */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H

#include <stdlib.h>

typedef double real_T;
typedef int int_T;

typedef struct {
  double parameters[8];
  int parameter_count, expected_parameters;
  double time;
  int inputs, outputs, input_width[8], output_width[8];
  double input[8][8], output[8][8];
  double sample_time, offset;
  int work_width;
  double *work;
} SimStruct;

#define SS_DOUBLE 0
#define mxGetScalar(parameter) (*(parameter))
#define ssGetSFcnParam(S, k) (&(S)->parameters[k])
#define ssSetNumSFcnParams(S, n) ((S)->expected_parameters = (n))
#define ssGetNumSFcnParams(S) ((S)->expected_parameters)
#define ssGetSFcnParamsCount(S) ((S)->parameter_count)
#define ssSetSFcnParamTunable(S, k, on) ((void)(k))
#define ssSetNumInputPorts(S, n) ((S)->inputs = (n), 1)
#define ssSetInputPortWidth(S, k, n) ((S)->input_width[k] = (n))
#define ssSetInputPortRequiredContiguous(S, k, on) ((void)(k))
#define ssSetInputPortDirectFeedThrough(S, k, on) ((void)(k))
#define ssSetNumOutputPorts(S, n) ((S)->outputs = (n), 1)
#define ssSetOutputPortWidth(S, k, n) ((S)->output_width[k] = (n))
#define ssSetNumSampleTimes(S, n) ((void)(S))
#define ssSetNumDWork(S, n) ((n) == 1)
#define ssSetDWorkWidth(S, k, n) ((S)->work_width = (n))
#define ssSetDWorkDataType(S, k, type) ((void)(S))
#define ssSetSampleTime(S, k, value) ((S)->sample_time = (value))
#define ssSetOffsetTime(S, k, value) ((S)->offset = (value))
#define ssGetDWork(S, k) ((void *)(S)->work)
#define ssGetT(S) ((S)->time)
#define ssGetInputPortSignal(S, k) ((const void *)(S)->input[k])
#define ssGetOutputPortSignal(S, k) ((void *)(S)->output[k])

#endif
