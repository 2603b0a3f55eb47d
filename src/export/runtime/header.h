/* @title@. Written by hysteron.
 *
 * Force of a damper from its motion, sample by sample. All quantities in SI units; no heap, no global state, no input or
 * output. The work of a step is bounded: see @NAME@_MOST_SUBSTEPS.
 *
 *   @name@_model damper;
 *   @name@_start(&damper, @frequency@);
 *   for (;;) {
 *     @name@_input now = {0};
 *     now.time = ...; now.displacement = ...; now.velocity = ...;@set_drive@
 *     @name@_derive(&damper, &now);    where slope, acceleration and jerk are not known
 *     force = @name@_step(&damper, &now);
 *   }
 */
#ifndef @NAME@_H
#define @NAME@_H

#ifdef __cplusplus
extern "C" {
#endif

/* Steps of the integration between two samples at most; twice as many where the velocity changes sign between them.
 * What the stiffness of the equations asks for beyond is not done: the force is then less accurate. */
#ifndef @NAME@_MOST_SUBSTEPS
#define @NAME@_MOST_SUBSTEPS @most_substeps@.0
#endif
/* 0: as many steps as the stiffness asks for. Otherwise always so many, and twice as many where the velocity changes
 * sign between two samples: the parts before and after are marched one by one. Plan the time of a sample for these. */
#ifndef @NAME@_SUBSTEPS
#define @NAME@_SUBSTEPS @substeps@
#endif
/* Samples of the drive that are kept. */
#ifndef @NAME@_HISTORY
#define @NAME@_HISTORY @history@
#endif

typedef struct {
  double time;         /* s, increasing; the first one counts as 0 */
  double displacement; /* m */
  double velocity;     /* m/s */
  double slope;        /* m/s^2, of the velocity between samples */
  double acceleration; /* m/s^2, what the equations see: as slope, or smoother */
  double jerk;         /* m/s^3, of the acceleration */
  double drive;        /* @drive@ */
} @name@_input;

/* Holds all there is of a damper: copies are dampers of their own. */
typedef struct {
  double state[@room@];
  double parameters[@parameters@]; /* that act at the last sample */
  double memory[@memories@][2];    /* of the effects on the drive */
  double history_time[@NAME@_HISTORY];
  double history_drive[@NAME@_HISTORY];
  int history_count;
  double frequency; /* Hz */
  double begun;     /* s, the first sample */
  double lead;      /* s before it */
  double force;     /* N at the last sample */
  @name@_input last, before_last;
  int samples;  /* 0, 1, 2 or more */
  int reversed; /* the velocity changed sign before the last sample */
} @name@_model;

/* At rest. `frequency` is that of the motion in Hz, where parameters follow it. */
void @name@_start(@name@_model *model, double frequency);

/* What follows is a new recording, whose time counts from its own start, that goes on in the state reached. */
void @name@_go_on(@name@_model *model);

/* Fills in slope, acceleration and jerk from time and velocity of this sample and the two before it; of second order in
 * the sampling interval. Noise of the velocity is not smoothed. */
void @name@_derive(@name@_model *model, @name@_input *now);

/* Force in N at this sample, which follows the last one. A sample that is not later than the last one, or holds a
 * number that is not finite (a lost measurement), changes nothing and returns the last force: the motion then goes on
 * from the last good sample to the next. */
double @name@_step(@name@_model *model, const @name@_input *now);

#ifdef __cplusplus
}
#endif

#endif
