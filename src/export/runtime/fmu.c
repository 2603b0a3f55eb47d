/* @title@ as an FMU for co-simulation, FMI 2.0: the interface around @name@.c. Written by hysteron.
 *
 * Inputs are samples of the motion at the communication points. fmi2DoStep takes those of its current point; the force
 * at the next one is that of the inputs set after the step, or, before any are set, of the motion carried on from the
 * last sample with its velocity and acceleration.
 *
 * Where an input, or the time, is not finite, fmi2DoStep steps nothing, keeps the state and returns fmi2Discard, as
 * fmi2GetReal does for the force, whose value is then the last one: set the input again and repeat the step.
 *
 * The functions carry the model's name, as the specification wants it of source code; for a binary, and wherever they
 * are to have their plain names, FMI2_OVERRIDE_FUNCTION_PREFIX is defined, or DISABLE_PREFIX, as some tools do.
 */
#if defined(DISABLE_PREFIX) && !defined(FMI2_OVERRIDE_FUNCTION_PREFIX)
#define FMI2_OVERRIDE_FUNCTION_PREFIX
#endif
#ifndef FMI2_FUNCTION_PREFIX
#define FMI2_FUNCTION_PREFIX @name@_
#endif
#include "fmi2.h"

#include <math.h>
#include <string.h>

#include "@name@.h"

#define EXPORT FMI2_Export
#define NAMED(name) fmi2FullName(name)
#define GUID "@guid@"

enum { DISPLACEMENT = 1, VELOCITY, DRIVE, SLOPE, ACCELERATION, JERK, FORCE, FREQUENCY };
enum { DERIVE = 1 };

typedef struct {
  fmi2CallbackFunctions callbacks;
  fmi2String name;
  char name_stored[128];
  @name@_model model; /* as of the last communication point that a step began at */
  @name@_input inputs;
  double frequency;
  int derive;
  int fresh; /* inputs were set since the last step */
  double time;
} component;

static fmi2Status refuse(component *of, const char *message) {
  if (of->callbacks.logger) {
    of->callbacks.logger(of->callbacks.componentEnvironment, of->name, fmi2Error, "error", message);
  }
  return fmi2Error;
}

static fmi2Status discard(component *of, const char *message) {
  if (of->callbacks.logger) {
    of->callbacks.logger(of->callbacks.componentEnvironment, of->name, fmi2Discard, "discard", message);
  }
  return fmi2Discard;
}

/* Slopes that are derived are not looked at. */
static int inputs_are_finite(const component *of) {
  const @name@_input *in = &of->inputs;
  const double sum = in->displacement + in->velocity + in->drive + of->frequency;
  const double slopes = in->slope + in->acceleration + in->jerk;
  return isfinite(sum) && (of->derive || isfinite(slopes));
}

static void set_up(component *of) {
  static const @name@_input nothing; /* zeros */
  of->inputs = nothing;
  of->frequency = @frequency@;
  of->derive = 1;
  of->fresh = 1;
  of->time = 0.0;
  @name@_start(&of->model, of->frequency);
}

/* A sample at this time. */
static double advance(component *of, @name@_model *model, double time, const @name@_input *inputs) {
  @name@_input now = *inputs;
  now.time = time;
  model->frequency = of->frequency;
  if (of->derive) @name@_derive(model, &now);
  return @name@_step(model, &now);
}

static double force_now(component *of) {
  @name@_model copy = of->model;
  @name@_input inputs = of->inputs;
  if (!of->fresh && copy.samples > 0) {
    const @name@_input *last = &of->model.last;
    const double h = of->time - last->time;
    inputs = *last;
    inputs.displacement += h * (last->velocity + 0.5 * h * last->slope);
    inputs.velocity += h * last->slope;
    inputs.acceleration += h * last->jerk;
  }
  return advance(of, &copy, of->time, &inputs);
}

EXPORT const char *NAMED(fmi2GetTypesPlatform)(void) { return "default"; }
EXPORT const char *NAMED(fmi2GetVersion)(void) { return "2.0"; }
EXPORT fmi2Status NAMED(fmi2SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String names[]) {
  (void)c;
  (void)on;
  (void)count;
  (void)names;
  return fmi2OK;
}

EXPORT fmi2Component NAMED(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                            const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                                            fmi2Boolean logging) {
  component *made;
  (void)resources;
  (void)visible;
  (void)logging;
  if (!callbacks || !callbacks->allocateMemory || !callbacks->freeMemory) return NULL;
  if (type != fmi2CoSimulation || !name || !*name || !guid || strcmp(guid, GUID) != 0) {
    if (callbacks->logger) {
      callbacks->logger(callbacks->componentEnvironment, name, fmi2Error, "error",
                        "instantiated with a wrong type, name or GUID");
    }
    return NULL;
  }
  made = (component *)callbacks->allocateMemory(1, sizeof(component));
  if (!made) return NULL;
  made->callbacks = *callbacks;
  strncpy(made->name_stored, name, sizeof made->name_stored - 1);
  made->name_stored[sizeof made->name_stored - 1] = '\0';
  made->name = made->name_stored;
  set_up(made);
  return made;
}
EXPORT void NAMED(fmi2FreeInstance)(fmi2Component c) {
  if (c) ((component *)c)->callbacks.freeMemory(c);
}
EXPORT fmi2Status NAMED(fmi2SetupExperiment)(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                             fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop) {
  (void)tolerance_defined;
  (void)tolerance;
  (void)stop_defined;
  (void)stop;
  ((component *)c)->time = start;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2EnterInitializationMode)(fmi2Component c) {
  (void)c;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2ExitInitializationMode)(fmi2Component c) {
  (void)c;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2Terminate)(fmi2Component c) {
  (void)c;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2Reset)(fmi2Component c) {
  set_up((component *)c);
  return fmi2OK;
}

static double *real_of(component *of, fmi2ValueReference reference) {
  switch (reference) {
    case DISPLACEMENT: return &of->inputs.displacement;
    case VELOCITY: return &of->inputs.velocity;
    case DRIVE: return &of->inputs.drive;
    case SLOPE: return &of->inputs.slope;
    case ACCELERATION: return &of->inputs.acceleration;
    case JERK: return &of->inputs.jerk;
    case FREQUENCY: return &of->frequency;
    default: return NULL;
  }
}

EXPORT fmi2Status NAMED(fmi2GetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                     fmi2Real values[]) {
  component *of = (component *)c;
  for (size_t k = 0; k < count; ++k) {
    const double *value = real_of(of, references[k]);
    if (value) {
      values[k] = *value;
    } else if (references[k] == FORCE) {
      values[k] = force_now(of);
      if (of->fresh && !inputs_are_finite(of)) return discard(of, "fmi2GetReal: an input is not finite");
    } else {
      return refuse(of, "fmi2GetReal: no such value reference");
    }
  }
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2SetReal)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                     const fmi2Real values[]) {
  component *of = (component *)c;
  for (size_t k = 0; k < count; ++k) {
    double *value = real_of(of, references[k]);
    if (!value) return refuse(of, "fmi2SetReal: no such value reference, or an output");
    *value = values[k];
    of->fresh = 1;
  }
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2GetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                        fmi2Boolean values[]) {
  component *of = (component *)c;
  for (size_t k = 0; k < count; ++k) {
    if (references[k] != DERIVE) return refuse(of, "fmi2GetBoolean: no such value reference");
    values[k] = of->derive;
  }
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2SetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                        const fmi2Boolean values[]) {
  component *of = (component *)c;
  for (size_t k = 0; k < count; ++k) {
    if (references[k] != DERIVE) return refuse(of, "fmi2SetBoolean: no such value reference");
    of->derive = values[k];
  }
  return fmi2OK;
}
/* There are no integers and strings. */
EXPORT fmi2Status NAMED(fmi2GetInteger)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                        fmi2Integer values[]) {
  (void)references;
  (void)values;
  return count == 0 ? fmi2OK : refuse((component *)c, "fmi2GetInteger: there are no integers");
}
EXPORT fmi2Status NAMED(fmi2SetInteger)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                        const fmi2Integer values[]) {
  (void)references;
  (void)values;
  return count == 0 ? fmi2OK : refuse((component *)c, "fmi2SetInteger: there are no integers");
}
EXPORT fmi2Status NAMED(fmi2GetString)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                       fmi2String values[]) {
  (void)references;
  (void)values;
  return count == 0 ? fmi2OK : refuse((component *)c, "fmi2GetString: there are no strings");
}
EXPORT fmi2Status NAMED(fmi2SetString)(fmi2Component c, const fmi2ValueReference references[], size_t count,
                                       const fmi2String values[]) {
  (void)references;
  (void)values;
  return count == 0 ? fmi2OK : refuse((component *)c, "fmi2SetString: there are no strings");
}

EXPORT fmi2Status NAMED(fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state) {
  component *of = (component *)c;
  if (!*state) *state = of->callbacks.allocateMemory(1, sizeof(component));
  if (!*state) return refuse(of, "fmi2GetFMUstate: out of memory");
  memcpy(*state, of, sizeof(component));
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state) {
  component *of = (component *)c;
  memcpy(of, state, sizeof(component));
  of->name = of->name_stored;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state) {
  if (*state) ((component *)c)->callbacks.freeMemory(*state);
  *state = NULL;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size) {
  (void)state;
  (void)size;
  return refuse((component *)c, "fmi2SerializedFMUstateSize: not offered");
}
EXPORT fmi2Status NAMED(fmi2SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  (void)state;
  (void)bytes;
  (void)size;
  return refuse((component *)c, "fmi2SerializeFMUstate: not offered");
}
EXPORT fmi2Status NAMED(fmi2DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                                 fmi2FMUstate *state) {
  (void)bytes;
  (void)size;
  (void)state;
  return refuse((component *)c, "fmi2DeSerializeFMUstate: not offered");
}
EXPORT fmi2Status NAMED(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknowns[],
                                                      size_t unknown_count, const fmi2ValueReference knowns[],
                                                      size_t known_count, const fmi2Real seed[], fmi2Real result[]) {
  (void)unknowns;
  (void)unknown_count;
  (void)knowns;
  (void)known_count;
  (void)seed;
  (void)result;
  return refuse((component *)c, "fmi2GetDirectionalDerivative: not offered");
}

EXPORT fmi2Status NAMED(fmi2SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference references[],
                                                     size_t count, const fmi2Integer orders[],
                                                     const fmi2Real values[]) {
  (void)references;
  (void)count;
  (void)orders;
  (void)values;
  return refuse((component *)c, "fmi2SetRealInputDerivatives: not offered, set slope and acceleration");
}
EXPORT fmi2Status NAMED(fmi2GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference references[],
                                                      size_t count, const fmi2Integer orders[], fmi2Real values[]) {
  (void)references;
  (void)count;
  (void)orders;
  (void)values;
  return refuse((component *)c, "fmi2GetRealOutputDerivatives: not offered");
}
EXPORT fmi2Status NAMED(fmi2DoStep)(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_state_before) {
  component *of = (component *)c;
  (void)no_state_before;
  if (!(step >= 0.0)) return refuse(of, "fmi2DoStep: the step is negative");
  if (!isfinite(time + step) || !inputs_are_finite(of)) {
    return discard(of, "fmi2DoStep: an input or the time is not finite, nothing is stepped");
  }
  advance(of, &of->model, time, &of->inputs);
  of->time = time + step;
  of->fresh = 0;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2CancelStep)(fmi2Component c) {
  return refuse((component *)c, "fmi2CancelStep: no step is ever pending");
}
EXPORT fmi2Status NAMED(fmi2GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
  (void)c;
  (void)kind;
  (void)value;
  return fmi2Discard;
}
EXPORT fmi2Status NAMED(fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  *value = ((component *)c)->time;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
  (void)c;
  (void)kind;
  (void)value;
  return fmi2Discard;
}
EXPORT fmi2Status NAMED(fmi2GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
  (void)c;
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = fmi2False;
  return fmi2OK;
}
EXPORT fmi2Status NAMED(fmi2GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
  (void)c;
  (void)kind;
  (void)value;
  return fmi2Discard;
}
