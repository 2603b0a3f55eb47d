// Costs with their derivatives, and the residuals and Jacobian of one candidate.
#include <algorithm>
#include <array>
#include <cmath>

#include "fit/directions.hpp"
#include "fit/march_target.hpp"
#include "fit/objective.hpp"
#include "fit/pack.hpp"
#include "fit/parallel.hpp"

namespace hysteron {

// A sweep differentiates by sweep_directions directions. The pairs of candidate and sweep are dealt to the lanes, so
// that few candidates with many directions fill a pack too.
Objective::PackSums Objective::differentiated(const std::vector<double>& points, Rows rows, const Target& target,
                                              const Directions& directions, const TakeDerivatives& take) const {
  const std::size_t d = layout_.dimension();
  const std::size_t columns = directions.count;
  const std::size_t count = rows.size();
  const std::size_t pairs = count * ((columns + sweep_directions - 1) / sweep_directions);
  const std::size_t samples = target.force.size();
  const Lanes limit(1e12 * target.normaliser);
  PackSums result;
  Lanes& squares = result.squares;
  Lanes& alive = result.alive;
  // One march has all the columns of a block at once; the columns of several are put together first.
  const bool together = pairs <= lane_count;
  std::vector<Lanes> jacobian((together ? block_samples : samples) * columns);
  std::vector<Lanes> residual(together ? block_samples : samples);
  std::vector<LaneDual> nodes(d);
  for (std::size_t first = 0; first < pairs; first += lane_count) {
    const auto pair = [&](std::size_t lane) { return std::min(first + lane, pairs - 1); };
    const auto low = [&](std::size_t lane) { return pair(lane) / count * sweep_directions; };
    const auto candidate = [&](std::size_t lane) { return pair(lane) % count; };
    const auto differentiate = [&](LaneDual& value, std::size_t direction, const Lanes& slope) {
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (direction >= low(lane) && direction < low(lane) + sweep_directions) {
          value.d[direction - low(lane)].set_lane(static_cast<int>(lane), slope.lane(static_cast<int>(lane)));
        }
      }
    };
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = LaneDual(lanes_of(points, rows, layout_, c, false, candidate));
      if (!directions.of[c].shared) {
        differentiate(nodes[c], directions.of[c].direction, lanes_of(points, rows, layout_, c, true, candidate));
      }
    }
    const std::size_t used = std::min<std::size_t>(lane_count, pairs - first);
    march_target<LaneDual>(
        layout_.model(), target,
        [&](const auto& drive, LaneDual* p) {
          parameters_of_pack(layout_, nodes, drive, target.frequency, p);
          for (std::size_t j = 0; directions.by_parameter && j < columns; ++j) {
            const ParameterLaw& law = layout_.laws()[j];
            if (directions.of[law.first].shared) {
              differentiate(p[law.parameter], j, Lanes(1.0));
            }
          }
        },
        [&](std::size_t begin, std::size_t block, const LaneDual* out) {
          check_stopped();
          const std::size_t base = together ? 0 : begin;
          for (std::size_t k = 0; k < block; ++k) {
            Lanes* row = jacobian.data() + (base + k) * columns;
            if (count == lane_count) {
              for (std::size_t c = low(0); c < std::min(low(0) + sweep_directions, columns); ++c) {
                row[c] = out[k].d[c - low(0)];
              }
            } else {
              for (std::size_t lane = 0; lane < used; ++lane) {
                for (std::size_t c = low(lane); c < std::min(low(lane) + sweep_directions, columns); ++c) {
                  row[c].set_lane(static_cast<int>(candidate(lane)),
                                  out[k].d[c - low(lane)].lane(static_cast<int>(lane)));
                }
              }
            }
            if (first == 0) {
              // The lanes of the first sweep are the candidates in order.
              const Lanes r = out[k].v - Lanes(target.force[begin + k]);
              residual[base + k] = r;
              if (begin + k >= target.run_in) {
                squares = fma(r, r, squares);
              }
              alive += select(abs(r) < limit, Lanes(1.0), Lanes(0.0));
            }
          }
          if (together) {
            take(begin, block, jacobian.data(), residual.data());
          }
        },
        [&](std::size_t begin, std::size_t block, const LaneDual* out) {
          for (std::size_t k = 0; first == 0 && k < block; ++k) {
            alive += select(abs(out[k].v - Lanes(target.force[begin + k])) < limit, Lanes(1.0), Lanes(0.0));
          }
        });
  }
  if (!together) {
    take(0, samples, jacobian.data(), residual.data());
  }
  return result;
}

namespace {

// Row and column of a symmetric matrix of which the upper triangle is stored row by row.
std::size_t in_triangle(std::size_t a, std::size_t b, std::size_t size) {
  const auto [row, column] = std::minmax(a, b);
  return row * size - row * (row + 1) / 2 + column;
}

}  // namespace

void Objective::sum_derivatives(const std::vector<double>& points, Rows rows, const Target& target,
                                double* sums) const {
  const std::size_t d = layout_.dimension();
  const Directions directions = directions_of(layout_, target);
  const std::size_t columns = directions.count;
  std::vector<Lanes> gradient(columns);
  std::vector<Lanes> matrix(columns * (columns + 1) / 2);
  const auto [squares, alive] =
      differentiated(points, rows, target, directions,
                     [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
                       for (std::size_t k = target.run_in > begin ? target.run_in - begin : 0; k < count; ++k) {
                         const Lanes* row = jacobian + k * columns;
                         std::size_t at = 0;
                         for (std::size_t a = 0; a < columns; ++a) {
                           const Lanes ja = row[a];
                           gradient[a] = fma(ja, residual[k], gradient[a]);
                           for (std::size_t b = a; b < columns; ++b, ++at) {
                             matrix[at] = fma(ja, row[b], matrix[at]);
                           }
                         }
                       }
                     });
  const auto store = [&](std::size_t slot, const Lanes& value, double factor) {
    for (int lane = 0; lane < lane_count; ++lane) {
      sums[slot * lane_count + static_cast<std::size_t>(lane)] = value.lane(lane) * factor;
    }
  };
  store(0, squares, target.weight);
  store(1, alive, 1.0);
  // From directions to coordinates.
  const auto candidate = [&](std::size_t lane) { return std::min(lane, rows.size() - 1); };
  std::vector<Lanes> slope(d, Lanes(1.0));
  for (std::size_t c = 0; c < d; ++c) {
    if (directions.of[c].shared) {
      slope[c] = Lanes(directions.of[c].weight) * lanes_of(points, rows, layout_, c, true, candidate);
    }
  }
  std::size_t slot = 2 + d;
  for (std::size_t a = 0; a < d; ++a) {
    const std::size_t row = directions.of[a].direction;
    store(2 + a, slope[a] * gradient[row], target.weight);
    for (std::size_t b = a; b < d; ++b, ++slot) {
      const std::size_t at = in_triangle(row, directions.of[b].direction, columns);
      store(slot, slope[a] * (slope[b] * matrix[at]), target.weight);
    }
  }
}

std::vector<Linearised> Objective::linearised(const std::vector<double>& point) const {
  const std::size_t d = layout_.dimension();
  const std::array<std::size_t, 1> row = {0};
  std::vector<Linearised> result(targets_.size());
  parallel_for(targets_.size(), threads_, [&](std::size_t r) {
    const Target& target = targets_[r];
    const double scale = std::sqrt(target.weight);
    result[r].residual.resize(target.force.size());
    result[r].jacobian.resize(target.force.size() * d);
    const Directions directions = directions_of(layout_, target);
    std::vector<double> slope(d, scale);
    for (std::size_t c = 0; c < d; ++c) {
      if (directions.of[c].shared) {
        slope[c] *= directions.of[c].weight * layout_.slope(c, point[c]);
      }
    }
    [[maybe_unused]] const PackSums sums =
        differentiated(point, row, target, directions,
                       [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
                         for (std::size_t n = std::max(begin, target.run_in); n < begin + count; ++n) {
                           result[r].residual[n] = scale * residual[n - begin].lane(0);
                           const Lanes* columns = jacobian + (n - begin) * directions.count;
                           for (std::size_t c = 0; c < d; ++c) {
                             result[r].jacobian[n * d + c] = slope[c] * columns[directions.of[c].direction].lane(0);
                           }
                         }
                       });
  });
  return result;
}

}  // namespace hysteron
