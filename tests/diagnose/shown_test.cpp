#include "diagnose/shown.hpp"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

Signature signature(const std::string& id, const std::string& effect, double z) {
  return {id, "what " + id + " is", "N", 20.0, 20.0 / z, z, 0.75, 1.0, 8, {effect}, {1}};
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
  evidence.signatures = {signature("drive-bend", "magnetic-saturation", 4.0), signature("first", "stiction", 3.5)};
  Candidate candidate;
  candidate.signatures = evidence.signatures;
  evidence.candidates = {candidate};
  name_units(evidence, DriveKind::voltage);
  EXPECT_EQ(sentence_of_contrasts(evidence, {}),
            "Whatever the cause, the residual of bouc-wen shows: what drive-bend is, 20 N/V^2 (one value of all 8 "
            "recordings); what first is, 20 N (6 of 8 recordings).");
  EXPECT_EQ(evidence.candidates[0].signatures[0].unit, "N/V^2");
  name_units(evidence, DriveKind::current);
  EXPECT_EQ(evidence.signatures[0].unit, "N/A^2");
  EXPECT_EQ(evidence.signatures[1].unit, "N");
}

}  // namespace
}  // namespace hysteron
