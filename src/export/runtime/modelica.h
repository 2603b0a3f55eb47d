/* @title@ for Modelica's external functions: an external object around @name@.c. Written by hysteron. */
#ifndef @NAME@_MODELICA_H
#define @NAME@_MODELICA_H

#include <stdlib.h>

#include "@name@.c"

static void *@name@_external_new(double frequency) {
  @name@_model *model = (@name@_model *)malloc(sizeof(@name@_model));
  if (model) @name@_start(model, frequency);
  return model;
}

static void @name@_external_delete(void *model) { free(model); }

static double @name@_external_force(void *model, double time, double displacement, double velocity, double slope,
                           double acceleration, double jerk, double drive, int derive) {
  @name@_input now;
  now.time = time;
  now.displacement = displacement;
  now.velocity = velocity;
  now.slope = slope;
  now.acceleration = acceleration;
  now.jerk = jerk;
  now.drive = drive;
  if (derive) @name@_derive((@name@_model *)model, &now);
  return @name@_step((@name@_model *)model, &now);
}

#endif
