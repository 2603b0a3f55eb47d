// The scorer on diagnoses written by hand.
#include "challenge/score.hpp"

#include <gtest/gtest.h>

#include <set>

#include "report/challenge.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;

json answer(const std::string& level, const std::vector<std::string>& effects, double detectability = 1e4) {
  json result = {{"campaign", "campaign-0001"},
                 {"level", level},
                 {"design", "mixed"},
                 {"disturbance", ""},
                 {"acceptable", json::array()},
                 {"effects", json::array()},
                 {"noise", {{"share_of_peak", 0.01}}},
                 {"floor_nrmse_heldout", 0.01}};
  const json parameter = {{"name", "m"}, {"value", 2.0}, {"unit", "kg"}};
  for (const std::string& id : effects) {
    result["effects"].push_back({{"id", id},
                                 {"foreign", id.starts_with("foreign:")},
                                 {"excited", true},
                                 {"share_of_peak", 0.1},
                                 {"left_nrmse", 0.02},
                                 {"detectability", detectability},
                                 {"parameters", json::array({parameter})}});
  }
  return result;
}

json diagnosis(const std::string& verdict, const json& effects = json::array()) {
  return {{"verdict", verdict},
          {"effects", effects},
          {"baseline", {{"nrmse_heldout", 0.03}}},
          {"augmented", {{"nrmse_heldout", 0.0105}}}};
}

json named(const std::string& id, const std::vector<std::string>& rivals = {}) {
  return {{"id", id}, {"confidence", 0.96}, {"indistinguishable_from", rivals}};
}

std::string outcome(const json& truth, const json& said) {
  return score_campaign(truth, said).at("outcome").get<std::string>();
}

TEST(Score, OneCause) {
  const json truth = answer("plain", {"inertia"});
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("inertia")}))), "right");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("sensor-delay")}))), "wrong");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("inertia"), named("asymmetry")}))), "wrong");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("sensor-delay", {"inertia"})}))),
            "in a set");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("sensor-delay", {"asymmetry"})}))), "wrong");
  EXPECT_EQ(outcome(truth, diagnosis("ambiguous", json::array({named("inertia", {"sensor-delay"})}))), "in a set");
  EXPECT_EQ(outcome(truth, diagnosis("ambiguous", json::array({named("asymmetry", {"sensor-delay"})}))), "abstained");
  EXPECT_EQ(outcome(truth, diagnosis("unattributed")), "abstained");
  EXPECT_EQ(outcome(truth, diagnosis("complete")), "missed");
  EXPECT_EQ(outcome(truth, nullptr), "failed");
}

TEST(Score, CauseThatCannotBeSeen) {
  const json truth = answer("unexcited", {"inertia"}, 0.5);
  EXPECT_EQ(outcome(truth, diagnosis("complete")), "right");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("inertia")}))), "right");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("asymmetry")}))), "wrong");
  EXPECT_EQ(outcome(truth, diagnosis("unattributed")), "abstained");
}

TEST(Score, TwoCauses) {
  const json truth = answer("pairs", {"inertia", "end-stop"});
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("end-stop"), named("inertia")}))), "right");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("end-stop")}))), "part");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("end-stop"), named("asymmetry")}))),
            "wrong");
  EXPECT_EQ(outcome(truth,
                    diagnosis("missing-physics", json::array({named("end-stop"), named("sensor-delay", {"inertia"})}))),
            "in a set");
}

TEST(Score, ForeignCausesAreToBeRefused) {
  const json truth = answer("foreign", {"foreign:slip-lock"});
  EXPECT_EQ(outcome(truth, diagnosis("unattributed")), "right");
  EXPECT_EQ(outcome(truth, diagnosis("missing-physics", json::array({named("clearance")}))), "wrong");
  EXPECT_EQ(outcome(truth, diagnosis("ambiguous", json::array({named("clearance", {"entrapped-gas"})}))), "abstained");
  EXPECT_EQ(outcome(truth, diagnosis("complete")), "missed");
}

json graded(const std::string& id, const std::string& grade, double confidence,
            const std::vector<std::string>& rivals = {}) {
  return {{"id", id}, {"grade", grade}, {"confidence", confidence}, {"indistinguishable_from", rivals}};
}

json diagnosis_2(const std::string& verdict, const json& effects, const json& suggestions) {
  json result = diagnosis(verdict, effects);
  result["schema"] = "hysteron.diagnosis/2";
  result["suggestions"] = suggestions;
  return result;
}

TEST(Score, SuggestionsAreNoNames) {
  const json truth = answer("plain", {"inertia"});
  const json wrong_suggestion = json::array({graded("asymmetry", "suggested", 0.6)});
  const json row = score_campaign(
      truth, diagnosis_2("missing-physics", json::array({graded("inertia", "supported", 0.85)}), wrong_suggestion));
  EXPECT_EQ(row.at("outcome"), "right");
  ASSERT_EQ(row.at("answer").size(), 2U);
  EXPECT_EQ(row.at("answer")[0].at("grade"), "supported");
  EXPECT_EQ(row.at("answer")[0].at("right"), true);
  EXPECT_EQ(row.at("answer")[1].at("name"), false);
  EXPECT_EQ(row.at("answer")[1].at("right"), false);
  EXPECT_EQ(outcome(truth, diagnosis_2("unattributed", json::array(), wrong_suggestion)), "abstained");
  EXPECT_EQ(outcome(answer("none", {}), diagnosis_2("complete", json::array(), wrong_suggestion)), "right");
  // A set that is graded is a name, whatever the verdict.
  const auto with_set = [](const std::vector<std::string>& rivals) {
    return diagnosis_2("ambiguous", json::array({graded("degradation", "established", 0.97, rivals)}), json::array());
  };
  EXPECT_EQ(outcome(truth, with_set({"inertia"})), "in a set");
  EXPECT_EQ(outcome(truth, with_set({"self-heating"})), "wrong");
}

TEST(Score, ASetIsOneStatementThoughItHasARowForEachMember) {
  const json set = json::array({graded("inertia", "supported", 0.9, {"sensor-delay", "compliance"}),
                                graded("sensor-delay", "supported", 0.9, {"inertia", "compliance"}),
                                graded("asymmetry", "supported", 0.8)});
  const json row = score_campaign(answer("plain", {"inertia"}), diagnosis_2("missing-physics", set, json::array()));
  ASSERT_EQ(row.at("answer").size(), 2U);
  EXPECT_EQ(row.at("answer")[0].at("set").size(), 3U);
  EXPECT_EQ(row.at("answer")[1].at("id"), "asymmetry");
}

TEST(Score, BesideForeignCausesOneNameIsEnough) {
  const json truth = answer("beside", {"inertia", "end-stop", "foreign:cogging"});
  const auto said = [&](const json& effects) {
    return outcome(truth, diagnosis_2("missing-physics", effects, json::array()));
  };
  EXPECT_EQ(said(json::array({graded("inertia", "supported", 0.9)})), "right");
  EXPECT_EQ(said(json::array({graded("sensor-delay", "supported", 0.9, {"inertia"})})), "in a set");
  EXPECT_EQ(said(json::array({graded("inertia", "supported", 0.9), graded("asymmetry", "supported", 0.8)})), "wrong");
  EXPECT_EQ(outcome(truth, diagnosis_2("unattributed", json::array(), json::array())), "abstained");
  EXPECT_EQ(outcome(truth, diagnosis("complete")), "missed");
  const json alone = answer("foreign", {"foreign:cogging"});
  EXPECT_EQ(outcome(alone, diagnosis_2("ambiguous", json::array(), json::array({graded("inertia", "suggested", 0.5)}))),
            "right");
}

TEST(Score, NegativeControlsAndWrongBases) {
  EXPECT_EQ(outcome(answer("none", {}), diagnosis("complete")), "right");
  EXPECT_EQ(outcome(answer("none", {}), diagnosis("unattributed")), "abstained");
  EXPECT_EQ(outcome(answer("none", {}), diagnosis("missing-physics", json::array({named("inertia")}))), "wrong");
  json other = answer("wrong-base", {});
  other["acceptable"] = json::array({"series-dashpot"});
  EXPECT_EQ(outcome(other, diagnosis("unattributed")), "right");
  EXPECT_EQ(outcome(other, diagnosis("missing-physics", json::array({named("series-dashpot")}))), "right");
  EXPECT_EQ(outcome(other, diagnosis("missing-physics", json::array({named("inertia")}))), "wrong");
}

TEST(Score, ParametersAreComparedByName) {
  json effect = named("inertia");
  effect["parameters"] = json::array({{{"name", "m"}, {"value", 2.2}, {"unit", "kg"}, {"ci95", {1.9, 2.5}}},
                                      {{"name", "tau"}, {"value", 1.0}, {"unit", "s"}, {"ci95", nullptr}}});
  const json scored = score_campaign(answer("plain", {"inertia"}), diagnosis("missing-physics", json::array({effect})));
  ASSERT_EQ(scored.at("parameters").size(), 1u);
  EXPECT_NEAR(scored.at("parameters")[0].at("relative_error").get<double>(), 0.1, 1e-12);
  EXPECT_EQ(scored.at("parameters")[0].at("inside_ci95"), true);
  effect["parameters"][0]["ci95"] = {2.1, 2.3};
  const json missed = score_campaign(answer("plain", {"inertia"}), diagnosis("missing-physics", json::array({effect})));
  json other = scored;
  other["parameters"][0]["name"] = "tau";
  const json rows = summarise(json::array({scored, missed, other})).at("parameters");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("inside_ci95").at("hits"), 1);
  EXPECT_EQ(rows[0].at("inside_ci95").at("trials"), 2);
  EXPECT_EQ(rows[2].at("parameter"), "all");
  EXPECT_EQ(rows[2].at("inside_ci95").at("hits"), 2);
  EXPECT_EQ(rows[2].at("inside_ci95").at("trials"), 3);
}

TEST(Summary, CountsWhatWasScored) {
  json campaigns = json::array();
  const auto add = [&](const json& truth, const json& said) { campaigns.push_back(score_campaign(truth, said)); };
  add(answer("plain", {"inertia"}), diagnosis("missing-physics", json::array({named("inertia")})));
  add(answer("plain", {"inertia"}), diagnosis("missing-physics", json::array({named("asymmetry")})));
  add(answer("plain", {"inertia"}), diagnosis("ambiguous", json::array({named("inertia", {"sensor-delay"})})));
  add(answer("plain", {"inertia"}), nullptr);
  add(answer("none", {}), diagnosis("complete"));
  add(answer("none", {}), diagnosis("ambiguous", json::array({named("inertia", {"sensor-delay"})})));
  const json summary = summarise(campaigns);
  EXPECT_EQ(summary.at("all").at("campaigns"), 6);
  EXPECT_EQ(summary.at("all").at("right"), 2);
  EXPECT_EQ(summary.at("detectable_plain").at("rate_right").at("hits"), 1);
  EXPECT_EQ(summary.at("detectable_plain").at("rate_right_or_in_set").at("hits"), 2);
  EXPECT_EQ(summary.at("detectable_plain").at("wrong"), 1);
  EXPECT_EQ(summary.at("negative_controls").at("definite_name").at("hits"), 0);
  EXPECT_EQ(summary.at("negative_controls").at("any_name").at("hits"), 1);
  EXPECT_EQ(summary.at("heldout").at("named_cases"), 1);
  EXPECT_EQ(summary.at("heldout").at("within_10_percent_of_floor").at("hits"), 1);
  // Two names with confidence 0.96, one of them right.
  for (const json& row : summary.at("reliability")) {
    const bool here = row.at("from") == 0.95;
    EXPECT_EQ(row.at("right").at("trials"), here ? 2 : 0);
    if (here) {
      EXPECT_EQ(row.at("right").at("hits"), 1);
    }
  }
  // Suggestions enter the reliability, at their level.
  json graded_campaigns = json::array();
  for (int k = 0; k < 4; ++k) {
    graded_campaigns.push_back(
        score_campaign(answer("plain", {"inertia"}),
                       diagnosis_2("unattributed", json::array(),
                                   json::array({graded(k < 3 ? "inertia" : "offset-force", "suggested", 0.75)}))));
  }
  const json rows = summarise(graded_campaigns).at("reliability_by_level")[0];
  EXPECT_EQ(rows.at("level"), "plain");
  for (const json& row : rows.at("bins")) {
    EXPECT_EQ(row.at("right").at("trials"), row.at("from") == 0.7 ? 4 : 0);
    if (row.at("from") == 0.7) {
      EXPECT_EQ(row.at("right").at("hits"), 3);
    }
  }
  const json result = {{"seed", 1}, {"seal", "00"}, {"summary", summary}, {"campaigns", campaigns}};
  const std::string text = challenge_markdown(result);
  EXPECT_NE(text.find("asymmetry 1"), std::string::npos);
  EXPECT_NE(text.find("Of 2 names 1 are not in the truth"), std::string::npos);
  EXPECT_NE(text.find("(diagnoses/campaign-0001/report.html)"), std::string::npos);
  const std::string page = challenge_html(result);
  EXPECT_NE(page.find("campaign-0001"), std::string::npos);
  // One line a campaign comes before the figures, and the page may load nothing.
  EXPECT_LT(page.find("<h2>Every campaign</h2>"), page.find("<h2>Key figures</h2>"));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("://"), std::string::npos);
}

// A name beside a set, two sets: of either neither hides the other. A suggestion is no answer.
TEST(Summary, TheConfusionTableHoldsAllThatWasSaidOfACampaign) {
  json campaigns = json::array();
  const auto add = [&](const json& effects, const json& suggestions = json::array()) {
    campaigns.push_back(
        score_campaign(answer("plain", {"inertia"}), diagnosis_2("missing-physics", effects, suggestions)));
  };
  const auto set = [](const std::string& id, const std::string& other) {
    return graded(id, "supported", 0.9, {other});
  };
  const json name = graded("end-stop", "supported", 0.9);
  add(json::array({name, set("inertia", "sensor-delay")}));
  add(json::array({name, set("asymmetry", "pinching")}));
  add(json::array({set("sensor-delay", "inertia"), set("asymmetry", "pinching")}));
  add(json::array({graded("inertia", "supported", 0.9)}), json::array({graded("asymmetry", "suggested", 0.6)}));
  const json rows = summarise(campaigns).at("confusion");
  ASSERT_EQ(rows.size(), 1U);
  std::set<std::string> said;
  for (const json& entry : rows[0].at("said")) {
    EXPECT_EQ(entry.at("count"), 1);
    said.insert(entry.at("said").get<std::string>());
  }
  EXPECT_EQ(said, (std::set<std::string>{"end-stop + (set with it)", "end-stop + (set without it)",
                                         "(set with it) + (set without it)", "inertia"}));
}

}  // namespace
}  // namespace hysteron::challenge
