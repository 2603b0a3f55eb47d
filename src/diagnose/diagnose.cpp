#include "diagnose/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/drive.hpp"
#include "core/error.hpp"
#include "diagnose/account.hpp"
#include "diagnose/residual/leftover.hpp"
#include "diagnose/residual/tone.hpp"
#include "diagnose/residual/wander.hpp"
#include "diagnose/search/law_part.hpp"
#include "diagnose/search/left_out.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"
#include "diagnose/signal/noise.hpp"
#include "diagnose/signal/thin.hpp"
#include "diagnose/summary.hpp"
#include "fit/identify.hpp"
#include "io/outliers.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// What hypotheses are compared on.
constexpr std::size_t quick_samples = 3000;
constexpr std::size_t quick_recordings = 8;
// A held-out recording that is this many times further above its white noise, in squares, than every fitted one shows
// what these do not.
constexpr double surprise = 4.0;
// Squares over those of the white noise above which what is left is asked whether it follows the force.
constexpr double above_white = 1.5;
// Squares over those of the noise above which what is left is asked whether its size follows the motion.
constexpr double above_floor = 1.5;
// Two standard errors: the law asked for is given up for no less.
constexpr double surely = 2.0;
// Independent values for each parameter without which nothing left cannot be told from too little data.
constexpr double values_per_parameter = 4.0;
// Least share of the largest force that counts as noise there.
constexpr double least_noise = 1e-4;
// A recorded velocity correlates with the slope of the displacement at least so.
constexpr double least_likeness = 0.5;
// What the base and the augmented model are then fitted on; every sample is predicted in the end.
constexpr std::size_t fine_samples = 8000;

std::vector<Estimate> estimates_of(const Workbench& bench, const Fit& fit) {
  const Objective objective(*fit.layout, bench.split().fit, bench.options());
  Identification identification{*fit.layout, fit.terms, {}, {}, 0, fit.cost, {}, {}, {}, false, {}};
  estimate(identification, objective, fit.point, bench.split().fit.front().drive_kind);
  return identification.estimates;
}

// Estimates of the fits that have been asked for: one fit is asked for several effects, and derivatives behind series
// elements take long.
class Estimates {
 public:
  explicit Estimates(const Workbench& bench) : bench_(&bench) {}

  // Valid until the next one.
  const std::vector<Estimate>& of(const Fit& fit) {
    const auto known =
        std::ranges::find_if(known_, [&](const Known& one) { return one.what == fit.what && one.point == fit.point; });
    if (known != known_.end()) {
      return known->estimates;
    }
    return known_.emplace_back(Known{fit.what, fit.point, estimates_of(*bench_, fit)}).estimates;
  }

 private:
  struct Known {
    Hypothesis what;
    std::vector<double> point;
    std::vector<Estimate> estimates;
  };
  const Workbench* bench_;
  std::vector<Known> known_;
};

// Of an effect of the fit, or of the parameter in which its law has it as a part of its own.
std::vector<ParameterInterval> intervals_of(const std::vector<Estimate>& estimates, const std::string& effect,
                                            const Fit& fit) {
  const bool joined = contains(fit.what, effect_extension(effect));
  const PartOfLaw* part = joined ? nullptr : part_of_law(effect, fit.what.model);
  const std::string own(part == nullptr ? std::string_view{} : part->parameter);
  const std::string prefix = effect + ".";
  std::vector<ParameterInterval> result;
  for (const Estimate& row : estimates) {
    const bool of_law = !own.empty() && (row.name == own || row.name.starts_with(own + "*"));
    if (of_law || row.name.starts_with(prefix)) {
      result.push_back({of_law ? row.name : row.name.substr(prefix.size()), row.unit, row.term.value, row.half_width,
                        row.at_bound.value_or(""), row.lower});
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

}  // namespace

std::vector<std::string> alternative_laws() {
  std::vector<std::string> result;
  for (const Part* law : model_catalogue()) {
    if (law->alternative) {
      result.emplace_back(law->id);
    }
  }
  return result;
}

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
    const bool follows = parameter.role == PhysicalRole::yield_force || parameter.role == PhysicalRole::damping;
    if (follows && !parameter.fixed) {
      result[std::string(parameter.name)] = 1;
    }
  }
  return result;
}

namespace {

// The laws of the user's choice, or the base model's own with a note.
LayoutOptions with_laws(const DiagnoseOptions& options, const Campaign& campaign, std::vector<std::string>& notes) {
  LayoutOptions layout = options.layout;
  if (!layout.by_current.empty() || !layout.by_frequency.empty()) {
    return layout;
  }
  layout.by_current = base_laws(options.model, campaign.recordings);
  std::string list;
  for (const auto& [name, order] : layout.by_current) {
    list += (list.empty() ? "" : ",") + fmt::format("{}:{}", name, order);
  }
  if (!list.empty()) {
    notes.push_back("the drive varies and no laws were given: --by-current " + list + " assumed");
  }
  return layout;
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

// In N. Of every sample: a thinned recording has no high frequencies.
std::optional<Tone> tone_left(const Search& search, const Workbench& bench) {
  const std::vector<Recording>& recordings = bench.split().fit;
  return tone_of(
      leftovers_of(recordings, bench.plain_residuals(search.augmented), std::vector<double>(recordings.size(), 1.0)));
}

// Why more than noise is left though no effect helps: a held-out recording, or the residual's bond to the force, shows
// it. Empty where nothing does.
struct Doubt {
  std::string why;
  bool of_tone = false;
};
Doubt doubt_of_completeness(const Search& search, const Workbench& fine, const std::vector<std::string>& surprising,
                            const std::optional<Tone>& tone) {
  if (!surprising.empty()) {
    return {"nothing but noise is left on the fitted recordings, but not on " + joined(surprising, " and ") +
            ": what is missing shows there only, and only a fitted recording can tell its cause"};
  }
  const Misfit& left = search.misfit;
  const auto parameters = static_cast<double>(search.augmented.dimension());
  if (left.independent < values_per_parameter * parameters) {
    return {fmt::format(
        "what is left holds {:.0f} independent values for {:.0f} parameters: too few to tell noise from what is "
        "missing",
        left.independent, parameters)};
  }
  if (left.squares <= above_white * left.white) {
    return {};
  }
  if (left.squares > above_floor * left.floor && uneven(left.evenness)) {
    return {"the size of what is left follows the motion, as that of noise does not"};
  }
  if (tone) {
    return {sentence_of(*tone), true};
  }
  const Residuals residuals = fine.residuals(search.augmented);
  const Wandering wander = wandering(leftovers_of(fine.split().fit, residuals.of, residuals.norms));
  if (!wanders(wander)) {
    return {};
  }
  return {
      fmt::format("{:.0f} % of what is left is a factor of the force that {}", 100.0 * wander.share,
                  wander.period > 0.0
                      ? fmt::format("swings with a period of {:.2g} s whatever the motion, as of a supply that cycles",
                                    wander.period)
                      : std::string("changes from moment to moment, as of a supply or a grip that changes"))};
}

// Why no name can be given: the recorded velocity is not that of the displacement, and effects would explain a fault of
// the data. Empty where it is.
std::string doubt_of_velocity(const std::vector<Recording>& recordings) {
  for (const Recording& recording : recordings) {
    if (!recording.velocity_measured) {
      continue;
    }
    const std::vector<double> slope = derive_velocity(recording.time, recording.displacement);
    double product = 0.0;
    double squares = 0.0;
    double recorded = 0.0;
    for (std::size_t n = 0; n < slope.size(); ++n) {
      product += slope[n] * recording.velocity[n];
      squares += slope[n] * slope[n];
      recorded += recording.velocity[n] * recording.velocity[n];
    }
    const double alike = product / std::max(std::sqrt(squares * recorded), 1e-300);
    if (alike < least_likeness) {
      return fmt::format(
          "{}: the recorded velocity is not the slope of the displacement (correlation {:.2f}); without that column "
          "the velocity would be derived",
          recording.file, alike);
    }
  }
  return {};
}

// A search with what it allows to say.
struct Judgement {
  Search search;
  std::vector<std::string> surprising;
  std::optional<Tone> tone;
  bool tone_doubts = false;
  std::vector<Contrast> contrasts;
  std::optional<Belonging> belonging;
  std::optional<ColumnTold> column;
  Evidence evidence;
  Verdict verdict;
  std::optional<Estimates> estimates;
  std::optional<Search> asked;  // behind the law whose place this one takes
};

Judgement judged(Search found, const Workbench& bench, const Workbench& fine, const std::string& doubt_of_data) {
  Judgement result;
  result.estimates.emplace(fine);
  result.search = std::move(found);
  // Of every sample: what relaxes after a stop, or lags, is over within what a thinned recording leaves out.
  result.contrasts = contrasts(bench.split().fit, bench.plain_residuals(result.search.base));
  for (Found& one : result.search.found) {
    one.contrasts = one.without.what == result.search.base.what
                        ? result.contrasts
                        : contrasts(bench.split().fit, bench.plain_residuals(one.without));
  }
  const Circumstances known = {
      [&](const Fit& fit, const std::string& effect) { return intervals_of(result.estimates->of(fit), effect, fit); },
      velocity_channel_lag(bench.split().fit), result.contrasts,
      [&](const Fit& fit) { return contrasts(bench.split().fit, bench.plain_residuals(fit), Placebos::none); }};
  result.surprising = surprises(bench, result.search.augmented);
  result.tone = tone_left(result.search, bench);
  result.evidence = evidence_of(result.search, fine, known);
  const Doubt doubt = doubt_of_completeness(result.search, fine, result.surprising, result.tone);
  result.evidence.doubt_of_completeness = doubt.why;
  result.tone_doubts = doubt.of_tone;
  result.evidence.doubt_of_data = doubt_of_data;
  return result;
}

// Recordings, and how they are searched.
struct Searching {
  const Workbench& bench;
  const Workbench& quick;
  const Workbench& fine;
  const Workbench& every;
  SearchOptions options;
  std::string doubt_of_data;  // why no name can be given on these recordings, known before any search

  [[nodiscard]] Search search_behind(const std::string& law, const SearchProgress& progress) const {
    return search(quick, fine, {law, {}, {}}, options, progress);
  }
  [[nodiscard]] Judgement judged(Search found) const {
    return hysteron::judged(std::move(found), bench, fine, doubt_of_data);
  }
  [[nodiscard]] Judgement behind(const std::string& law, const SearchProgress& progress) const {
    return judged(search_behind(law, progress));
  }
  // With whether the recordings belong together or follow a column, judging ones too: that is no matter of how well a
  // fit predicts.
  [[nodiscard]] Judgement whole(Judgement judgement) const {
    const ByRecording base = by_recording(every, judgement.search.base);
    judgement.column = unused_column(every, base);
    if (judgement.evidence.doubt_of_data.empty()) {
      judgement.belonging = belonging_of(every, base, judgement.search.augmented);
      judgement.evidence.doubt_of_data = mixed(judgement.belonging) ? sentence_of(*judgement.belonging) : std::string{};
    }
    judgement.verdict = verdict_of(judgement.evidence);
    return judgement;
  }
};

// Behind `asked`. Where another damper law does as well without any effect, what is missing behind that one is looked
// for. It takes the place of the one asked for where it surely predicts recordings left out better, effects and all,
// than the one asked for with all the effects that the recordings ask for (with two of them where these leave twice the
// squares of the other): a law that does no better than that is no reason to doubt it.
Judgement behind_asked_or_better(Searching searching, const std::string& asked, const SearchProgress& progress,
                                 std::vector<std::string>& notes) {
  Judgement first = searching.behind(asked, progress);
  const std::string law = better_law(first.evidence);
  const SearchProgress behind_law = [&](double share, const std::string& stage) {
    progress(0.9 + 0.02 * share, "behind " + law + ": " + stage);
  };
  std::optional<Search> other;
  if (!law.empty()) {
    other = searching.search_behind(law, behind_law);
  }
  const bool beaten = other && squared(first.search.augmented.cost) > comparable * squared(other->augmented.cost);
  if (first.search.limited && !beaten) {
    searching.options.in_full = true;
    first = searching.behind(asked, [&](double share, const std::string& stage) {
      progress(0.92 + 0.02 * share, "behind " + asked + " again: " + stage);
    });
  }
  if (!other) {
    return searching.whole(std::move(first));
  }
  const std::vector<LeftOut> both = left_out(searching.fine, {&first.search.augmented, &other->augmented});
  if (block_score(both[0].predicted, both[1].predicted, noise_of(searching.fine)).z() < surely) {
    return searching.whole(std::move(first));
  }
  take_parts_of_law(*other, first.search, searching.quick, searching.options, behind_law);
  Judgement second = searching.judged(std::move(*other));
  second.evidence.asked_for = asked;
  second.evidence.behind_asked = {first.evidence};
  second = searching.whole(std::move(second));
  // Of the misfit of the law asked for, part of which the other law takes.
  const Left before = first.evidence.base;
  const double left = std::clamp(second.evidence.base.excess() / std::max(before.excess(), 1e-300), 0.0, 1.0);
  second.verdict.unknown_share *= left;
  for (std::vector<Named>* list : {&second.verdict.effects, &second.verdict.suggestions, &second.verdict.doubtful}) {
    for (Named& named : *list) {
      named.share_of_misfit *= named.of_law ? 1.0 : left;
    }
  }
  second.search.base = first.search.base;
  second.search.base_misfit = first.search.base_misfit;
  second.asked = std::move(first.search);
  notes.push_back(
      fmt::format("{} takes the place of {}, with which recordings left out are predicted worse: what is "
                  "named is missing behind {}",
                  law, asked, law));
  return second;
}

// The names that come from the search behind the law asked for, or the others.
std::vector<Named> named_of(std::vector<Named> names, bool behind_asked) {
  std::erase_if(names, [&](const Named& named) { return named.behind_asked != behind_asked; });
  return names;
}

// What is reported is of every sample at the tolerance asked for, and of the judging recordings, which nothing before
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

Workbenches workbenches_of(const Campaign& campaign, const Split& split, const DiagnoseOptions& options,
                           std::vector<std::string>& notes) {
  const LayoutOptions layout = with_laws(options, campaign, notes);
  const DataScale scale = scale_of(campaign.recordings);
  ObjectiveOptions objective = options.objective;
  objective.skip_run_in = true;
  objective.stopped = options.stopped;
  ObjectiveOptions coarse = objective;
  coarse.comparing = true;
  Split fewer{thinned(spread(split.fit, quick_recordings), quick_samples), {}, {}, false};
  Split some{thinned(split.fit, fine_samples), {}, {}, false};
  Workbenches result{Workbench(scale, split, layout, objective, options.seed, options.stopped),
                     Workbench(scale, std::move(fewer), layout, coarse, options.seed, options.stopped),
                     Workbench(scale, std::move(some), layout, coarse, options.seed, options.stopped),
                     Workbench(scale, {thinned(campaign.recordings, fine_samples), {}, {}, false}, layout, coarse,
                               options.seed, options.stopped)};
  result.quick.take_noise_of(result.whole);
  if (options.checkpoint != nullptr) {
    for (Workbench* bench : {&result.whole, &result.quick, &result.fine, &result.every}) {
      bench->keep_in(*options.checkpoint);
    }
  }
  return result;
}

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

namespace {

std::unique_ptr<Diagnosis> diagnose(const Campaign& campaign, const Split& split, const DiagnoseOptions& options,
                                    const SearchProgress& progress) {
  check_samples(split);
  std::vector<std::string> notes;
  Workbenches benches = workbenches_of(campaign, split, options, notes);
  const Workbench& quick = benches.quick;
  const Workbench& fine = benches.fine;
  auto result = std::make_unique<Diagnosis>(std::move(benches.whole), std::move(notes));
  Diagnosis& diagnosis = *result;
  diagnosis.notes.push_back(split.how);

  SearchOptions searching;
  const std::string doubt = doubt_of_velocity(diagnosis.bench.split().fit);
  // No name is given on a fault of the data, so no effects are looked for.
  searching.most_effects = doubt.empty() ? options.most_effects : 0;
  searching.candidates = candidates_of(options, diagnosis);
  searching.told = told_by_channels(fine.split().fit, searching.candidates);
  searching.laws = options.laws;
  searching.stands = options.stands;
  Judgement judgement = behind_asked_or_better({diagnosis.bench, quick, fine, benches.every, searching, doubt},
                                               options.model, progress, diagnosis.notes);
  diagnosis.search = std::move(judgement.search);
  diagnosis.asked = std::move(judgement.asked);
  diagnosis.surprises = std::move(judgement.surprising);
  diagnosis.tone = judgement.tone;
  diagnosis.tone_doubts = judgement.tone_doubts;
  diagnosis.belonging = std::move(judgement.belonging);
  diagnosis.column = std::move(judgement.column);
  diagnosis.evidence = std::move(judgement.evidence);
  diagnosis.verdict = std::move(judgement.verdict);
  diagnosis.contrasts = std::move(judgement.contrasts);
  diagnosis.drive = drive_kind_of(campaign.recordings);
  const std::string instead = law_instead(diagnosis.search);
  const std::vector<Named> names = listed(diagnosis.verdict);
  score_on_all(diagnosis.search, named_of(names, false), diagnosis.bench);
  if (diagnosis.asked) {
    score_on_all(*diagnosis.asked, named_of(names, true), diagnosis.bench);
  }
  estimate_noise_floor(diagnosis, options.objective.normalisation);

  progress(0.95, "locating the misfit");
  // Where nothing but noise is left, places of it would be those of chance.
  if (diagnosis.verdict.answer != Answer::complete &&
      (structured(diagnosis.search.base_misfit) || !diagnosis.search.found.empty())) {
    diagnosis.locations = locate(diagnosis.bench.split().fit, diagnosis.bench.residuals(diagnosis.search.base));
    if (diagnosis.verdict.remaining_structure && !(diagnosis.search.augmented.what == diagnosis.search.base.what)) {
      diagnosis.locations_left =
          locate(diagnosis.bench.split().fit, diagnosis.bench.residuals(diagnosis.search.augmented));
    }
  }
  diagnosis.drift_of_base = drift_of(fine, diagnosis.search.base);
  diagnosis.drift_of_augmented = drift_of(fine, diagnosis.search.augmented);
  for (const Named& named : names) {
    const Fit& fit = fit_of(diagnosis, named);
    diagnosis.parameters.push_back(intervals_of(judgement.estimates->of(fit), named.id, fit));
    diagnosis.sentences.push_back(
        sentence_of(diagnosis, named, diagnosis.parameters.back()) +
        (instead.empty() ? ""
         : named.of_law
             ? " " + instead + ", which takes the place of " + options.model + ", has it as a part of its own."
             : " All this behind " + instead + ", which takes the place of " + options.model + "."));
  }
  for (const Named& named : names) {
    diagnosis.views.push_back(
        view_of(contrast_of(diagnosis, named), fine.split().fit, fine.plain_residuals(without_of(diagnosis, named))));
  }
  for (const Named& shape : diagnosis.verdict.doubtful) {
    const Fit& fit = diagnosis.search.augmented;
    diagnosis.shapes.push_back(intervals_of(judgement.estimates->of(fit), shape.id, fit));
  }
  std::vector<std::string> absent;
  for (const std::string& id : searching.candidates) {
    const std::vector<std::string>& used = diagnosis.search.augmented.what.effects;
    if (std::ranges::find(names, id, &Named::id) == names.end() && std::ranges::find(used, id) == used.end()) {
      absent.push_back(id);
    }
  }
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

  progress(0.98, "final fit");
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role == Role::validate; });
  diagnosis.final = fine.on_all(diagnosis.search.augmented,
                                thinned(roles ? diagnosis.bench.split().fit : campaign.recordings, fine_samples), 5);
  return result;
}

void add_note(Diagnosis& diagnosis, const std::string& note) {
  if (!note.empty()) {
    diagnosis.notes.push_back(note);
  }
}

}  // namespace

std::unique_ptr<Diagnosis> diagnose(const Campaign& recorded, const DiagnoseOptions& options,
                                    const SearchProgress& progress) {
  Campaign campaign = recorded;
  const std::string cleaned = without_outliers(campaign);
  const Split split = split_of(campaign);
  std::unique_ptr<Diagnosis> result = diagnose(campaign, split, options, progress);
  if (!split.by_program || result->surprises.empty()) {
    add_note(*result, cleaned);
    return result;
  }
  // The split was the program's own: what only a held-out recording shows has to be learnt from it.
  Split other = split_of(campaign, result->surprises);
  other.how +=
      " (first others, of which " + joined(result->surprises, " and ") + " showed what the fitted ones did not)";
  result = diagnose(campaign, other, options, progress);
  add_note(*result, cleaned);
  return result;
}

}  // namespace hysteron
