// Residuals of candidates over a window of one recording, for solvers that pass through it.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/march_target.hpp"
#include "fit/objective.hpp"
#include "fit/pack.hpp"

namespace hysteron {

// In one thread: a window is too short to share.
Response Objective::evaluate_window(const Request& request) const {
  const std::size_t d = layout_.dimension();
  const std::size_t points = request.points.size() / d;
  const auto states = static_cast<std::size_t>(layout_.model().states());
  const Window& window = *request.window;
  const Target& target = targets_[window.recording];
  const std::size_t samples = window.end - window.begin;
  const double scale = std::sqrt(target.weight);
  const double limit = 1e12 * target.normaliser;
  Response response;
  response.cost.resize(points);
  response.residual.resize(points * samples);
  response.states.resize(points * states);
  std::vector<std::size_t> order(points);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<Lanes> nodes(d);
  std::vector<Lanes> state(max_states);
  for (std::size_t first = 0; first < points; first += lane_count) {
    const Rows rows = Rows(order).subspan(first, std::min<std::size_t>(lane_count, points - first));
    const auto candidate = [&](std::size_t lane) { return std::min(lane, rows.size() - 1); };
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = lanes_of(request.points, rows, layout_, c, false, candidate);
    }
    for (int lane = 0; lane < lane_count && window.begin > 0; ++lane) {
      for (std::size_t s = 0; s < states; ++s) {
        state[s].set_lane(lane, request.states[(first + candidate(static_cast<std::size_t>(lane))) * states + s]);
      }
    }
    march_window<Lanes>(
        layout_.model(), target,
        [&](const auto& drive, std::span<const double> conditions, Lanes* p) {
          parameters_of_pack(layout_, nodes, drive, target.frequency, conditions, p);
        },
        window.begin, window.end, state,
        [&](std::size_t begin, std::size_t count, const Lanes* out) {
          check_stopped();
          for (std::size_t lane = 0; lane < rows.size(); ++lane) {
            double* residual = response.residual.data() + (first + lane) * samples + begin - window.begin;
            for (std::size_t k = 0; k < count; ++k) {
              residual[k] = out[k].lane(static_cast<int>(lane)) - target.force[begin + k];
            }
          }
        },
        [](std::size_t, std::size_t, const Lanes*) {});
    for (std::size_t lane = 0; lane < rows.size(); ++lane) {
      double* residual = response.residual.data() + (first + lane) * samples;
      double* end_states = response.states.data() + (first + lane) * states;
      double squares = 0.0;
      bool finite = true;
      for (std::size_t k = 0; k < samples; ++k) {
        finite = finite && std::fabs(residual[k]) < limit;
        residual[k] *= window.begin + k >= target.run_in ? scale : 0.0;
        squares += residual[k] * residual[k];
      }
      for (std::size_t s = 0; s < states; ++s) {
        end_states[s] = state[s].lane(static_cast<int>(lane));
        finite = finite && std::isfinite(end_states[s]);
      }
      response.cost[first + lane] = finite ? std::sqrt(squares) : diverged_cost;
      if (!finite) {
        std::fill_n(residual, samples, 0.0);
        std::fill_n(end_states, states, 0.0);
      }
    }
  }
  return response;
}

}  // namespace hysteron
