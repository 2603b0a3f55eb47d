#include "diagnose/judge/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "diagnose/judge/evidence.hpp"

namespace hysteron {
namespace {

constexpr double floor_squares = 1e-4;

// A search that found one effect: `left` is the squared error it leaves, `gain` what it took off.
Search search_of(const std::string& id, double left, double gain, bool structured = false) {
  Search search;
  search.misfit.squares = left;
  search.misfit.white = search.misfit.floor = floor_squares;
  search.misfit.structure = structured ? 0.8 * (left - floor_squares) : 0.0;
  search.misfit.noise = left - search.misfit.structure;
  search.misfit.predictable = structured ? 0.5 : 0.0;
  search.base_misfit = search.misfit;
  search.base_misfit.squares = left + gain;
  search.augmented.cost = search.augmented.heldout = std::sqrt(left);
  search.base.cost = search.base.heldout = std::sqrt(left + gain);
  Found found;
  found.id = id;
  found.gain = gain;
  found.evidence = 1e4;
  found.without = search.base;
  found.share_of_misfit = 0.9;
  search.found = {found};
  return search;
}

Rival rival(const std::string& id, double share, double evidence) {
  Rival row;
  row.id = id;
  row.share = share;
  row.evidence = evidence;
  return row;
}

// Every fit has these intervals of every effect.
Circumstances knowing(const std::vector<ParameterInterval>& intervals, std::optional<ChannelLag> channel = {}) {
  return {[intervals](const Fit&, const std::string&) { return intervals; }, channel};
}

Verdict verdict_of(const Search& search, const Circumstances& known) {
  return hysteron::verdict_of(findings_of(search, known));
}

const Circumstances plain = knowing({{"size", "N", 1.0, 0.5}});

TEST(Verdict, FarFromTheNoiseOnlyADominantEffectIsNamed) {
  EXPECT_EQ(verdict_of(search_of("inertia", 1.5 * floor_squares, 20.0 * floor_squares), plain).word, "missing-physics");
  // Fifteen times the noise stays: an effect of five times what stays is no answer, one of twenty times is.
  const double left = 16.0 * floor_squares;
  EXPECT_EQ(verdict_of(search_of("inertia", left, 5.0 * 15.0 * floor_squares, true), plain).word, "unattributed");
  EXPECT_EQ(verdict_of(search_of("inertia", left, 20.0 * 15.0 * floor_squares, true), plain).word, "missing-physics");
}

TEST(Verdict, AnEffectOfTheEndsOfTheStrokeIsJudgedByWhatStaysThere) {
  // On the whole it takes off twice what stays.
  const double left = 16.0 * floor_squares;
  Search search = search_of("end-stop", left, 2.0 * 15.0 * floor_squares, true);
  const auto word = [&](double share, double before, std::vector<Rival> rivals) {
    search.found[0].locality = Locality{share, before, 2.0, 1.0};
    search.found[0].rivals = std::move(rivals);
    return verdict_of(search, plain).word;
  };
  const std::vector<Rival> beaten = {rival("cubic-stiffness", 0.2, 500.0)};
  EXPECT_EQ(word(0.1, 30.0, beaten), "missing-physics");
  EXPECT_EQ(word(0.1, 10.0, beaten), "unattributed") << "much stays where it acts";
  EXPECT_EQ(word(0.5, 30.0, beaten), "unattributed") << "it acts nearly everywhere";
  EXPECT_EQ(word(0.1, 30.0, {}), "unattributed") << "it was set against nothing";
  EXPECT_EQ(word(0.1, 30.0, {rival("cubic-stiffness", 0.9, 500.0)}), "ambiguous");
}

TEST(Verdict, ARivalIsExcludedByWhatItLeavesUnexplained) {
  for (const auto& [share, left, word] :
       {std::tuple{0.99, 1.2, "ambiguous"}, std::tuple{0.95, 1.2, "missing-physics"},
        std::tuple{0.95, 15.0, "missing-physics"}, std::tuple{0.95, 40.0, "ambiguous"}}) {
    // Where more stays beyond the noise, what is unknown may favour either.
    Search search = search_of("linear-stiffness", left * floor_squares, 290.0 * floor_squares);
    search.found[0].rivals = {rival("cubic-stiffness", share, 500.0)};
    EXPECT_EQ(verdict_of(search, plain).word, word) << share << " " << left;
  }
}

TEST(Verdict, ARivalThatTheJudgingRecordingsRefuteIsNone) {
  Search search = search_of("linear-stiffness", 1.1 * floor_squares, 10.0 * floor_squares);
  for (const auto& [factor, evidence, word] : {std::tuple{1.5, 50.0, "ambiguous"}, std::tuple{1.1, 500.0, "ambiguous"},
                                               std::tuple{1.5, 500.0, "missing-physics"}}) {
    search.found[0].rivals = {rival("pre-yield-hysteresis", 0.98, evidence)};
    search.found[0].rivals[0].fit.heldout = std::sqrt(factor) * search.augmented.heldout;
    EXPECT_EQ(verdict_of(search, plain).word, word) << factor << " " << evidence;
  }
}

TEST(Verdict, WhatIsLikeNoiseInAllIsTheNoise) {
  // Colour doubles the white noise: half as much gain as stays above the estimate is too little for a name ...
  Search search = search_of("coil-lag", 2.0 * floor_squares, 0.5 * floor_squares);
  search.found[0].without.cost = search.found[0].without.heldout = std::sqrt(2.5 * floor_squares);
  EXPECT_EQ(verdict_of(search, plain).word, "unattributed");
  // ... unless neither the values of what stays nor their size follow the motion, and nothing further helps.
  search.misfit.evenness = {0.01, 0.02};
  EXPECT_EQ(verdict_of(search, plain).word, "unattributed");
  search.further = 5.0;
  EXPECT_EQ(verdict_of(search, plain).word, "missing-physics");
  Search shapes = search;
  shapes.found.resize(3, shapes.found.front());
  EXPECT_EQ(verdict_of(shapes, plain).word, "unattributed") << "three effects are the shape of something else";
  for (const auto& [share, word] : {std::pair{0.012, "missing-physics"}, std::pair{0.016, "unattributed"}}) {
    search.recurrence = {share, 0.006, 0.012};
    EXPECT_EQ(verdict_of(search, plain).word, word) << "all recordings together show that it follows the motion";
  }
  search.recurrence = {};
  search.misfit.evenness = {0.04, 0.02};
  EXPECT_EQ(verdict_of(search, plain).word, "unattributed");
  // Where what further would help was not looked at, a twentieth of the noise is asked for in any case.
  for (const auto& [gain, named] : {std::pair{0.1, true}, std::pair{0.03, false}}) {
    search = search_of("stiction", 1.01 * floor_squares, gain * floor_squares);
    search.found[0].without.cost = search.found[0].without.heldout = std::sqrt((1.01 + gain) * floor_squares);
    search.misfit.evenness = {0.01, 0.02};
    EXPECT_EQ(verdict_of(search, plain).word == "missing-physics", named) << gain;
  }
}

TEST(Verdict, NearTheNoiseTheEvidenceDecides) {
  const auto small = [](double evidence, std::optional<double> further) {
    Search search = search_of("quadratic-damping", 1.1 * floor_squares, 0.03 * floor_squares);
    search.found[0].without.cost = search.found[0].without.heldout = std::sqrt(1.13 * floor_squares);
    search.found[0].evidence = evidence;
    search.misfit.evenness = {0.01, 0.02};
    search.further = further;
    return search;
  };
  EXPECT_EQ(verdict_of(small(200.0, 5.0), plain).word, "missing-physics");
  EXPECT_EQ(verdict_of(small(30.0, 5.0), plain).word, "complete") << "as much as a noise that is not white may give";
  EXPECT_EQ(verdict_of(small(200.0, 60.0), plain).word, "unattributed") << "something else is missing too";
  EXPECT_EQ(verdict_of(small(200.0, std::nullopt), plain).word, "unattributed") << "what else helps was not looked at";
  Search search = small(200.0, 5.0);
  search.misfit.evenness = {0.04, 0.02};
  EXPECT_EQ(verdict_of(search, plain).word, "unattributed") << "what stays follows the motion";
  // Effects that are too many for a name, or too little each, show together that something is missing.
  for (const auto& [heldout, word] : {std::pair{0.99, "complete"}, std::pair{0.95, "unattributed"}}) {
    search = small(30.0, 5.0);
    search.found.resize(3, search.found.front());
    search.augmented.heldout = std::sqrt(heldout) * search.base.heldout;
    EXPECT_EQ(verdict_of(search, plain).word, word) << heldout;
  }
  // Judging recordings that do not excite the effect are no objection to much evidence, those that contradict are.
  for (const auto& [evidence, heldout, word] :
       {std::tuple{100.0, 1.0, "complete"}, std::tuple{400.0, 1.0, "missing-physics"},
        std::tuple{400.0, 1.02, "complete"}}) {
    search = small(evidence, 5.0);
    search.augmented.heldout = std::sqrt(heldout) * search.found[0].without.heldout;
    EXPECT_EQ(verdict_of(search, plain).word, word) << evidence << " " << heldout;
  }
  search = small(200.0, 5.0);
  search.found.resize(3, search.found.front());
  EXPECT_EQ(verdict_of(search, plain).word, "unattributed") << "three effects are the shape of something else";
  // A rival is as good that comes near in share or in evidence.
  for (const auto& [share, evidence, ambiguous] :
       {std::tuple{0.7, 60.0, false}, std::tuple{0.7, 8.0, true}, std::tuple{0.97, 60.0, true}}) {
    search = small(200.0, 5.0);
    search.found[0].rivals = {rival("shear-thinning", share, evidence)};
    EXPECT_EQ(verdict_of(search, plain).word == "ambiguous", ambiguous) << share << " " << evidence;
  }
}

TEST(Verdict, ASmallFurtherEffectIsNamedWhereTheJudgingRecordingsLeaveNoDoubt) {
  const auto names = [](const std::string& strong, const std::string& small, double heldout_without) {
    Search search = search_of(strong, 1.05 * floor_squares, 20.0 * floor_squares);
    search.misfit.evenness = {0.01, 0.02};
    Found further = search.found.front();
    further.id = small;
    further.gain = 0.4 * floor_squares;
    further.evidence = 500.0;
    further.without.cost = std::sqrt(1.45 * floor_squares);
    further.without.heldout = std::sqrt(heldout_without * floor_squares);
    search.found.push_back(further);
    return verdict_of(search, plain).effects.size();
  };
  EXPECT_EQ(names("series-dashpot", "inertia", 2.0), 2U);
  EXPECT_EQ(names("series-dashpot", "inertia", 1.3), 1U) << "less than on the fitted ones";
  EXPECT_EQ(names("pinching", "gas-spring", 2.0), 1U) << "what the form of the one misses looks like the other";
}

TEST(Verdict, ThreeEffectsThatLeaveMoreThanNoiseAreAShape) {
  for (const auto& [gain, left, word] : {std::tuple{3.0, 1.6, "unattributed"}, std::tuple{9.0, 1.6, "missing-physics"},
                                         std::tuple{3.0, 1.2, "missing-physics"}}) {
    Search search = search_of("clearance", left * floor_squares, gain * floor_squares);
    search.found.resize(3, search.found.front());
    search.found[1].gain = search.found[2].gain = 0.1 * gain * floor_squares;
    search.found[1].id = "viscous-damping";
    search.found[2].id = "inertia";
    EXPECT_EQ(verdict_of(search, plain).word, word) << gain << " " << left;
  }
}

TEST(Verdict, AnotherLawIsAsGoodOnlyIfItTakesMuchOfTheGain) {
  for (const auto& [gain, law, word] :
       {std::tuple{40.0, 1.15, "unattributed"}, std::tuple{40.0, 1.3, "missing-physics"},
        std::tuple{0.1, 1.13, "unattributed"}, std::tuple{0.1, 1.17, "missing-physics"}}) {
    Search search = search_of("inertia", 1.1 * floor_squares, gain * floor_squares);
    search.misfit.evenness = {0.01, 0.02};
    search.further = 0.0;
    search.quick_base.cost = search.base.cost;
    search.quick_augmented.cost = search.augmented.cost;
    Fit other;
    other.what.model = "bouc-wen";
    other.cost = std::sqrt(law * floor_squares);
    search.other_laws = {other};
    const Verdict verdict = verdict_of(search, plain);
    EXPECT_EQ(verdict.word, word) << gain << " " << law;
    EXPECT_EQ(verdict.better_law.empty(), verdict.word != "unattributed");
  }
}

TEST(Verdict, ALawThatHasWhatWasFoundOfItsOwnSaysTheSame) {
  for (const auto& [effect, asked, word] :
       {std::tuple{"linear-stiffness", "bingham", "missing-physics"}, std::tuple{"inertia", "bingham", "unattributed"},
        std::tuple{"linear-stiffness", "bouc-wen", "unattributed"}}) {
    Search search = search_of(effect, 1.1 * floor_squares, 40.0 * floor_squares);
    search.base.what.model = asked;
    search.quick_base.cost = search.base.cost;
    search.quick_augmented.cost = search.augmented.cost;
    Fit other;
    other.what.model = "algebraic-hysteresis";
    other.cost = search.augmented.cost;
    search.other_laws = {other};
    EXPECT_EQ(verdict_of(search, plain).word, word) << effect << " behind " << asked;
  }
}

TEST(Verdict, BesideWhatTheMotionPredictsOnlyADominantEffectIsNamed) {
  Search search = search_of("pinching", 2.5 * floor_squares, 8.0 * 1.5 * floor_squares, true);
  EXPECT_EQ(verdict_of(search, plain).word, "unattributed");
  search.misfit.predictable = 0.1;
  EXPECT_EQ(verdict_of(search, plain).word, "missing-physics");
  search = search_of("pinching", 2.5 * floor_squares, 25.0 * 1.5 * floor_squares, true);
  EXPECT_EQ(verdict_of(search, plain).word, "missing-physics");
  Found second = search.found[0];
  second.id = "compliance";
  second.gain = 12.0 * 1.5 * floor_squares;
  search.found.push_back(second);
  EXPECT_EQ(verdict_of(search, plain).effects.size(), 1U) << "more than near the noise stays";
  search.misfit.squares = 1.4 * floor_squares;
  EXPECT_EQ(verdict_of(search, plain).effects.size(), 2U);
  search.misfit.squares = 2.5 * floor_squares;
  search.misfit.predictable = search.misfit.structure = 0.0;
  EXPECT_EQ(verdict_of(search, plain).effects.size(), 1U);
  search.misfit.evenness = {0.01, 0.02};
  EXPECT_EQ(verdict_of(search, plain).effects.size(), 2U) << "nothing but noise stays, whatever its size";
  search.found[1].id = "cubic-stiffness";
  EXPECT_EQ(verdict_of(search, plain).effects.size(), 1U) << "kin of pinching";
}

TEST(Verdict, WhatAnotherLawNeedsTooDoesNotMakeUpForTheLawAskedFor) {
  // What stays follows the motion: five times as much is no answer, unless the effect is no shape of the law's lack.
  for (const auto& [under, share, gain, word] :
       {std::tuple{"behind lugre", 0.9, 5.0, "missing-physics"}, std::tuple{"behind lugre", 0.9, 3.0, "unattributed"},
        std::tuple{"behind lugre", 0.4, 5.0, "unattributed"}, std::tuple{"with a skew", 0.9, 5.0, "unattributed"}}) {
    Search search = search_of("cavitation", 2.5 * floor_squares, gain * 1.5 * floor_squares, true);
    search.tried = "cavitation";
    search.trials = {{under, share, 500.0}};
    EXPECT_EQ(verdict_of(search, plain).word, word) << under << " " << share << " " << gain;
    search.tried = "inertia";
    EXPECT_EQ(verdict_of(search, plain).word, "unattributed") << "another effect stood the trial";
  }
}

TEST(Verdict, EffectsThatOnlyMakeUpForEachOtherAreNoNames) {
  for (const auto& [all, word] : {std::pair{0.001, "complete"}, std::pair{0.5, "missing-physics"}}) {
    Search search = search_of("stiction", 1.01 * floor_squares, floor_squares);
    search.found.resize(2, search.found.front());
    search.found[1].id = "offset-force";
    search.base.cost = search.base.heldout = std::sqrt((1.01 + all) * floor_squares);
    EXPECT_EQ(verdict_of(search, plain).word, word) << all;
  }
}

TEST(Verdict, WhatTheLawHasOfItsOwnIsNoName) {
  Search search = search_of("linear-stiffness", 1.1 * floor_squares, 40.0 * floor_squares);
  for (const auto& [law, word] : {std::pair{"bingham", "missing-physics"}, std::pair{"bouc-wen", "unattributed"}}) {
    search.base.what.model = law;
    EXPECT_EQ(verdict_of(search, plain).word, word) << law;
  }
}

TEST(Verdict, AFormThatHoldsTheEffectAsItsLimitMustBeWorthItsParameters) {
  const Circumstances curved = knowing({{"f_g", "N", 100.0, 1.0}, {"g", "1/m", 10.0, 3.0}});
  const Circumstances straight = knowing({{"f_g", "N", 100.0, 1.0}, {"g", "1/m", 10.0, 12.0}});
  Search search = search_of("offset-force", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("gas-spring", 1.0, 5.0)};
  EXPECT_EQ(verdict_of(search, curved).word, "missing-physics");
  search.found[0].rivals = {rival("gas-spring", 1.0, -1.0)};
  EXPECT_EQ(verdict_of(search, curved).word, "ambiguous");
  EXPECT_EQ(verdict_of(search, straight).word, "missing-physics");
  // Where what stays is like noise the evidence tells, whatever the interval.
  search.misfit.evenness = {0.01, 0.02};
  search.further = 1.0;
  EXPECT_EQ(verdict_of(search, straight).word, "ambiguous");
  search = search_of("gas-spring", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("offset-force", 1.0, 30.0)};
  EXPECT_EQ(verdict_of(search, curved).word, "ambiguous");
  EXPECT_EQ(verdict_of(search, straight).word, "ambiguous") << "the evidence and the interval disagree";
  search.found[0].rivals = {rival("offset-force", 1.0, 8.0)};
  const Verdict verdict = verdict_of(search, straight);
  ASSERT_EQ(verdict.word, "missing-physics");
  EXPECT_EQ(verdict.effects[0].id, "offset-force");
}

TEST(Verdict, WhereStructureStaysKinThatComeNearAreNotExcluded) {
  for (const auto& [other, share, predictable, word] :
       {std::tuple{"degradation", 0.93, 0.3, "ambiguous"}, std::tuple{"degradation", 0.93, 0.1, "missing-physics"},
        std::tuple{"degradation", 0.85, 0.3, "missing-physics"},
        std::tuple{"clearance", 0.93, 0.3, "missing-physics"}}) {
    Search search = search_of("self-heating", 1.5 * floor_squares, 30.0 * floor_squares, true);
    search.misfit.predictable = predictable;
    search.found[0].rivals = {rival(other, share, 1500.0)};
    EXPECT_EQ(verdict_of(search, plain).word, word) << other << " " << share << " " << predictable;
  }
}

TEST(Verdict, WhereStructureStaysAGasIsNotToldFromAClearance) {
  const Circumstances told = knowing({{"d_a", "m", 3e-5, 2e-6}, {"f_a", "N", 128.0, 60.0}});
  for (const auto& [structured, share, word] :
       {std::tuple{true, 0.7, "ambiguous"}, std::tuple{true, 0.4, "missing-physics"},
        std::tuple{false, 0.7, "missing-physics"}}) {
    Search search = search_of("entrapped-gas", 1.5 * floor_squares, 30.0 * floor_squares, structured);
    search.found[0].rivals = {rival("clearance", share, 3000.0)};
    EXPECT_EQ(verdict_of(search, told).word, word) << structured << " " << share;
  }
}

TEST(Verdict, AnEffectThatEndsAsAnotherIsNotToldFromIt) {
  Search search = search_of("entrapped-gas", 1.2 * floor_squares, 20.0 * floor_squares);
  search.found[0].rivals = {rival("clearance", 0.9, 600.0)};
  const auto knowing_force = [](std::optional<double> half_width) {
    return knowing({{"d_a", "m", 1.0, 0.01}, {"f_a", "N", 50.0, half_width, "", 30.0}});
  };
  EXPECT_EQ(verdict_of(search, knowing_force(5.0)).word, "missing-physics");
  EXPECT_EQ(verdict_of(search, knowing_force(25.0)).word, "ambiguous");
  const Verdict verdict = verdict_of(search, knowing_force({}));
  ASSERT_EQ(verdict.word, "ambiguous");
  EXPECT_EQ(verdict.effects[0].indistinguishable_from, std::vector<std::string>{"clearance"});
}

TEST(Verdict, AFrictionThatTurnsOverAsSlowlyAsItCanIsNotToldFromShearThinning) {
  Search search = search_of("coulomb-friction", 1.1 * floor_squares, 20.0 * floor_squares);
  search.found[0].rivals = {rival("shear-thinning", 1.03, 4.0)};
  const auto film = [](const std::string& bound) {
    return knowing({{"fc", "N", 20.0, 2.0}, {"v_t", "m/s", 0.03, {}, bound}});
  };
  EXPECT_EQ(verdict_of(search, film("lower")).word, "missing-physics");
  const Verdict verdict = verdict_of(search, film("upper"));
  ASSERT_EQ(verdict.word, "ambiguous");
  EXPECT_EQ(verdict.effects[0].indistinguishable_from, std::vector<std::string>{"shear-thinning"});
}

TEST(Verdict, TheChannelsTellALagOfTheVelocityFromADelayOfTheForce) {
  // The recorded velocity comes 5 ms late.
  const ChannelLag channel{5e-3, 1e-5};
  const Circumstances agreeing = knowing({{"lag", "s", 4.9e-3, 1e-5}}, channel);
  const Circumstances contradicting = knowing({{"lag", "s", 2e-3, 1e-5}}, channel);
  Search search = search_of("sensor-delay", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("velocity-lag", 1.0, 1.0)};
  ASSERT_EQ(verdict_of(search, agreeing).word, "missing-physics");
  EXPECT_EQ(verdict_of(search, agreeing).effects[0].id, "velocity-lag");
  ASSERT_EQ(verdict_of(search, contradicting).word, "missing-physics");
  EXPECT_EQ(verdict_of(search, contradicting).effects[0].id, "sensor-delay");
  search = search_of("velocity-lag", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("sensor-delay", 1.0, 1.0)};
  EXPECT_EQ(verdict_of(search, agreeing).word, "missing-physics");
  EXPECT_EQ(verdict_of(search, contradicting).word, "ambiguous");
  // What stays is no doubt of what the channels show.
  search = search_of("velocity-lag", 5.0 * floor_squares, 1.0 * floor_squares, true);
  EXPECT_EQ(verdict_of(search, agreeing).word, "missing-physics");
  EXPECT_EQ(verdict_of(search, contradicting).word, "unattributed");
}

TEST(Verdict, IsTheSameFromItsWrittenEvidence) {
  Search search = search_of("gas-spring", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("offset-force", 1.0, 8.0), rival("linear-stiffness", 0.3, 3000.0)};
  search.found[0].locality = Locality{0.1, 30.0, 2.0, 1.0};
  search.further = 4.0;
  search.misfit.evenness = {0.01, 0.02};
  search.tried = "gas-spring";
  search.trials = {{"behind lugre", 0.9, 900.0}};
  const Circumstances straight = knowing({{"f_g", "N", 100.0, 1.0}, {"g", "1/m", 10.0, 12.0}});
  for (const Circumstances& known : {plain, straight}) {
    for (const std::string doubt : {"", "the recorded velocity is not the slope of the displacement"}) {
      Findings findings = findings_of(search, known);
      findings.doubt_of_data = doubt;
      const nlohmann::json written = findings_json(findings);
      const Findings again = findings_from(nlohmann::json::parse(written.dump()));
      EXPECT_EQ(findings_json(again), written);
      const Verdict a = hysteron::verdict_of(findings);
      const Verdict b = hysteron::verdict_of(again);
      EXPECT_EQ(a.word, b.word);
      EXPECT_EQ(a.effects.size(), b.effects.size());
      EXPECT_EQ(a.effects.empty(), !doubt.empty());
    }
  }
  // The offset force is named in place of the gas spring, so that its fit is the rival's.
  search.found[0].rivals[0].fit.what.effects = {"offset-force"};
  EXPECT_EQ(fit_of(search, verdict_of(search, straight).effects[0]).what.effects,
            std::vector<std::string>{"offset-force"});
}

}  // namespace
}  // namespace hysteron
