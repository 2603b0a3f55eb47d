#include "diagnose/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <set>

#include "core/apart.hpp"
#include "core/drive.hpp"
#include "core/error.hpp"
#include "core/joined.hpp"
#include "diagnose/account.hpp"
#include "diagnose/base_bounds.hpp"
#include "diagnose/doubts.hpp"
#include "diagnose/judgement.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/wording.hpp"
#include "diagnose/shown.hpp"
#include "diagnose/signal/noise.hpp"
#include "diagnose/signal/thin.hpp"
#include "diagnose/summary.hpp"
#include "diagnose/without_tones.hpp"
#include "diagnose/workbenches.hpp"
#include "io/outliers.hpp"

namespace hysteron {

std::vector<Named> listed(const Verdict& verdict) {
  std::vector<Named> result = verdict.effects;
  result.insert(result.end(), verdict.suggestions.begin(), verdict.suggestions.end());
  return result;
}

const Search& search_of(const Diagnosis& diagnosis, const Named& named) {
  return named.behind_asked && diagnosis.asked ? *diagnosis.asked : diagnosis.search;
}

const Fit& fit_of(const Diagnosis& diagnosis, const Named& named) {
  const Search& search = search_of(diagnosis, named);
  if (!named.in_place_of) {
    return search.augmented;
  }
  const auto found =
      std::ranges::find_if(search.found, [&](const Found& one) { return one.part.effect == *named.in_place_of; });
  const auto rival =
      std::ranges::find_if(found->rivals, [&](const Rival& one) { return one.fit && one.part.effect == named.id; });
  return rival == found->rivals.end() ? search.augmented : *rival->fit;
}

bool has_fit(const Diagnosis& diagnosis, const Named& named) {
  return !named.in_place_of || contains(fit_of(diagnosis, named).what, effect_extension(named.id));
}

std::string law_instead(const Search& search) {
  return search.augmented.what.model == search.base.what.model ? std::string{} : search.augmented.what.model;
}

// The effect of the augmented model in whose place a name stands: mostly itself.
std::string place_of(const Named& named) { return named.in_place_of.value_or(named.id); }

const Fit& without_of(const Diagnosis& diagnosis, const Named& named) {
  const Search& search = search_of(diagnosis, named);
  const auto found = std::ranges::find(search.found, place_of(named), [](const Found& one) { return one.part.effect; });
  return found->without;
}

namespace {

void add_note(Diagnosis& diagnosis, const std::string& note) {
  if (!note.empty()) {
    diagnosis.notes.push_back(note);
  }
}

// Of laws in parameters that the base law lacks; empty without any. Other laws that are tried, or effects, have them.
std::string note_of_laws_elsewhere(const DiagnoseOptions& options) {
  const std::vector<std::string> own = make_model(options.model, {}).parameter_names();
  std::set<std::string> lacking;
  const auto add = [&](const LawOrders& orders) {
    for (const auto& [parameter, order] : orders) {
      if (std::ranges::find(own, parameter) == own.end()) lacking.insert(parameter);
    }
  };
  add(options.layout.by_current);
  add(options.layout.by_frequency);
  for (const auto& [condition, orders] : options.layout.by) add(orders);
  if (lacking.empty()) return {};
  const bool one = lacking.size() == 1;
  const std::vector<std::string> names(lacking.begin(), lacking.end());
  return fmt::format("{} has no {}, so that {} only where another damper law or an effect has {}", options.model,
                     joined(names, " and no "), one ? "its law acts" : "their laws act", one ? "it" : "them");
}

// Effects that the inputs excite; the others are noted as not observable.
std::vector<std::string> candidates_of(const DiagnoseOptions& options, Diagnosis& diagnosis) {
  std::vector<std::string> result;
  for (const Part* effect : effect_catalogue()) {
    const std::string id(effect->id);
    if (!options.candidates.empty() && std::ranges::find(options.candidates, id) == options.candidates.end()) {
      continue;
    }
    if (const auto reason = excluded_by_inputs(id, diagnosis.bench.split().fit)) {
      diagnosis.not_observable.push_back({id, *reason, ""});
    } else {
      result.push_back(id);
    }
  }
  return result;
}

// The names that come from the search behind the law asked for, or the others.
std::vector<Named> named_of(std::vector<Named> names, bool behind_asked) {
  std::erase_if(names, [&](const Named& named) { return named.behind_asked != behind_asked; });
  return names;
}

// What is reported is of every sample at the tolerance asked for, and of the held-out recordings, which nothing before
// has looked at.
void score_on_all(Search& found, const std::vector<Named>& names, const Workbench& bench) {
  found.base = bench.scored(found.base);
  found.augmented = bench.scored(found.augmented);
  for (Found& one : found.found) {
    if (std::ranges::find(names, one.part.effect, place_of) == names.end()) {
      continue;
    }
    one.without = bench.scored(one.without);
    for (Rival& rival : one.rivals) {
      if (rival.fit && std::ranges::find(names, rival.part.effect, &Named::id) != names.end()) {
        rival.fit = bench.scored(*rival.fit);
      }
    }
  }
}

void estimate_noise_floor(Diagnosis& diagnosis, Normalisation normalisation) {
  const auto relative = [&](const Recording& recording, const NoiseFloor& noise) {
    return squared(noise.sigma / normaliser(recording, normalisation));
  };
  const std::vector<Recording>& recordings = diagnosis.bench.split().fit;
  const std::vector<NoiseFloor>& floors = diagnosis.bench.noise();
  double fitted = 0.0;
  diagnosis.noise_floor_method = floors.front().method;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    fitted += relative(recordings[k], floors[k]);
    if (floors[k].method != floors.front().method) {
      diagnosis.noise_floor_method = NoiseMethod::mixed;
    }
  }
  double heldout = 0.0;
  for (const Judged& judged : diagnosis.bench.split().judge) {
    heldout += relative(judged.recording, noise_floor(judged.recording));
  }
  diagnosis.noise_floor = std::sqrt(fitted / static_cast<double>(diagnosis.bench.split().fit.size()));
  diagnosis.noise_floor_heldout = std::sqrt(heldout / static_cast<double>(diagnosis.bench.split().judge.size()));
}

void check_samples(const Split& split) {
  for (const Recording& recording : split.fit) {
    if (recording.size() < fewest_noise_samples) {
      throw InputError(
          fmt::format("{}: {} samples to fit, expected at least {}: fewer do not tell the noise of the force",
                      recording.file, recording.size(), fewest_noise_samples));
    }
  }
}

}  // namespace

std::string without_outliers(Campaign& campaign) {
  std::size_t replaced = 0;
  std::size_t samples = 0;
  std::size_t recordings = 0;
  for (Recording& recording : campaign.recordings) {
    const std::size_t here = replace_outliers(recording);
    replaced += here;
    samples += recording.size();
    recording.drive = quiet_drive(recording.drive);
    recordings += here > 0 ? 1 : 0;
  }
  return replaced == 0 ? std::string{}
                       : fmt::format(
                             "{} of {} force samples, in {} of {} recordings, stand out alone: they were replaced by "
                             "what their neighbours say before anything was compared (table and plots of the "
                             "recordings still hold them)",
                             replaced, samples, recordings, campaign.recordings.size());
}

Campaign without_apart(const Campaign& campaign) {
  Campaign result = campaign;
  const std::vector<Apart> apart = apart_from_others(campaign.recordings);
  for (const Apart& one : apart | std::views::reverse) {
    result.recordings.erase(result.recordings.begin() + static_cast<std::ptrdiff_t>(one.recording));
    result.roles.erase(result.roles.begin() + static_cast<std::ptrdiff_t>(one.recording));
  }
  return result;
}

namespace {

std::string note_of_apart(const Campaign& campaign) {
  std::vector<std::string> files;
  for (const Apart& apart : apart_from_others(campaign.recordings)) {
    files.push_back(campaign.recordings[apart.recording].file);
  }
  if (files.empty()) return {};
  return fmt::format(
      "{} left out: no other recording has the rod at these positions, so a spring or a stop there looks like a sensor "
      "zero that was set differently; correct the zero, or add a second recording there, and it counts",
      joined(files, " and ") + (files.size() == 1 ? " was" : " were"));
}

std::unique_ptr<Diagnosis> diagnose(const Campaign& campaign, const Split& split, const DiagnoseOptions& options,
                                    const std::optional<Tone>& taken_out, const SearchProgress& told) {
  // A search that takes something back does again what it has done: nobody is told less than before.
  double reached = 0.0;
  const SearchProgress progress = [&](double share, const std::string& stage) {
    reached = std::max(reached, share);
    told(reached, stage);
  };
  check_samples(split);
  std::vector<std::string> notes;
  Workbenches benches = workbenches_of(campaign, split, options, notes);
  const Workbench& quick = benches.quick;
  const Workbench& fine = benches.fine;
  auto result = std::make_unique<Diagnosis>(std::move(benches.whole), std::move(notes));
  Diagnosis& diagnosis = *result;
  diagnosis.notes.push_back(split.how);
  if (std::ranges::any_of(campaign.recordings, [](const Recording& recording) { return !recording.earlier.empty(); })) {
    diagnosis.notes.emplace_back(
        "the starts of the recordings are told: heat and wear go on from one to the next, by the measured force");
  }

  add_note(diagnosis, note_of_laws_elsewhere(options));
  if (!options.candidates.empty()) {
    add_note(diagnosis, "only these effects were tried: " + joined(options.candidates, ", "));
  }

  SearchOptions searching;
  std::string doubt = doubt_of_velocity(diagnosis.bench.split().fit);
  if (doubt.empty()) doubt = doubt_of_channels(campaign.recordings);
  // No name is given on a fault of the data, so no effects are looked for.
  searching.most_effects = doubt.empty() ? options.most_effects : 0;
  searching.candidates = candidates_of(options, diagnosis);
  searching.told = told_by_channels(fine.split().fit, searching.candidates);
  searching.laws = options.laws;
  searching.stands = options.stands;
  Judgement judgement =
      behind_asked_or_better({diagnosis.bench, quick, fine, benches.every, searching, doubt, taken_out}, options.model,
                             within(progress, 0.0, 0.9), diagnosis.notes);
  diagnosis.search = std::move(judgement.search);
  diagnosis.asked = std::move(judgement.asked);
  diagnosis.surprises = std::move(judgement.surprising);
  diagnosis.tone = judgement.tone;
  diagnosis.tone_taken_out = taken_out.has_value();
  diagnosis.tone_doubts = judgement.tone_doubts;
  diagnosis.too_few_values = judgement.too_few_values;
  diagnosis.belonging = std::move(judgement.belonging);
  diagnosis.column = std::move(judgement.column);
  diagnosis.evidence = std::move(judgement.evidence);
  diagnosis.verdict = std::move(judgement.verdict);
  diagnosis.contrasts = std::move(judgement.contrasts);
  diagnosis.drive = drive_kind_of(campaign.recordings);
  name_units(diagnosis.evidence, diagnosis.drive);
  const std::vector<Named> names = listed(diagnosis.verdict);
  progress(0.9, "scoring on every sample");
  score_on_all(diagnosis.search, named_of(names, false), diagnosis.bench);
  if (diagnosis.asked) {
    score_on_all(*diagnosis.asked, named_of(names, true), diagnosis.bench);
  }
  estimate_noise_floor(diagnosis, options.objective.normalisation);

  progress(0.92, "locating the misfit");
  // Where nothing but noise is left, places of it would be those of chance.
  if (diagnosis.verdict.answer != Answer::complete && !only_a_tone(diagnosis) &&
      (structured(diagnosis.search.base_misfit) || !diagnosis.search.found.empty())) {
    diagnosis.locations = locate(diagnosis.bench.split().fit, diagnosis.bench.residuals(diagnosis.search.base));
    if (diagnosis.verdict.remaining_structure && !(diagnosis.search.augmented.what == diagnosis.search.base.what)) {
      diagnosis.locations_left =
          locate(diagnosis.bench.split().fit, diagnosis.bench.residuals(diagnosis.search.augmented));
    }
  }
  if (diagnosis.verdict.answer != Answer::complete) add_note(diagnosis, note_of_bounds(fine, diagnosis.search.base));
  diagnosis.drift_of_base = drift_of(fine, diagnosis.search.base);
  diagnosis.drift_of_augmented = drift_of(fine, diagnosis.search.augmented);
  for (const Named& named : names) {
    const Fit& fit = fit_of(diagnosis, named);
    diagnosis.parameters.push_back(judgement.estimates->intervals(fit, named.id));
    diagnosis.sentences.push_back(sentence_of(diagnosis, named, diagnosis.parameters.back()));
  }
  for (const Named& named : names) {
    const Contrast* contrast = contrast_of(diagnosis, named);
    diagnosis.views.push_back(view_of(contrast, fine.split().fit, fine.plain_residuals(without_of(diagnosis, named))));
    diagnosis.seen.push_back(
        contrast == nullptr || contrast->of_all
            ? std::nullopt
            : std::optional(seen_in(*contrast, acting_in(fine, fit_of(diagnosis, named), named.id))));
  }
  for (const Named& shape : diagnosis.verdict.doubtful) {
    const Fit& fit = diagnosis.search.augmented;
    diagnosis.shapes.push_back(judgement.estimates->intervals(fit, shape.id));
  }
  std::vector<std::string> absent;
  for (const std::string& id : searching.candidates) {
    const std::vector<std::string>& used = diagnosis.search.augmented.what.effects;
    if (std::ranges::find(names, id, &Named::id) == names.end() && std::ranges::find(used, id) == used.end()) {
      absent.push_back(id);
    }
  }
  progress(0.95, "looking for what could not be seen");
  // What the effects of the augmented model imitate of others is little beside what the law does, and behind a series
  // element every simulation takes several times as long.
  for (Unobservable& row : detection_limits(quick, diagnosis.search.base, diagnosis.search.misfit, absent)) {
    diagnosis.not_observable.push_back(std::move(row));
  }
  diagnosis.alias = alias_map(quick, diagnosis.search.base, searching.candidates);
  diagnosis.rejected = rejected_of(diagnosis);
  diagnosis.next_experiment = experiment_after(diagnosis);
  note_verdict(diagnosis);
  diagnosis.summary = summary_of(diagnosis);

  progress(0.97, "final fit");
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role == Role::validate; });
  diagnosis.final = fine.on_all(diagnosis.search.augmented,
                                thinned(roles ? diagnosis.bench.split().fit : campaign.recordings, fine_samples), 5);
  return result;
}

}  // namespace

std::unique_ptr<Diagnosis> diagnose(const Campaign& recorded, const DiagnoseOptions& options,
                                    const SearchProgress& progress) {
  Campaign campaign = without_apart(recorded);
  const std::string cleaned = without_outliers(campaign);
  Split split = split_of(campaign);
  std::unique_ptr<Diagnosis> result = diagnose(campaign, split, options, std::nullopt, progress);
  std::string cleared;
  std::optional<Tone> taken_out;
  if (result->tone && result->evidence.doubt_of_data.empty()) {
    WithoutTones without = without_tones(campaign, result->search.augmented, result->bench);
    if (!without.tones.empty()) {
      campaign = std::move(without.campaign);
      split = split_of(campaign);
      taken_out = without.tones.front();
      cleared = sentence_of(without.tones);
      result = diagnose(campaign, split, options, taken_out,
                        within(progress, 0.0, 1.0, fmt::format("without {:.3g} Hz: ", taken_out->frequency)));
    }
  }
  const auto noted = [&](std::unique_ptr<Diagnosis> finished) {
    add_note(*finished, cleaned);
    add_note(*finished, cleared);
    add_note(*finished, note_of_apart(recorded));
    return finished;
  };
  if (!split.by_program || result->surprises.empty()) {
    return noted(std::move(result));
  }
  // The split was the program's own: what only a held-out recording shows has to be learnt from it.
  Split other = split_of(campaign, result->surprises);
  other.how +=
      " (first others, of which " + joined(result->surprises, " and ") + " showed what the fitted ones did not)";
  return noted(diagnose(campaign, other, options, taken_out, within(progress, 0.0, 1.0, "with others held out: ")));
}

}  // namespace hysteron
