// diagnosis.json against the public contract, on campaigns in which something is missing, nothing is, or what is has no
// equation.
#include "diagnose/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "diagnose/concealed_damper.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/summary.hpp"

namespace hysteron {
namespace {

using nlohmann::json;
using testing::campaign_with;
using testing::diagnosis_of;
using testing::few;

void expect_share(const json& row, const char* name) {
  ASSERT_TRUE(row.contains(name) && row[name].is_number()) << name << " of " << row.dump();
  EXPECT_GE(row[name].get<double>(), 0.0) << name;
  EXPECT_LE(row[name].get<double>(), 1.0) << name;
}

void expect_positive(const json& row, const char* name) {
  ASSERT_TRUE(row.contains(name) && row[name].is_number()) << name << " of " << row.dump();
  EXPECT_GT(row[name].get<double>(), 0.0) << name;
}

void expect_text(const json& row, const char* name) {
  ASSERT_TRUE(row.contains(name) && row[name].is_string()) << name << " of " << row.dump();
  const auto text = row[name].get<std::string>();
  EXPECT_FALSE(text.empty()) << name;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  EXPECT_EQ(text.find_first_of("[]|"), std::string::npos) << "mark-up of a card reached a reader: " << text;
}

void expect_parameters(const json& rows) {
  ASSERT_TRUE(rows.is_array());
  for (const json& row : rows) {
    expect_text(row, "name");
    expect_text(row, "unit");
    ASSERT_TRUE(row.at("value").is_number());
    if (row.at("ci95").is_null()) {
      continue;
    }
    ASSERT_EQ(row["ci95"].size(), 2U);
    EXPECT_LE(row["ci95"][0].get<double>(), row["value"].get<double>());
    EXPECT_GE(row["ci95"][1].get<double>(), row["value"].get<double>());
  }
}

void expect_contrast(const json& contrast) {
  if (contrast.is_null()) {
    return;
  }
  expect_text(contrast, "what");
  expect_text(contrast, "unit");
  ASSERT_TRUE(contrast.at("value").is_number());
  expect_positive(contrast, "std_error");
  expect_share(contrast, "placebo_quantile");
  ASSERT_TRUE(contrast.at("recordings").is_number_unsigned());
  EXPECT_EQ(contrast.at("of_recordings").size(), contrast["recordings"].get<std::size_t>());
}

void expect_named(const json& row, double least, double most) {
  expect_text(row, "id");
  expect_text(row, "family");
  expect_text(row, "sentence");
  expect_text(row, "experiment");
  ASSERT_TRUE(row.contains("rig_cause"));
  if (!row["rig_cause"].is_null()) expect_text(row, "rig_cause");
  expect_share(row, "confidence");
  EXPECT_GE(row["confidence"].get<double>(), least);
  EXPECT_LT(row["confidence"].get<double>(), most);
  EXPECT_EQ(row.at("grade"), row["confidence"] >= 0.95   ? "established"
                             : row["confidence"] >= 0.80 ? "supported"
                                                         : "suggested");
  expect_share(row, "confidence_alone");
  expect_share(row, "robustness_value");
  expect_share(row, "share_of_misfit");
  expect_positive(row, "nrmse_heldout_before");
  expect_positive(row, "nrmse_heldout_after");
  expect_parameters(row.at("parameters"));
  expect_contrast(row.at("contrast"));
  for (const json& other : row.at("indistinguishable_from")) {
    EXPECT_NE(other, row["id"]);
  }
  ASSERT_TRUE(row.contains("nearest_rival"));
  if (!row["nearest_rival"].is_null()) {
    expect_text(row["nearest_rival"], "id");
    expect_share(row["nearest_rival"], "share_of_gain");
  }
  for (const json& law : row.at("behind_other_laws")) {
    expect_text(law, "model");
    expect_share(law, "share_of_gain");
    EXPECT_FALSE(is_part_of(row["id"], law["model"])) << "that law has it as a part of its own and cannot lose it";
  }
  ASSERT_TRUE(row.at("view").is_object()) << "a name that cannot be looked at";
  EXPECT_LT(row["view"].at("from").get<double>(), row["view"].at("to").get<double>());
}

void expect_contract(const Diagnosis& diagnosis) {
  const json record = json::parse(diagnosis_json(diagnosis).dump());
  EXPECT_EQ(record.at("schema"), "hysteron.diagnosis/2");
  for (const char* name : {"nrmse_fit", "nrmse_heldout", "noise_floor_nrmse"}) {
    expect_positive(record.at("baseline"), name);
  }
  expect_text(record["baseline"], "model");
  const std::set<std::string> verdicts = {"complete", "missing-physics", "ambiguous", "unattributed"};
  ASSERT_TRUE(verdicts.contains(record.at("verdict").get<std::string>()));
  expect_share(record, "unknown_share");
  expect_text(record, "next_experiment");
  ASSERT_GE(record.at("summary").size(), 2U);
  for (const json& sentence : record["summary"]) {
    EXPECT_TRUE(sentence.get<std::string>().ends_with(".")) << sentence;
  }
  EXPECT_TRUE(record["summary"].back().get<std::string>().starts_with("Next recording: "));

  const auto likeliest = [](const json& a, const json& b) { return a["confidence"] < b["confidence"]; };
  std::vector<json> stated = record.at("effects");
  for (const json& row : record.at("suggestions")) stated.push_back(row);
  const auto first = std::max_element(stated.begin(), stated.end(), likeliest);
  const bool told = first != stated.end() && !(*first)["rig_cause"].is_null();
  const auto outside = std::count_if(record["summary"].begin(), record["summary"].end(), [](const json& sentence) {
    return sentence.get<std::string>().find(" may also come from outside the damper: ") != std::string::npos;
  });
  EXPECT_EQ(outside, told ? 1 : 0);

  std::set<std::string> accounted;
  for (const json& row : record.at("effects")) {
    expect_named(row, 0.80, 1.01);
    accounted.insert(row["id"]);
  }
  for (const json& row : record.at("suggestions")) {
    expect_named(row, 0.50, 0.80);
    accounted.insert(row["id"]);
  }
  std::set<std::string> rejected;
  for (const json& row : record.at("rejected")) {
    expect_text(row, "id");
    expect_text(row, "reason");
    EXPECT_FALSE(row.contains("p")) << "a p value that is not calibrated";
    EXPECT_TRUE(rejected.insert(row["id"]).second) << row["id"] << " has two reasons";
    EXPECT_FALSE(accounted.contains(row["id"])) << row["id"] << " is named and rejected";
  }
  accounted.merge(rejected);
  for (const std::string& held : diagnosis.final.what.effects) {
    EXPECT_TRUE(accounted.contains(held)) << held << " is in model.json and in no list";
  }
  for (const json& row : record.at("locations")) {
    expect_text(row, "where");
    expect_text(row, "variable");
    expect_share(row, "share_of_misfit");
    expect_share(row, "share_of_samples");
    EXPECT_LE(row.at("from").get<double>(), row.at("to").get<double>());
    EXPECT_FALSE(row.at("recordings").empty());
  }
  for (const json& row : record.at("not_observable")) {
    expect_text(row, "id");
    expect_text(row, row.contains("reason") ? "reason" : "detection_limit");
  }
  expect_positive(record.at("augmented"), "nrmse_fit");
  expect_positive(record["augmented"], "nrmse_heldout");
  EXPECT_TRUE(record["augmented"].at("remaining_structure").is_boolean());
  for (const json& row : record["augmented"].at("shapes")) {
    expect_text(row, "id");
    expect_share(row, "confidence");
    expect_parameters(row.at("parameters"));
    expect_contrast(row.at("contrast"));
  }
}

std::string paragraph(const Diagnosis& diagnosis) {
  std::string text;
  for (const std::string& sentence : diagnosis.summary) {
    text += sentence + " ";
  }
  return text;
}

// The mass is not looked for: its contrast is told, and nothing is named for it.
TEST(Record, AContrastThatNoNameAccountsForIsTold) {
  const Campaign campaign = campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01);
  const std::string told = paragraph(*diagnosis_of(campaign, {"offset-force", "force-drift"}));
  EXPECT_NE(told.find("Whatever the cause, the residual of bouc-wen shows: "), std::string::npos) << told;
  EXPECT_NE(told.find("force per acceleration, "), std::string::npos) << told;
  const std::string named = paragraph(*diagnosis_of(campaign, few));
  EXPECT_EQ(named.find("force per acceleration, "), std::string::npos) << named;
}

TEST(Record, OfAMissingMass) {
  const auto diagnosis = diagnosis_of(campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01), few);
  expect_contract(*diagnosis);
  const json record = diagnosis_json(*diagnosis);
  ASSERT_EQ(record["effects"].size(), 1U);
  const json& mass = record["effects"][0];
  EXPECT_EQ(mass["family"], "phase");
  EXPECT_EQ(mass["contrast"]["id"], "acceleration");
  EXPECT_NEAR(mass["contrast"]["value"].get<double>(), 8.0, 1.0);
  EXPECT_TRUE(mass["contrast"]["shown"]);
  EXPECT_LT(record["unknown_share"].get<double>(), 0.1);
  const std::string text = paragraph(*diagnosis);
  EXPECT_NE(text.find("the inertia of fluid, rod or fixture, m = "), std::string::npos) << text;
  EXPECT_NE(text.find("in 5 of 5 recordings"), std::string::npos) << text;
  EXPECT_NE(text.find("takes the held-out error from "), std::string::npos) << text;
  EXPECT_NE(text.find("unmodelled physics would have to explain"), std::string::npos) << text;
  EXPECT_EQ(text.find("current"), std::string::npos) << "these recordings have no drive: " << text;
}

// Every sentence is true of what it speaks of: an effect of what it does itself, the names of what is named.
TEST(Record, SaysOfNoEffectWhatALawDoes) {
  const auto diagnosis = diagnosis_of(campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01), few);
  EXPECT_NE(paragraph(*diagnosis).find("It takes the held-out error"), std::string::npos) << paragraph(*diagnosis);
  Diagnosis changed = *diagnosis;
  changed.search.richer = {"f0", "c0", "f0"};
  changed.verdict.unknown_share = 0.9;
  changed.search.misfit.structure = 0.1 * changed.search.base_misfit.structure;
  changed.summary = summary_of(changed);
  const std::string richer = paragraph(changed);
  EXPECT_NE(richer.find("The augmented model, with a richer dependence of c0 and f0 on the drive, takes the held-out"),
            std::string::npos)
      << richer;
  EXPECT_NE(richer.find("80 % goes with a richer dependence of c0 and f0 on the drive."), std::string::npos) << richer;
  // The item on an effect says of the same figures that held-out recordings do not show it.
  changed.search.base.heldout = 0.0531;
  changed.search.augmented.heldout = 0.0525;
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find(" hardly changes the held-out error: 0.053 before, 0.052 after ("),
            std::string::npos)
      << paragraph(changed);
  // A law that needs no effect is told.
  ASSERT_FALSE(changed.evidence.other_laws.empty());
  EXPECT_EQ(paragraph(changed).find("alone describes the recordings as well"), std::string::npos);
  OtherLaw& other = changed.evidence.other_laws.front();
  other.squares = 0.9 * changed.evidence.augmented_compared;
  other.has_what_was_found = false;
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("But " + other.model +
                                    " alone describes the recordings as well: they do not tell "
                                    "whether " +
                                    changed.evidence.model + " lacks an effect or is the wrong law."),
            std::string::npos)
      << paragraph(changed);
  // What a name and a shape both explain counts in the share of each.
  changed = *diagnosis;
  changed.verdict.unknown_share = 0.2;
  changed.verdict.doubtful.emplace_back().id = "force-drift";
  changed.verdict.doubtful.back().share_of_misfit = 0.2;
  changed.shapes.emplace_back();
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("has no name: it stays or is the part of unnamed shapes in what names and shapes "
                                    "explain together."),
            std::string::npos)
      << paragraph(changed);
  // Neither are suggestions names behind a law that takes the place of the one asked for.
  changed = *diagnosis;
  changed.verdict.unknown_share = 0.2;
  changed.search.augmented.what.model = "lugre";
  changed.verdict.suggestions = changed.verdict.effects;
  changed.parameters.insert(changed.parameters.end(), diagnosis->parameters.begin(), diagnosis->parameters.end());
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("is explained by nothing named or suggested; the rest is explained by lugre and "
                                    "what is named or suggested."),
            std::string::npos)
      << paragraph(changed);
  // A suggestion is no name.
  changed = *diagnosis;
  changed.verdict.unknown_share = 0.0;
  changed.verdict.suggestions = std::move(changed.verdict.effects);
  changed.verdict.effects.clear();
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("is explained by what is suggested."), std::string::npos) << paragraph(changed);
  EXPECT_EQ(paragraph(changed).find("has a name"), std::string::npos) << paragraph(changed);
}

TEST(Record, SaysWhatItsNumbersAreOf) {
  const auto diagnosis = diagnosis_of(campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01), few);
  Diagnosis changed = *diagnosis;
  Location place;
  place.where = "speed above 20 mm/s";
  place.variable = "speed";
  place.share_of_misfit = 0.7;
  place.share_of_samples = 0.2;
  changed.locations_left = {place};
  changed.noise_floor_method = NoiseMethod::cycles;
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("(noise 0."), std::string::npos) << paragraph(changed);
  EXPECT_NE(paragraph(changed).find("is above 20 mm/s (20 % of the samples, each recording weighing the same)."),
            std::string::npos)
      << paragraph(changed);
  changed.noise_floor_method = NoiseMethod::mixed;
  changed.noise_floor_heldout = 0.9 * changed.search.augmented.heldout;
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("(noise at least 0."), std::string::npos) << "slow noise is not seen everywhere";
  changed.noise_floor_heldout = 1.1 * changed.search.augmented.heldout;
  changed.summary = summary_of(changed);
  EXPECT_NE(paragraph(changed).find("(noise about 0."), std::string::npos) << "an error below what is at least there";
}

TEST(Record, WhereNothingIsMissing) {
  const auto diagnosis = diagnosis_of(campaign_with({}, {}, 0.02), few);
  expect_contract(*diagnosis);
  const json record = diagnosis_json(*diagnosis);
  EXPECT_EQ(record["verdict"], "complete");
  EXPECT_EQ(record["unknown_share"], 0.0);
  EXPECT_EQ(paragraph(*diagnosis).find("no name"), std::string::npos) << paragraph(*diagnosis);
}

// A spring that the weak range does not act on is told from the law's own, on which it does: none is missing.
TEST(Record, OfWhatTheLawHasOfItsOwn) {
  const auto diagnosis = diagnosis_of(campaign_with({"pinching", "linear-stiffness"},
                                                    {{"k0", 0.0},
                                                     {"pinching.p", 0.6},
                                                     {"pinching.x_p", 1e-3},
                                                     {"pinching.w", 2e-3},
                                                     {"pinching.q", 2.0},
                                                     {"linear-stiffness.k", 2e4}},
                                                    0.005),
                                      {"pinching", "linear-stiffness", "quadratic-damping"});
  const json record = diagnosis_json(*diagnosis);
  ASSERT_EQ(record["effects"].size(), 1U);
  EXPECT_EQ(record["effects"][0]["id"], "pinching");
  ASSERT_EQ(record["augmented"]["shapes"].size(), 1U);
  EXPECT_EQ(record["augmented"]["shapes"][0]["id"], "linear-stiffness");
  EXPECT_EQ(record["augmented"]["shapes"][0]["confidence"], 0.0);
  EXPECT_NE(paragraph(*diagnosis).find("beside what bouc-wen has of its own: nothing of it is missing."),
            std::string::npos)
      << paragraph(*diagnosis);
}

TEST(Record, OfACauseThatIsNotAmongTheCandidates) {
  const auto diagnosis = diagnosis_of(campaign_with({"cubic-stiffness"}, {{"cubic-stiffness.k3", 9e7}}, 0.01),
                                      {"force-drift", "quadratic-damping", "sensor-delay"});
  expect_contract(*diagnosis);
  const json record = diagnosis_json(*diagnosis);
  EXPECT_EQ(record["verdict"], "unattributed");
  EXPECT_EQ(record["unknown_share"], 1.0);
  const std::string text = paragraph(*diagnosis);
  EXPECT_TRUE(text.starts_with("Physics is missing, but no effect is certain enough to name")) << text;
  Diagnosis of_few_values = *diagnosis;
  of_few_values.too_few_values = true;
  of_few_values.summary = summary_of(of_few_values);
  EXPECT_TRUE(paragraph(of_few_values).starts_with("Whether physics is missing cannot be told: "));
  Diagnosis of_a_tone = *diagnosis;
  of_a_tone.tone_doubts = true;
  of_a_tone.summary = summary_of(of_a_tone);
  EXPECT_TRUE(paragraph(of_a_tone).starts_with("More than noise is left, of the damper or of the rig: "));
  EXPECT_EQ(text.find("current"), std::string::npos) << "these recordings have no drive: " << text;
  Diagnosis of_shapes = *diagnosis;
  for (const auto& [id, confidence] : {std::pair("inertia", 0.31), {"force-drift", 0.2}}) {
    Named& shape = of_shapes.verdict.doubtful.emplace_back();
    shape.id = id;
    shape.confidence = confidence;
    of_shapes.shapes.emplace_back();
  }
  of_shapes.summary = summary_of(of_shapes);
  EXPECT_NE(paragraph(of_shapes).find("has no name"), std::string::npos);
  EXPECT_NE(paragraph(of_shapes).find("(31 %); a drift of the load cell"), std::string::npos) << paragraph(of_shapes);
}

}  // namespace
}  // namespace hysteron
