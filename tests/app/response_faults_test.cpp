// What `fit --response` and `respond` say of recordings of a mass that are not what they are taken for.
// Every test runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"
#include "core/random.hpp"

namespace hysteron {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

// A mass of 50 kg on a spring of 20 kN/m and a damper of 300 N s/m.
class FaultsOfAResponse : public Program {
 protected:
  static constexpr double slower = 3.0;                // 1/s
  static constexpr double omega = 19.773719933284986;  // rad/s, sqrt(400 - 9)
  static constexpr int rate = 500;                     // Hz

  struct Sample {
    double x;  // m
    double v;  // m/s
    double a;  // m/s^2
  };
  static Sample decay(double from, double t) {
    const double left = from * std::exp(-slower * t);
    const double c = std::cos(omega * t);
    const double s = std::sin(omega * t);
    const double square = omega * omega + slower * slower;
    return {left * (c + slower / omega * s), -left * square / omega * s, -left * square * (c - slower / omega * s)};
  }
  // Under the base, steady: that of 2 mm and 9 rad/s, and what it makes of the mass relative to it.
  static constexpr double shaking = 9.0;
  static constexpr double base = 0.002;
  static Sample shaken(double t) {
    // (k - m w^2 + i c w) y = m w^2 b
    const double real = 20000.0 - 50.0 * shaking * shaking;
    const double imaginary = 300.0 * shaking;
    const double size = 50.0 * shaking * shaking * base / std::hypot(real, imaginary);
    const double phase = shaking * t - std::atan2(imaginary, real);
    return {size * std::sin(phase), size * shaking * std::cos(phase), -size * shaking * shaking * std::sin(phase)};
  }

  // Two recordings of 3 s under this header: `row` writes a sample by its recording, its number and its time.
  void record(const std::string& head, int samples, const std::function<std::string(int, int, double)>& row) const {
    for (const int one : {0, 1}) {
      std::string text = head + "\n";
      for (int n = 0; n < samples; ++n) {
        const double t = static_cast<double>(n) / rate;
        text += fmt::format("{},{}\n", t, row(one, n, t));
      }
      write(folder_ / fmt::format("mass/r{}.csv", one), text);
    }
  }
  static double noise(int one, int n) {
    return 1e-6 * Stream(3).child(std::to_string(one)).normal(static_cast<std::size_t>(n));
  }

  [[nodiscard]] Outcome fitted(const std::string& mass = "50", const std::string& budget = "100") const {
    return run({"fit", "mass", "--response", "--mass", mass, "--stiffness", "20000", "--model", "viscous", "--solver",
                "lm", "--budget", budget, "--quiet", "--out", "out"});
  }
  // Of what is said before anything is searched.
  [[nodiscard]] Outcome hardly_fitted() const { return fitted("50", "10"); }
  [[nodiscard]] double damping() const {
    const json model = json::parse(read(folder_ / "out/model.json"));
    for (const json& one : model.at("parameters")) {
      if (one.at("name") == "c0") return one.at("value");
    }
    return std::nan("");
  }
};

TEST_F(FaultsOfAResponse, ADecayAndAShakenMassAsTheyShouldBeAreNotRemarkedOn) {
  record("time [s],displacement [m]", 1500,
         [](int one, int n, double t) { return fmt::format("{}", decay(0.01 + 0.005 * one, t).x + noise(one, n)); });
  const Outcome free = fitted();
  EXPECT_EQ(free.status, 0);
  EXPECT_EQ(free.err, "");
  EXPECT_NEAR(damping(), 300.0, 1.0);
  record("time [s],base [m],displacement [m],acceleration [m/s^2]", 1500, [](int one, int n, double t) {
    const double size = 1.0 + 0.5 * one;
    const Sample mass = shaken(t);
    return fmt::format("{},{},{}", size * base * std::sin(shaking * t), size * mass.x + noise(one, n), size * mass.a);
  });
  EXPECT_EQ(hardly_fitted().err.find("acceleration"), std::string::npos);
}

TEST_F(FaultsOfAResponse, AMassThatIsHeldIsFittedFromItsRelease) {
  record("time [s],displacement [m]", 1600, [](int one, int n, double t) {
    return fmt::format("{}", decay(0.01 + 0.005 * one, std::max(0.0, t - 0.2)).x + noise(one, n));
  });
  const Outcome outcome = fitted();
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("warning: r0.csv: nothing moves the mass, and it stands still from 0 to 0.2"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("it was held, and the fit starts at its release, sample 10"), std::string::npos)
      << outcome.err;
  EXPECT_NEAR(damping(), 300.0, 1.0);
  // In the results as well.
  EXPECT_NE(read(folder_ / "out/fit.json").find("it was held"), std::string::npos);
}

TEST_F(FaultsOfAResponse, AnAccelerationThatIsNotRelativeToTheBaseIsLeftOut) {
  const auto with = [&](const std::function<double(double relative, double of_base)>& recorded) {
    record("time [s],base [m],displacement [m],acceleration [m/s^2]", 1500, [&](int one, int n, double t) {
      const double size = 1.0 + 0.5 * one;
      const Sample mass = shaken(t);
      const double b = size * base * std::sin(shaking * t);
      return fmt::format("{},{},{}", b, size * mass.x + noise(one, n), recorded(size * mass.a, -shaking * shaking * b));
    });
    return hardly_fitted().err;
  };
  const std::string left_out = "; the slope of the velocity is taken instead (1 more recording alike)\n";
  const std::string absolute = with([](double relative, double of_base) { return relative + of_base; });
  EXPECT_NE(
      absolute.find("the acceleration is the absolute one of the mass, expected that relative to the base" + left_out),
      std::string::npos)
      << absolute;
  const std::string of_base = with([](double, double b) { return b; });
  EXPECT_NE(of_base.find("the acceleration is that of the base, expected that of the mass relative to it" + left_out),
            std::string::npos)
      << of_base;
  const std::string reversed = with([](double relative, double) { return -relative; });
  EXPECT_NE(reversed.find("the acceleration runs against the displacement, -1 times its second derivative: check its "
                          "sign" +
                          left_out),
            std::string::npos)
      << reversed;
}

TEST_F(FaultsOfAResponse, AnAbsoluteDisplacementIsRefusedOnABase) {
  const auto row = [](int one, int n, double t) {
    const double b = base * std::sin(shaking * t);
    return fmt::format("{},{}", b, shaken(t).x + b + noise(one, n));
  };
  record("time [s],base [m],absolute displacement [m]", 1500, row);
  const Outcome outcome = fitted();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("r0.csv:1: column 'absolute displacement [m]' is not the displacement relative to "
                             "the base"),
            std::string::npos)
      << outcome.err;
  // On a base that does not move there is one displacement.
  record("time [s],absolute displacement [m]", 1500,
         [](int one, int n, double t) { return fmt::format("{}", decay(0.01, t).x + noise(one, n)); });
  EXPECT_EQ(fitted().status, 0);
}

TEST_F(FaultsOfAResponse, ForcesAndAMassThatDoNotGoWithTheMotionAreTold) {
  record("time [s],force [N],displacement [m]", 1500, [](int one, int n, double t) {
    const Sample mass = decay(0.01, t);
    return fmt::format("{},{}", 300.0 * mass.v, mass.x + noise(one, n));
  });
  const Outcome own = fitted();
  EXPECT_NE(own.err.find("the force, taken as that on the mass, is that of the damper in a free decay"),
            std::string::npos)
      << own.err;
  record("time [s],displacement [m]", 1500,
         [](int one, int n, double t) { return fmt::format("{}", decay(0.01, t).x + noise(one, n)); });
  const Outcome grams = fitted("50000");
  EXPECT_NE(grams.err.find("m x'' of a mass of 5e+04 kg is "), std::string::npos) << grams.err;
  EXPECT_NE(grams.err.find(" times what else is known to act on it: check that the mass is in kg"), std::string::npos)
      << grams.err;
}

TEST_F(FaultsOfAResponse, AMassThatIsMovedByWhatIsNotRecordedIsTold) {
  record("time [s],displacement [m]", 1500, [](int one, int n, double t) {
    return fmt::format("{}", std::min(1.0, 0.5 * t) * shaken(t).x + noise(one, n));
  });
  const Outcome outcome = fitted();
  EXPECT_NE(outcome.err.find("a free decay, with no force on the mass and no base, and yet its displacement spans "),
            std::string::npos)
      << outcome.err;
}

TEST_F(FaultsOfAResponse, AnotherZeroOfTheSensorInEachRecordingIsTold) {
  record("time [s],displacement [m]", 2000, [](int one, int n, double t) {
    return fmt::format("{}", decay(0.01, t).x + 0.025 * (one + 1) + noise(one, n));
  });
  const Outcome outcome = fitted();
  EXPECT_NE(
      outcome.err.find("warning: r1.csv: the mass comes to rest at 50 mm, and at 25 mm in r0.csv, where the model "
                       "has one place of rest: another zero of the displacement sensor looks so"),
      std::string::npos)
      << outcome.err;
}

TEST_F(FaultsOfAResponse, AMotionThatIsNotSteadyIsTold) {
  write(folder_ / "damper.json",
        R"({"schema":"hysteron.model/1","model":"viscous","effects":[],"parameters":[
        {"name":"k0","value":0,"unit":"N/m"},{"name":"c0","value":300,"unit":"N s/m"},
        {"name":"f0","value":0,"unit":"N"}]})");
  std::string text = "time [s],force [N]\n";
  for (int n = 0; n < 100; ++n) text += fmt::format("{},{}\n", 0.01 * n, 100.0 * std::sin(0.0628318530717959 * n));
  write(folder_ / "period.csv", text);
  // A decay of 3 % a period, near the resonance.
  const auto told = [&](const std::string& periods) {
    return run({"respond", "damper.json", "period.csv", "--mass", "5000", "--stiffness", "2e5", "--periods", periods,
                "--out", "motion.csv"});
  };
  const Outcome one = told("1");
  EXPECT_NE(one.err.find("the motion is not steady in one period: its start and end differ by "), std::string::npos)
      << one.err;
  const Outcome fifty = told("50");
  EXPECT_NE(fifty.err.find("the motion is not steady in the last of 50 periods: its start and end differ by "),
            std::string::npos)
      << fifty.err;
  EXPECT_NE(fifty.err.find(" off the steady one; expected about "), std::string::npos) << fifty.err;
  EXPECT_EQ(told("400").err, "");
  // The rows are those of one period all the same.
  const std::string motion = read(folder_ / "motion.csv");
  EXPECT_EQ(std::ranges::count(motion, '\n'), 101);
}

TEST_F(FaultsOfAResponse, ASolverWithoutACandidateSaysWhy) {
  const auto error = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"fit", "data", "--model", "viscous", "--quiet", "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).err;
  };
  const std::string budget = error({"--budget", "1"});
  EXPECT_NE(budget.find("cannot evaluate anything in a budget of 1, expected a larger --budget: an evaluation with "
                        "derivatives counts 4\n"),
            std::string::npos)
      << budget;
  const std::string held = error({"--budget", "300", "--fix", "f0=1e9"});
  EXPECT_NE(held.find("misses the recordings by less than 100000 times their size in "), std::string::npos) << held;
  EXPECT_NE(held.find(": check what is held\n"), std::string::npos) << held;
}

}  // namespace
}  // namespace hysteron
