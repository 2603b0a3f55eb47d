// Costs with their derivatives, and the residuals and Jacobian of one candidate.
#include <algorithm>
#include <array>
#include <cmath>

#include "fit/march_target.hpp"
#include "fit/objective.hpp"
#include "fit/pack.hpp"
#include "fit/parallel.hpp"

namespace hysteron {

// A sweep differentiates sweep_directions coordinates. The pairs of candidate and sweep are dealt to the lanes, so that
// few candidates with many coordinates fill a pack too.
Objective::PackSums Objective::differentiated(const std::vector<double>& points, Rows rows, const Target& target,
                                              const TakeDerivatives& take) const {
  const std::size_t d = layout_.dimension();
  const std::size_t count = rows.size();
  const std::size_t pairs = count * ((d + sweep_directions - 1) / sweep_directions);
  const std::size_t samples = target.force.size();
  const Lanes limit(1e12 * target.normaliser);
  PackSums result;
  Lanes& squares = result.squares;
  Lanes& alive = result.alive;
  // One march has all the columns of a block at once; the columns of several are put together first.
  const bool together = pairs <= lane_count;
  std::vector<Lanes> jacobian((together ? block_samples : samples) * d);
  std::vector<Lanes> residual(together ? block_samples : samples);
  std::vector<LaneDual> nodes(d);
  for (std::size_t first = 0; first < pairs; first += lane_count) {
    const auto pair = [&](std::size_t lane) { return std::min(first + lane, pairs - 1); };
    const auto low = [&](std::size_t lane) { return pair(lane) / count * sweep_directions; };
    const auto candidate = [&](std::size_t lane) { return pair(lane) % count; };
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = LaneDual(lanes_of(points, rows, layout_, c, false, candidate));
      const Lanes slope = lanes_of(points, rows, layout_, c, true, candidate);
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (c >= low(lane) && c < low(lane) + sweep_directions) {
          nodes[c].d[c - low(lane)].set_lane(static_cast<int>(lane), slope.lane(static_cast<int>(lane)));
        }
      }
    }
    const std::size_t used = std::min<std::size_t>(lane_count, pairs - first);
    march_target<LaneDual>(
        layout_.model(), target,
        [&](const auto& drive, LaneDual* p) { parameters_of_pack(layout_, nodes, drive, target.frequency, p); },
        [&](std::size_t begin, std::size_t block, const LaneDual* out) {
          check_stopped();
          const std::size_t base = together ? 0 : begin;
          for (std::size_t k = 0; k < block; ++k) {
            Lanes* row = jacobian.data() + (base + k) * d;
            if (count == lane_count) {
              for (std::size_t c = low(0); c < std::min(low(0) + sweep_directions, d); ++c) {
                row[c] = out[k].d[c - low(0)];
              }
            } else {
              for (std::size_t lane = 0; lane < used; ++lane) {
                for (std::size_t c = low(lane); c < std::min(low(lane) + sweep_directions, d); ++c) {
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

void Objective::sum_derivatives(const std::vector<double>& points, Rows rows, const Target& target,
                                double* sums) const {
  const std::size_t d = layout_.dimension();
  std::vector<Lanes> gradient(d);
  std::vector<Lanes> matrix(d * (d + 1) / 2);
  const auto [squares, alive] = differentiated(
      points, rows, target, [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
        for (std::size_t k = target.run_in > begin ? target.run_in - begin : 0; k < count; ++k) {
          const Lanes* row = jacobian + k * d;
          std::size_t at = 0;
          for (std::size_t a = 0; a < d; ++a) {
            const Lanes ja = row[a];
            gradient[a] = fma(ja, residual[k], gradient[a]);
            for (std::size_t b = a; b < d; ++b, ++at) {
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
  for (std::size_t a = 0; a < d; ++a) {
    store(2 + a, gradient[a], target.weight);
  }
  for (std::size_t k = 0; k < matrix.size(); ++k) {
    store(2 + d + k, matrix[k], target.weight);
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
    [[maybe_unused]] const PackSums sums = differentiated(
        point, row, target, [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
          for (std::size_t n = std::max(begin, target.run_in); n < begin + count; ++n) {
            result[r].residual[n] = scale * residual[n - begin].lane(0);
            for (std::size_t c = 0; c < d; ++c) {
              result[r].jacobian[n * d + c] = scale * jacobian[(n - begin) * d + c].lane(0);
            }
          }
        });
  });
  return result;
}

}  // namespace hysteron
