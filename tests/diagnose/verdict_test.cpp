#include "diagnose/judge/verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/probability_text.hpp"
#include "diagnose/judge/features.hpp"
#include "diagnose/judge/speaking.hpp"
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double floor_squares = 1e-4;

Left left_of(double squares, bool structured) {
  Left left;
  left.squares = squares;
  left.floor = left.white = floor_squares;
  left.structure = structured ? squares - floor_squares : 0.0;
  left.predictable = structured ? 0.6 : 0.0;
  left.recurring = structured ? 0.6 : 0.01;
  left.recurring_by_chance = 0.01;
  left.recurring_at_most = 0.02;
  left.unevenness = structured ? 0.5 : 0.01;
  left.unevenness_by_chance = 0.02;
  left.independent = 500.0;
  return left;
}

Contender contender(const std::string& id, double share, double z, bool kin = false) {
  Contender row;
  row.id = id;
  row.kin = kin;
  row.share = share;
  row.refitted = true;
  row.squares = 2.0 * floor_squares;
  row.behind = {z * 0.1, 0.1, z > 0.0 ? 1.0 : 0.0, 6};
  return row;
}

// One effect that takes everything but the noise off, as plainly as can be.
Evidence plain() {
  Evidence evidence;
  evidence.model = "bouc-wen";
  evidence.recordings = 6;
  evidence.motions = 6;
  evidence.base = left_of(20.0 * floor_squares, true);
  evidence.augmented = left_of(1.0 * floor_squares, false);
  evidence.base_compared = evidence.base.squares;
  evidence.augmented_compared = evidence.augmented.squares;
  evidence.augmented_over_base = {1.5, 0.1, 1.0, 6};
  Candidate one;
  one.id = "inertia";
  one.gain = 19.0 * floor_squares;
  one.score = {1.5, 0.1, 1.0, 6};
  one.gain_alone = one.gain;
  for (std::size_t r = 0; r < 6; ++r) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      one.sizes.push_back({r, quarter, 1.0, 1e-4});
    }
  }
  one.contenders = {contender("sensor-delay", 0.3, 10.0, true), contender("quadratic-damping", 0.1, 12.0)};
  one.behind_laws = {{"lugre", 1.0}, {"bingham", 0.9}};
  one.signatures = {{"acceleration", "force with acceleration", "kg", 8.0, 0.1, 12.0, 1.0, 1.0, 6, {"inertia"}, {0}}};
  evidence.candidates = {one};
  evidence.other_laws = {{"lugre", 19.0 * floor_squares, false, {}}};
  evidence.signatures = one.signatures;
  return evidence;
}

// Of one sign below the middle of the stroke and of the other above.
void make_uneven(Candidate& candidate) {
  for (SizeOfPart& part : candidate.sizes) {
    part.size = part.quarter % 2 == 0 ? 3.0 : -1.0;
  }
}

// No cause: what the base leaves is noise and nothing was found.
Evidence nothing() {
  Evidence evidence = plain();
  evidence.base = evidence.augmented;
  evidence.base_compared = evidence.augmented_compared;
  evidence.augmented_over_base = {};
  evidence.candidates.clear();
  evidence.other_laws.clear();
  evidence.signatures.clear();
  return evidence;
}

TEST(Robustness, IsThatOfCinelliAndHazlett) {
  // Partial R2 of the effect is f2 / (1 + f2); the value solves RV^2 / (1 - RV) = f2.
  for (const double f2 : {0.1, 0.5, 2.5, 10.0}) {
    const double value = robustness_value(f2);
    EXPECT_NEAR(value * value / (1.0 - value), f2, 1e-12 * (1.0 + f2));
  }
  EXPECT_NEAR(robustness_value(0.5), 0.50, 0.005);
  EXPECT_NEAR(robustness_value(2.5), 0.77, 0.005);
  EXPECT_NEAR(robustness_value(10.0), 0.92, 0.005);
}

// However much it takes off: as a shape it stays in the augmented model.
TEST(Verdict, DoesNotNameWhatTheLawHasOfItsOwn) {
  Evidence evidence = plain();
  ASSERT_EQ(verdict_of(evidence).answer, Answer::missing_physics);
  evidence.candidates.front().had_by_law = true;
  const Verdict verdict = verdict_of(evidence);
  EXPECT_TRUE(verdict.effects.empty());
  EXPECT_TRUE(verdict.suggestions.empty());
  ASSERT_EQ(verdict.doubtful.size(), 1U);
  EXPECT_EQ(verdict.doubtful.front().confidence, 0.0);
}

TEST(Grade, FollowsTheProbability) {
  EXPECT_EQ(grade_of(0.95), Grade::established);
  EXPECT_EQ(grade_of(0.949), Grade::supported);
  EXPECT_EQ(grade_of(0.80), Grade::supported);
  EXPECT_EQ(grade_of(0.799), Grade::suggested);
  EXPECT_EQ(grade_of(0.499), Grade::none);
}

TEST(Table, IsMonotoneInEveryFeature) {
  for (const Table* table : {&alone_table(), &name_table(), &missing_table()}) {
    for (const double weight : table->weights) {
      EXPECT_GE(weight, 0.0);
    }
    for (std::size_t k = 1; k < table->knots.size(); ++k) {
      EXPECT_GT(table->knots[k].score, table->knots[k - 1].score);
      EXPECT_GE(table->knots[k].log_odds, table->knots[k - 1].log_odds);
    }
  }
  EXPECT_EQ(alone_table().weights.size(), name_features.size() + 1);
  EXPECT_EQ(name_table().weights.size(), name_features.size());
  EXPECT_EQ(missing_table().weights.size(), missing_features.size());
}

TEST(Table, LogOddsAreLinearBetweenKnotsAndConstantBeyond) {
  static constexpr double weights[] = {2.0};
  static constexpr Knot knots[] = {{0.0, -2.0}, {4.0, 2.0}, {6.0, 3.0}};
  const Table table{1.0, weights, knots};
  const auto log_odds = [&](double feature) {
    const std::array<double, 1> features = {feature};
    const double p = table.probability(features);
    return std::log(p / (1.0 - p));
  };
  EXPECT_NEAR(log_odds(-5.0), -2.0, 1e-12);
  EXPECT_NEAR(log_odds(0.5), 0.0, 1e-12);  // score 2
  EXPECT_NEAR(log_odds(1.5), 2.0, 1e-12);
  EXPECT_NEAR(log_odds(2.0), 2.5, 1e-12);
  EXPECT_NEAR(log_odds(9.0), 3.0, 1e-12);
}

TEST(Features, AreFiniteAndSpeakForTheNameTheLargerTheyAre) {
  const Evidence evidence = plain();
  for (const double value : features_of(evidence.candidates[0], evidence)) {
    EXPECT_TRUE(std::isfinite(value));
    EXPECT_GE(value, 0.0);
  }
  // More of everything that speaks against it: no feature grows.
  Evidence worse = evidence;
  worse.augmented = left_of(8.0 * floor_squares, true);
  Candidate& candidate = worse.candidates[0];
  candidate.gain *= 0.5;
  candidate.score = {0.1, 0.2, 0.5, 6};
  candidate.contenders[0].share = 0.9;
  candidate.contenders[1].share = 0.8;
  candidate.behind_laws = {{"lugre", 0.1}};
  candidate.on_bound = 1;
  candidate.gain_of_relative = candidate.gain;
  worse.other_laws[0].squares = 2.0 * floor_squares;
  candidate.signatures[0].z = 0.5;
  worse.candidates.push_back(candidate);
  const NameFeatures before = features_of(evidence.candidates[0], evidence);
  const NameFeatures after = features_of(worse.candidates[0], worse);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_LE(after[k], before[k]) << name_features[k].name;
  }
  EXPECT_LT(name_table().score(after), name_table().score(before));
}

double feature(const Evidence& evidence, std::string_view name) {
  const auto at = std::ranges::find(name_features, name, &Feature::name);
  return features_of(evidence.candidates[0], evidence)[static_cast<std::size_t>(at - name_features.begin())];
}

TEST(Features, AContrastCountsInTheSenseOfTheEffectOnly) {
  Evidence evidence = plain();
  Signature& contrast = evidence.candidates[0].signatures[0];
  contrast.sign = {-1};
  EXPECT_EQ(feature(evidence, "contrast"), 0.0);
  contrast.sign = {1};
  contrast.z = 2.5;
  EXPECT_DOUBLE_EQ(feature(evidence, "contrast"), 0.5);
  contrast.z = 0.9;
  EXPECT_EQ(feature(evidence, "contrast"), 0.0) << "as noise";
  contrast.z = 60.0;
  EXPECT_EQ(feature(evidence, "contrast"), 1.0);
  contrast.placebo_quantile = 0.94;
  EXPECT_EQ(feature(evidence, "contrast"), 0.0) << "placebos show as much";
  evidence.candidates[0].signatures.clear();
  EXPECT_EQ(feature(evidence, "contrast"), 0.5) << "no motion shows it";
}

TEST(Features, AContrastThatSpeaksTellsThatSomethingIsMissing) {
  const auto at = static_cast<std::size_t>(
      std::ranges::find(missing_features, std::string_view("spoken"), &Feature::name) - missing_features.begin());
  Evidence evidence = plain();
  EXPECT_EQ(features_of(evidence)[at], 1.0);
  evidence.signatures[0].placebo_quantile = 0.9;
  EXPECT_EQ(features_of(evidence)[at], 0.0) << "a tenth of the placebos say as much";
  evidence = plain();
  evidence.signatures[0].z = 2.9;
  EXPECT_EQ(features_of(evidence)[at], 0.0) << "shown, and not loud";
  evidence = plain();
  evidence.signatures[0].sign = {-1};
  EXPECT_EQ(features_of(evidence)[at], 0.0) << "in a sense that speaks for nothing";
}

TEST(Features, ALawThatHasTheEffectAsAPartOfItsOwnIsNoDoubtOfIt) {
  Evidence evidence = plain();
  const auto at = static_cast<std::size_t>(
      std::ranges::find(name_features, std::string_view("no_other_law"), &Feature::name) - name_features.begin());
  evidence.other_laws = {{"modified-bouc-wen", evidence.augmented_compared, false, {}}};
  EXPECT_EQ(features_of(evidence.candidates[0], evidence)[at], 0.0);
  evidence.other_laws[0].has = {evidence.candidates[0].id};
  EXPECT_EQ(features_of(evidence.candidates[0], evidence)[at], 1.0);
}

TEST(Table, AddsTheOffsetOfTheEffect) {
  static constexpr double weights[] = {2.0};
  static constexpr Offset offsets[] = {{"pinching", -1.5}, {"coil-lag", 1.0}};
  const Table table{1.0, weights, {}, offsets};
  const std::array<double, 1> features = {0.25};
  EXPECT_DOUBLE_EQ(table.score(features, "pinching"), 0.0);
  EXPECT_DOUBLE_EQ(table.score(features, "coil-lag"), 2.5);
  EXPECT_DOUBLE_EQ(table.score(features, "of-a-plugin"), 1.5);
  EXPECT_DOUBLE_EQ(table.probability(features, "pinching"), 0.5);
}

TEST(Features, FewMotionsMakeANameLessSure) {
  Evidence evidence = plain();
  const auto at = [&](std::size_t motions) {
    evidence.motions = motions;
    return feature(evidence, "motions");
  };
  EXPECT_EQ(at(1), 0.0);
  EXPECT_DOUBLE_EQ(at(2), 1.0 / 3.0);
  EXPECT_EQ(at(4), 1.0);
  EXPECT_EQ(at(20), 1.0) << "more make no name surer";
  evidence.motions = 1;
  const double of_one = name_table().probability(features_of(evidence.candidates[0], evidence), "inertia");
  evidence.motions = 6;
  EXPECT_LE(of_one, name_table().probability(features_of(evidence.candidates[0], evidence), "inertia"));
}

TEST(Features, AnEffectOfUnevenSizeIsLessSure) {
  Evidence evidence = plain();
  EXPECT_DOUBLE_EQ(feature(evidence, "evenness"), 3.0);
  for (SizeOfPart& part : evidence.candidates[0].sizes) {
    part.size = part.quarter < 2 ? 2.0 : 0.0;
  }
  EXPECT_DOUBLE_EQ(feature(evidence, "evenness"), std::log10(2.0));
}

TEST(Features, OfANameAloneCountWhatDoesAsWell) {
  Evidence evidence = plain();
  EXPECT_EQ(alone_features_of(evidence.candidates[0], evidence).back(), 1.0);
  evidence.candidates[0].contenders = {contender("sensor-delay", 0.95, 1.9, true)};
  EXPECT_EQ(alone_features_of(evidence.candidates[0], evidence).back(), 0.5);
}

TEST(Comparison, FewClustersAskForMoreThanTwoStandardErrors) {
  // Quantiles of Student's distribution where the normal one is at two: 2.649 with five degrees of freedom, 2.284 with
  // ten.
  EXPECT_FALSE((Comparison{0.264, 0.1, 1.0, 6}.surely_better()));
  EXPECT_TRUE((Comparison{0.265, 0.1, 1.0, 6}.surely_better()));
  EXPECT_FALSE((Comparison{0.228, 0.1, 1.0, 11}.surely_better()));
  EXPECT_TRUE((Comparison{0.229, 0.1, 1.0, 11}.surely_better()));
  EXPECT_TRUE((Comparison{0.201, 0.1, 1.0, 1000}.surely_better()));
}

TEST(EquallyGood, WhatIsNotSurelyWorse) {
  Evidence evidence = plain();
  Candidate& candidate = evidence.candidates[0];
  candidate.contenders = {contender("sensor-delay", 0.95, 1.9, true), contender("compliance", 0.9, 2.7),
                          contender("velocity-lag", 0.4, 0.5)};
  const std::vector<const Contender*> others = equally_good(candidate);
  ASSERT_EQ(others.size(), 1U) << "told by the data, and never near";
  EXPECT_EQ(others[0]->id, "sensor-delay");
  // A wider form that is not surely away from its limit is the candidate itself.
  candidate.contenders[0].holds_the_candidate = true;
  candidate.contenders[0].apart = false;
  EXPECT_TRUE(equally_good(candidate).empty());
}

TEST(EquallyGood, ARelatedEffectThatTakesOffNineTenths) {
  Evidence evidence = plain();
  Candidate& candidate = evidence.candidates[0];
  candidate.contenders = {contender("sensor-delay", 0.95, 8.0, true), contender("linear-stiffness", 0.85, 8.0, true),
                          contender("compliance", 0.95, 8.0)};
  const std::vector<const Contender*> others = equally_good(candidate);
  ASSERT_EQ(others.size(), 1U) << "the data tell the two others apart";
  EXPECT_EQ(others[0]->id, "sensor-delay") << "what they tell may be the form of it alone";
  candidate.contenders[0].holds_the_candidate = true;
  EXPECT_TRUE(equally_good(candidate).empty()) << "a wider form takes off as much in any case";
}

TEST(EquallyGood, AlsoWhatLeavesTheContrastOfTheCandidate) {
  Evidence evidence = plain();
  Candidate& candidate = evidence.candidates[0];
  candidate.contenders = {contender("quadratic-damping", 0.9, 1.0)};
  evidence.contrasts_left = {{"inertia", "acceleration", "", false, 0.5},
                             {"inertia", "acceleration", "quadratic-damping", false, 4.0}};
  EXPECT_EQ(equally_good(candidate).size(), 1U) << "recordings left out do not tell the two apart";
  EXPECT_EQ(in_its_place(candidate, evidence).tried, 1U);
  EXPECT_EQ(in_its_place(candidate, evidence).leave_the_contrast, 1U);
  evidence.contrasts_left[1].z = 2.5;
  EXPECT_EQ(in_its_place(candidate, evidence).leave_the_contrast, 0U) << "less than three standard errors of it stay";
  evidence.contrasts_left[1].z = 4.0;
  evidence.contrasts_left[0].z = 2.5;
  EXPECT_EQ(in_its_place(candidate, evidence).leave_the_contrast, 0U) << "the candidate does not explain it either";
}

TEST(Features, ALawThatLeavesTheContrastIsNoExplanation) {
  Evidence evidence = plain();
  evidence.other_laws = {{"lugre", 2.0 * floor_squares, false, {}}};
  const auto at = std::ranges::find(name_features, "no_other_law", &Feature::name) - name_features.begin();
  EXPECT_LT(features_of(evidence.candidates[0], evidence)[at], 0.1);
  evidence.contrasts_left = {{"inertia", "acceleration", "", false, 0.5},
                             {"inertia", "acceleration", "lugre", true, 4.0}};
  EXPECT_EQ(features_of(evidence.candidates[0], evidence)[at], 1.0);
}

TEST(Verdict, NamesThePartThatTheBetterLawHasOfItsOwn) {
  Evidence before = plain();
  before.other_laws = {{"modified-bouc-wen", 1.1 * floor_squares, true, {"inertia"}}};
  Evidence evidence = nothing();
  evidence.model = "modified-bouc-wen";
  evidence.asked_for = "bouc-wen";
  EXPECT_EQ(verdict_of(evidence).answer, Answer::unattributed);
  evidence.behind_asked = {before};
  const Verdict verdict = verdict_of(evidence);
  EXPECT_EQ(verdict.answer, Answer::missing_physics);
  ASSERT_EQ(verdict.effects.size(), 1U);
  EXPECT_EQ(verdict.effects[0].id, "inertia");
  EXPECT_EQ(verdict.effects[0].of_law, "modified-bouc-wen");
  EXPECT_EQ(verdict.effects[0].confidence, verdict_of(before).effects.at(0).confidence);
  EXPECT_EQ(candidate_of(verdict.effects[0], evidence).gain, before.candidates[0].gain);
  // Found behind the law asked for, and no part of the one that took its place: that explains it otherwise.
  evidence.behind_asked[0].other_laws[0].has.clear();
  EXPECT_TRUE(verdict_of(evidence).effects.empty());
}

TEST(Verdict, JudgesThePartOfTheBetterLawInTheModelThatIsReported) {
  Evidence evidence = plain();
  evidence.model = "modified-bouc-wen";
  evidence.asked_for = "bouc-wen";
  evidence.candidates[0].of_law = true;
  Evidence before = plain();
  before.other_laws = {{"modified-bouc-wen", 1.1 * floor_squares, true, {"inertia"}}};
  before.base.squares *= 2.0;
  before.base_compared *= 2.0;
  before.candidates[0].gain *= 1e-3;
  evidence.behind_asked = {before};
  const Verdict verdict = verdict_of(evidence);
  ASSERT_EQ(verdict.effects.size(), 1U) << "once, though it was found behind the law asked for too";
  EXPECT_EQ(verdict.effects[0].of_law, "modified-bouc-wen");
  EXPECT_FALSE(verdict.effects[0].behind_asked);
  EXPECT_EQ(candidate_of(verdict.effects[0], evidence).gain, evidence.candidates[0].gain);
  EXPECT_NEAR(verdict.effects[0].share_of_misfit, evidence.candidates[0].gain / before.base.excess(), 1e-12)
      << "of what the law asked for leaves";
  // The other law is weighed against the law asked for, too.
  const auto at = std::ranges::find(name_features, "no_other_law", &Feature::name) - name_features.begin();
  evidence.other_laws = {{"lugre", evidence.base_compared, false, {}}};
  EXPECT_NEAR(
      features_of(evidence.candidates[0], evidence)[at],
      1.0 - (before.base_compared - evidence.base_compared) / (before.base_compared - evidence.augmented_compared),
      1e-12);
}

TEST(Verdict, NamesWhatIsPlainAndNothingWhereNothingIsLeft) {
  const Verdict verdict = verdict_of(plain());
  EXPECT_EQ(verdict.answer, Answer::missing_physics);
  ASSERT_EQ(verdict.effects.size(), 1U);
  EXPECT_EQ(verdict.effects[0].id, "inertia");
  EXPECT_GE(verdict.effects[0].confidence, supported_from);
  EXPECT_FALSE(verdict.remaining_structure);
  EXPECT_NEAR(verdict.unknown_share, 0.0, 1e-12);
  EXPECT_EQ(verdict_of(nothing()).answer, Answer::complete);
  EXPECT_EQ(verdict_of(nothing()).unknown_share, 0.0) << "nothing but noise has no unknown share";
}

TEST(Verdict, WhatTheChannelsTellNeedsNoModel) {
  Evidence evidence = plain();
  evidence.augmented = left_of(15.0 * floor_squares, true);
  Candidate& candidate = evidence.candidates[0];
  candidate.id = "velocity-lag";
  candidate.gain = 0.1 * floor_squares;
  candidate.score = {0.0, 0.2, 0.5, 6};
  candidate.signatures[0].id = "velocity-delay";
  candidate.signatures[0].speaks_for = {candidate.id};
  candidate.gain_alone = 0.0;
  make_uneven(candidate);
  EXPECT_TRUE(verdict_of(evidence).effects.empty());
  candidate.as_channels = true;
  const Verdict told = verdict_of(evidence);
  ASSERT_EQ(told.effects.size(), 1U);
  EXPECT_EQ(told.effects[0].confidence, channel_probability());
  EXPECT_TRUE(told.effects[0].indistinguishable_from.empty());
  candidate.signatures[0].placebo_quantile = 0.9;
  EXPECT_TRUE(verdict_of(evidence).effects.empty()) << "one of ten placebos is as large";
}

TEST(Verdict, ASetIsToldWhereItIsSurerByMoreThanATenth) {
  Evidence evidence = plain();
  Candidate& candidate = evidence.candidates[0];
  std::size_t alone = 0;
  std::size_t sets = 0;
  for (const int others : {1, 2, 4}) {
    candidate.contenders.clear();
    for (int k = 0; k < others; ++k) {
      candidate.contenders.push_back(
          contender(k == 0 ? "sensor-delay" : "rival-" + std::to_string(k), 0.95, 0.5, true));
    }
    for (const double weaker : {1.0, 0.8, 0.6, 0.4, 0.3}) {
      candidate.signatures[0].z = 12.0 * (weaker - 0.25);
      candidate.gain_alone = weaker * candidate.gain;
      const double of_one = alone_table().probability(alone_features_of(candidate, evidence), candidate.id);
      const double of_all = std::max(of_one, name_table().probability(features_of(candidate, evidence), candidate.id));
      const Verdict verdict = verdict_of(evidence);
      std::vector<Named> names = verdict.effects.empty() ? verdict.suggestions : verdict.effects;
      if (names.empty()) {
        EXPECT_LT(of_all, suggested_from);
        continue;
      }
      const bool told_alone = names.size() == 1;
      (told_alone ? alone : sets) += 1;
      EXPECT_EQ(names[0].confidence, told_alone ? of_one : of_all);
      EXPECT_EQ(names[0].less_likely.size(), told_alone ? static_cast<std::size_t>(others) : 0U);
      EXPECT_EQ(names[0].alone, of_one);
      const bool listed_alike = of_one >= suggested_from && (of_one >= supported_from) == (of_all >= supported_from);
      EXPECT_EQ(told_alone, listed_alike && of_all - of_one <= 0.1) << of_one << " " << of_all;
    }
  }
  EXPECT_GT(alone + sets, 0U);
}

TEST(Verdict, AShapeThatEverythingSpeaksAgainstIsNoName) {
  Evidence evidence = plain();
  evidence.augmented = left_of(15.0 * floor_squares, true);
  evidence.augmented_compared = evidence.augmented.squares;
  Candidate& candidate = evidence.candidates[0];
  candidate.gain = 5.0 * floor_squares;
  candidate.score = {0.02, 0.05, 0.5, 6};
  candidate.contenders = {contender("quadratic-damping", 0.97, 0.1), contender("shear-thinning", 0.96, 0.1)};
  candidate.behind_laws = {{"lugre", 0.05}, {"bingham", 0.1}};
  evidence.other_laws[0].squares = 14.0 * floor_squares;
  candidate.signatures[0].z = 0.3;
  make_uneven(candidate);
  const Verdict verdict = verdict_of(evidence);
  EXPECT_TRUE(verdict.effects.empty());
  EXPECT_EQ(verdict.answer, Answer::unattributed);
  EXPECT_EQ(verdict.unknown_share, 1.0) << "nothing is named or suggested";
  ASSERT_FALSE(verdict.doubtful.empty());
  EXPECT_EQ(verdict.reason, "the likeliest, inertia or another that does as well, is there with " +
                                probability_text(verdict.doubtful[0].confidence) + ", and a name is given from 80 %");
}

TEST(Verdict, AFaultOfTheDataLeavesNoName) {
  Evidence evidence = plain();
  evidence.doubt_of_data = "the recorded velocity is not the slope of the displacement";
  const Verdict verdict = verdict_of(evidence);
  EXPECT_EQ(verdict.answer, Answer::unattributed);
  EXPECT_TRUE(verdict.effects.empty());
  EXPECT_TRUE(verdict.suggestions.empty());
  EXPECT_EQ(verdict.reason, evidence.doubt_of_data);
  ASSERT_EQ(verdict.doubtful.size(), 1U) << "the augmented model holds it all the same";
  EXPECT_EQ(verdict.unknown_share, 1.0);
}

TEST(Verdict, WhatIsDoubtedHasItsPartOfWhatHasNoName) {
  Evidence evidence = plain();
  evidence.augmented = left_of(5.0 * floor_squares, false);
  evidence.augmented_compared = evidence.augmented.squares;
  Verdict verdict = verdict_of(evidence);
  ASSERT_EQ(verdict.effects.size() + verdict.suggestions.size(), 1U);
  EXPECT_NEAR(verdict.unknown_share, 4.0 / 19.0, 1e-12) << "what stays over what there was, beyond the noise";
  // A second effect that nothing speaks for took a third as much off.
  Candidate doubted = evidence.candidates[0];
  doubted.id = "cavitation";
  doubted.gain = evidence.candidates[0].gain / 3.0;
  doubted.score = {0.0, 0.1, 0.5, 6};
  doubted.contenders = {contender("quadratic-damping", 1.0, 0.0), contender("asymmetry", 1.0, 0.0, true)};
  doubted.behind_laws = {{"lugre", 0.0}};
  doubted.gain_alone = 0.0;
  doubted.signatures[0].speaks_for = {"cavitation"};
  doubted.signatures[0].z = 0.2;
  make_uneven(doubted);
  evidence.candidates.push_back(doubted);
  verdict = verdict_of(evidence);
  ASSERT_EQ(verdict.effects.size() + verdict.suggestions.size(), 1U);
  ASSERT_EQ(verdict.doubtful.size(), 1U);
  EXPECT_NEAR(verdict.unknown_share, 4.0 / 19.0 + 15.0 / 19.0 / 4.0, 1e-12);
}

// The augmented model may owe most to richer laws in the drive, which are no candidates.
TEST(Verdict, ANameIsCreditedWithNoMoreThanItTakesOff) {
  Evidence evidence = plain();
  evidence.candidates[0].gain = 4.75 * floor_squares;
  evidence.candidates[0].gain_alone = 3.8 * floor_squares;
  Verdict verdict = verdict_of(evidence);
  ASSERT_EQ(verdict.effects.size() + verdict.suggestions.size(), 1U);
  EXPECT_NEAR(verdict.unknown_share, 0.75, 1e-12) << "it takes a quarter off, and all is taken off";
  evidence.candidates[0].gain_alone = 9.5 * floor_squares;
  verdict = verdict_of(evidence);
  ASSERT_EQ(verdict.effects.size() + verdict.suggestions.size(), 1U);
  EXPECT_NEAR(verdict.unknown_share, 0.5, 1e-12) << "alone it takes off a half";
}

TEST(Features, AContrastIsThatOfWhatIsLeftWithoutTheCandidate) {
  Evidence evidence = plain();
  evidence.signatures[0].z = 0.2;  // behind the bare law another effect covers it
  EXPECT_EQ(feature(evidence, "contrast"), 1.0);
  evidence.signatures[0].z = 12.0;
  evidence.candidates[0].signatures[0].z = 0.2;  // another effect of the model has it
  EXPECT_LT(feature(evidence, "contrast"), 0.2);
}

TEST(Speaking, IsTheContrastWithTheLargestZInTheSenseOfTheEffect) {
  std::vector<Signature> signatures = {
      {"a", "", "", -1.0, 0.1, -9.0, 1.0, 1.0, 6, {"shear-thinning", "inertia"}, {-1, 1}},
      {"b", "", "", 1.0, 0.1, 3.0, 1.0, 0.5, 6, {"inertia"}, {0}}};
  EXPECT_FALSE(speaking_for("clearance", signatures)) << "no motion shows it";
  EXPECT_EQ(speaking_for("shear-thinning", signatures)->signature->id, "a");
  EXPECT_EQ(speaking_for("shear-thinning", signatures)->z, 9.0);
  EXPECT_EQ(speaking_for("inertia", signatures)->signature->id, "b") << "the louder one speaks against it";
  EXPECT_FALSE(shows(*speaking_for("inertia", signatures))) << "as large as half of the placebos";
  EXPECT_TRUE(shows(*speaking_for("shear-thinning", signatures)));
  signatures.pop_back();
  EXPECT_EQ(speaking_for("inertia", signatures)->z, 0.0) << "one that speaks against it does not speak for it";
}

TEST(Verdict, WhatIsNotNoiseIsNotComplete) {
  Evidence evidence = nothing();
  evidence.doubt_of_completeness = "what is left is a factor of the force that swings";
  EXPECT_EQ(verdict_of(evidence).answer, Answer::unattributed);
  EXPECT_EQ(verdict_of(evidence).reason, evidence.doubt_of_completeness + "; no effect that was tried explains it");
}

TEST(Verdict, EveryCandidateIsNamedSuggestedOrDoubted) {
  Evidence evidence = plain();
  Candidate trace = evidence.candidates[0];
  trace.id = "cavitation";
  trace.gain = 0.05 * floor_squares;
  trace.score = {0.0, 0.1, 0.5, 6};
  trace.contenders = {contender("asymmetry", 1.0, 0.0, true)};
  evidence.candidates.push_back(trace);
  const Verdict verdict = verdict_of(evidence);
  for (const std::string id : {"inertia", "cavitation"}) {
    std::ptrdiff_t listed = 0;
    for (const std::vector<Named>* list : {&verdict.effects, &verdict.suggestions, &verdict.doubtful}) {
      listed += std::ranges::count(*list, id, &Named::id);
    }
    EXPECT_EQ(listed, 1) << id;
  }
  EXPECT_EQ(verdict.effects.front().id, "inertia");
}

TEST(Evidence, AVerdictFollowsFromTheRecordedNumbers) {
  const Evidence evidence = plain();
  const nlohmann::json recorded = nlohmann::json::parse(evidence_json(evidence).dump());
  const Evidence again = evidence_from(recorded);
  EXPECT_EQ(evidence_json(again), recorded);
  EXPECT_EQ(verdict_of(again).effects.at(0).confidence, verdict_of(evidence).effects.at(0).confidence);
  nlohmann::json earlier = recorded;
  earlier.erase("contrasts_left");
  earlier.erase("behind_asked");
  earlier["candidates"][0].erase("signatures");
  for (nlohmann::json& row : earlier["signatures"]) row.erase("of_all");
  EXPECT_EQ(evidence_json(evidence_from(earlier)), recorded) << "records of earlier programs hold none of these";
  Evidence nested = evidence;
  nested.behind_asked = {evidence};
  nested.contrasts_left = {{"inertia", "acceleration", "lugre", true, 4.0}};
  EXPECT_EQ(evidence_json(evidence_from(evidence_json(nested))), evidence_json(nested));
  nlohmann::json broken = recorded;
  broken.erase("candidates");
  EXPECT_THROW(evidence_from(broken), nlohmann::json::exception);
}

TEST(BetterLaw, OneThatDoesAsWellWithoutEffects) {
  Evidence evidence = plain();
  EXPECT_EQ(better_law(evidence), "");
  evidence.other_laws = {{"lugre", 1.2 * floor_squares, false, {}}, {"modified-dahl", 1.1 * floor_squares, true, {}}};
  EXPECT_EQ(better_law(evidence), "lugre") << "what has the effect as its own parameter says the same in other words";
  evidence.base_compared = 0.95 * floor_squares;
  evidence.other_laws.front().squares = 0.9 * floor_squares;
  evidence.candidates.clear();
  EXPECT_EQ(better_law(evidence), "") << "a law that leaves the noise misses nothing";
}

}  // namespace
}  // namespace hysteron
