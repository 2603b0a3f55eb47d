// One thread.
#pragma once

inline int omp_get_max_threads() { return 1; }
