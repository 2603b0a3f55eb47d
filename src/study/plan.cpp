#include "study/plan.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "check/campaign.hpp"
#include "core/error.hpp"
#include "datasets/dataset.hpp"
#include "external/external_solver.hpp"
#include "fit/usable.hpp"
#include "io/campaign.hpp"
#include "io/sha256.hpp"
#include "io/value_hash.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

// Recordings that are made, not read: the hash of their numbers stands for the hash of a file.
std::string hash_of(const Recording& recording) {
  return sha256_of_channels({&recording.time, &recording.displacement, &recording.velocity, &recording.force,
                             &recording.acceleration, &recording.drive, &recording.temperature});
}

// What is wrong with a path that a study names, rather than with a file in it, is said with the study's line.
Campaign load_paths(const DataSpec& spec, const std::string& file, const ReadOptions& read) {
  try {
    return load_campaign(spec.paths, read,
                         {.model = false, .laws = false, .roles = spec.validate.empty() && !spec.each});
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (spec.paths_line > 0 &&
        std::ranges::any_of(spec.paths, [&](const std::string& path) { return message.starts_with(path + ": "); })) {
      throw InputError(file, spec.paths_line, "recordings: " + message);
    }
    throw;
  }
}

Campaign load(const DataSpec& spec, const std::string& file, std::vector<Remark>& remarks) {
  if (!spec.made.empty()) {
    Campaign campaign;
    campaign.recordings = spec.made;
    campaign.roles.assign(spec.made.size(), Role::fit);
    for (Recording& recording : campaign.recordings) recording.sha256 = hash_of(recording);
    return campaign;
  }
  if (spec.dataset.empty()) {
    ReadOptions read;
    read.remark = [&](const Remark& remark) { remarks.push_back(remark); };
    Campaign campaign = load_paths(spec, file, read);
    const std::vector<Remark> of_campaign = remarks_on(campaign.recordings, Moving::damper);
    remarks.insert(remarks.end(), of_campaign.begin(), of_campaign.end());
    return campaign;
  }
  const DatasetEntry* entry = find_dataset(spec.dataset);
  if (entry == nullptr) throw InputError("unknown dataset '" + spec.dataset + "', see `hysteron list datasets`");
  Campaign campaign = entry->generate(Stream(spec.seed).child(entry->id));
  for (Recording& recording : campaign.recordings) {
    if (recording.sha256.empty()) recording.sha256 = hash_of(recording);
  }
  return campaign;
}

// Whether a name contains one of the parts.
bool named_by(const std::vector<std::string>& parts, const Recording& recording) {
  return std::ranges::any_of(parts,
                             [&](const std::string& part) { return recording.file.find(part) != std::string::npos; });
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "'" : ", '") + word + "'";
  return text;
}

// The first of the recordings, by name.
std::string names_in(const Campaign& campaign) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (const Recording& recording : campaign.recordings) {
    if (names.size() < most) names.push_back(recording.file);
  }
  const std::size_t others = campaign.recordings.size() - names.size();
  return listed(names) + (others == 0 ? "" : " or " + std::to_string(others) + " others");
}

// Every part that 'only' or 'validate' holds is meant to choose something.
void refuse_unmatched(const std::string& key, const std::vector<std::string>& parts,
                      const std::vector<Recording>& recordings, const Campaign& campaign, const DataSpec& spec,
                      const std::string& file) {
  for (const std::string& part : parts) {
    if (std::ranges::any_of(recordings, [&](const Recording& recording) { return named_by({part}, recording); })) {
      continue;
    }
    throw InputError(file, spec.line,
                     "no recording of '" + spec.label + "' has a name that contains '" + part + "' of '" + key +
                         "', expected a part of " + names_in(campaign));
  }
}

struct DataGroup {
  std::string label;
  std::vector<Recording> fitted;
  std::vector<Recording> heldout;
};

std::vector<DataGroup> groups_of(const DataSpec& spec, const std::string& file, std::vector<Remark>& remarks) {
  const Campaign campaign = load(spec, file, remarks);
  refuse_unmatched("only", spec.only, campaign.recordings, campaign, spec, file);
  DataGroup all{spec.label, {}, {}};
  std::vector<DataGroup> each;
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    const Recording& recording = campaign.recordings[k];
    if (!spec.only.empty() && !named_by(spec.only, recording)) continue;
    if (spec.each) {
      std::string name = recording.file;
      if (const auto dot = name.rfind('.'); dot != std::string::npos && dot > 0) name.resize(dot);
      each.push_back({spec.label + "/" + name, {recording}, {}});
    }
    const bool judges =
        spec.validate.empty() ? campaign.roles[k] == Role::validate : named_by(spec.validate, recording);
    (judges ? all.heldout : all.fitted).push_back(recording);
  }
  if (spec.each) return each;
  if (all.fitted.empty()) {
    throw InputError(file, spec.line,
                     "every recording of '" + spec.label + "' has the role validate, expected one to fit");
  }
  refuse_unmatched("validate", spec.validate, all.heldout, campaign, spec, file);
  return {all};
}

json problem_config(const ModelSpec& model, const StudyProblem& problem, const ObjectiveOptions& options) {
  const auto files = [](const std::vector<Recording>& recordings) {
    json rows = json::array();
    for (const Recording& recording : recordings) rows.push_back(recording.sha256);
    return rows;
  };
  // Starts may stand in campaign.toml, beside the files.
  json earlier = json::array();
  for (const std::vector<Recording>* recordings : {&problem.recordings, &problem.heldout}) {
    for (const Recording& recording : *recordings) {
      for (const EarlierWork& stretch : recording.earlier) {
        earlier.push_back({recording.sha256, stretch.ago, stretch.work});
      }
    }
  }
  json box = json::array();
  for (const Coordinate& coordinate : problem.layout.coordinates()) {
    box.push_back({{"parameter", problem.layout.names()[coordinate.parameter]},
                   {"node", coordinate.node},
                   {"log", coordinate.scale == Scale::logarithmic},
                   {"lower", coordinate.lower},
                   {"upper", coordinate.upper}});
  }
  json laws = json::array();
  for (const ParameterLaw& law : problem.layout.laws()) {
    laws.push_back({{"parameter", problem.layout.names()[law.parameter]},
                    {"drive", law.drive_nodes},
                    {"frequency", law.frequency_nodes}});
  }
  json config = {{"recordings", files(problem.recordings)},
                 {"heldout", files(problem.heldout)},
                 {"model", model.model},
                 {"effects", model.effects},
                 {"box", box},
                 {"laws", laws},
                 {"held", problem.layout.held()},
                 {"normalisation", word_of(options.normalisation)},
                 {"weighting", options.weighting == Weighting::pooled ? "pooled" : "per-recording"},
                 {"tolerance", options.tolerance}};
  if (!earlier.empty()) config["earlier_work"] = std::move(earlier);
  return config;
}

}  // namespace

Plan make_plan(const Study& study, const std::string& version) {
  Plan plan{study, {}, {}};
  std::set<std::string> labels;
  for (const DataSpec& data : study.data) {
    // A wrong recording is named with its own file and line.
    const std::vector<DataGroup> groups = groups_of(data, study.file, plan.remarks);
    for (const DataGroup& group : groups) {
      for (const ModelSpec& model : study.models) {
        if (!model.on.empty() && std::ranges::find(model.on, data.label) == model.on.end()) continue;
        try {
          const DataScale scale = scale_of(group.fitted);
          Layout layout(make_model(model.model, model.effects), scale, model.layout);
          if (layout.dimension() == 0) throw InputError("every parameter is fixed, expected at least one to identify");
          require_usable(group.fitted);
          for (const Recording& recording : group.fitted) normaliser(recording, study.objective.normalisation);
          StudyProblem problem{model.label + " @ " + group.label,
                               model.label,
                               group.label,
                               {},
                               {},
                               std::move(layout),
                               group.fitted,
                               group.heldout};
          problem.config = problem_config(model, problem, study.objective).dump();
          problem.hash = sha256_hex(problem.config);
          if (!labels.insert(problem.label).second) {
            throw InputError("'" + problem.label + "' occurs twice, expected different labels of data");
          }
          plan.problems.push_back(std::move(problem));
        } catch (const InputError& error) {
          throw InputError(study.file, model.line,
                           "model '" + model.label + "' on '" + group.label + "': " + error.what());
        }
      }
    }
  }
  std::set<std::string> keys;
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    for (const std::size_t budget : study.budgets) {
      for (const std::uint64_t seed : study.seeds) {
        for (std::size_t s = 0; s < study.solvers.size(); ++s) {
          const SolverEntry* entry = find_solver(study.solvers[s].id);
          if (entry == nullptr)
            throw InputError(study.file, study.solvers[s].line, "unknown solver '" + study.solvers[s].id + "'");
          json settings = json::object();
          for (const Setting& row : entry->settings) settings[std::string(row.name)] = row.value;
          for (const auto& [name, value] : study.solvers[s].settings) settings[name] = value;
          json config = {{"problem", plan.problems[p].hash},
                         {"solver", study.solvers[s].id},
                         {"settings", settings},
                         {"budget", budget},
                         {"seed", seed},
                         {"start", study.start == StartPoint::card ? "card" : "random"},
                         {"version", version}};
          if (study.solvers[s].project) config["project"] = true;
          if (const ExternalProgram* program = external_program(study.solvers[s].id)) {
            config["program"] = program->words;
            config["program_files"] = program->files;
          }
          PlannedRun run;
          run.config = config.dump();
          run.key = sha256_hex(run.config);
          run.problem = p;
          run.solver = s;
          run.budget = budget;
          run.seed = seed;
          if (!keys.insert(run.key).second) {
            throw InputError(study.file, study.solvers[s].line,
                             "solver '" + study.solvers[s].label + "' on '" + plan.problems[p].label +
                                 "' is the same work as another one of the study, expected different settings or data");
          }
          plan.runs.push_back(std::move(run));
        }
      }
    }
  }
  return plan;
}

namespace {

// The ranges of the parameters that are coordinates of their own, in SI units.
json box_of(const Layout& layout) {
  json box = json::object();
  for (const ParameterLaw& law : layout.laws()) {
    const Coordinate& coordinate = layout.coordinates()[law.first];
    if (law.count() == 1) box[layout.names()[law.parameter]] = {coordinate.lower, coordinate.upper};
  }
  return box;
}

}  // namespace

json plan_json(const Plan& plan) {
  json problems = json::array();
  for (const StudyProblem& problem : plan.problems) {
    std::size_t samples = 0;
    json files = json::array();
    for (const Recording& recording : problem.recordings) {
      samples += recording.size();
      files.push_back({{"file", recording.file}, {"sha256", recording.sha256}});
    }
    json heldout = json::array();
    for (const Recording& recording : problem.heldout) {
      heldout.push_back({{"file", recording.file}, {"sha256", recording.sha256}});
    }
    problems.push_back({{"label", problem.label},
                        {"model", problem.model},
                        {"data", problem.data},
                        {"hash", problem.hash},
                        {"dimension", problem.layout.dimension()},
                        {"box", box_of(problem.layout)},
                        {"samples", samples},
                        {"recordings", files},
                        {"heldout", heldout}});
  }
  json solvers = json::array();
  for (const SolverSpec& solver : plan.study.solvers) {
    solvers.push_back({{"label", solver.label}, {"id", solver.id}, {"settings", solver.settings}});
    if (solver.project) solvers.back()["project"] = true;
  }
  json runs = json::array();
  for (const PlannedRun& run : plan.runs) {
    runs.push_back({{"key", run.key},
                    {"problem", run.problem},
                    {"solver", run.solver},
                    {"budget", run.budget},
                    {"seed", run.seed}});
  }
  return {{"schema", "hysteron.plan/1"},
          {"title", plan.study.title},
          {"normalisation", word_of(plan.study.objective.normalisation)},
          {"weighting", plan.study.objective.weighting == Weighting::pooled ? "pooled" : "per-recording"},
          {"tolerance", plan.study.objective.tolerance},
          {"start", plan.study.start == StartPoint::card ? "card" : "random"},
          {"targets", plan.study.targets},
          {"target_nrmse", plan.study.target_nrmse},
          {"tie", plan.study.tie},
          {"equivalence", plan.study.equivalence},
          {"budgets", plan.study.budgets},
          {"seeds", plan.study.seeds},
          {"solvers", solvers},
          {"problems", problems},
          {"runs", runs}};
}

bool in_shard(const std::string& key, std::size_t index, std::size_t count) {
  return std::stoull(key.substr(0, 12), nullptr, 16) % count + 1 == index;
}

Problem solver_problem(const StudyProblem& problem, const PlannedRun& run, const Study& study) {
  Problem result;
  result.dimension = problem.layout.dimension();
  result.budget = run.budget;
  // Without the solver's name: solvers that draw a first population alike draw the same one, so that seeds are pairs.
  result.stream = Stream(run.seed).child("study").child(problem.hash);
  result.linear = problem.layout.linear();
  if (study.start == StartPoint::card) {
    result.start = problem.layout.initial();
  } else {
    const Stream start = Stream(run.seed).child("study start").child(problem.hash);
    for (std::size_t d = 0; d < result.dimension; ++d) result.start.push_back(start.uniform(d));
  }
  result.settings = study.solvers[run.solver].settings;
  return result;
}

}  // namespace hysteron
