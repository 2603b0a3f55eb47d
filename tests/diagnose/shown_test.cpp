#include "diagnose/shown.hpp"

#include <gtest/gtest.h>

#include "diagnose/account.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"

namespace hysteron {
namespace {

Signature signature(const std::string& id, const std::string& effect, double z) {
  return {id, "what " + id + " is", "N", 20.0, 20.0 / z, z, 0.75, 1.0, 8, {effect}, {1}, false};
}

TEST(Shown, IsWhatSpeaksAndHasNoName) {
  Evidence evidence;
  evidence.model = "bouc-wen";
  evidence.signatures = {signature("quiet", "compliance", 2.5), signature("named", "inertia", 9.0),
                         signature("loud", "stiction", 4.0), signature("louder", "pinching", 6.0)};
  Named mass;
  mass.id = "inertia";
  EXPECT_EQ(
      sentence_of_contrasts(evidence, {mass}),
      "Whatever the cause, the residual of bouc-wen shows: what louder is, 20 N (6 of 8 recordings); what loud is, "
      "20 N (6 of 8 recordings).");
  evidence.signatures.resize(2);
  EXPECT_EQ(sentence_of_contrasts(evidence, {mass}), "");
}

// A mass that is left out shows as a lag too.
TEST(Shown, IsNotWhatANameExplainsByTheWay) {
  Evidence evidence;
  evidence.model = "bouc-wen";
  evidence.signatures = {signature("lag", "sensor-delay", 4.0), signature("loud", "stiction", 6.0)};
  evidence.signatures_left = {signature("lag", "sensor-delay", 0.5), signature("loud", "stiction", 4.0)};
  Named mass;
  mass.id = "inertia";
  const std::string loud = "what loud is, 20 N (6 of 8 recordings)";
  mass.grade = Grade::supported;
  EXPECT_EQ(sentence_of_contrasts(evidence, {mass}),
            "Whatever the cause, the residual of bouc-wen shows: " + loud + ".");
  mass.grade = Grade::suggested;
  EXPECT_EQ(sentence_of_contrasts(evidence, {mass}),
            "Whatever the cause, the residual of bouc-wen shows: " + loud + "; what lag is, 20 N (6 of 8 recordings).");
}

TEST(Shown, SaysWhatIsGoneBehindTheLawThatTakesThePlace) {
  Evidence asked;
  asked.model = "bouc-wen";
  asked.signatures = {signature("rest", "series-dashpot", 4.0), signature("travel", "compliance", 5.0),
                      signature("first", "stiction", 3.5), signature("speed", "shear-thinning", 1.0)};
  Evidence evidence;
  evidence.model = "modified-bouc-wen";
  evidence.signatures = {signature("rest", "series-dashpot", 0.5), signature("travel", "compliance", 3.2),
                         signature("speed", "shear-thinning", 3.3)};
  evidence.behind_asked = {asked};
  EXPECT_EQ(
      sentence_of_contrasts(evidence, {}),
      "Whatever the cause, the residual of bouc-wen shows: what travel is, 20 N (6 of 8 recordings); what rest is, "
      "20 N (6 of 8 recordings; absent with modified-bouc-wen); what first is, 20 N (6 of 8 recordings; absent with "
      "modified-bouc-wen). The residual of modified-bouc-wen also shows: what speed is, 20 N (6 of 8 "
      "recordings).");
  evidence.behind_asked.front().signatures.clear();
  evidence.signatures.resize(2);
  EXPECT_EQ(sentence_of_contrasts(evidence, {}),
            "Whatever the cause, the residual of modified-bouc-wen shows: what travel is, 20 N (6 of 8 recordings).");
}

TEST(Shown, ACurvatureOverTheDriveIsOneValueInItsUnit) {
  Evidence evidence;
  evidence.model = "bouc-wen";
  evidence.signatures = {signature("bend", "magnetic-saturation", 4.0), signature("first", "stiction", 3.5)};
  evidence.signatures[0].unit = "N per drive squared";
  evidence.signatures[0].of_all = true;
  Candidate candidate;
  candidate.signatures = evidence.signatures;
  evidence.candidates = {candidate};
  name_units(evidence, DriveKind::voltage);
  EXPECT_EQ(sentence_of_contrasts(evidence, {}),
            "Whatever the cause, the residual of bouc-wen shows: what bend is, 20 N/V^2 (one value of all 8 "
            "recordings); what first is, 20 N (6 of 8 recordings).");
  EXPECT_EQ(evidence.candidates[0].signatures[0].unit, "N/V^2");
  EXPECT_EQ(evidence.signatures[1].unit, "N");
  evidence.signatures[0].unit = "N per drive squared";
  name_units(evidence, DriveKind::current);
  EXPECT_EQ(evidence.signatures[0].unit, "N/A^2");
}

// A dashpot that friction explains as well, and compliance less; a mass that nothing else explains.
Evidence of_dashpot_and_mass() {
  Candidate dashpot;
  dashpot.id = "series-dashpot";
  for (const auto& [id, share] : {std::pair{"seal-friction", 0.9}, std::pair{"compliance", 0.6}}) {
    Contender row;
    row.id = id;
    row.share = share;
    dashpot.contenders.push_back(row);
  }
  Candidate mass;
  mass.id = "inertia";
  Evidence evidence;
  evidence.candidates = {mass, dashpot};
  return evidence;
}

Named named(const std::string& id, std::size_t candidate, double confidence) {
  Named result;
  result.id = id;
  result.candidate = candidate;
  result.confidence = confidence;
  result.grade = grade_of(confidence);
  return result;
}

TEST(NearestRival, IsNoneThatDoesAsWellAndIsLessLikely) {
  const Evidence evidence = of_dashpot_and_mass();
  Named dashpot = named("series-dashpot", 1, 0.6);
  EXPECT_EQ(nearest_rival(dashpot, evidence)->id, "seal-friction");
  dashpot.less_likely = {"seal-friction"};
  EXPECT_EQ(nearest_rival(dashpot, evidence)->id, "compliance");
  dashpot.less_likely = {"compliance"};
  dashpot.indistinguishable_from = {"seal-friction"};
  EXPECT_EQ(nearest_rival(dashpot, evidence), nullptr);
}

TEST(NextRecording, DecidesBetweenTheLikeliestAndItsRival) {
  const Evidence evidence = of_dashpot_and_mass();
  const auto advice = [&](const Verdict& verdict) {
    return experiment_to_decide(verdict, evidence, DriveKind::current);
  };
  const std::string of_dashpot(knowledge_of("series-dashpot").experiment);
  const std::string title = title_of("series-dashpot");
  Verdict verdict;
  // Strongest first, which need not be the likeliest.
  verdict.suggestions = {named("inertia", 0, 0.55), named("series-dashpot", 1, 0.6)};
  EXPECT_EQ(advice(verdict),
            of_dashpot + "; it would show whether there is " + title + " and not " + title_of("seal-friction"));
  verdict.suggestions[1].less_likely = {"compliance"};
  EXPECT_EQ(advice(verdict),
            of_dashpot + "; it would show whether there is " + title + " and not " + title_of("compliance"));
  verdict.effects = {named("series-dashpot", 1, 0.9)};
  verdict.suggestions.pop_back();
  EXPECT_EQ(advice(verdict), of_dashpot + "; it would confirm " + title + " against " + title_of("seal-friction"));
  verdict.effects[0].indistinguishable_from = {"seal-friction"};
  EXPECT_EQ(advice(verdict), of_dashpot + "; it would tell " + title + " and " + title_of("seal-friction") + " apart");
  verdict.effects = {named("inertia", 0, 0.9)};
  verdict.suggestions = {named("series-dashpot", 1, 0.6)};
  EXPECT_TRUE(advice(verdict).ends_with("; it would confirm " + title_of("inertia"))) << advice(verdict);
  // Nothing stated: the likeliest shape.
  verdict = {};
  verdict.doubtful = {named("inertia", 0, 0.2), named("series-dashpot", 1, 0.4)};
  EXPECT_TRUE(advice(verdict).starts_with(of_dashpot));
}

}  // namespace
}  // namespace hysteron
