// What only the recordings of a campaign side by side show, and what a model was not fitted on, is said. Every test
// runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

// A damper with friction under sines, four periods.
struct Sine {
  double amplitude = 0.02;  // m
  double frequency = 1.0;   // Hz
  double current = 0.5;     // A
  double noise = 0.0;       // N, of a generator that begins with `seed`
  unsigned seed = 1;
  int samples = 400;
  double x_unit = 1e-3;  // of the numbers written, whatever the header says
  double t_unit = 1.0;
  double force_unit = 1.0;
  int digits = 17;
};
std::string csv_of(const Sine& test) {
  std::string text = "time [s],displacement [mm],force [N],current [A]\n";
  std::uint32_t state = test.seed;
  const auto uniform = [&] {
    state = state * 1664525U + 1013904223U;
    return state / 4294967296.0 - 0.5;
  };
  const double omega = 2.0 * std::numbers::pi * test.frequency;
  for (int n = 0; n < test.samples; ++n) {
    const double t = 4.0 / test.frequency * n / test.samples;
    const double x = test.amplitude * std::sin(omega * t);
    const double v = test.amplitude * omega * std::cos(omega * t);
    const double force = 900.0 * v + 300.0 * std::tanh(50.0 * v) + test.noise * std::sqrt(12.0) * uniform();
    text += fmt::format("{:.{}g},{:.{}g},{:.{}g},{}\n", t / test.t_unit, test.digits, x / test.x_unit, test.digits,
                        force / test.force_unit, test.digits, test.current);
  }
  return text;
}

class CampaignRemarks : public Program {
 protected:
  // What is said on reading recordings called a.csv, b.csv, ...
  std::string said_of(const std::vector<std::string>& texts) const {
    fs::remove_all(folder_ / "many");
    for (std::size_t k = 0; k < texts.size(); ++k) {
      write(folder_ / "many" / (std::string(1, static_cast<char>('a' + k)) + ".csv"), texts[k]);
    }
    const Outcome outcome = run({"score", "model.json", "many"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  }
  void SetUp() override {
    Program::SetUp();
    write(folder_ / "model.json",
          R"({"schema":"hysteron.model/1","model":"viscous","parameters":[{"name":"c0","value":1200.0,"unit":"N s/m"},)"
          R"({"name":"k0","value":0.0,"unit":"N/m"},{"name":"f0","value":0.0,"unit":"N"}]})");
  }
};

TEST_F(CampaignRemarks, OneRecordingInAnotherUnit) {
  const std::vector<Sine> tests = {{.amplitude = 0.02, .frequency = 1.0},
                                   {.amplitude = 0.01, .frequency = 2.0},
                                   {.amplitude = 0.005, .frequency = 3.0},
                                   {.amplitude = 0.015, .frequency = 1.0}};
  const auto said = [&](const auto& change) {
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < tests.size(); ++k) {
      Sine test = tests[k];
      if (k == 1) change(test);
      texts.push_back(csv_of(test));
    }
    return said_of(texts);
  };
  EXPECT_EQ(said([](Sine&) {}), "");
  EXPECT_EQ(said([](Sine& test) { test.x_unit = 1.0; }),
            "warning: b.csv: a stroke of 0.02 mm, and 10 to 40 mm in the other recordings, a factor of a thousand: "
            "check the unit of the displacement\n");
  EXPECT_NE(
      said([](Sine& test) { test.t_unit = 1e-3; })
          .find("warning: b.csv: a main frequency of 0.002 Hz, and 1 to 3 Hz in the other recordings, a factor of a "
                "thousand: check the unit of the time\n"),
      std::string::npos);
  EXPECT_NE(said([](Sine& test) { test.force_unit = 1e3; })
                .find("warning: b.csv: a force of 0.413 N, and 385 to 413 N in the other recordings, a factor of a "
                      "thousand: check the unit of the force\n"),
            std::string::npos)
      << said([](Sine& test) { test.force_unit = 1e3; });
  // Slow and small tests are what they are.
  EXPECT_EQ(said([](Sine& test) { test.frequency = 0.02; }), "");
  EXPECT_EQ(said([](Sine& test) { test.amplitude = 0.0003; }), "");
}

TEST_F(CampaignRemarks, NearCopiesAreTold) {
  const Sine first{.noise = 5.0, .seed = 7};
  Sine rounded = first;
  rounded.digits = 4;
  const auto told = [](const std::string& said) {
    return said.starts_with("warning: b.csv: differs from a.csv by ") &&
           said.find(" as a copy does: neither is held out from the other\n") != std::string::npos;
  };
  EXPECT_TRUE(told(said_of({csv_of(first), csv_of(rounded)})));
  // Noise beside that of the recording.
  Sine noisy = first;
  noisy.noise = 7.0;
  EXPECT_TRUE(told(said_of({csv_of(first), csv_of(noisy)}))) << "the same draws, two fifths larger";
  // The same test made twice, and the same motion at another current.
  Sine again = first;
  again.seed = 8;
  EXPECT_EQ(said_of({csv_of(first), csv_of(again)}), "");
  std::string other = csv_of(first);
  Sine stronger = first;
  stronger.force_unit = 0.5;
  EXPECT_EQ(said_of({other, csv_of(stronger)}), "");
}

TEST_F(CampaignRemarks, FewSamplesAPeriodAreTold) {
  EXPECT_EQ(said_of({csv_of({.samples = 80})}), "");
  EXPECT_EQ(
      said_of({csv_of({.samples = 40})}),
      "warning: a.csv: 10.0 samples a period of its main frequency, 1 Hz: what happens at a reversal lies between "
      "them, and parameters may be off by a third; record 50 or more a period\n");
}

TEST_F(CampaignRemarks, AModelUsedBeyondItsMotionIsTold) {
  write(folder_ / "fitted_on.csv", csv_of({}));
  ASSERT_EQ(run({"fit", "fitted_on.csv", "--model", "viscous", "--budget", "100", "--quiet", "--out", "f"}).status, 0);
  const json over = json::parse(read(folder_ / "f/model.json")).at("fitted_over");
  EXPECT_NEAR(over.at("displacement_m").at(1), 0.02, 1e-6);
  EXPECT_NEAR(over.at("velocity_m_s").at(0), -0.1257, 1e-3);
  EXPECT_EQ(over.at("current_a"), json({0.5, 0.5}));
  write(folder_ / "near.csv", csv_of({.amplitude = 0.022}));
  write(folder_ / "wide.csv", csv_of({.amplitude = 0.05, .frequency = 0.4}));
  write(folder_ / "fast.csv", csv_of({.frequency = 3.0}));
  write(folder_ / "strong.csv", csv_of({.current = 2.0}));
  const std::string wide =
      "warning: wide.csv: a displacement of 50 mm, and f/model.json was fitted from -20 to 20 mm: what it says beyond "
      "is "
      "a guess\n";
  EXPECT_EQ(run({"score", "f/model.json", "near.csv"}).err, "");
  EXPECT_EQ(run({"score", "f/model.json", "wide.csv"}).err, wide);
  EXPECT_EQ(run({"simulate", "f/model.json", "wide.csv", "--out", "s.csv"}).err, wide);
  // By its label.
  EXPECT_EQ(run({"compare", "f/model.json", "wide.csv", "--quiet", "--out", "c"}).err,
            "warning: wide.csv: a displacement of 50 mm, and viscous was fitted from -20 to 20 mm: what it says beyond "
            "is a guess\n");
  const std::string fast = run({"score", "f/model.json", "fast.csv"}).err;
  EXPECT_TRUE(fast.starts_with("warning: fast.csv: a velocity of ")) << fast;
  EXPECT_NE(fast.find(" m/s, and f/model.json was fitted from -0.126 to 0.126 m/s: what it says"), std::string::npos)
      << fast;
  EXPECT_EQ(run({"score", "f/model.json", "strong.csv"}).err,
            "warning: strong.csv: a current of 2 A, and f/model.json was fitted at 0.5 A: what it says beyond is a "
            "guess\n");
  // The motion that was worked out.
  write(
      folder_ / "push.csv", "time [s],force [N],current [A]\n" + [] {
        std::string text;
        for (int n = 0; n < 400; ++n) text += fmt::format("{},{},0.5\n", 0.01 * n, 2000.0 * std::sin(2.0 * 0.01 * n));
        return text;
      }());
  const std::string pushed = run({"respond", "f/model.json", "push.csv", "--mass", "1", "--out", "r.csv"}).err;
  EXPECT_TRUE(pushed.starts_with("warning: push.csv: a displacement of ")) << pushed;
  // A model that does not say what it was fitted on.
  EXPECT_EQ(run({"score", "model.json", "wide.csv"}).err, "");
}

}  // namespace
}  // namespace hysteron
