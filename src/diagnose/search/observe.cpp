#include "diagnose/search/observe.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/search/relatives.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

std::size_t drive_levels(const std::vector<Recording>& recordings) {
  std::set<long> levels;
  for (const Recording& recording : recordings) {
    for (const double drive : recording.drive) {
      levels.insert(std::lround(100.0 * drive));
    }
  }
  return levels.size();
}

}  // namespace

std::optional<std::string> unmet(Need need, const std::vector<Recording>& recordings) {
  switch (need) {
    case Need::drive:
      if (std::ranges::all_of(recordings, [](const Recording& r) { return r.drive.empty(); })) {
        return "no current or voltage was recorded";
      }
      break;
    case Need::changing_drive:
      if (std::ranges::none_of(recordings, drive_varies)) {
        return "the current is constant in every recording";
      }
      break;
    case Need::three_drive_levels:
      if (drive_levels(recordings) < 3) {
        return "fewer than three current levels: it looks like another slope of the force with current";
      }
      break;
    case Need::velocity:
      if (std::ranges::none_of(recordings, &Recording::velocity_measured)) {
        return "the velocity was not recorded";
      }
      break;
    case Need::lagging_velocity: {
      const std::optional<ChannelLag> lag = velocity_channel_lag(recordings);
      if (!lag) {
        return "the velocity was not recorded but derived from the displacement without lag";
      }
      if (std::fabs(lag->lag) < std::max(3.0 * lag->std_error, 1e-4)) {
        return fmt::format("the recorded velocity agrees with the slope of the displacement within {:.2g} ms",
                           1e3 * std::max({std::fabs(lag->lag), 2.0 * lag->std_error, 1e-6}));
      }
      break;
    }
  }
  return std::nullopt;
}

std::optional<std::string> excluded_by_inputs(const std::string& effect, const std::vector<Recording>& recordings) {
  for (const Need need : knowledge_of(effect).needs) {
    if (const std::optional<std::string> reason = unmet(need, recordings)) {
      return reason;
    }
  }
  return std::nullopt;
}

namespace {

// A velocity channel beside the slope of the displacement, both over the peak of the slope so that recordings count
// alike.
struct VelocityPair {
  const std::vector<double>* time;
  std::vector<double> recorded;
  std::vector<double> slope;
};

// y behind a first-order filter of time constant tau, for y straight between samples.
std::vector<double> filtered(const std::vector<double>& time, const std::vector<double>& y, double tau) {
  std::vector<double> result(y.size(), y.front());
  for (std::size_t n = 1; n < y.size(); ++n) {
    const double step = time[n] - time[n - 1];
    const double slope = (y[n] - y[n - 1]) / step;
    const double lagging = y[n - 1] - tau * slope;
    result[n] = y[n] - tau * slope + (result[n - 1] - lagging) * std::exp(-step / tau);
  }
  return result;
}

struct LagEquation {
  double cross = 0.0;       // zero at the lag; it falls with tau
  double energy = 0.0;      // sum of squared accelerations
  double squares = 0.0;     // of the differences of the channels
  double neighbours = 0.0;  // products of neighbouring differences
  std::size_t samples = 0;
};

// The differences of the channels against the acceleration, once the one ahead went through the filter: white noise of
// either does not correlate with its own slope, so that it does not shift the zero.
LagEquation lag_equation(const std::vector<VelocityPair>& pairs, bool recorded_lags, double tau) {
  LagEquation result;
  for (const VelocityPair& pair : pairs) {
    const std::vector<double>& time = *pair.time;
    const std::vector<double>& behind = recorded_lags ? pair.recorded : pair.slope;
    const std::vector<double>& ahead = recorded_lags ? pair.slope : pair.recorded;
    const std::vector<double> delayed = tau > 0.0 ? filtered(time, ahead, tau) : ahead;
    double before = 0.0;
    for (std::size_t n = 1; n + 1 < time.size(); ++n) {
      const double acceleration = (delayed[n + 1] - delayed[n - 1]) / (time[n + 1] - time[n - 1]);
      const double difference = behind[n] - delayed[n];
      result.cross -= difference * acceleration;
      result.energy += acceleration * acceleration;
      result.squares += difference * difference;
      result.neighbours += difference * before;
      before = difference;
      ++result.samples;
    }
  }
  return result;
}

}  // namespace

std::optional<ChannelLag> velocity_channel_lag(const std::vector<Recording>& recordings) {
  constexpr double longest = 0.2;  // s
  std::vector<VelocityPair> pairs;
  for (const Recording& recording : recordings) {
    if (!recording.velocity_measured || recording.size() < 16) {
      continue;
    }
    VelocityPair pair{&recording.time, recording.velocity, derive_velocity(recording.time, recording.displacement)};
    double peak = 1e-12;
    for (const double v : pair.slope) {
      peak = std::max(peak, std::fabs(v));
    }
    for (std::size_t n = 0; n < pair.slope.size(); ++n) {
      pair.recorded[n] /= peak;
      pair.slope[n] /= peak;
    }
    pairs.push_back(std::move(pair));
  }
  const LagEquation together = lag_equation(pairs, true, 0.0);
  if (together.samples == 0 || !(together.energy > 0.0)) {
    return std::nullopt;
  }
  const bool recorded_lags = together.cross > 0.0;
  double low = 0.0;
  double high = longest;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (low + high);
    (lag_equation(pairs, recorded_lags, middle).cross > 0.0 ? low : high) = middle;
  }
  const double lag = 0.5 * (low + high);
  const LagEquation at = lag_equation(pairs, recorded_lags, lag);
  const double r = at.squares > 0.0 ? std::clamp(at.neighbours / at.squares, 0.0, 0.99) : 0.0;
  const double variance = at.squares / static_cast<double>(at.samples);
  return ChannelLag{recorded_lags ? lag : -lag, std::sqrt(variance / at.energy * (1.0 + r) / (1.0 - r))};
}

std::vector<Unobservable> detection_limits(const Workbench& bench, const Fit& fit, const Misfit& misfit,
                                           const std::vector<std::string>& effects) {
  std::vector<Unobservable> result(effects.size());
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const std::string& id = effects[k];
    result[k].id = id;
    const Fit with = bench.with_neutral(fit, id);
    const Layout& layout = *with.layout;
    std::vector<double> point = with.point;
    std::size_t size_at = 0;
    while (size_at < layout.dimension() &&
           !layout.names()[layout.coordinates()[size_at].parameter].starts_with(id + ".")) {
      ++size_at;
    }
    if (size_at == layout.dimension()) {
      result[k].reason = "its parameters are all held";
      continue;
    }
    // The neutral size may hide the response: a little off it.
    point[size_at] = std::clamp(point[size_at] + (point[size_at] > 0.9 ? -0.02 : 0.02), 0.0, 1.0);
    const Response response = Objective(layout, bench.split().fit, bench.options()).evaluate({point, true});
    const auto d = static_cast<Eigen::Index>(layout.dimension());
    const Eigen::Map<const Eigen::MatrixXd> full(response.gauss_newton.data(), d, d);
    std::vector<Eigen::Index> others;
    for (Eigen::Index c = 0; c < d; ++c) {
      if (!layout.names()[layout.coordinates()[static_cast<std::size_t>(c)].parameter].starts_with(id + ".") &&
          full(c, c) > 0.0) {
        others.push_back(c);
      }
    }
    const auto s = static_cast<Eigen::Index>(size_at);
    const double sensitivity = full(s, s);
    if (response.cost[0] >= diverged_cost) {
      result[k].reason = "its equations are too stiff at these sampling rates for its smallest size to be told";
      continue;
    }
    if (!(sensitivity > 0.0)) {
      result[k].reason = find_effect(result[k].id)->starts.empty()
                             ? "it changes no force on these motions"
                             : "it acts only beyond a threshold, and a small one changes no force";
      continue;
    }
    const auto m = static_cast<Eigen::Index>(others.size());
    Eigen::MatrixXd base(m, m);
    Eigen::VectorXd cross(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      for (Eigen::Index j = 0; j < m; ++j) {
        base(i, j) = full(others[static_cast<std::size_t>(i)], others[static_cast<std::size_t>(j)]);
      }
      cross[i] = full(others[static_cast<std::size_t>(i)], s);
    }
    base.diagonal() *= 1.0 + 1e-9;
    const double kept = (sensitivity - cross.dot(base.ldlt().solve(cross))) / sensitivity;
    if (!(kept > 1e-5)) {
      result[k].reason = "the other parameters imitate it entirely on these recordings";
      continue;
    }
    // size^2 * sensitivity * kept / squares * effective = what the criterion asks for.
    const double asked = 12.0 + std::log(misfit.independent);
    const double response_share = std::sqrt(asked * misfit.squares / (misfit.independent * kept));
    if (response_share > 1.0) {
      result[k].reason = "the other parameters imitate it nearly entirely on these recordings";
      continue;
    }
    result[k].detection_limit =
        fmt::format("a force below {:.2g} % of the peak force (root mean square)", 100.0 * response_share);
  }
  return result;
}

}  // namespace hysteron
