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
  const std::size_t groups = (pairs + lane_count - 1) / lane_count;
  const std::size_t samples = target.force.size();
  const Lanes limit(1e12 * target.normaliser);
  PackSums result;
  Lanes& squares = result.squares;
  Lanes& alive = result.alive;
  const auto pair = [&](std::size_t group, std::size_t lane) { return std::min(group * lane_count + lane, pairs - 1); };
  const auto low = [&](std::size_t group, std::size_t lane) { return pair(group, lane) / count * sweep_directions; };
  const auto candidate = [&](std::size_t group, std::size_t lane) { return pair(group, lane) % count; };
  const auto differentiate = [&](LaneDual& value, std::size_t group, std::size_t direction, const Lanes& slope) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t from = low(group, lane);
      if (direction >= from && direction < from + sweep_directions) {
        value.d[direction - from].set_lane(static_cast<int>(lane), slope.lane(static_cast<int>(lane)));
      }
    }
  };
  std::vector<std::vector<LaneDual>> nodes(groups, std::vector<LaneDual>(d));
  for (std::size_t group = 0; group < groups; ++group) {
    const auto candidate_of = [&](std::size_t lane) { return candidate(group, lane); };
    for (std::size_t c = 0; c < d; ++c) {
      LaneDual& node = nodes[group][c];
      node = LaneDual(lanes_of(points, rows, layout_, c, false, candidate_of));
      if (!directions.of[c].shared) {
        differentiate(node, group, directions.of[c].direction, lanes_of(points, rows, layout_, c, true, candidate_of));
      }
    }
  }
  // All groups pass a block of samples before the next block, so that its columns come together in little memory.
  const auto parameters_of = [&](std::size_t group) {
    return [this, &nodes, &target, &directions, &differentiate, group](
               const auto& drive, std::span<const double> conditions, LaneDual* p) {
      parameters_of_pack(layout_, nodes[group], drive, target.frequency, conditions, p);
      for (std::size_t j = 0; directions.by_parameter && j < directions.count; ++j) {
        const ParameterLaw& law = layout_.laws()[j];
        if (directions.of[law.first].shared) {
          differentiate(p[law.parameter], group, j, Lanes(1.0));
        }
      }
    };
  };
  std::vector<Marcher<LaneDual, decltype(parameters_of(0))>> marchers;
  std::vector<std::vector<LaneDual>> states(groups, std::vector<LaneDual>(max_states));
  for (std::size_t group = 0; group < groups; ++group) {
    marchers.emplace_back(layout_.model(), target, parameters_of(group));
    marchers[group].start(0, states[group], [&](std::size_t begin, std::size_t block, const LaneDual* out) {
      for (std::size_t k = 0; group == 0 && k < block; ++k) {
        alive += select(abs(out[k].v - Lanes(target.force[begin + k])) < limit, Lanes(1.0), Lanes(0.0));
      }
    });
  }
  std::vector<Lanes> jacobian(block_samples * columns);
  std::vector<Lanes> residual(block_samples);
  for (std::size_t begin = 0; begin < samples; begin += block_samples) {
    const std::size_t block = std::min(block_samples, samples - begin);
    for (std::size_t group = 0; group < groups; ++group) {
      check_stopped();
      const LaneDual* out = marchers[group].block(begin, begin + block, states[group]);
      const std::size_t used = std::min<std::size_t>(lane_count, pairs - group * lane_count);
      for (std::size_t k = 0; k < block; ++k) {
        Lanes* row = jacobian.data() + k * columns;
        if (count == lane_count) {
          const std::size_t from = low(group, 0);
          for (std::size_t c = from; c < std::min(from + sweep_directions, columns); ++c) {
            row[c] = out[k].d[c - from];
          }
        } else {
          for (std::size_t lane = 0; lane < used; ++lane) {
            const std::size_t from = low(group, lane);
            for (std::size_t c = from; c < std::min(from + sweep_directions, columns); ++c) {
              row[c].set_lane(static_cast<int>(candidate(group, lane)),
                              out[k].d[c - from].lane(static_cast<int>(lane)));
            }
          }
        }
        if (group == 0) {
          // The lanes of the first sweep are the candidates in order.
          const Lanes r = out[k].v - Lanes(target.force[begin + k]);
          residual[k] = r;
          if (begin + k >= target.run_in) {
            squares = fma(r, r, squares);
          }
          alive += select(abs(r) < limit, Lanes(1.0), Lanes(0.0));
        }
      }
    }
    take(begin, block, jacobian.data(), residual.data());
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

void Objective::linearise(const std::vector<double>& point, const TakeLinearised& take) const {
  const std::size_t d = layout_.dimension();
  const std::array<std::size_t, 1> row = {0};
  parallel_for(targets_.size(), threads_, [&](std::size_t r) {
    const Target& target = targets_[r];
    const double scale = std::sqrt(target.weight);
    const Directions directions = directions_of(layout_, target);
    std::vector<double> slope(d, scale);
    for (std::size_t c = 0; c < d; ++c) {
      if (directions.of[c].shared) {
        slope[c] *= directions.of[c].weight * layout_.slope(c, point[c]);
      }
    }
    std::vector<double> residuals(block_samples);
    std::vector<double> rows(block_samples * d);
    [[maybe_unused]] const PackSums sums =
        differentiated(point, row, target, directions,
                       [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
                         for (std::size_t k = 0; k < count; ++k) {
                           const bool counts = begin + k >= target.run_in;
                           residuals[k] = counts ? scale * residual[k].lane(0) : 0.0;
                           const Lanes* columns = jacobian + k * directions.count;
                           for (std::size_t c = 0; c < d; ++c) {
                             rows[k * d + c] = counts ? slope[c] * columns[directions.of[c].direction].lane(0) : 0.0;
                           }
                         }
                         take(r, begin, count, residuals.data(), rows.data());
                       });
  });
}

std::vector<Linearised> Objective::linearised(const std::vector<double>& point) const {
  const std::size_t d = layout_.dimension();
  std::vector<Linearised> result(targets_.size());
  for (std::size_t r = 0; r < targets_.size(); ++r) {
    result[r].residual.resize(targets_[r].force.size());
    result[r].jacobian.resize(targets_[r].force.size() * d);
  }
  linearise(point,
            [&](std::size_t r, std::size_t begin, std::size_t count, const double* residual, const double* jacobian) {
              std::copy_n(residual, count, result[r].residual.data() + begin);
              std::copy_n(jacobian, count * d, result[r].jacobian.data() + begin * d);
            });
  return result;
}

}  // namespace hysteron
