
/* ---- The drive that acts, and the parameters that follow it -------------------------------------------------------- */

typedef struct {
  const double *time, *drive;
  int count; /* oldest first */
} drive_history;

/* The drive `lag` seconds ago: linear between samples, held before the oldest that is kept and after the newest. */
static double drive_before(const drive_history *past, double lag) {
  const int newest = past->count - 1;
  const double wanted = past->time[newest] - lag;
  if (!(wanted > past->time[0])) return past->drive[0];
  for (int k = newest; k > 0; --k) {
    if (wanted >= past->time[k - 1]) {
      const double h = past->time[k] - past->time[k - 1];
      const double share = fmin((wanted - past->time[k - 1]) / h, 1.0);
      return past->drive[k - 1] + (past->drive[k] - past->drive[k - 1]) * share;
    }
  }
  return past->drive[0];
}

static void remember_drive(@name@_model *model, double time, double drive) {
  if (model->history_count == @NAME@_HISTORY) {
    for (int k = 1; k < @NAME@_HISTORY; ++k) {
      model->history_time[k - 1] = model->history_time[k];
      model->history_drive[k - 1] = model->history_drive[k];
    }
    --model->history_count;
  }
  model->history_time[model->history_count] = time;
  model->history_drive[model->history_count] = drive;
  ++model->history_count;
}
