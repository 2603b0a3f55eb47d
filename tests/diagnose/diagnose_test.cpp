#include "diagnose/diagnose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "diagnose/concealed_damper.hpp"
#include "diagnose/judge/evidence.hpp"
#include "diagnose/record.hpp"
#include "diagnose/residual/locate.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/signal/thin.hpp"
#include "fit/synthetic.hpp"
#include "io/channel_lag.hpp"

namespace hysteron {
namespace {

using testing::campaign_of;
using testing::campaign_with;
using testing::diagnosis_of;
using testing::few;
using testing::seed;

TEST(Diagnosis, NamesAndMeasuresAConcealedMass) {
  const auto diagnosis = diagnosis_of(campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01), few);
  ASSERT_EQ(diagnosis->verdict.answer, Answer::missing_physics);
  ASSERT_EQ(diagnosis->verdict.effects.size(), 1U);
  EXPECT_EQ(diagnosis->verdict.effects[0].id, "inertia");
  ASSERT_FALSE(diagnosis->parameters[0].empty());
  EXPECT_NEAR(diagnosis->parameters[0][0].value, 8.0, 0.8);
  EXPECT_LT(diagnosis->search.augmented.heldout, diagnosis->search.base.heldout);
  EXPECT_NEAR(diagnosis->search.augmented.cost, diagnosis->noise_floor, 0.2 * diagnosis->noise_floor);
  EXPECT_FALSE(diagnosis->verdict.remaining_structure);
}

// A mass beside a spring twenty times as strong: the contrast of what the bare law leaves is blurred by the spring,
// that of what the law with the spring leaves is the mass.
TEST(Diagnosis, TakesTheContrastOfAnEffectBehindTheOthers) {
  const auto diagnosis =
      diagnosis_of(campaign_with({"inertia", "gas-spring"},
                                 {{"inertia.m", 8.0}, {"gas-spring.f_g", 300.0}, {"gas-spring.g", 20.0}}, 0.01),
                   few);
  const Evidence& evidence = diagnosis->evidence;
  ASSERT_EQ(evidence.candidates.size(), 2U);
  const auto z_behind = [](const std::vector<Signature>& signatures) {
    return speaking_for("inertia", signatures)->signature->value;
  };
  const auto mass = std::ranges::find(evidence.candidates, "inertia", &Candidate::id);
  ASSERT_NE(mass, evidence.candidates.end());
  EXPECT_NEAR(z_behind(mass->signatures), 8.0, 0.8) << z_behind(evidence.signatures);
}

TEST(Diagnosis, SetsAnEffectAgainstItsRivalsHoweverSmallBesideAnother) {
  const auto diagnosis =
      diagnosis_of(campaign_with({"inertia", "gas-spring"},
                                 {{"inertia.m", 20.0}, {"gas-spring.f_g", 100.0}, {"gas-spring.g", 10.0}}, 0.003),
                   few);
  const std::vector<Candidate>& candidates = diagnosis->evidence.candidates;
  ASSERT_EQ(candidates.size(), 2U);
  const auto [small, large] = std::ranges::minmax(candidates, {}, &Candidate::gain);
  ASSERT_LT(small.gain, 0.02 * large.gain);
  EXPECT_FALSE(small.contenders.empty());
  EXPECT_FALSE(large.contenders.empty());
}

TEST(Diagnosis, NamesNothingWhereTheVelocityIsNotThatOfTheDisplacement) {
  Campaign campaign = campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01);
  for (Recording& recording : campaign.recordings) {
    recording.velocity_measured = true;
    for (double& velocity : recording.velocity) {
      velocity = -velocity;
    }
  }
  const auto diagnosis = diagnosis_of(campaign, few);
  EXPECT_EQ(diagnosis->verdict.answer, Answer::unattributed);
  EXPECT_TRUE(diagnosis->verdict.effects.empty());
  EXPECT_NE(diagnosis->verdict.reason.find("not the slope of the displacement (correlation -1.00)"), std::string::npos)
      << diagnosis->verdict.reason;
  EXPECT_TRUE(diagnosis->search.found.empty()) << "effects would explain a fault of the data";
}

// The spring of the law has another force there, of which an end stop or a gas spring would be made.
TEST(Diagnosis, ARecordingOfAnotherZeroGivesNoName) {
  Campaign campaign = campaign_with({}, {}, 0.02);
  for (double& displacement : campaign.recordings[2].displacement) displacement += 0.1;
  const auto diagnosis = diagnosis_of(campaign, {"end-stop", "gas-spring", "cubic-stiffness"});
  EXPECT_EQ(diagnosis->verdict.answer, Answer::complete);
  EXPECT_TRUE(std::ranges::none_of(diagnosis->bench.split().fit,
                                   [](const Recording& recording) { return recording.file == "r2.csv"; }));
  EXPECT_TRUE(std::ranges::any_of(diagnosis->notes,
                                  [](const std::string& note) { return note.starts_with("r2.csv was left out: "); }));
}

// modified-bouc-wen, which is tried in its place, has one.
TEST(Diagnosis, TellsOfALawInAParameterThatTheBaseLawLacks) {
  DiagnoseOptions options;
  options.model = "bouc-wen";
  options.seed = seed;
  options.candidates = {"inertia"};
  options.layout.by_frequency = {{"c0", 1}, {"c1", 1}};
  const auto diagnosis = diagnose(campaign_with({}, {}, 0.02), options, [](double, const std::string&) {});
  EXPECT_EQ(
      std::ranges::count(diagnosis->notes,
                         "bouc-wen has no c1, so that its law acts only where another damper law or an effect has it"),
      1);
}

TEST(Diagnosis, NamesNothingWhereNothingIsMissing) {
  const auto diagnosis = diagnosis_of(campaign_with({}, {}, 0.02), few);
  EXPECT_EQ(diagnosis->verdict.answer, Answer::complete);
  EXPECT_TRUE(diagnosis->verdict.effects.empty());
}

TEST(Diagnosis, NamesWhatIsMissingBehindALawThatTakesThePlaceOfTheOneAskedFor) {
  DiagnoseOptions options;
  options.model = "bingham";
  options.seed = seed;
  options.candidates = few;
  const auto diagnosis =
      diagnose(campaign_with({"inertia"}, {{"inertia.m", 4.0}}, 0.01), options, [](double, const std::string&) {});
  ASSERT_EQ(diagnosis->verdict.answer, Answer::missing_physics) << diagnosis->verdict.reason;
  ASSERT_EQ(diagnosis->verdict.effects.size(), 1U);
  EXPECT_EQ(diagnosis->verdict.effects[0].id, "inertia");
  EXPECT_NEAR(diagnosis->parameters[0][0].value, 4.0, 0.6);
  EXPECT_EQ(diagnosis->search.base.what.model, "bingham");
  EXPECT_LT(diagnosis->verdict.effects[0].share_of_misfit, 0.5) << "the law takes most of it";
  EXPECT_NE(diagnosis->sentences[0].find("takes the place of bingham"), std::string::npos);
  EXPECT_NE(diagnosis->search.augmented.what.model, "bingham");
  EXPECT_TRUE(std::ranges::any_of(diagnosis->notes, [](const std::string& note) {
    return note.find("takes the place of bingham") != std::string::npos;
  }));
}

// Algebraic hysteresis has a stiffness of its own, with which it does as well as Bingham and the effect.
TEST(Diagnosis, NamesAStiffnessThatAnotherLawHasOfItsOwn) {
  DiagnoseOptions options;
  options.model = "bingham";
  options.seed = seed;
  options.candidates = few;
  options.candidates.emplace_back("linear-stiffness");
  const auto diagnosis =
      diagnose(campaign_of("bingham", {"linear-stiffness"},
                           {{"fc", 600.0}, {"c0", 1500.0}, {"f0", 20.0}, {"linear-stiffness.k", 4e4}}, 0.01),
               options, [](double, const std::string&) {});
  ASSERT_EQ(diagnosis->verdict.answer, Answer::missing_physics) << diagnosis->verdict.reason;
  ASSERT_EQ(diagnosis->verdict.effects.size(), 1U);
  EXPECT_EQ(diagnosis->verdict.effects[0].id, "linear-stiffness");
  EXPECT_NEAR(diagnosis->parameters[0][0].value, 4e4, 2e3);
  EXPECT_TRUE(std::ranges::any_of(diagnosis->evidence.other_laws, &OtherLaw::has_what_was_found));
}

// The verdict rests on what diagnosis.json holds, and on nothing else.
TEST(Diagnosis, TheVerdictFollowsFromTheRecord) {
  const auto diagnosis = diagnosis_of(campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01), few);
  const Verdict again = verdict_of(evidence_from(diagnosis_json(*diagnosis).at("evidence")));
  EXPECT_EQ(again.answer, diagnosis->verdict.answer);
  ASSERT_EQ(again.effects.size(), 1U);
  EXPECT_EQ(again.effects[0].id, "inertia");
  EXPECT_EQ(again.effects[0].confidence, diagnosis->verdict.effects[0].confidence);
}

TEST(Diagnosis, DoesNotNameWhatIsNotAmongTheCandidates) {
  // The cause is a hardening spring; only strangers are offered.
  const auto diagnosis = diagnosis_of(campaign_with({"cubic-stiffness"}, {{"cubic-stiffness.k3", 9e7}}, 0.01),
                                      {"inertia", "shear-thinning", "quadratic-damping", "force-drift"});
  EXPECT_NE(diagnosis->verdict.answer, Answer::complete);
  EXPECT_NE(diagnosis->verdict.answer, Answer::missing_physics);
}

TEST(Diagnosis, SaysWhatTheInputsCannotShow) {
  const Campaign campaign = campaign_with({}, {}, 0.02);
  EXPECT_TRUE(excluded_by_inputs("coil-lag", campaign.recordings));
  EXPECT_TRUE(excluded_by_inputs("magnetic-saturation", campaign.recordings));
  EXPECT_FALSE(excluded_by_inputs("inertia", campaign.recordings));
}

TEST(Diagnosis, TellsTheLagOfTheVelocityChannelWithoutAModel) {
  Recording recording = testing::motion("r.csv", {{0.01, 2.0}}, 4.0, 4001, 0.2);
  // The same motion 3 ms later.
  const std::vector<double> velocity = recording.velocity;
  for (std::size_t n = 3; n < velocity.size(); ++n) {
    recording.velocity[n] = velocity[n - 3];
  }
  const auto lag = velocity_channel_lag(std::vector{recording});
  ASSERT_TRUE(lag);
  EXPECT_NEAR(lag->lag, 3e-3, 2e-4);
}

TEST(Diagnosis, TellsALongLagOfTheVelocityChannelFromANoisySlope) {
  // 20 ms at up to 6 Hz is far from a small shift, and the noise of the displacement makes most of its slope's slope.
  Recording recording = testing::motion("r.csv", {{0.01, 1.0}, {0.002, 6.0}}, 4.0, 4001, 0.2);
  const double keep = std::exp(-1e-3 / 0.02);
  double lagged = 0.0;
  const Stream noise = Stream(seed).child("noise");
  for (std::size_t n = 0; n < recording.size(); ++n) {
    lagged = n == 0 ? recording.velocity[0] : recording.velocity[n] + (lagged - recording.velocity[n]) * keep;
    recording.velocity[n] = lagged;
    recording.displacement[n] += 2e-6 * noise.normal(n, 0);
  }
  const auto lag = velocity_channel_lag(std::vector{recording});
  ASSERT_TRUE(lag);
  EXPECT_NEAR(lag->lag, 0.02, 1e-3);
}

TEST(Diagnosis, DoesNotCallAForceCompleteThatASupplyScales) {
  // 15 % up and down in 1.7 s: it repeats with nothing of the motion.
  const Layout layout(make_model("viscous", {}), DataScale{}, {});
  Campaign campaign;
  for (int k = 0; k < 3; ++k) {
    const double f = 1.0 + 0.3 * k;
    Recording recording = testing::motion("r" + std::to_string(k) + ".csv",
                                          {{0.006, 1.7 * f}, {0.003, 4.1 * f}, {0.002, 6.3 * f}}, 8.0, 2000, 0.1);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.005,
                       Stream(seed).child(static_cast<std::uint64_t>(k)));
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.force[n] *= 1.0 + 0.15 * std::sin(2.0 * std::numbers::pi * recording.time[n] / 1.7);
    }
    campaign.recordings.push_back(recording);
    campaign.roles.push_back(k == 1 ? Role::validate : Role::fit);
  }
  DiagnoseOptions options;
  options.model = "viscous";
  options.seed = seed;
  options.candidates = {"inertia", "force-drift"};
  const auto diagnosis = diagnose(campaign, options, [](double, const std::string&) {});
  EXPECT_EQ(diagnosis->verdict.answer, Answer::unattributed);
  EXPECT_TRUE(diagnosis->verdict.effects.empty());
}

// Two sines at each of five currents from 0 to 1 A of a Bouc-Wen damper whose yield force and damping follow curves of
// the current.
std::unique_ptr<Diagnosis> diagnosis_of_curves(const std::function<double(double)>& yield_force,
                                               const std::function<double(double)>& damping,
                                               const std::vector<std::string>& candidates = {"inertia",
                                                                                             "force-drift"}) {
  Campaign campaign;
  for (int level = 0; level < 5; ++level) {
    const double current = 0.25 * level;
    for (const double frequency : {0.7, 2.2}) {
      LayoutOptions made;
      made.fix = {{"alpha", yield_force(current)},
                  {"c0", damping(current)},
                  {"k0", 0.0},
                  {"f0", 0.0},
                  {"x_y", 8e-4},
                  {"share", 0.6},
                  {"n", 1.5}};
      const Layout layout(make_model("bouc-wen", {}), DataScale{}, made);
      const std::size_t index = campaign.recordings.size();
      Recording recording = testing::motion("r" + std::to_string(index) + ".csv", {{0.008, frequency}}, 3.0 / frequency,
                                            400, 0.2 / frequency);
      testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(seed).child(index));
      recording.drive.assign(recording.size(), current);
      recording.drive_kind = DriveKind::current;
      campaign.recordings.push_back(recording);
      campaign.roles.push_back(Role::unassigned);
    }
  }
  DiagnoseOptions options;
  options.model = "bouc-wen";
  options.seed = seed;
  options.candidates = candidates;
  options.layout.by_current = {{"alpha", 1}, {"c0", 1}};
  return diagnose(campaign, options, [](double, const std::string&) {});
}

TEST(Diagnosis, WithoutANameTheModelStillLearnsTheCurveOfTheDrive) {
  // One curve, steep in the middle, that no effect is.
  const auto curve = [](double current) { return 0.2 + current * current * (3.0 - 2.0 * current); };
  const auto diagnosis = diagnosis_of_curves([&](double current) { return 600.0 * curve(current); },
                                             [&](double current) { return 1500.0 * curve(current); });
  EXPECT_EQ(diagnosis->verdict.answer, Answer::unattributed);
  EXPECT_TRUE(diagnosis->verdict.effects.empty());
  const std::vector<std::string>& richer = diagnosis->search.augmented.what.richer;
  EXPECT_EQ(std::ranges::count(richer, "alpha"), 2);
  EXPECT_EQ(std::ranges::count(richer, "c0"), 2);
  EXPECT_LT(diagnosis->search.augmented.heldout, 1.2 * diagnosis->noise_floor_heldout);
  EXPECT_GT(diagnosis->search.base.heldout, 4.0 * diagnosis->noise_floor_heldout);
}

TEST(Diagnosis, ALawThatNeedsTwoMoreOrdersIsOneFinding) {
  // A yield force that saturates early, beyond what one more order follows.
  const auto diagnosis = diagnosis_of_curves([](double current) { return 100.0 + 700.0 * std::tanh(current / 0.35); },
                                             [](double current) { return 1000.0 + 500.0 * current; });
  const std::vector<std::string>& richer = diagnosis->search.augmented.what.richer;
  ASSERT_EQ(std::ranges::count(richer, "alpha"), 2);
  ASSERT_EQ(diagnosis->search.found.size(), 1U);
  const Search& search = diagnosis->search;
  EXPECT_EQ(search.found[0].part.effect, saturation);
  // Without any of its orders the law is that of the base.
  EXPECT_NEAR(search.found[0].gain, squared(search.quick_base.cost) - squared(search.quick_augmented.cost),
              1e-3 * search.found[0].gain);
  EXPECT_EQ(diagnosis->verdict.answer, Answer::missing_physics);
}

TEST(Diagnosis, APolynomialThatFollowsAKneeOfTheDriveIsSaturation) {
  // Straight up to 0.5 A and a tenth as steep above, in yield force and damping alike.
  const auto knee = [](double current) { return std::min(current, 0.5) + 0.1 * std::max(current - 0.5, 0.0); };
  const std::vector<std::string> candidates = {"inertia", "force-drift", "magnetic-saturation"};
  const auto of_knee = diagnosis_of_curves([&](double current) { return 100.0 + 1200.0 * knee(current); },
                                           [&](double current) { return 500.0 + 2500.0 * knee(current); }, candidates);
  ASSERT_EQ(of_knee->verdict.effects.size(), 1U);
  EXPECT_EQ(of_knee->verdict.effects[0].id, saturation);
  // Not so a curve that is as flat at its start as at its end.
  const auto step = [](double current) { return current * current * (3.0 - 2.0 * current); };
  const auto of_step = diagnosis_of_curves([&](double current) { return 100.0 + 600.0 * step(current); },
                                           [&](double current) { return 500.0 + 1500.0 * step(current); }, candidates);
  EXPECT_TRUE(of_step->verdict.effects.empty());
  EXPECT_TRUE(of_step->verdict.suggestions.empty());
}

TEST(Diagnosis, TooFewSamplesSayNothing) {
  // Too few to tell the noise of the force ...
  Campaign campaign;
  campaign.recordings.push_back(testing::motion("few.csv", {{0.01, 1.0}}, 1.0, 8, 0.2));
  campaign.recordings[0].force.assign(8, 1.0);
  campaign.roles.push_back(Role::unassigned);
  EXPECT_THROW((void)diagnosis_of(campaign, {"inertia"}), InputError);
  // ... and enough for that, but not for the seven parameters of the law.
  Recording& recording = campaign.recordings[0];
  recording = testing::motion("few.csv", {{0.01, 1.0}}, 1.5, 27, 0.2);
  const Stream stream = Stream(4);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.force.push_back(2000.0 * recording.velocity[n] + stream.normal(n));
  }
  EXPECT_NE(diagnosis_of(campaign, {"inertia"})->verdict.answer, Answer::complete);
}

TEST(Diagnosis, SameBytesForAnyNumberOfThreads) {
  const Campaign campaign = campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01);
  std::string first;
  for (const int threads : {1, 3}) {
    DiagnoseOptions options;
    options.model = "bouc-wen";
    options.seed = seed;
    options.objective.threads = threads;
    options.candidates = {"inertia", "force-drift", "sensor-delay"};
    const std::string text = diagnosis_json(*diagnose(campaign, options, [](double, const std::string&) {})).dump();
    if (first.empty()) {
      first = text;
    }
    EXPECT_EQ(text, first) << threads << " threads";
  }
}

TEST(Locate, ABinForEachLevelOfANoisyDrive) {
  const Stream stream = Stream(3).child("levels");
  std::vector<double> drive;
  std::vector<double> spread;
  for (std::uint64_t n = 0; n < 3000; ++n) {
    drive.push_back(0.5 * static_cast<double>(n % 3) + 1e-5 * stream.uniform(n));
    spread.push_back(stream.uniform(n));
  }
  const std::vector<double> levels = bin_edges(drive);
  ASSERT_EQ(levels.size(), 4U);
  EXPECT_NEAR(levels[1], 0.25, 1e-4);
  EXPECT_NEAR(levels[2], 0.75, 1e-4);
  EXPECT_EQ(bin_edges(spread).size(), 17U);
  EXPECT_EQ(bin_edges({1.0, 1.0, 1.0}).size(), 2U);
}

TEST(Thinned, KeepsTheMotionAndStaysNearTheTotal) {
  Recording recording = testing::motion("r.csv", {{0.01, 1.0}}, 10.0, 10001, 0.2);
  recording.force.assign(recording.size(), 1.0);
  const std::vector<Recording> few_samples = thinned({recording}, 1500);
  EXPECT_LE(few_samples[0].size(), 1500U);
  EXPECT_GE(few_samples[0].size(), 600U);
  EXPECT_EQ(thinned({recording}, 20000)[0].size(), recording.size());
}

TEST(Thinned, LongNoisyRecordingsThinToWhatIsAskedAndTellTheSame) {
  // 66000 samples at 3 kHz, displacement and velocity with noise.
  Recording recording = testing::motion("r.csv", {{0.01, 1.0}, {0.003, 2.7}}, 22.0, 66000, 0.2);
  const Stream stream = Stream(8);
  constexpr double noise = 5.0;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.force.push_back(2000.0 * recording.velocity[n] + 5000.0 * recording.displacement[n] +
                              noise * stream.normal(n));
    recording.displacement[n] += 2e-5 * stream.normal(n, 1);
    recording.velocity[n] += 1e-3 * stream.normal(n, 2);
  }
  const Recording few_samples = thinned({recording}, 1500)[0];
  EXPECT_LE(few_samples.size(), 1500U);
  EXPECT_GE(few_samples.size(), 750U);
  // The force is that of the instant.
  for (std::size_t n = 0; n < few_samples.size(); ++n) {
    const auto at = std::ranges::lower_bound(recording.time, few_samples.time[n]) - recording.time.begin();
    EXPECT_EQ(few_samples.force[n], recording.force[static_cast<std::size_t>(at)]);
  }
  const auto damping = [](const Recording& of) {
    const Workbench bench(scale_of({of}), {{of}, {{of, 0}}, "", false}, {}, {}, 1, [] { return false; });
    const Fit fit = bench.from_anywhere({"viscous", {}, {}}, 500);
    for (const Term& term : fit.terms) {
      if (fit.layout->names()[term.parameter] == "c0") return term.value;
    }
    return 0.0;
  };
  double squares = 0.0;
  for (const double v : few_samples.velocity) squares += v * v;
  EXPECT_NEAR(damping(few_samples), damping(recording), 4.0 * noise / std::sqrt(squares));
}

TEST(Relatives, AreEffectsAndMutual) {
  for (const Part* effect : effect_catalogue()) {
    for (const std::string& other : relatives(std::string(effect->id))) {
      EXPECT_NE(find_effect(other), nullptr) << other;
      const std::vector<std::string> back = relatives(other);
      EXPECT_NE(std::ranges::find(back, effect->id), back.end()) << effect->id << " " << other;
    }
  }
  EXPECT_TRUE(relatives("no-such-effect").empty());
  EXPECT_TRUE(is_limit("offset-force", "gas-spring"));
  EXPECT_FALSE(is_limit("gas-spring", "offset-force"));
}

}  // namespace
}  // namespace hysteron
