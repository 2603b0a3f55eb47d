#include "io/plausible.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/channel_faults.hpp"
#include "io/csv.hpp"

namespace hysteron {
namespace {

// What is remarked of 2 Hz, 10 mm, 800 N recorded in units whose factors to SI are given; header as the file has it.
std::vector<std::string> remarks(const std::string& header, double x_unit, double force_unit, double v_unit = 0.0,
                                 double t_unit = 1.0) {
  std::string text = header + "\n";
  for (int n = 0; n < 200; ++n) {
    const double t = 0.005 * n;
    const double phase = 4.0 * std::numbers::pi * t;
    const double v = 0.01 * 4.0 * std::numbers::pi * std::cos(phase);
    text += std::to_string(t / t_unit) + "," + std::to_string(0.01 * std::sin(phase) / x_unit) + "," +
            std::to_string(800.0 * std::tanh(20.0 * v) / force_unit);
    text += v_unit != 0.0 ? "," + std::to_string(v / v_unit) + "\n" : "\n";
  }
  std::vector<std::string> result;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { result.push_back(remark.text.plain()); };
  (void)parse_csv(text, "a.csv", options);
  return result;
}

void expect_one(const std::vector<std::string>& said, const std::string& beginning) {
  ASSERT_EQ(said.size(), 1U) << beginning;
  EXPECT_TRUE(said[0].starts_with(beginning)) << said[0];
}

TEST(Plausible, NothingIsSaidOfADamper) {
  EXPECT_TRUE(remarks("time [s],displacement [mm],force [N]", 1e-3, 1.0).empty());
  EXPECT_TRUE(remarks("time [ms],displacement [in],force [lbf],velocity [mm/s]", 0.0254, 4.448, 1e-3, 1e-3).empty());
  EXPECT_TRUE(remarks("time,displacement,force", 1.0, 1.0).empty());
}

TEST(Plausible, MillimetresWithoutAUnitAreNotMetresWithoutAWord) {
  expect_one(remarks("time,displacement,force", 1e-3, 1.0),
             "displacement has no unit and was taken in m: a stroke of 20 m is not of a damper's size");
}

TEST(Plausible, KilonewtonsWithoutAUnit) {
  expect_one(remarks("time,displacement [mm],force", 1e-3, 1e3),
             "force has no unit and was taken in N: a force of 0.79 N");
}

TEST(Plausible, MillisecondsWithoutAUnit) {
  expect_one(remarks("time,displacement [mm],force [N]", 1e-3, 1.0, 0.0, 1e-3), "time has no unit and was taken in s");
}

TEST(Plausible, AForceOfTheOtherSign) {
  expect_one(remarks("time [s],displacement [mm],force [N]", 1e-3, -1.0),
             "the force falls as the velocity grows, as if the damper drove the rig");
  EXPECT_TRUE(remarks("time [s],displacement [mm],force [N]", -1e-3, -1.0).empty()) << "both reversed are one damper";
}

// A preload or a spring is no damper that drives its rig, also where the motion does not come back.
TEST(Plausible, ASpringHasNoWrongSign) {
  for (const double stiffness : {-4e4, 4e4}) {
    std::string text = "time [s],displacement [mm],force [N]\n";
    for (int n = 0; n < 200; ++n) {
      const double x = 20.0 * std::sin(0.005 * n);
      text += std::to_string(0.005 * n) + "," + std::to_string(x) + "," + std::to_string(1e-3 * stiffness * x) + "\n";
    }
    std::vector<std::string> said;
    ReadOptions options;
    options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
    (void)parse_csv(text, "a.csv", options);
    EXPECT_TRUE(said.empty()) << said[0];
  }
}

TEST(Plausible, AGapInTime) {
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  const auto read = [&](double gap) {
    std::string text = "time [s],displacement [mm],force [N]\n";
    for (int n = 0; n < 400; ++n) {
      const double t = 0.005 * n + (n < 260 ? 0.0 : gap);
      text += std::to_string(t) + "," + std::to_string(10.0 * std::sin(12.0 * t)) + "," +
              std::to_string(800.0 * std::cos(12.0 * t)) + "\n";
    }
    (void)parse_csv(text, "a.csv", options);
  };
  read(0.045);
  EXPECT_TRUE(said.empty()) << said[0];
  read(0.75);
  expect_one(said,
             "no samples for 0.755 s from 1.295 s on, 151 times the usual spacing: the motion in between is taken");
}

// What is remarked of a force that is made of the one that a damper has at 12 rad/s.
std::vector<std::string> remarks_on(const std::function<double(int sample, double force)>& force) {
  std::string text = "time [s],displacement [mm],force [N]\n";
  for (int n = 0; n < 400; ++n) {
    const double phase = 12.0 * 0.005 * n;
    text += std::to_string(0.005 * n) + "," + std::to_string(10.0 * std::sin(phase)) + "," +
            std::to_string(force(n, 800.0 * std::cos(phase))) + "\n";
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  (void)parse_csv(text, "a.csv", options);
  return said;
}

TEST(Plausible, SamplesThatStandOutAlone) {
  expect_one(
      remarks_on([](int n, double force) { return n == 100 || n == 301 ? 1e5 : force; }),
      "a force of 1e+05 N at 1.505 s where its neighbours tell 563 N, 2 samples like that: outliers weigh on a fit");
  // Two side by side, and one at either end, of a chain that starts or stops.
  expect_one(remarks_on([](int n, double force) { return n == 100 || n == 101 ? 5000.0 : force; }),
             "a force of 5e+03 N at 0.5 s where its neighbours tell 789 N, 2 samples");
  expect_one(remarks_on([](int n, double force) { return n == 0 || n == 399 ? -5000.0 : force; }),
             "a force of -5e+03 N at 0 s where its neighbours tell ");
  // What stands out by less than the force spans is the noise of a chain, which a diagnosis replaces.
  EXPECT_TRUE(remarks_on([](int n, double force) { return n == 100 ? force + 300.0 : force; }).empty());
  // A stop that the rod runs into is no outlier.
  EXPECT_TRUE(remarks_on([](int n, double force) { return n % 100 < 4 ? 5000.0 + n % 7 : force; }).empty());
}

// It makes the error look small, as the largest force is that of no sample.
TEST(Plausible, ANumberThatStandsForMissingSamples) {
  for (const int count : {3, 5, 10}) {
    expect_one(remarks_on([&](int n, double force) { return n >= 100 && n < 100 + count ? -9999.0 : force; }),
               "the force is exactly -9999 N in " + std::to_string(count) +
                   " samples, first at 0.5 s, and all others are from -800 to 800 N");
  }
  // At the end of a file, and again and again.
  expect_one(remarks_on([](int n, double force) { return n >= 390 || n % 50 == 3 ? 99999.0 : force; }),
             "the force is exactly 99999 N in 18 samples");
  // The crest of a force in steps, and one that is cut off.
  for (const double step : {50.0, 400.0}) {
    for (const std::string& said : remarks_on([&](int, double force) { return step * std::round(force / step); })) {
      EXPECT_EQ(said.find("is exactly"), std::string::npos) << said;
    }
  }
}

TEST(Plausible, ABaseWithoutAUnit) {
  const auto said_of = [](const std::string& base, double stroke, double frequency) {
    std::string text = "time [s],displacement [mm]," + base + "\n";
    for (int n = 0; n < 400; ++n) {
      const double t = 0.05 * n / frequency / 4.0;
      text += std::to_string(t) + "," + std::to_string(10.0 * std::sin(12.0 * frequency * t)) + "," +
              std::to_string(0.5 * stroke * std::sin(12.0 * frequency * t)) + "\n";
    }
    std::vector<std::string> said;
    ReadOptions options;
    options.force_required = false;
    options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
    (void)parse_csv(text, "a.csv", options);
    return said;
  };
  // As of 3 mm, and of 0.8 mm at 20 times that frequency.
  expect_one(said_of("base", 3.0, 1.0),
             "base has no unit and was taken in m: a stroke of 3 m is not of a damper's size; give the unit, as in "
             "column base=\"base [UNIT]\"");
  expect_one(said_of("base", 0.8, 4.0),
             "base has no unit and was taken in m: a speed of 19.2 m/s, from base and time, is not of a damper's size");
  EXPECT_TRUE(said_of("base", 0.8, 1.0).empty());
  EXPECT_TRUE(said_of("base [m]", 3.0, 1.0).empty());
}

TEST(Plausible, ADisplacementWithoutAUnitIsFast) {
  std::string text = "time [s],displacement,force [N]\n";
  for (int n = 0; n < 400; ++n) {
    const double phase = 62.8 * 0.0025 * n;
    text += std::to_string(0.0025 * n) + "," + std::to_string(0.4 * std::sin(phase)) + "," +
            std::to_string(3e3 * std::cos(phase)) + "\n";
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  (void)parse_csv(text, "a.csv", options);
  ASSERT_FALSE(said.empty());
  EXPECT_TRUE(said[0].starts_with("displacement has no unit and was taken in m: a speed of 25")) << said[0];
}

TEST(Plausible, AForceThatSaturates) {
  // acos(3/4) (1 + 3 * 2) of 24 rad.
  expect_one(remarks_on([](int, double force) { return std::min(force, 600.0); }),
             "the force stays at exactly 600 N, an end of its range, for 21 % of the samples");
  expect_one(remarks_on([](int, double force) { return std::max(force, -600.0); }),
             "the force stays at exactly -600 N");
}

// Samples of a force of the phase, 200 a period, some noise on them, as a converter of `step` gives them.
std::vector<double> sampled(int samples, const std::function<double(double phase)>& force, double noise, double step) {
  const Stream stream(5);
  std::vector<double> values;
  for (int n = 0; n < samples; ++n) {
    const double value =
        force(0.01 * std::numbers::pi * n + 0.3) + noise * stream.normal(static_cast<std::uint64_t>(n));
    values.push_back(step * std::round(value / step));
  }
  return values;
}

TEST(Plausible, AForceThatIsCutFarBelowItsPeak) {
  const auto damper = [](double phase) { return 620.0 * std::tanh(3.0 * std::cos(phase)); };
  for (const int samples : {600, 1000, 2000, 6000}) {
    for (const double step : {1e-6, 1.0, 5.0}) {
      std::vector<double> force = sampled(samples, damper, 6.0, step);
      EXPECT_FALSE(flat_end_of(force).has_value()) << samples << " " << step;
      for (double& value : force) value = std::clamp(value, -400.0, 400.0);
      EXPECT_TRUE(flat_end_of(force).has_value()) << samples << " " << step;
    }
  }
}

// A force that is proportional to the motion since a reversal and rests at the yield force then.
TEST(Plausible, AFrictionAtRestAtItsYieldForceIsNoSaturation) {
  for (const int samples : {400, 600, 1000}) {
    for (const double stiffness : {1000.0, 2000.0, 8000.0, 40000.0}) {
      for (const double step : {1e-9, 0.01, 1.0, 10.0}) {
        double force = 0.0;
        double before = 0.0;
        const auto friction = [&](double phase) {
          const double x = std::sin(phase);
          force = std::clamp(force + stiffness * (x - before), -400.0, 400.0);
          before = x;
          return force;
        };
        EXPECT_FALSE(flat_end_of(sampled(samples, friction, 0.0, step)).has_value())
            << samples << " " << stiffness << " " << step;
      }
    }
  }
}

TEST(Plausible, AFewStepsOfAConverterAreNoSaturation) {
  for (const int samples : {400, 1000, 2000, 6000}) {
    for (const double step : {10.0, 40.0, 100.0}) {
      for (const double sharpness : {0.1, 20.0, 200.0}) {
        const auto force = [&](double phase) {
          return 620.0 * std::tanh(sharpness * std::cos(phase)) / std::tanh(sharpness);
        };
        EXPECT_FALSE(flat_end_of(sampled(samples, force, 2.0, step)).has_value())
            << samples << " " << step << " " << sharpness;
      }
    }
  }
}

TEST(Plausible, AForceThatWasOff) {
  expect_one(remarks_on([](int n, double force) { return n < 300 ? force : 0.0; }),
             "the force is exactly 0 from 1.5 to 1.995 s, 100 samples");
  EXPECT_TRUE(remarks_on([](int n, double force) { return n < 395 ? force : 0.0; }).empty());
}

// What is remarked of a displacement and a force made of the phase, 400 samples over 24 rad.
std::vector<std::string> remarks_on_both(const std::function<double(int sample, double phase)>& displacement,
                                         const std::function<double(int sample, double phase)>& force,
                                         const std::string& drive = "") {
  std::string text = "time [s],displacement [mm],force [N]" + std::string(drive.empty() ? "" : ",current [A]") + "\n";
  for (int n = 0; n < 400; ++n) {
    const double phase = 12.0 * 0.005 * n;
    text += std::to_string(0.005 * n) + "," + std::to_string(displacement(n, phase)) + "," +
            std::to_string(force(n, phase)) +
            (drive.empty() ? ""
             : n % 40 < 20 ? "," + drive
                           : ",0") +
            "\n";
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  (void)parse_csv(text, "a.csv", options);
  return said;
}
double sine(int /*sample*/, double phase) { return 10.0 * std::sin(phase); }
double viscous(int /*sample*/, double phase) { return 800.0 * std::cos(phase); }
double friction(int /*sample*/, double phase) { return std::cos(phase) > 0.0 ? 500.0 : -500.0; }

// Where a file begins and ends no sample tells from the other side.
TEST(Plausible, AForceThatBeginsLate) {
  expect_one(remarks_on([](int n, double force) { return n < 20 ? 0.0 : force; }),
             "the force is exactly 0 in the first 20 samples, until 0.095 s, while the rod moves, and then 289.9 N at "
             "once: a channel that was switched on late looks so; cut them");
  expect_one(remarks_on([](int n, double force) { return n >= 370 ? 0.0 : force; }),
             "the force is exactly 0 in the last 30 samples, from 1.85 s, while the rod moves, and before that ");
  // A play, which is crossed again and again, and one from which the force rises without a jump.
  EXPECT_TRUE(remarks_on([](int, double force) { return std::fabs(force) < 400.0 ? 0.0 : force; }).empty());
  EXPECT_TRUE(
      remarks_on([](int n, double force) { return n < 20 ? 0.0 : force * std::min(1.0, 0.02 * (n - 19)); }).empty());
}

// Dampers have their largest force anywhere, and a friction begins with a jump; beyond all others is another thing.
TEST(Plausible, AForceThatBeginsBeyondAllOthers) {
  expect_one(remarks_on([](int n, double force) { return n == 0 ? 1300.0 : force; }),
             "the force is 1300 N in the first sample, at 0 s, and the samples behind it tell 802.9 N");
  EXPECT_TRUE(remarks_on([](int n, double force) { return n == 0 ? 0.0 : force; }).empty());
}

TEST(Plausible, AForceThatFroze) {
  const auto frozen = [](int n, double phase) { return viscous(n, n < 250 ? phase : 15.0); };
  expect_one(remarks_on_both(sine, frozen),
             "the force stays at exactly -607.8 N from 1.25 to 1.995 s while the motion goes on: a channel that froze");
  expect_one(remarks_on_both(sine, [](int, double) { return 37.0; }), "the force is 37 N throughout and the motion");
  EXPECT_TRUE(remarks_on_both(sine, friction).empty()) << "it yields";
  // Of a play in which nothing is felt.
  EXPECT_TRUE(remarks_on_both(sine, [](int n, double phase) {
                return std::fabs(std::sin(phase)) > 0.9 ? viscous(n, phase) + 4000.0 * std::sin(phase) : 0.0;
              }).empty());
}

TEST(Plausible, ADisplacementThatFroze) {
  const auto frozen = [](int n, double phase) { return sine(n, n < 250 ? phase : 15.0); };
  for (const auto& force : {viscous, friction}) {
    const auto said = remarks_on_both(frozen, force);
    ASSERT_FALSE(said.empty());
    EXPECT_TRUE(
        said[0].starts_with("the displacement stays at exactly 6.503 mm from 1.25 to 1.995 s while the force "
                            "goes on: a channel that froze"))
        << said[0];
  }
  expect_one(remarks_on_both([](int, double) { return 3.0; }, viscous), "the displacement is 3 mm throughout and the");
  EXPECT_TRUE(
      remarks_on_both([](int, double) { return 3.0; }, [](int n, double) { return n % 40 < 20 ? 700.0 : 90.0; }, "2")
          .empty())
      << "a current that is switched";
}

TEST(Plausible, ADisplacementThatSaturates) {
  const auto cut = [](int n, double phase) { return std::clamp(sine(n, phase), -9.0, 9.0); };
  for (const auto& force : {viscous, friction}) {
    expect_one(remarks_on_both(cut, force), "the displacement stays at exactly ");
  }
  // A motion that rests at its ends: the force stays, drops or relaxes.
  const auto trapezoid = [](int, double phase) {
    return std::clamp(20.0 * std::asin(std::sin(phase)) / std::numbers::pi, -6.0, 6.0);
  };
  const auto moves = [](double phase) { return std::fabs(std::asin(std::sin(phase))) < 0.3 * std::numbers::pi; };
  EXPECT_TRUE(
      remarks_on_both(trapezoid, [&](int n, double phase) { return moves(phase) ? friction(n, phase) : 0.0; }).empty());
  const auto relaxing = remarks_on_both(trapezoid, [&](int, double phase) {
    // Since the rest began.
    const double rest = std::fmod(phase + 0.2 * std::numbers::pi, std::numbers::pi);
    const double sign = std::sin(phase) > 0.0 ? 1.0 : -1.0;
    const double towards = std::cos(phase) > 0.0 ? 1.0 : -1.0;
    return moves(phase) ? (500.0 + 20.0 * std::cos(phase)) * towards
                        : 500.0 * sign * std::exp(-3.0 * (rest - 0.5 * std::numbers::pi));
  });
  EXPECT_TRUE(relaxing.empty()) << relaxing.front();
}

// A converter of few steps holds its crest for several samples too.
TEST(Plausible, CoarseStepsAreNoSaturation) {
  for (const double step : {1.0, 10.0, 40.0, 100.0, 160.0, 170.0, 300.0}) {
    const auto said = remarks_on([&](int, double force) { return step * std::round(force / step); });
    EXPECT_TRUE(said.empty()) << step << ": " << said[0];
    const auto friction =
        remarks_on([&](int, double force) { return step * std::round(800.0 * std::tanh(0.02 * force) / step); });
    EXPECT_TRUE(friction.empty()) << step << ": " << friction[0];
  }
}

TEST(Plausible, AWrongUnit) {
  expect_one(remarks("time [s],displacement [m],force [N]", 1e-3, 1.0),
             "a stroke of 20 m is not of a damper's size: check the unit of column 'displacement [m]'");
  expect_one(remarks("time [s],displacement [mm],force [mN]", 1e-3, 1e3), "a force of 0.00079 N");
}

TEST(Plausible, AVelocityThatIsNotTheSlope) {
  expect_one(remarks("time [s],displacement [mm],force [N],velocity [m/s]", 1e-3, 1.0, 0.1),
             "the velocity is 10 times the slope of the displacement");
  expect_one(remarks("time [s],displacement [mm],force [N],velocity [m/s]", 1e-3, 1.0, 0.8),
             "the velocity is 1.25 times the slope of the displacement");
  EXPECT_TRUE(remarks("time [s],displacement [mm],force [N],velocity [m/s]", 1e-3, 1.0, 0.95).empty());
  expect_one(remarks("time [s],displacement [mm],force [N],velocity [m/s]", 1e-3, 1.0, -1.0),
             "the velocity runs against the displacement");
}

// Of a column that a damper is set to; 400 samples.
std::vector<std::string> remarks_on_setting(const std::string& column, const std::vector<std::string>& followed,
                                            const std::function<double(int sample)>& setting) {
  std::string text = "time [s],displacement [mm],force [N]," + column + "\n";
  for (int n = 0; n < 400; ++n) {
    const double phase = 0.06 * n;
    text += std::to_string(0.005 * n) + "," + std::to_string(10.0 * std::sin(phase)) + "," +
            std::to_string(400.0 * std::cos(phase)) + "," + std::to_string(setting(n)) + "\n";
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.conditions = followed;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  (void)parse_csv(text, "a.csv", options);
  return said;
}

TEST(Plausible, ANumberThatStandsForMissingSamplesOfASetting) {
  expect_one(remarks_on_setting("pressure [bar]", {"pressure"}, [](int n) { return n < 6 ? -9999.0 : 3.0; }),
             "column 'pressure [bar]' is exactly -9999 in 6 samples, first at 0 s, and all others are 3: a number");
  expect_one(remarks_on_setting("valve [%]", {"valve"}, [](int n) { return n == 50   ? 99999.0
                                                                           : n < 200 ? 0.0
                                                                                     : 40.0; }),
             "column 'valve [%]' is exactly 99999 in 1 sample, first at 0.25 s, and all others are from 0 to 40");
  expect_one(remarks_on_setting("temperature [degC]", {"temperature"}, [](int n) { return n < 20 ? -99.0 : 50.0; }),
             "column 'temperature [degC]' is exactly -99 in 20 samples");
  // Levels of a valve, and of a heater that begins cold.
  EXPECT_TRUE(remarks_on_setting("valve [%]", {"valve"}, [](int n) { return n < 20 ? 99.0 : 0.0; }).empty());
  EXPECT_TRUE(remarks_on_setting("speed of fan [rpm]", {"speed of fan"}, [](int n) {
                return n < 20 ? -999.0 : n < 200 ? 999.0 : 0.0;
              }).empty());
}

TEST(Plausible, ADriveThatStrays) {
  expect_one(remarks_on_setting("current [A]", {}, [](int n) { return n == 140 ? 30.0 : 2.0; }),
             "column 'current [A]' is 30 at 0.7 s where its neighbours tell 2, 1 sample like that");
  // The first sample and the last.
  for (const int end : {0, 399}) {
    expect_one(remarks_on_setting("current [A]", {}, [&](int n) { return n == end ? 30.0 : 2.0; }),
               end == 0 ? "column 'current [A]' is 30 at 0 s where its neighbours tell 2, 1 sample like that"
                        : "column 'current [A]' is 30 at 1.995 s where its neighbours tell 2, 1 sample like that");
  }
  // Switched, late by a sample, in steps of a converter, off.
  EXPECT_TRUE(
      remarks_on_setting("current [A]", {}, [](int n) { return n / 20 % 2 == 0 || n == 70 ? 2.0 : 0.0; }).empty());
  EXPECT_TRUE(remarks_on_setting("current [A]", {}, [](int n) { return n == 0 ? 0.0 : 2.0; }).empty());
  EXPECT_TRUE(remarks_on_setting("current [A]", {}, [](int n) { return n % 90 == 8 ? 2.02 : 2.0; }).empty());
  EXPECT_TRUE(remarks_on_setting("current [A]", {}, [](int n) { return n == 140 ? 0.01 : 0.0; }).empty());
}

}  // namespace
}  // namespace hysteron
