#include "diagnose/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <set>

#include "diagnose/noise.hpp"
#include "diagnose/thin.hpp"
#include "diagnose/wander.hpp"
#include "fit/identify.hpp"

namespace hysteron {
namespace {

// What hypotheses are compared on.
constexpr std::size_t quick_samples = 4000;
constexpr std::size_t quick_recordings = 8;
// Effects that make the prediction of the judging recordings worse than this are no answer.
constexpr double most_loss = 1.01;
// A held-out recording that is this many times further above its white noise, in squares, than every fitted one shows
// what these do not.
constexpr double surprise = 4.0;
// Squares over those of the white noise above which what is left is asked whether it follows the force.
constexpr double above_white = 1.5;
// Least share of the largest force that counts as noise there.
constexpr double least_noise = 1e-4;
// What the base and the augmented model are then fitted on; every sample is predicted in the end.
constexpr std::size_t fine_samples = 12000;

std::string title_of(const std::string& effect) {
  const Part* part = find_effect(effect);
  std::string title(part == nullptr ? effect : part->title);
  if (title.size() > 1 && std::islower(static_cast<unsigned char>(title[1])) != 0) {
    title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  }
  return title;
}

std::vector<ParameterInterval> intervals_of(const Workbench& bench, const Fit& fit, const std::string& effect) {
  const Objective objective(*fit.layout, bench.split().fit, bench.options());
  Identification identification{*fit.layout, fit.terms, {}, {}, 0, fit.cost, {}, {}, {}, false, {}};
  estimate(identification, objective, fit.point, bench.split().fit.front().drive_kind);
  std::vector<ParameterInterval> result;
  for (const Estimate& row : identification.estimates) {
    if (row.name.starts_with(effect + ".")) {
      result.push_back({row.name.substr(effect.size() + 1), row.unit, row.term.value, row.half_width});
    }
  }
  return result;
}

// Files of the held-out recordings that show what the fitted ones do not.
std::vector<std::string> surprises(const Workbench& bench, const Fit& fit) {
  const auto above_noise = [&](const Recording& recording) {
    const double least = least_noise * normaliser(recording, Normalisation::max_abs);
    const double white = noise_floor(recording).white;
    return bench.residual(fit, recording).mean_square() / (white * white + least * least);
  };
  double usual = 1.0;
  for (const Recording& recording : bench.split().fit) {
    usual = std::max(usual, above_noise(recording));
  }
  std::vector<std::string> result;
  for (const Judged& judged : bench.split().judge) {
    if (judged.from == 0 && above_noise(judged.recording) > surprise * usual) {
      result.push_back(judged.recording.file);
    }
  }
  return result;
}

std::string join(const std::vector<std::string>& words, const std::string& last) {
  std::string result;
  for (std::size_t k = 0; k < words.size(); ++k) {
    result += (k == 0 ? "" : (k + 1 == words.size() ? last : ", ")) + words[k];
  }
  return result;
}

std::string sentence_of(const Diagnosis& diagnosis, const Named& named,
                        const std::vector<ParameterInterval>& parameters) {
  std::vector<std::string> values;
  for (const ParameterInterval& p : parameters) {
    std::string text = fmt::format("{} = {:.3g}{}", p.name, p.value, p.unit == "1" ? "" : " " + p.unit);
    if (p.half_width) {
      text += fmt::format(" (95 %: {:.3g} to {:.3g})", p.value - *p.half_width, p.value + *p.half_width);
    }
    values.push_back(text);
  }
  std::string text = "Consistent with " + title_of(named.id);
  for (const Found& found : diagnosis.search.found) {
    if (found.id == named.id && !found.by_law.empty()) {
      text += ": " + found.by_law + " rises ever less with the drive";
    }
  }
  if (!values.empty()) {
    text += ", " + join(values, " and ");
  }
  text += fmt::format(", which takes the held-out NRMSE from {:.3g} to {:.3g} (noise floor {:.2g})",
                      named.without->heldout, named.fit->heldout, diagnosis.noise_floor);
  if (!named.indistinguishable_from.empty()) {
    std::vector<std::string> others;
    for (const std::string& id : named.indistinguishable_from) {
      others.push_back(title_of(id));
    }
    text += "; these recordings cannot tell it from " + join(others, " or ");
  }
  if (!named.laws_as_good.empty()) {
    text += "; a richer dependence of " + join(named.laws_as_good, " or ") + " on the drive would explain as much";
  }
  for (const Found& found : diagnosis.search.found) {
    if (found.id != named.id || !named.indistinguishable_from.empty()) {
      continue;
    }
    std::vector<std::string> beaten;
    for (const Rival& rival : found.rivals) {
      if (beaten.size() < 2 && find_effect(rival.id) != nullptr && rival.share > 0.05) {
        beaten.push_back(
            fmt::format("{} ({:.0f} % of its gain)", title_of(rival.id), 100.0 * std::min(rival.share, 1.0)));
      }
    }
    if (!beaten.empty()) {
      text += "; next best in its place: " + join(beaten, " and ");
    }
  }
  return text + ".";
}

}  // namespace

std::map<std::string, int> base_laws(const std::string& model, const std::vector<Recording>& recordings) {
  std::set<long> levels;
  for (const Recording& recording : recordings) {
    for (const double drive : recording.drive) {
      levels.insert(std::lround(1e3 * drive));
    }
  }
  std::map<std::string, int> result;
  const Part* part = find_model(model);
  if (levels.size() < 2 || part == nullptr) {
    return result;
  }
  for (const Parameter& parameter : part->parameters) {
    const bool force = parameter.unit == "N" && parameter.lower >= 0.0;
    const bool damping = parameter.unit == "N s/m";
    if ((force || damping) && !parameter.fixed) {
      result[std::string(parameter.name)] = 1;
    }
  }
  return result;
}

namespace {

std::unique_ptr<Diagnosis> diagnose(const Campaign& campaign, const Split& split, const DiagnoseOptions& options,
                                    const SearchProgress& progress) {
  LayoutOptions layout = options.layout;
  std::vector<std::string> notes;
  if (layout.by_current.empty() && layout.by_frequency.empty()) {
    layout.by_current = base_laws(options.model, campaign.recordings);
    std::string list;
    for (const auto& [name, order] : layout.by_current) {
      list += (list.empty() ? "" : ",") + fmt::format("{}:{}", name, order);
    }
    if (!list.empty()) {
      notes.push_back("the drive varies and no laws were given: --by-current " + list + " assumed");
    }
  }
  const DataScale scale = scale_of(campaign.recordings);
  ObjectiveOptions objective = options.objective;
  objective.skip_run_in = true;
  Workbench bench(scale, split, layout, objective, options.seed, options.stopped);
  notes.push_back(bench.split().how);

  SearchOptions searching;
  searching.most_effects = options.most_effects;
  std::vector<Unobservable> hidden;
  for (const Part* effect : effect_catalogue()) {
    const std::string id(effect->id);
    if (!options.candidates.empty() && std::ranges::find(options.candidates, id) == options.candidates.end()) {
      continue;
    }
    if (const auto reason = excluded_by_inputs(id, bench.split().fit)) {
      hidden.push_back({id, *reason, ""});
    } else {
      searching.candidates.push_back(id);
    }
  }
  const Hypothesis base{options.model, {}, {}};
  auto result =
      std::make_unique<Diagnosis>(Diagnosis{std::move(bench), {}, {}, 0.0, {}, {}, {}, {}, {}, {}, {}, {}, {}, notes});
  Diagnosis& diagnosis = *result;
  Split fewer = diagnosis.bench.split();
  Split some = fewer;
  fewer.fit = thinned(spread(fewer.fit, quick_recordings), quick_samples);
  some.fit = thinned(some.fit, fine_samples);
  ObjectiveOptions coarse = objective;
  coarse.comparing = true;
  const Workbench quick(scale, std::move(fewer), layout, coarse, options.seed, options.stopped);
  const Workbench fine(scale, std::move(some), layout, coarse, options.seed, options.stopped);
  diagnosis.search = search(quick, fine, base, searching, progress);
  // What is reported is of every sample at the tolerance asked for.
  Search& found = diagnosis.search;
  found.base = diagnosis.bench.scored(found.base);
  found.augmented = diagnosis.bench.scored(found.augmented);
  for (Found& one : found.found) {
    one.without = diagnosis.bench.scored(one.without);
    for (Rival& rival : one.rivals) {
      if (rival.share > 0.5) {
        rival.fit = diagnosis.bench.scored(rival.fit);
      }
    }
  }
  if (found.augmented.heldout > most_loss * found.base.heldout) {
    found.augmented = found.base;
    found.quick_augmented = found.quick_base;
    found.misfit = found.base_misfit;
    found.found.clear();
    found.richer.clear();
    diagnosis.notes.push_back(
        "effects that improved the fit made the prediction of the held-out recordings worse and were dropped");
  }
  diagnosis.verdict = verdict_of(
      diagnosis.search, {[&](const Fit& fit, const std::string& effect) { return intervals_of(fine, fit, effect); },
                         velocity_channel_lag(diagnosis.bench.split().fit)});

  diagnosis.surprises = surprises(diagnosis.bench, diagnosis.search.augmented);
  if (diagnosis.verdict.word == "complete" && !diagnosis.surprises.empty()) {
    diagnosis.verdict.word = "unattributed";
    diagnosis.verdict.reason = "nothing but noise is left on the fitted recordings, but not on " +
                               join(diagnosis.surprises, " and ") +
                               ": what is missing shows there only, and only a fitted recording can tell its cause";
  }

  const Misfit& left = diagnosis.search.misfit;
  if (diagnosis.verdict.word == "complete" && left.squares > above_white * left.white) {
    const Wandering wander = wandering(fine, diagnosis.search.augmented);
    if (wanders(wander)) {
      diagnosis.verdict.word = "unattributed";
      diagnosis.verdict.reason = fmt::format(
          "{:.0f} % of what is left is a factor of the force that changes from moment to moment: a supply that cycles "
          "or "
          "a grip that changes, say; no known effect describes it",
          100.0 * wander.share);
    }
  }

  double floor = 0.0;
  std::set<std::string> methods;
  for (const Recording& recording : diagnosis.bench.split().fit) {
    const NoiseFloor noise = noise_floor(recording);
    const double relative = noise.sigma / normaliser(recording, options.objective.normalisation);
    floor += relative * relative / static_cast<double>(diagnosis.bench.split().fit.size());
    methods.insert(noise.method);
  }
  diagnosis.noise_floor = std::sqrt(floor);
  diagnosis.noise_floor_method = methods.size() == 1 ? *methods.begin() : "cycles where periodic, high-pass elsewhere";

  progress(0.95, "locating the misfit");
  if (structured(diagnosis.search.base_misfit) || !diagnosis.search.found.empty()) {
    diagnosis.locations = locate(diagnosis.bench, diagnosis.search.base);
  }
  for (const Named& named : diagnosis.verdict.effects) {
    diagnosis.parameters.push_back(intervals_of(fine, *named.fit, named.id));
    diagnosis.sentences.push_back(sentence_of(diagnosis, named, diagnosis.parameters.back()));
  }

  std::vector<std::string> absent;
  const auto listed = [&](const std::string& id) {
    return std::ranges::any_of(diagnosis.verdict.effects, [&](const Named& named) { return named.id == id; });
  };
  for (const std::string& id : searching.candidates) {
    if (!listed(id) && std::ranges::find(diagnosis.search.augmented.what.effects, id) ==
                           diagnosis.search.augmented.what.effects.end()) {
      absent.push_back(id);
    }
  }
  for (Unobservable& row : detection_limits(fine, diagnosis.search.augmented, diagnosis.search.misfit, absent)) {
    hidden.push_back(std::move(row));
  }
  diagnosis.not_observable = std::move(hidden);

  for (const Tried& tried : diagnosis.search.first_stage) {
    if (listed(tried.id) || find_effect(tried.id) == nullptr) {
      continue;
    }
    const Fit& before = diagnosis.search.quick_base;
    const double effective = diagnosis.search.effective;
    const double statistic =
        effective * std::log(std::max(before.cost * before.cost / (tried.fit.cost * tried.fit.cost), 1.0));
    const double more = std::max(1.0, static_cast<double>(tried.fit.dimension() - before.dimension()));
    Rejected row;
    row.id = tried.id;
    row.p = boost::math::gamma_q(0.5 * more, 0.5 * statistic);
    const double share =
        std::max(0.0, tried.gain) / std::max(before.cost * before.cost - diagnosis.search.quick_augmented.cost *
                                                                             diagnosis.search.quick_augmented.cost,
                                             1e-300);
    if (tried.evidence < 0.0) {
      row.reason = "alone it explains no more than the best of so many candidates would by chance";
    } else if (!diagnosis.search.found.empty()) {
      row.reason =
          fmt::format("alone it explains {:.0f} % of what the augmented model explains", 100.0 * std::min(share, 1.0));
    } else {
      row.reason =
          fmt::format("alone it takes {:.2g} % off the squared error: too little, or not on the held-out recordings",
                      100.0 * tried.gain / (before.cost * before.cost));
    }
    diagnosis.rejected.push_back(std::move(row));
  }

  std::vector<std::string> candidates;
  for (const Named& named : diagnosis.verdict.effects) {
    candidates.push_back(named.id);
  }
  if (diagnosis.verdict.word == "ambiguous") {
    diagnosis.next_experiment = next_experiment(candidates);
  } else if (diagnosis.verdict.word == "unattributed") {
    diagnosis.next_experiment = next_experiment({});
  } else if (diagnosis.verdict.word == "missing-physics") {
    diagnosis.next_experiment = "to confirm: " + next_experiment(candidates);
  } else {
    diagnosis.next_experiment =
        "none is needed for this model; effects listed as not observable need their own recordings";
  }
  if (!diagnosis.verdict.reason.empty()) {
    diagnosis.notes.push_back(diagnosis.verdict.reason);
  }
  if (diagnosis.verdict.word == "unattributed" && !diagnosis.search.augmented.what.effects.empty()) {
    diagnosis.notes.push_back("the augmented model uses " + join(diagnosis.search.augmented.what.effects, " and ") +
                              " as a shape that predicts better; it is not offered as the cause");
  }
  for (const std::string& name : diagnosis.search.richer) {
    diagnosis.notes.push_back("the recordings also ask for a richer dependence of " + name + " on the drive");
  }

  progress(0.98, "final fit");
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role == Role::validate; });
  diagnosis.final = fine.on_all(diagnosis.search.augmented,
                                thinned(roles ? diagnosis.bench.split().fit : campaign.recordings, fine_samples), 5);
  return result;
}

}  // namespace

std::unique_ptr<Diagnosis> diagnose(const Campaign& campaign, const DiagnoseOptions& options,
                                    const SearchProgress& progress) {
  const Split split = split_of(campaign);
  std::unique_ptr<Diagnosis> result = diagnose(campaign, split, options, progress);
  if (!split.by_program || result->surprises.empty()) {
    return result;
  }
  // The split was the program's own: what only a held-out recording shows has to be learnt from it.
  Split other = split_of(campaign, result->surprises);
  other.how += " (first others, of which " + join(result->surprises, " and ") + " showed what the fitted ones did not)";
  return diagnose(campaign, other, options, progress);
}

}  // namespace hysteron
