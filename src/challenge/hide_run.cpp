#include "challenge/hide_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "challenge/hide.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/sha256.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

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

json settings_of(const Campaign& campaign, const std::vector<std::string>& ids, std::uint64_t seed) {
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

struct Claims {
  Names definite;
  Names candidates;  // of declared sets
  Names modelled;    // of the augmented model, named or not
};

Claims claims_of(const json& diagnosis) {
  Claims claims;
  if (!diagnosis.is_object()) return claims;
  for (const json& effect : diagnosis.at("effects")) {
    const bool alone = effect.at("indistinguishable_from").empty() && diagnosis.at("verdict") == "missing-physics";
    (alone ? claims.definite : claims.candidates).insert(effect.at("id").get<std::string>());
  }
  claims.modelled = diagnosis.at("augmented").at("effects").get<Names>();
  return claims;
}

std::string outcome_of(const json& answer, const json& diagnosis, const Claims& claims, const Claims& as_recorded) {
  if (!diagnosis.is_object()) return "failed";
  const auto hidden = answer.at("hidden").get<std::string>();
  const bool placebo = answer.at("placebo").get<bool>();
  const bool strange = std::ranges::any_of(claims.definite, [&](const std::string& id) {
    return id != hidden && !as_recorded.definite.contains(id) && !as_recorded.candidates.contains(id);
  });
  if (strange) return "wrong";
  if (placebo) return "refused";
  if (claims.definite.contains(hidden)) return "found";
  if (claims.candidates.contains(hidden)) return "in a set";
  return claims.modelled.contains(hidden) && !as_recorded.modelled.contains(hidden) ? "in the model" : "not found";
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
        if (effect.at("id") == answer.at("hidden") && found.at("name") == wanted.at("name")) {
          row["found"] = found.at("value");
          row["ci95"] = found.at("ci95");
        }
      }
    }
    for (const json& found : row.at("found").is_null() && model.is_object() ? model.at("parameters") : json::array()) {
      if (found.at("name") == answer.at("hidden").get<std::string>() + "." + wanted.at("name").get<std::string>()) {
        row["found"] = found.at("value");
      }
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::string hide_all(const std::filesystem::path& out, const Campaign& campaign, const std::vector<std::string>& ids,
                     std::uint64_t seed) {
  const std::string settings = settings_of(campaign, ids, seed).dump(1) + "\n";
  if (std::filesystem::exists(out / "settings.json")) {
    if (read_file(out / "settings.json") != settings) {
      throw InputError((out / "settings.json").string(), 0,
                       "the folder holds a challenge with other settings, expected the same or a new folder");
    }
    if (std::filesystem::exists(out / "seal.sha256")) return read_file(out / "seal.sha256").substr(0, 64);
  }
  // The order tells nothing of what is hidden where.
  std::vector<std::string> order = ids;
  Draws places(Stream(seed), "order");
  for (std::size_t k = order.size(); k > 1; --k) {
    std::swap(order[k - 1], order[static_cast<std::size_t>(places.integer(0, static_cast<int>(k) - 1))]);
  }
  std::vector<Recording> plain = campaign.recordings;
  for (Recording& recording : plain) {
    if (!recording.velocity_measured) recording.velocity.clear();
  }
  json answers = json::array();
  std::vector<Altered> altered;
  for (const std::string& id : order) {
    Draws draws(Stream(seed), id);
    altered.push_back(alter(campaign.recordings, id, draws));
  }
  write_file_atomically(out / "settings.json", settings);
  write_campaign(out / campaign_name(0), campaign, plain);
  for (std::size_t k = 0; k < altered.size(); ++k) {
    const Altered& one = altered[k];
    write_campaign(out / campaign_name(k + 1), campaign, one.recordings);
    json parameters = json::array();
    for (const HiddenParameter& p : one.parameters) {
      parameters.push_back({{"name", p.name}, {"unit", p.unit}, {"value", p.value}});
    }
    answers.push_back({{"campaign", campaign_name(k + 1)},
                       {"hidden", one.id},
                       {"placebo", std::ranges::find(placebos(), one.id) != placebos().end()},
                       {"share", one.share},
                       {"parameters", parameters}});
  }
  return seal({{"schema", "hysteron.hidden-answers/1"}, {"seed", seed}, {"campaigns", answers}}, out);
}

json score_hidden(const std::filesystem::path& out, const std::string& hash) {
  const json answers = open_seal(out, hash);
  const json plain = written_in(out, campaign_name(0), "diagnosis.json");
  const Claims as_recorded = claims_of(plain);
  json campaigns = json::array();
  for (const json& answer : answers.at("campaigns")) {
    const auto name = answer.at("campaign").get<std::string>();
    const json diagnosis = written_in(out, name, "diagnosis.json");
    const Claims claims = claims_of(diagnosis);
    const bool there = diagnosis.is_object();
    campaigns.push_back(
        {{"campaign", answer.at("campaign")},
         {"hidden", answer.at("hidden")},
         {"placebo", answer.at("placebo")},
         {"share", answer.at("share")},
         {"verdict", there ? diagnosis.at("verdict") : json(nullptr)},
         {"named", claims.definite},
         {"candidates", claims.candidates},
         {"outcome", outcome_of(answer, diagnosis, claims, as_recorded)},
         {"parameters", parameters_of(answer, diagnosis, written_in(out, name, "model.json"))},
         {"nrmse_heldout_before", there ? diagnosis.at("baseline").at("nrmse_heldout") : json(nullptr)},
         {"nrmse_heldout_after", there ? diagnosis.at("augmented").at("nrmse_heldout") : json(nullptr)}});
  }
  std::sort(campaigns.begin(), campaigns.end(), [](const json& a, const json& b) {
    return std::pair(a.at("placebo").get<bool>(), a.at("hidden").get<std::string>()) <
           std::pair(b.at("placebo").get<bool>(), b.at("hidden").get<std::string>());
  });
  return {{"schema", "hysteron.hidden/1"},
          {"seed", answers.at("seed")},
          {"seal", read_file(out / "seal.sha256").substr(0, 64)},
          {"as_recorded",
           {{"verdict", plain.is_object() ? plain.at("verdict") : json(nullptr)},
            {"named", as_recorded.definite},
            {"candidates", as_recorded.candidates}}},
          {"campaigns", campaigns}};
}

}  // namespace hysteron::challenge
