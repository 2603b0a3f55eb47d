#include "simulate/march.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "simulate/compile.hpp"
#include "simulate/composite.hpp"

namespace hysteron {
namespace {

using Vector = std::vector<double>;

// Sum of sines with exact velocities.
struct Tone {
  double amplitude;
  double frequency;
  double phase;
};

Motion motion_of(const Vector& time, const std::vector<Tone>& tones) {
  Vector x(time.size(), 0.0);
  Vector v(time.size(), 0.0);
  for (std::size_t n = 0; n < time.size(); ++n) {
    for (const Tone& tone : tones) {
      const double omega = 2.0 * std::numbers::pi * tone.frequency;
      x[n] += tone.amplitude * std::sin(omega * time[n] + tone.phase);
      v[n] += tone.amplitude * omega * std::cos(omega * time[n] + tone.phase);
    }
  }
  return make_motion(time, x, v, {});
}

Vector uniform_time(double rate, double duration) {
  Vector time(static_cast<std::size_t>(rate * duration) + 1);
  for (std::size_t n = 0; n < time.size(); ++n) {
    time[n] = static_cast<double>(n) / rate;
  }
  return time;
}

const std::vector<Tone> sine = {{0.025, 2.0, 0.0}};

std::vector<Tone> multisine(std::uint64_t seed) {
  std::vector<Tone> tones;
  const Stream stream(seed);
  for (std::uint32_t k = 0; k < 12; ++k) {
    tones.push_back({0.006 / std::sqrt(1.0 + k), 0.4 * (1.0 + k), 2.0 * std::numbers::pi * stream.uniform(k)});
  }
  return tones;
}

Vector draw(const Part& part, std::uint64_t seed, std::uint64_t index) {
  const Stream stream(seed);
  Vector p;
  for (std::size_t j = 0; j < part.parameters.size(); ++j) {
    const Parameter& card = part.parameters[j];
    const double u = stream.uniform(index, static_cast<std::uint32_t>(j));
    if (card.fixed) {
      p.push_back(card.initial);
    } else if (card.scale == Scale::logarithmic) {
      p.push_back(card.box.lower * std::pow(card.box.upper / card.box.lower, u));
    } else {
      p.push_back(card.box.lower + (card.box.upper - card.box.lower) * u);
    }
  }
  return p;
}

double peak(const Vector& a) {
  double result = 0.0;
  for (const double value : a) {
    result = std::max(result, std::fabs(value));
  }
  return result;
}

// Root mean square of the difference, of peak force.
double error_of(const Vector& a, const Vector& reference) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    sum += (a[n] - reference[n]) * (a[n] - reference[n]);
  }
  return std::sqrt(sum / static_cast<double>(a.size())) / peak(reference);
}

std::size_t parameter_index(const Part& part, std::string_view name) {
  for (std::size_t j = 0; j < part.parameters.size(); ++j) {
    if (part.parameters[j].name == name) {
      return j;
    }
  }
  throw std::out_of_range(std::string(name));
}

CompositeModel law(const Part& part) {
  CompositeModel model;
  model.law = &part;
  return model;
}

// s' = lambda (v - s): smooth and linear.
struct Relaxation {
  static constexpr std::string_view id = "relaxation";
  static constexpr std::string_view title = "Relaxation";
  static constexpr std::string_view reference = "";
  static constexpr std::string_view equations[] = {"F = s", "s' = lambda (v - s)"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "lambda", .unit = "1/s", .meaning = "rate", .box = {1, 1e3}, .initial = 10}};

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 1>& p, const std::array<T, 1>& s, const Input<T>& in) {
    return {p[0] * (in.v - s[0])};
  }
  template <class T>
  static T stiffness(const std::array<T, 1>& p, double /*speed*/) {
    return p[0];
  }
  template <class T>
  static T force(const std::array<T, 1>& /*p*/, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& /*below*/) {
    return s[0];
  }
};

TEST(March, ConvergesWithFourthOrder) {
  static constexpr Part part = compile<Relaxation>();
  // v = 1 + t + t^2 + t^3, a cubic, is interpolated exactly away from the ends (their slopes are quadratic): only the
  // integrator errs. s for v = sum c_k t^k follows from the recursion of its polynomial part. One interval; its cubic
  // is set here.
  Vector time = {0.0, 1.0};
  Motion motion = make_motion(time, Vector{0.0, 25.0 / 12.0}, Vector{1.0, 4.0}, {});
  MotionInterval& interval = motion.intervals[0];
  for (double& c : interval.course.v) {
    c = 1.0;
  }
  interval.middle[1] = cubic(interval.course.v, 0.5);
  interval.end[1] = cubic(interval.course.v, 1.0);
  const double lambda = 3.0;
  // Particular solution sum b_k t^k: b_3 = 1, b_k = 1 - (k + 1) b_{k+1} / lambda.
  double b[4];
  b[3] = 1.0;
  for (int k = 2; k >= 0; --k) {
    b[k] = 1.0 - (k + 1) * b[k + 1] / lambda;
  }
  const double exact = b[0] + b[1] + b[2] + b[3] - b[0] * std::exp(-lambda);
  double before = 0.0;
  for (const double limit : {0.5, 0.25, 0.125, 0.0625, 0.03125}) {
    motion.step_limit = limit;
    const double error = std::fabs(simulate(law(part), motion, {lambda})[1] - exact);
    if (before > 0.0) {
      EXPECT_NEAR(before / error, 16.0, 4.0) << limit;
    }
    before = error;
  }
}

// Forces of a pack of parameter sets, each with the bits that it has alone (Batch.ACandidateDoesNotDependOnItsCompany).
std::vector<Vector> simulate_pack(const CompositeModel& model, const Motion& motion, std::span<const Vector> sets) {
  std::vector<Lanes> p(model.parameter_count());
  for (std::size_t j = 0; j < p.size(); ++j) {
    for (int k = 0; k < lane_count; ++k) p[j].set_lane(k, sets[static_cast<std::size_t>(k)][j]);
  }
  std::vector<Lanes> state(max_states);
  std::vector<Lanes> force(motion.time.size());
  model.march<Lanes>(motion, p.data(), 0, 0, force.size(), state.data(), force.data());
  std::vector<Vector> forces;
  for (int k = 0; k < lane_count; ++k) {
    Vector& own = forces.emplace_back();
    for (const Lanes& sample : force) own.push_back(sample.lane(k));
  }
  return forces;
}

// Draws of a part, the stiffest last: a pack of neighbours has about the same number of sub-steps in every lane.
std::vector<Vector> draws_by_stiffness(const Part& part, std::uint64_t seed, std::uint64_t count) {
  std::vector<Vector> draws;
  for (std::uint64_t i = 0; i < count; ++i) draws.push_back(draw(part, seed, i));
  if (const auto stiffness = part.on<double>().stiffness; stiffness != nullptr) {
    std::ranges::stable_sort(draws, {}, [&](const Vector& p) { return stiffness(p.data(), 1.0); });
  }
  return draws;
}

void expect_accurate(const Motion& motion, std::uint64_t seed, const std::string& what) {
  constexpr std::size_t draws = 64;
  static_assert(draws % lane_count == 0);
  Motion tight = motion;
  tight.step_limit = 0.02;
  for (const Part* part : model_catalogue()) {
    const CompositeModel model = law(*part);
    const std::vector<Vector> sets = draws_by_stiffness(*part, seed, draws);
    for (std::size_t first = 0; first < draws; first += lane_count) {
      const std::vector<Vector> references = simulate_pack(model, tight, std::span(sets).subspan(first, lane_count));
      for (std::size_t k = 0; k < references.size(); ++k) {
        const Vector& p = sets[first + k];
        EXPECT_LT(error_of(simulate(model, motion, p), references[k]), 1e-4)
            << part->id << ", " << what << ", at " << ::testing::PrintToString(p);
      }
    }
  }
}

TEST(March, IsAccurateAtEverySampling) {
  for (const double rate : {50.0, 100.0, 1000.0, 10000.0}) {
    // Fewer samples of the fastest recording keep the reference affordable.
    const double duration = rate > 5000.0 ? 0.4 : 1.0;
    expect_accurate(motion_of(uniform_time(rate, duration), sine), 31, "sine at " + std::to_string(rate) + " Hz");
    expect_accurate(motion_of(uniform_time(rate, duration), multisine(7)), 32,
                    "multisine at " + std::to_string(rate) + " Hz");
  }
}

TEST(March, IsAccurateOnUnevenSamples) {
  const Stream stream(41);
  Vector time = {0.0};
  for (std::uint64_t n = 0; time.back() < 1.0; ++n) {
    time.push_back(time.back() + 1e-3 + 9e-3 * stream.uniform(n));
  }
  expect_accurate(motion_of(time, sine), 42, "uneven sine");
  expect_accurate(motion_of(time, multisine(8)), 43, "uneven multisine");
}

// A share far above its default box: unloading is then up to 39 times as stiff as loading, which has larger steps.
TEST(March, IsAccurateWhereUnloadingIsStiff) {
  for (const double rate : {50.0, 200.0, 1000.0, 5000.0}) {
    for (const Motion& motion :
         {motion_of(uniform_time(rate, 0.5), sine), motion_of(uniform_time(rate, 0.5), multisine(11))}) {
      Motion tight = motion;
      tight.step_limit = 0.02;
      for (const char* id : {"bouc-wen", "modified-bouc-wen"}) {
        const Part& part = *find_model(id);
        for (std::uint64_t i = 0; i < 12; ++i) {
          Vector p = draw(part, 44, i);
          p[parameter_index(part, "share")] = 1.5 * std::pow(20.0 / 1.5, static_cast<double>(i) / 11.0);
          EXPECT_LT(error_of(simulate(law(part), motion, p), simulate(law(part), tight, p)), 1e-4)
              << id << " at " << rate << " Hz, draw " << i;
        }
      }
    }
  }
}

Vector bouc_wen(double alpha, double c0, double k0, double x_y, double share, double n) {
  const Part& part = *find_model("bouc-wen");
  Vector p(part.parameters.size(), 0.0);
  p[parameter_index(part, "alpha")] = alpha;
  p[parameter_index(part, "c0")] = c0;
  p[parameter_index(part, "k0")] = k0;
  p[parameter_index(part, "x_y")] = x_y;
  p[parameter_index(part, "share")] = share;
  p[parameter_index(part, "n")] = n;
  return p;
}

TEST(BoucWen, FollowsTheExponentialOfDisplacement) {
  // n = 1, z and v positive: dz/dx = (1 - z) / x_y, whatever the speed.
  const Motion motion = motion_of(uniform_time(1000.0, 0.12), sine);
  for (const double x_y : {1e-3, 5e-3, 2e-2}) {
    const Vector force = simulate(law(*find_model("bouc-wen")), motion, bouc_wen(800.0, 0.0, 0.0, x_y, 0.7, 1.0));
    for (std::size_t n = 0; n < force.size(); ++n) {
      EXPECT_NEAR(force[n], 800.0 * (1.0 - std::exp(-motion.x[n] / x_y)), 800.0 * 1e-4) << n;
    }
  }
}

TEST(BoucWen, NeverPassesItsYieldForce) {
  // share >= 1/2 keeps |z| <= 1; one step may pass it by its own error.
  for (const double rate : {50.0, 1000.0}) {
    const Motion motion = motion_of(uniform_time(rate, 2.0), multisine(9));
    for (const double n : {1.0, 1.5, 2.0, 4.0}) {
      for (const double x_y : {5e-5, 1e-3, 1e-2}) {
        for (const double share : {0.5, 1.0}) {
          const Vector force = simulate(law(*find_model("bouc-wen")), motion, bouc_wen(1.0, 0.0, 0.0, x_y, share, n));
          EXPECT_LE(peak(force), 1.0 + 1e-9) << rate << " " << n << " " << x_y << " " << share;
        }
      }
    }
  }
}

TEST(ModifiedBoucWen, TendsToBoucWenForAStiffSeriesDashpot) {
  const Part& part = *find_model("modified-bouc-wen");
  Vector p(part.parameters.size(), 0.0);
  p[parameter_index(part, "alpha")] = 600.0;
  p[parameter_index(part, "c0")] = 400.0;
  p[parameter_index(part, "x_y")] = 2e-3;
  p[parameter_index(part, "share")] = 0.6;
  p[parameter_index(part, "n")] = 1.5;
  const Motion motion = motion_of(uniform_time(500.0, 1.0), sine);
  const Vector limit = simulate(law(*find_model("bouc-wen")), motion, bouc_wen(600.0, 400.0, 0.0, 2e-3, 0.6, 1.5));
  double before = 1.0;
  for (const double c1 : {1e4, 1e5, 1e6}) {
    p[parameter_index(part, "c1")] = c1;
    const double error = error_of(simulate(law(part), motion, p), limit);
    EXPECT_LT(error, 0.2 * before);  // in proportion to 1 / c1
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

// A candidate has the same bits alone, among seven and fifteen others, as the value of a dual, and marched in pieces.
TEST(Batch, ACandidateDoesNotDependOnItsCompany) {
  for (const double rate : {50.0, 1000.0}) {
    const Motion motion = motion_of(uniform_time(rate, 1.0), multisine(10));
    const std::size_t samples = motion.time.size();
    for (const Part* part : model_catalogue()) {
      const CompositeModel model = law(*part);
      for (std::uint64_t batch = 0; batch < 3; ++batch) {
        std::vector<Vector> candidates;
        std::vector<Lanes> p(part->parameters.size());
        for (int k = 0; k < lane_count; ++k) {
          candidates.push_back(draw(*part, 51, batch * lane_count + static_cast<std::uint64_t>(k)));
          for (std::size_t j = 0; j < p.size(); ++j) {
            if (part->parameters[j].name == "n" && k < 3) {
              candidates.back()[j] = 1.0 + 0.5 * k;  // neighbours on different branches of power_law
            }
            p[j].set_lane(k, candidates.back()[j]);
          }
        }
        std::vector<LaneDual> dual_p;
        for (std::size_t j = 0; j < p.size(); ++j) {
          dual_p.emplace_back(p[j]);
          if (j < sweep_directions) {
            dual_p.back().d[j] = Lanes(1.0);
          }
        }
        std::vector<Lanes> state(max_states);
        std::vector<Lanes> force(samples);
        model.march<Lanes>(motion, p.data(), 0, 0, samples, state.data(), force.data());
        std::vector<Lanes> piece_state(max_states);
        std::vector<Lanes> pieces(samples);
        for (std::size_t begin = 0; begin < samples; begin += 13) {
          model.march<Lanes>(motion, p.data(), 0, begin, std::min(begin + 13, samples), piece_state.data(),
                             pieces.data() + begin);
        }
        // Beside a pack of others, which has them the other way round.
        std::vector<WideLanes> wide_p(p.size());
        for (std::size_t j = 0; j < p.size(); ++j) {
          for (int k = 0; k < lane_count; ++k) {
            wide_p[j].set_lane(k, p[j].lane(k));
            wide_p[j].set_lane(wide_lane_count - 1 - k, p[j].lane(k));
          }
        }
        std::vector<WideLanes> wide_state(max_states);
        std::vector<WideLanes> wide_force(samples);
        if (model.has_wide_march()) {
          model.march<WideLanes>(motion, wide_p.data(), 0, 0, samples, wide_state.data(), wide_force.data());
        }
        std::vector<LaneDual> dual_state(max_states);
        std::vector<LaneDual> dual_force(samples);
        model.march<LaneDual>(motion, dual_p.data(), 0, 0, samples, dual_state.data(), dual_force.data());
        for (int k = 0; k < lane_count; ++k) {
          const std::vector<int> wide_lanes =
              model.has_wide_march() ? std::vector<int>{k, wide_lane_count - 1 - k} : std::vector<int>{};
          const Vector alone = simulate(model, motion, candidates[static_cast<std::size_t>(k)]);
          for (std::size_t n = 0; n < samples; ++n) {
            const auto bits = std::bit_cast<std::uint64_t>(alone[n]);
            ASSERT_EQ(std::bit_cast<std::uint64_t>(force[n].lane(k)), bits) << part->id << " " << k << " " << n;
            ASSERT_EQ(std::bit_cast<std::uint64_t>(pieces[n].lane(k)), bits) << part->id << " " << k << " " << n;
            for (const int lane : wide_lanes) {
              ASSERT_EQ(std::bit_cast<std::uint64_t>(wide_force[n].lane(lane)), bits)
                  << part->id << " " << lane << " " << n;
            }
            ASSERT_EQ(std::bit_cast<std::uint64_t>(dual_force[n].v.lane(k)), bits) << part->id << " " << k << " " << n;
          }
        }
      }
    }
  }
}

TEST(Batch, ANeighbourWithNanDoesNotStopTheOthers) {
  const Motion motion = motion_of(uniform_time(50.0, 1.0), sine);
  const Part& part = *find_model("bouc-wen");
  const Vector good = bouc_wen(500.0, 100.0, 0.0, 1e-3, 0.5, 1.5);
  std::vector<Lanes> p(good.begin(), good.end());
  p[parameter_index(part, "x_y")].set_lane(0, std::numeric_limits<double>::quiet_NaN());
  std::vector<Lanes> state(max_states);
  std::vector<Lanes> force(motion.time.size());
  law(part).march<Lanes>(motion, p.data(), 0, 0, motion.time.size(), state.data(), force.data());
  const Vector alone = simulate(law(part), motion, good);
  for (std::size_t n = 0; n < alone.size(); ++n) {
    EXPECT_EQ(force[n].lane(5), alone[n]) << n;
  }
}

// Force at `rate` Hz while yield force and damping swing by 80 % of themselves at 3 Hz.
Vector force_of_swinging_parameters(const CompositeModel& model, double rate) {
  const Vector time = uniform_time(rate, 1.0);
  Motion motion = motion_of(time, sine);
  motion = make_motion(motion.time, motion.x, motion.v, {}, 1e-9);
  const std::vector<Parameter> cards = model.parameters();
  Vector all;
  for (const double t : time) {
    for (const Parameter& card : cards) {
      const bool swings = card.name == "alpha" || card.name == "c0";
      const double initial = card.name == "C" ? 1e-6 : card.initial;
      all.push_back(initial * (swings ? 1.0 + 0.8 * std::sin(6.0 * std::numbers::pi * t) : 1.0));
    }
  }
  Vector force(time.size());
  Vector state(max_states, 0.0);
  model.march<double>(motion, all.data(), cards.size(), 0, time.size(), state.data(), force.data());
  return force;
}

TEST(March, ParametersThatVaryAreOfSecondOrder) {
  for (const CompositeModel& model : {make_model("modified-bouc-wen", {}), make_model("bouc-wen", {"compliance"})}) {
    constexpr double rate = 200.0;
    constexpr std::size_t finer = 32;
    const Vector exact = force_of_swinging_parameters(model, rate * finer);
    const auto error = [&](std::size_t part) {
      const Vector force = force_of_swinging_parameters(model, rate * static_cast<double>(part));
      double sum = 0.0;
      for (std::size_t n = 0; n * part < force.size(); ++n) {
        sum += std::pow(force[n * part] - exact[n * finer], 2.0);
      }
      return std::sqrt(sum);
    };
    EXPECT_GT(error(1) / error(2), 3.0) << model.law->id;
    EXPECT_GT(error(2) / error(4), 3.0) << model.law->id;
    EXPECT_LT(error(4), 2e-3 * peak(exact) * std::sqrt(static_cast<double>(exact.size()) / finer)) << model.law->id;
  }
}

}  // namespace
}  // namespace hysteron
