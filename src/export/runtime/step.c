
void @name@_start(@name@_model *model, double frequency) {
  static const @name@_model empty; /* zeros */
  *model = empty;
  model->frequency = frequency;
}

void @name@_go_on(@name@_model *model) {
  model->lead += model->last.time - model->begun;
  model->samples = 0;
  model->reversed = 0;
  model->history_count = 0;
}

/* Slope at the last of three points, of the parabola through them, and in the middle. */
static double slope_at_end(double h_before, double h, double y0, double y1, double y2) {
  const double before = (y1 - y0) / h_before;
  const double after = (y2 - y1) / h;
  return after + (after - before) * h / (h_before + h);
}
static double slope_in_middle(double h_before, double h, double y0, double y1, double y2) {
  return ((y1 - y0) / h_before * h + (y2 - y1) / h * h_before) / (h_before + h);
}

/* One number that is none would stay in the state for ever. */
static int is_sample(const @name@_input *now) {
  return isfinite(now->time) && isfinite(now->displacement) && isfinite(now->velocity) && isfinite(now->slope) &&
         isfinite(now->acceleration) && isfinite(now->jerk) && isfinite(now->drive);
}

void @name@_derive(@name@_model *model, @name@_input *now) {
  @name@_input *last = &model->last;
  const @name@_input *first = &model->before_last;
  const double h = now->time - last->time;
  now->slope = 0.0;
  now->jerk = 0.0;
  now->acceleration = 0.0;
  if (!is_sample(now)) return;
  if (model->samples == 1 && h > 0.0) {
    now->slope = (now->velocity - last->velocity) / h;
    last->slope = now->slope;
    last->acceleration = now->slope;
  } else if (model->samples > 1 && h > 0.0) {
    const double h_before = last->time - first->time;
    now->slope = slope_at_end(h_before, h, first->velocity, last->velocity, now->velocity);
    last->slope = slope_in_middle(h_before, h, first->velocity, last->velocity, now->velocity);
    last->acceleration = last->slope;
    now->jerk = (now->slope - last->slope) / h;
    last->jerk = now->jerk;
  }
  now->acceleration = now->slope;
}

double @name@_step(@name@_model *model, const @name@_input *now) {
  double p[PARAMETERS];
  double h, speed;
  motion_point in;
  if (!is_sample(now)) return model->force;
  if (model->samples > 0 && !(now->time > model->last.time)) return model->force;
  if (model->samples == 0) model->begun = now->time;
  acting_parameters(model, now, p);
#if STATES > 0
  if (model->samples > 0) {
    double between[PARAMETERS];
    interval over;
    for (int k = 0; k < PARAMETERS; ++k) between[k] = 0.5 * (model->parameters[k] + p[k]);
    make_interval(model, now, &over);
    march(model->parameters, between, &over, model->state);
    model->reversed = over.reversal;
  }
#endif
  in.x = now->displacement;
  in.v = now->velocity;
  in.drive = now->drive;
  in.time = now->time - model->begun;
  in.age = in.time + model->lead;
  in.a = now->acceleration;
  in.jerk = now->jerk;
  h = model->samples > 0 ? now->time - model->last.time : 0.0;
  speed = fmax(fabs(in.v), fabs(in.v + h * now->slope)) + 8.0 / 27.0 * h * fabs(now->slope);
  model->force = force_of(p, model->state, &in, speed, fabs(now->slope));
  for (int k = 0; k < PARAMETERS; ++k) model->parameters[k] = p[k];
  model->before_last = model->last;
  model->last = *now;
  if (model->samples < 2) ++model->samples;
  return model->force;
}
