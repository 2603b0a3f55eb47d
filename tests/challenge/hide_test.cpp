#include "challenge/hide.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "challenge/hide_run.hpp"
#include "core/error.hpp"
#include "io/campaign.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/temporary_folder.hpp"
#include "report/hidden.hpp"

namespace hysteron::challenge {
namespace {

constexpr double amplitude = 0.01;
constexpr double middle = 0.002;

Recording sine(const std::string& file, double frequency, double current) {
  Recording recording;
  recording.file = file;
  recording.sha256 = std::string(64, file.back());
  const double w = 2.0 * std::numbers::pi * frequency;
  for (int n = 0; n < 1500; ++n) {
    const double t = n * 1e-3;
    recording.time.push_back(t);
    recording.displacement.push_back(middle + amplitude * std::sin(w * t));
    recording.velocity.push_back(amplitude * w * std::cos(w * t));
    recording.force.push_back(1000.0 * std::cos(w * t) + 300.0 * std::sin(w * t));
    recording.drive.push_back(current);
  }
  recording.drive_kind = DriveKind::current;
  return recording;
}

std::vector<Recording> two() { return {sine("a", 2.0, 0.5), sine("b", 4.0, 1.0)}; }

double value_of(const Altered& altered, const std::string& name) {
  for (const HiddenParameter& p : altered.parameters) {
    if (p.name == name) return p.value;
  }
  ADD_FAILURE() << name;
  return 0.0;
}

TEST(Hide, ForcesAreThoseOfTheEquations) {
  const std::vector<Recording> plain = two();
  for (const std::string_view id : hideable()) {
    Draws draws(Stream(3), id);
    const Altered altered = alter(plain, std::string(id), draws);
    double change = 0.0;
    double force = 0.0;
    for (std::size_t r = 0; r < plain.size(); ++r) {
      const double w = 2.0 * std::numbers::pi * (r == 0 ? 2.0 : 4.0);
      ASSERT_EQ(altered.recordings[r].size(), plain[r].size());
      for (std::size_t n = 0; n < plain[r].size(); ++n) {
        change += std::pow(altered.recordings[r].force[n] - plain[r].force[n], 2);
        force += std::pow(plain[r].force[n], 2);
      }
      for (std::size_t n = 100; n + 100 < plain[r].size(); ++n) {  // derivatives at the ends are less exact
        const double t = plain[r].time[n];
        const double x = plain[r].displacement[n];
        const double more = altered.recordings[r].force[n] - plain[r].force[n];
        const double moved = altered.recordings[r].displacement[n] - x;
        if (id == "inertia") {
          EXPECT_NEAR(more, -value_of(altered, "m") * w * w * (x - middle), 2.0);
        }
        if (id == "force-drift") {
          EXPECT_NEAR(more, value_of(altered, "r") * t, 1e-9);
        }
        if (id == "cubic-stiffness") {
          EXPECT_NEAR(more, value_of(altered, "k3") * std::pow(x - middle, 3), 1e-4);
        }
        const double v = plain[r].velocity[n];
        if (id == "gas-spring") {
          const double g = value_of(altered, "g");
          EXPECT_NEAR(more, value_of(altered, "f_g") * (1.0 / (1.0 - g * (x - middle)) - 1.0), 1e-6);
        }
        if (id == "offset-force") {
          EXPECT_NEAR(more, value_of(altered, "f0"), 1e-9);
        }
        if (id == "coulomb-friction" && std::fabs(v) > 0.02) {
          EXPECT_NEAR(more, std::copysign(value_of(altered, "fc"), v), 1e-3);
        }
        if (id == "quadratic-damping") {
          EXPECT_NEAR(more, value_of(altered, "d2") * v * std::fabs(v), 1.0);
        }
        if (id == "pinching") {
          // The force at the place is smaller by p, and nowhere is it larger.
          EXPECT_LE(more * plain[r].force[n], 1e-9);
          EXPECT_LE(std::fabs(more), value_of(altered, "p") * std::fabs(plain[r].force[n]) * (1.0 + 1e-12));
        }
        if (id == "stiction") {
          EXPECT_GE(more * plain[r].force[n], -1e-9);
          EXPECT_LE(std::fabs(more), value_of(altered, "a") * std::fabs(plain[r].force[n]) * (1.0 + 1e-12));
        }
        if (id == "degradation") {
          // Turns at 1/8 T, 3/8 T and so on: 12 in 1.5 s of 4 Hz are the most.
          const double turns = std::floor(2.0 * w / (2.0 * std::numbers::pi) * t + 0.5);
          if (std::fabs(v) > 0.1 * amplitude * w) {
            EXPECT_NEAR(more, -value_of(altered, "d") * turns / 12.0 * plain[r].force[n], 1e-6);
          }
        }
        if (id == "entrapped-gas") {
          EXPECT_LE(std::fabs(moved), value_of(altered, "L"));
          EXPECT_GE(moved * plain[r].force[n], 0.0);
        }
        if (id == "series-dashpot") {
          // The integral of 1000 cos + 300 sin from the start.
          const double integral = (1000.0 * std::sin(w * t) + 300.0 * (1.0 - std::cos(w * t))) / w;
          EXPECT_NEAR(moved, value_of(altered, "e") * integral, 1e-6);
        }
        if (id == "compliance") {
          EXPECT_NEAR(moved, value_of(altered, "C") * plain[r].force[n], 1e-12);
        }
        if (id == "clearance") {
          EXPECT_LE(std::fabs(moved), 0.5 * value_of(altered, "gap") * (1.0 + 1e-12));
        }
        if (id == "asymmetry") {
          const double sign = plain[r].velocity[n] < 0.0 ? -1.0 : 1.0;
          // The valves take turns within a tenth of the largest speed.
          if (std::fabs(plain[r].velocity[n]) > 0.6 * amplitude * w) {
            EXPECT_NEAR(more, value_of(altered, "e") * sign * plain[r].force[n], 2e-5 * std::fabs(plain[r].force[n]));
          }
        }
        if (id == "end-stop") {
          const double over =
              std::max(x - value_of(altered, "x_up"), 0.0) - std::max(-x - value_of(altered, "x_low"), 0.0);
          EXPECT_NEAR(more, value_of(altered, "k_b") * over, 1e-6);
        }
        if (id == "sensor-delay") {
          const double late = w * (t - value_of(altered, "lag"));
          EXPECT_NEAR(altered.recordings[r].force[n], 1000.0 * std::cos(late) + 300.0 * std::sin(late), 1.0);
        }
      }
    }
    EXPECT_GE(altered.share, 0.1);
    EXPECT_LE(altered.share, 0.3);
    const bool in_series = id == "compliance" || id == "clearance" || id == "entrapped-gas" || id == "series-dashpot";
    if (!in_series) {
      EXPECT_NEAR(std::sqrt(change / force), altered.share, 0.15 * altered.share) << id;
    }
  }
}

TEST(Hide, PlacebosPutChannelsInDisorder) {
  const std::vector<Recording> plain = two();
  Draws draws(Stream(3), "placebo");
  const Altered flipped = alter(plain, "flipped-velocity", draws);
  const Altered swapped = alter(plain, "swapped-forces#1", draws);
  EXPECT_NEAR(flipped.recordings[0].velocity[700], -plain[0].velocity[700], 1e-4);
  EXPECT_EQ(swapped.recordings[0].force, plain[1].force);
  std::vector<Recording> stepped = plain;
  for (std::size_t n = 0; n < stepped[0].size(); ++n) stepped[0].drive[n] = n < 700 ? 0.2 : 1.4;
  const Altered shuffled = alter(stepped, "shuffled-drive", draws);
  EXPECT_NE(shuffled.recordings[0].drive, stepped[0].drive);
  std::vector<double> sorted = shuffled.recordings[0].drive;
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, stepped[0].drive);
  EXPECT_THROW(alter(plain, "magic", draws), InputError);
  // The forces of others among alike: with three of one amplitude and two of another no force crosses over.
  std::vector<Recording> five = {sine("a", 1.0, 1.0), sine("b", 2.0, 1.0), sine("c", 3.0, 1.0), sine("d", 4.0, 1.0),
                                 sine("e", 5.0, 1.0)};
  for (const std::size_t r : {3, 4}) {
    for (double& x : five[r].displacement) x = middle + 0.1 * (x - middle);
    for (double& f : five[r].force) f *= 0.01;
  }
  const Altered alike = alter(five, "swapped-like-forces#2", draws);
  for (std::size_t r = 0; r < 5; ++r) {
    EXPECT_NE(alike.recordings[r].force, five[r].force);
    EXPECT_EQ(*std::ranges::max_element(alike.recordings[r].force) > 100.0, r < 3) << r;
  }
  // The same forces in another order, or in other strokes.
  const Altered reversed = alter(plain, "reversed-forces#1", draws);
  EXPECT_NE(reversed.recordings[0].force, plain[0].force);
  auto here = reversed.recordings[0].force;
  auto there = plain[0].force;
  std::ranges::sort(here);
  std::ranges::sort(there);
  EXPECT_EQ(here, there);
  const Altered strokes = alter(plain, "shuffled-strokes#1", draws);
  EXPECT_NE(strokes.recordings[0].force, plain[0].force);
  EXPECT_EQ(strokes.recordings[0].displacement, plain[0].displacement);
  EXPECT_LE(*std::ranges::max_element(strokes.recordings[0].force), *std::ranges::max_element(plain[0].force));
}

TEST(Hide, SeveralAreOnePutInAfterTheOther) {
  const std::vector<Recording> plain = two();
  Draws draws(Stream(3), "several");
  const Altered both = alter(plain, "force-drift+compliance", draws, 0.05);
  EXPECT_NEAR(both.share, 0.05, 1e-12);
  const double r = value_of(both, "force-drift.r");
  const double c = value_of(both, "compliance.C");
  for (std::size_t n = 0; n < plain[1].size(); n += 31) {
    const double force = plain[1].force[n] + r * plain[1].time[n];
    EXPECT_NEAR(both.recordings[1].force[n], force, 1e-9);
    EXPECT_NEAR(both.recordings[1].displacement[n], plain[1].displacement[n] + c * force, 1e-12);
  }
  EXPECT_THROW(alter(plain, "force-drift+magic", draws), InputError);
}

class HideRun : public ::testing::Test {
 protected:
  Campaign campaign() const {
    Campaign result;
    result.recordings = two();
    result.roles.assign(2, Role::unassigned);
    result.model = "bingham";
    result.by_current = {{"fc", 1}};
    return result;
  }
  void diagnosed(const std::string& name, const std::string& verdict, const std::vector<std::string>& effects) const {
    nlohmann::json diagnosis = {{"verdict", verdict},
                                {"baseline", {{"nrmse_heldout", 0.1}}},
                                {"augmented", {{"nrmse_heldout", 0.05}, {"effects", effects}}},
                                {"effects", nlohmann::json::array()}};
    for (const std::string& id : effects) {
      nlohmann::json others = nlohmann::json::array();
      if (verdict == "ambiguous") others.push_back("something");
      diagnosis["effects"].push_back({{"id", id},
                                      {"indistinguishable_from", others},
                                      {"parameters", {{{"name", "m"}, {"value", 2.0}, {"ci95", {1.0, 3.0}}}}}});
    }
    std::filesystem::create_directories(out_ / "diagnoses" / name);
    write_file_atomically(out_ / "diagnoses" / name / "diagnosis.json", diagnosis.dump());
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path();
};

TEST_F(HideRun, WritesCampaignsThatDoNotTellAndScoresThem) {
  const std::vector<HideTask> ids = {{"inertia"}, {"swapped-forces"}};
  const std::string hash = hide_all(out_, campaign(), ids, 7);
  EXPECT_EQ(hide_all(out_, campaign(), ids, 7), hash);
  EXPECT_TRUE(is_hidden_in_recordings(out_)) << "which --score-only goes by, without --in";
  EXPECT_THROW(hide_all(out_, campaign(), ids, 8), InputError);
  for (const char* name : {"campaign-0000", "campaign-0001", "campaign-0002"}) {
    const Campaign read = load_campaign({(out_ / name).string()});
    ASSERT_EQ(read.recordings.size(), 2U);
    EXPECT_EQ(read.model, "bingham");
    EXPECT_EQ(read.by_current.at("fc"), 1);
    EXPECT_EQ(read_file(out_ / name / "campaign.toml").find("inertia"), std::string::npos);
  }
  const nlohmann::json answers = nlohmann::json::parse(read_file(out_ / "answers.sealed")).at("campaigns");
  std::string inertia;
  std::string placebo;
  for (const nlohmann::json& answer : answers) {
    (answer.at("hidden") == "inertia" ? inertia : placebo) = answer.at("campaign");
  }
  struct Case {
    std::vector<std::string> plain, named, of_placebo;
    const char* verdict;
    const char* outcome;
    const char* placebo_outcome;
  };
  const Case cases[] = {
      {{}, {"inertia"}, {}, "missing-physics", "found", "refused"},
      {{}, {"inertia"}, {"inertia"}, "missing-physics", "found", "wrong"},
      {{"compliance"}, {"compliance"}, {"compliance"}, "missing-physics", "not found", "refused"},
      {{}, {"compliance"}, {}, "missing-physics", "wrong", "refused"},
      {{}, {"inertia", "sensor-delay"}, {}, "ambiguous", "in a set", "refused"},
      {{}, {}, {}, "unattributed", "not found", "refused"},
  };
  for (const Case& one : cases) {
    diagnosed("campaign-0000", "missing-physics", one.plain);
    diagnosed(inertia, one.verdict, one.named);
    diagnosed(placebo, one.of_placebo.empty() ? "unattributed" : "missing-physics", one.of_placebo);
    const nlohmann::json result = score_hidden(out_, hash);
    EXPECT_EQ(result.at("campaigns")[0].at("hidden"), "inertia");
    EXPECT_EQ(result.at("campaigns")[0].at("outcome"), one.outcome);
    EXPECT_EQ(result.at("campaigns")[1].at("outcome"), one.placebo_outcome);
  }
  // In the augmented model without a name: told, with its parameter, unless the recordings as they are need it too.
  diagnosed("campaign-0000", "unattributed", {});
  diagnosed(inertia, "unattributed", {});
  const std::filesystem::path folder = out_ / "diagnoses" / inertia;
  nlohmann::json diagnosis = nlohmann::json::parse(read_file(folder / "diagnosis.json"));
  diagnosis["augmented"]["effects"] = {"inertia"};
  write_file_atomically(folder / "diagnosis.json", diagnosis.dump());
  write_file_atomically(folder / "model.json", R"({"parameters": [{"name": "inertia.m", "value": 3.5}]})");
  const nlohmann::json modelled = score_hidden(out_, hash).at("campaigns")[0];
  EXPECT_EQ(modelled.at("outcome"), "in the model");
  EXPECT_EQ(modelled.at("parameters")[0].at("found"), 3.5);
  diagnosed("campaign-0000", "unattributed", {"inertia"});
  EXPECT_EQ(score_hidden(out_, hash).at("campaigns")[0].at("outcome"), "not found");
  // One that was not reached is no failure, and not counted; one whose diagnosis failed is.
  EXPECT_EQ(score_hidden(out_, hash).at("not_diagnosed"), 0);
  std::filesystem::remove_all(out_ / "diagnoses" / inertia);
  const nlohmann::json partial = score_hidden(out_, hash);
  EXPECT_EQ(partial.at("not_diagnosed"), 1);
  ASSERT_EQ(partial.at("campaigns").size(), 1U);
  EXPECT_NE(hidden_markdown(partial).find("not diagnosed, and not counted: 1."), std::string::npos);
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / "failed.txt", "no candidate\n");
  EXPECT_EQ(score_hidden(out_, hash).at("campaigns")[0].at("outcome"), "failed");
}

TEST_F(HideRun, SizesAreThoseOfTheBaseResidual) {
  const Campaign plain = campaign();
  const auto tasks = hide_tasks({"inertia"}, {0.3, 3.0}, 12, plain);
  ASSERT_EQ(tasks.size(), 14U);
  EXPECT_EQ(tasks[2].id, "flipped-velocity#1");
  int asked = 0;
  const std::string hash = hide_all(out_, plain, tasks, 7, [&](const std::filesystem::path& data) {
    EXPECT_EQ(data.filename(), "campaign-0000");
    ++asked;
    return 20.0;
  });
  EXPECT_EQ(asked, 1);
  EXPECT_THROW(hide_all(out_ / "other", plain, tasks, 7), InputError);
  diagnosed("campaign-0000", "unattributed", {});
  for (std::size_t k = 1; k <= tasks.size(); ++k) {
    const std::filesystem::path folder = out_ / "diagnoses" / fmt::format("campaign-{:04}", k);
    std::filesystem::create_directories(folder);
    write_file_atomically(folder / "failed.txt", "not worked at here\n");
  }
  std::set<std::string> placebos;
  const nlohmann::json scored = score_hidden(out_, hash);
  for (const nlohmann::json& row : scored.at("campaigns")) {
    if (row.at("placebo")) {
      placebos.insert(row.at("hidden"));
      continue;
    }
    EXPECT_NEAR(row.at("share").get<double>(), row.at("size").get<double>() * 20.0 / force_of(plain.recordings), 1e-12);
  }
  EXPECT_EQ(placebos.size(), 12U);
}

TEST_F(HideRun, SuggestionsAreNoNamesAndWhatStandsAsRecordedIsLeftOut) {
  const std::string hash = hide_all(out_, campaign(), {{"inertia"}, {"reversed-forces#1"}}, 7);
  diagnosed("campaign-0000", "missing-physics", {"compliance"});
  for (const char* name : {"campaign-0001", "campaign-0002"}) {
    const std::filesystem::path folder = out_ / "diagnoses" / name;
    diagnosed(name, "missing-physics", {"compliance"});
    nlohmann::json diagnosis = nlohmann::json::parse(read_file(folder / "diagnosis.json"));
    diagnosis["effects"][0]["grade"] = "supported";
    diagnosis["suggestions"] = {
        {{"id", "inertia"}, {"grade", "suggested"}, {"confidence", 0.6}, {"indistinguishable_from", {"velocity-lag"}}}};
    write_file_atomically(folder / "diagnosis.json", diagnosis.dump());
  }
  const nlohmann::json result = score_hidden(out_, hash);
  EXPECT_EQ(result.at("campaigns")[0].at("outcome"), "suggested");
  EXPECT_EQ(result.at("campaigns")[1].at("outcome"), "refused");
  EXPECT_EQ(result.at("campaigns")[0].at("answer").size(), 1U);
  EXPECT_EQ(result.at("placebos").at("hits"), 0);
  int trials = 0;
  int hits = 0;
  for (const nlohmann::json& bin : result.at("reliability")) {
    trials += bin.at("right").at("trials").get<int>();
    hits += bin.at("right").at("hits").get<int>();
  }
  EXPECT_EQ(trials, 2);
  EXPECT_EQ(hits, 1);
  EXPECT_NE(hidden_markdown(result).find("Of 1 hidden effects 0 were named"), std::string::npos);
}

}  // namespace
}  // namespace hysteron::challenge
