#include "challenge/hide_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "challenge/claims.hpp"
#include "challenge/hide.hpp"
#include "challenge/run.hpp"
#include "challenge/score.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/sha256.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;

constexpr const char* hidden_answers = "hysteron.hidden-answers/1";  // schema

std::string campaign_name(std::size_t number) { return fmt::format("campaign-{:04}", number); }

std::string csv_of(const Recording& recording) {
  struct Column {
    std::string_view name;
    const std::vector<double>* values;
  };
  std::vector<Column> columns = {{"time [s]", &recording.time}, {"displacement [m]", &recording.displacement}};
  if (!recording.velocity.empty()) columns.push_back({"velocity [m/s]", &recording.velocity});
  columns.push_back({"force [N]", &recording.force});
  if (!recording.drive.empty()) {
    columns.push_back({recording.drive_kind == DriveKind::voltage ? "voltage [V]" : "current [A]", &recording.drive});
  }
  std::string text;
  for (const Column& column : columns) text += (text.empty() ? "" : ",") + std::string(column.name);
  text += '\n';
  for (std::size_t n = 0; n < recording.size(); ++n) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      fmt::format_to(std::back_inserter(text), "{}{:.9g}", c > 0 ? "," : "", (*columns[c].values)[n]);
    }
    text += '\n';
  }
  return text;
}

std::string role_of(const Campaign& campaign, std::size_t recording) {
  if (campaign.roles[recording] == Role::unassigned) return "";
  return campaign.roles[recording] == Role::validate ? "role = \"validate\"\n" : "role = \"fit\"\n";
}

void write_campaign(const std::filesystem::path& folder, const Campaign& campaign,
                    const std::vector<Recording>& recordings) {
  std::filesystem::create_directories(folder);
  std::string toml = fmt::format("schema = \"hysteron.campaign/1\"\nmodel = \"{}\"\n", campaign.model);
  const auto add_laws = [&](const char* table, const std::map<std::string, int>& laws) {
    if (laws.empty()) return;
    toml += fmt::format("[{}]\n", table);
    for (const auto& [parameter, order] : laws) toml += fmt::format("{} = {}\n", parameter, order);
  };
  add_laws("by_current", campaign.by_current);
  add_laws("by_frequency", campaign.by_frequency);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const std::string file = fmt::format("r{:03}.csv", r + 1);
    write_file_atomically(folder / file, csv_of(recordings[r]));
    toml += fmt::format("[[recording]]\nfile = \"{}\"\n{}", file, role_of(campaign, r));
  }
  write_file_atomically(folder / "campaign.toml", toml);
}

json settings_of(const Campaign& campaign, const std::vector<HideTask>& tasks, std::uint64_t seed) {
  json ids = json::array();
  for (const HideTask& task : tasks) ids.push_back({{"id", task.id}, {"size", task.size}});
  json files = json::array();
  for (const Recording& recording : campaign.recordings) files.push_back(recording.sha256);
  return {{"schema", "hysteron.hidden-settings/1"},
          {"seed", seed},
          {"ids", ids},
          {"model", campaign.model},
          {"by_current", campaign.by_current},
          {"by_frequency", campaign.by_frequency},
          {"recordings", files}};
}

// What a diagnosis has written, null where there is none: `file` is diagnosis.json or model.json.
json written_in(const std::filesystem::path& out, const std::string& name, const char* file) {
  const std::filesystem::path path = out / "diagnoses" / name / file;
  if (!std::filesystem::exists(path)) return nullptr;
  try {
    return json::parse(read_file(path));
  } catch (const json::exception&) {
    throw InputError(path.string(), 0, "not valid JSON, expected what a diagnosis writes");
  }
}

// What was said of a campaign, and what its model holds.
struct Said {
  Claims claims;
  Names candidates;  // of declared sets
  Names suggested;
  Names modelled;  // of the augmented model, named or not
};

Said said_in(const json& diagnosis, const Names& hidden) {
  Said said;
  if (!diagnosis.is_object()) return said;
  said.claims = claims_of(diagnosis, hidden);
  for (const Names& set : said.claims.sets) said.candidates.insert(set.begin(), set.end());
  for (const Claim& claim : said.claims.all) {
    if (claim.grade == Grade::suggested) said.suggested.insert(claim.set.begin(), claim.set.end());
  }
  said.modelled = diagnosis.at("augmented").value("effects", json::array()).get<Names>();
  return said;
}

// Whether the recordings as they are have this said of them already.
bool stands(const Claim& claim, const Said& as_recorded) {
  return meet(claim.set, as_recorded.claims.definite) || meet(claim.set, as_recorded.candidates) ||
         meet(claim.set, as_recorded.suggested);
}

std::string outcome_of(const json& answer, const json& diagnosis, const Names& hidden, const Said& said,
                       const Said& as_recorded) {
  if (!diagnosis.is_object()) return "failed";
  for (const Claim& claim : said.claims.all) {
    if (claim.name && !claim.right && !stands(claim, as_recorded)) return "wrong";
  }
  if (answer.at("placebo").get<bool>()) return "refused";
  const auto count = [&](const Names& names) {
    return std::ranges::count_if(hidden, [&](const std::string& id) { return names.contains(id); });
  };
  const auto all = static_cast<std::ptrdiff_t>(hidden.size());
  if (count(said.claims.definite) == all) return "found";
  Names listed = said.claims.definite;
  listed.insert(said.candidates.begin(), said.candidates.end());
  if (count(listed) == all) return "in a set";
  if (count(listed) > 0) return "part";
  if (count(said.suggested) > 0) return "suggested";
  const bool modelled = std::ranges::any_of(
      hidden, [&](const std::string& id) { return said.modelled.contains(id) && !as_recorded.modelled.contains(id); });
  return modelled ? "in the model" : "not found";
}

// The hidden parameters beside those of the name, or of the augmented model where no name was given.
json parameters_of(const json& answer, const json& diagnosis, const json& model) {
  json rows = json::array();
  for (const json& wanted : answer.at("parameters")) {
    json row = wanted;
    row["found"] = nullptr;
    row["ci95"] = nullptr;
    for (const json& effect : diagnosis.is_object() ? diagnosis.at("effects") : json::array()) {
      for (const json& found : effect.at("parameters")) {
        const auto id = effect.at("id").get<std::string>();
        const auto name = found.at("name").get<std::string>();
        if ((id == answer.at("hidden") && name == wanted.at("name")) || id + "." + name == wanted.at("name")) {
          row["found"] = found.at("value");
          row["ci95"] = found.at("ci95");
        }
      }
    }
    for (const json& found : row.at("found").is_null() && model.is_object() ? model.at("parameters") : json::array()) {
      if (found.at("name") == wanted.at("name") ||
          found.at("name") == answer.at("hidden").get<std::string>() + "." + wanted.at("name").get<std::string>()) {
        row["found"] = found.at("value");
      }
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::vector<HideTask> hide_tasks(const std::vector<std::string>& ids, const std::vector<double>& sizes,
                                 int placebo_count, const Campaign& campaign) {
  std::vector<HideTask> tasks;
  for (const std::string& id : ids) {
    if (sizes.empty() || is_placebo(id)) {
      tasks.push_back({id});
    } else {
      for (const double size : sizes) tasks.push_back({id, size});
    }
  }
  std::vector<std::string> kinds;
  for (const std::string_view kind : placebos()) {
    if (kind == "shuffled-drive" && campaign.recordings.front().drive.empty()) continue;
    if (kind.starts_with("swapped") && campaign.recordings.size() < 2) continue;
    if (kind != "flipped-velocity") kinds.emplace_back(kind);
  }
  for (int k = 0; k < placebo_count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    // There is one way to flip the velocity.
    tasks.push_back({k == 0 ? "flipped-velocity#1"
                            : fmt::format("{}#{}", kinds[(at - 1) % kinds.size()], (at - 1) / kinds.size() + 1)});
  }
  return tasks;
}

std::string hide_all(const std::filesystem::path& out, const Campaign& campaign, const std::vector<HideTask>& tasks,
                     std::uint64_t seed, const BaseResidual& residual) {
  const bool sized = std::ranges::any_of(tasks, [](const HideTask& task) { return task.size > 0.0; });
  if (sized && !residual) throw InputError("sizes over the base residual want the base residual");
  const std::string settings = settings_of(campaign, tasks, seed).dump(1) + "\n";
  if (std::filesystem::exists(out / "settings.json")) {
    if (read_file(out / "settings.json") != settings) {
      throw InputError((out / "settings.json").string(), 0,
                       "the folder holds a challenge with other settings, expected the same or a new folder");
    }
    if (std::filesystem::exists(out / "seal.sha256")) return read_file(out / "seal.sha256").substr(0, 64);
  }
  // The order tells nothing of what is hidden where.
  std::vector<HideTask> order = tasks;
  Draws places(Stream(seed), "order");
  for (std::size_t k = order.size(); k > 1; --k) {
    std::swap(order[k - 1], order[static_cast<std::size_t>(places.integer(0, static_cast<int>(k) - 1))]);
  }
  std::vector<Recording> plain = campaign.recordings;
  for (Recording& recording : plain) {
    if (!recording.velocity_measured) recording.velocity.clear();
  }
  write_file_atomically(out / "settings.json", settings);
  write_campaign(out / campaign_name(0), campaign, plain);
  const double left = sized ? residual(out / campaign_name(0)) : 0.0;
  const double force = force_of(campaign.recordings);
  json answers = json::array();
  for (std::size_t k = 0; k < order.size(); ++k) {
    Draws draws(Stream(seed), order[k].id);
    const Altered one = alter(campaign.recordings, order[k].id, draws, order[k].size * left / force);
    write_campaign(out / campaign_name(k + 1), campaign, one.recordings);
    json parameters = json::array();
    for (const HiddenParameter& p : one.parameters) {
      parameters.push_back({{"name", p.name}, {"unit", p.unit}, {"value", p.value}});
    }
    answers.push_back({{"campaign", campaign_name(k + 1)},
                       {"hidden", one.id},
                       {"placebo", is_placebo(one.id)},
                       {"size", order[k].size},
                       {"share", one.share},
                       {"parameters", parameters}});
  }
  return seal({{"schema", hidden_answers},
               {"seed", seed},
               {"base_residual_n", sized ? json(left) : json(nullptr)},
               {"campaigns", answers}},
              out);
}

bool is_hidden_in_recordings(const std::filesystem::path& out) { return open_seal(out).at("schema") == hidden_answers; }

json score_hidden(const std::filesystem::path& out, const std::string& hash) {
  const json answers = open_seal(out, hash);
  const json plain = written_in(out, campaign_name(0), "diagnosis.json");
  const Said as_recorded = said_in(plain, {});
  json campaigns = json::array();
  int not_diagnosed = 0;
  for (const json& answer : answers.at("campaigns")) {
    const auto name = answer.at("campaign").get<std::string>();
    if (!was_reached(out / "diagnoses" / name)) {
      ++not_diagnosed;
      continue;
    }
    const auto id = answer.at("hidden").get<std::string>();
    const bool placebo = answer.at("placebo").get<bool>();
    Names hidden;
    if (!placebo) {
      for (const std::string& part : parts_of(id)) hidden.insert(part);
    }
    const json diagnosis = written_in(out, name, "diagnosis.json");
    const Said said = said_in(diagnosis, hidden);
    const bool there = diagnosis.is_object();
    json stated = json::array();
    for (const Claim& claim : said.claims.all) {
      if (claim.right || !stands(claim, as_recorded)) stated.push_back(json_of(claim));
    }
    campaigns.push_back(
        {{"campaign", answer.at("campaign")},
         {"hidden", id},
         {"placebo", placebo},
         {"size", answer.value("size", 0.0)},
         {"share", answer.at("share")},
         {"verdict", there ? diagnosis.at("verdict") : json(nullptr)},
         {"answer", stated},
         {"named", said.claims.definite},
         {"candidates", said.candidates},
         {"suggested", said.suggested},
         {"outcome", outcome_of(answer, diagnosis, hidden, said, as_recorded)},
         {"parameters", parameters_of(answer, diagnosis, written_in(out, name, "model.json"))},
         {"nrmse_heldout_before", there ? diagnosis.at("baseline").at("nrmse_heldout") : json(nullptr)},
         {"nrmse_heldout_after", there ? diagnosis.at("augmented").at("nrmse_heldout") : json(nullptr)}});
  }
  std::stable_sort(campaigns.begin(), campaigns.end(), [](const json& a, const json& b) {
    const auto key = [](const json& c) {
      return std::tuple(c.at("placebo").get<bool>(), c.at("hidden").get<std::string>(), c.at("size").get<double>());
    };
    return key(a) < key(b);
  });
  // Outcomes size by size, and of the placebos.
  std::map<double, std::map<std::string, int>> sizes;
  int placebo_count = 0;
  int placebo_names = 0;
  int names = 0;
  int names_right = 0;
  for (const json& c : campaigns) {
    const auto outcome = c.at("outcome").get<std::string>();
    for (const json& stated : c.at("answer")) {
      names += stated.at("name").get<bool>() ? 1 : 0;
      names_right += stated.at("name").get<bool>() && stated.at("right").get<bool>() ? 1 : 0;
    }
    if (!c.at("placebo").get<bool>()) {
      ++sizes[c.at("size").get<double>()][outcome];
    } else if (outcome != "failed") {
      ++placebo_count;
      placebo_names += outcome == "wrong" ? 1 : 0;
    }
  }
  json by_size = json::array();
  for (const auto& [size, outcomes] : sizes) by_size.push_back({{"size", size}, {"outcomes", outcomes}});
  return {{"schema", "hysteron.hidden/2"},
          {"seed", answers.at("seed")},
          {"seal", read_file(out / "seal.sha256").substr(0, 64)},
          {"base_residual_n", number_of(answers, "base_residual_n")},
          {"not_diagnosed", not_diagnosed},
          {"as_recorded",
           {{"verdict", plain.is_object() ? plain.at("verdict") : json(nullptr)},
            {"named", as_recorded.claims.definite},
            {"candidates", as_recorded.candidates},
            {"suggested", as_recorded.suggested}}},
          {"sizes", by_size},
          {"placebos", rate_of(placebo_names, placebo_count)},
          {"names", rate_of(names_right, names)},
          {"reliability", reliability_of(campaigns)},
          {"campaigns", campaigns}};
}

}  // namespace hysteron::challenge
