#include "diagnose/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "diagnose/doubts.hpp"
#include "diagnose/residual/zero_step.hpp"
#include "diagnose/search/law_part.hpp"
#include "diagnose/search/left_out.hpp"
#include "diagnose/search/of_fit.hpp"
#include "io/channel_lag.hpp"

namespace hysteron {
namespace {

// Standard errors by which another law must predict recordings left out better to take the place of the one asked for.
constexpr double replacement_errors = 2.0;

Judgement judge_search(Search found, const Searching& searching, const SearchProgress& progress) {
  const Workbench& bench = searching.bench;
  const Workbench& fine = searching.fine;
  Judgement result;
  result.estimates.emplace(fine);
  result.search = std::move(found);
  constexpr double of_other_laws = 0.35;  // share of the time
  const auto trying = [&](double share) {
    progress(of_other_laws * share, "trying the effects behind other damper laws");
  };
  trying(0.0);
  try_behind_other_laws(result.search, searching.quick, trying);
  const auto weighing = [&](double share) {
    progress(of_other_laws + (1.0 - of_other_laws) * share, "weighing the evidence");
  };
  weighing(0.0);
  // Of every sample: what relaxes after a stop, or lags, is over within what a thinned recording leaves out.
  result.contrasts = contrasts(bench.split().fit, bench.plain_residuals(result.search.base), bench.motions());
  const auto pieces = static_cast<double>(result.search.found.size() + 1);
  double done = 0.0;
  for (Found& one : result.search.found) {
    weighing(0.4 * ++done / pieces);
    one.contrasts = one.without.what == result.search.base.what
                        ? result.contrasts
                        : contrasts(bench.split().fit, bench.plain_residuals(one.without), bench.motions());
  }
  double compared = 0.0;
  const Circumstances known = {
      [&](const Fit& fit, const std::string& effect) { return result.estimates->intervals(fit, effect); },
      velocity_channel_lag(bench.split().fit), result.contrasts,
      [&](const Fit& fit) {
        weighing(0.8 + 0.2 * compared / (compared + pieces));
        compared += 1.0;
        return contrasts(bench.split().fit, bench.plain_residuals(fit), bench.motions(), Placebos::none);
      },
      [&](double share) { weighing(0.5 + 0.3 * share); }};
  weighing(0.4);
  result.surprising = surprises(bench, result.search.augmented);
  result.tone = tone_left(result.search, bench);
  weighing(0.5);
  result.evidence = evidence_of(result.search, fine, known);
  Doubt doubt = doubt_of_completeness(result.search, fine, result.surprising, result.tone);
  result.evidence.doubt_of_completeness = doubt.why;
  // What was taken out of the forces is the reason where there is no other.
  if (searching.taken_out) {
    result.tone = searching.taken_out;
    if (verdict_of(result.evidence).answer == Answer::complete) {
      doubt = {sentence_of(*result.tone), true, false};
      result.evidence.doubt_of_completeness = doubt.why;
    }
  }
  result.tone_doubts = doubt.of_tone;
  result.too_few_values = doubt.too_few;
  result.evidence.doubt_of_data = searching.doubt_of_data;
  return result;
}

Search search_behind(const std::string& law, const Searching& searching, const SearchProgress& progress) {
  return search(searching.quick, searching.fine, {law, {}, {}}, searching.options, progress);
}

// Adds whether the recordings are of one device state and whether parameters follow an unused column; both use the
// held-out recordings too, because neither measures prediction.
Judgement with_recording_checks(Judgement judgement, const Searching& searching, const SearchProgress& progress,
                                std::vector<std::string>& notes) {
  progress(0.0, "holding the recordings against each other");
  const ByRecording base = by_recording(searching.every, judgement.search.base);
  judgement.column = unused_column(searching.every, base);
  progress(0.5, "holding the recordings against each other");
  if (judgement.evidence.doubt_of_data.empty()) {
    judgement.belonging = belonging_of(searching.every, base, judgement.search.augmented);
    judgement.evidence.doubt_of_data = mixed(judgement.belonging) ? sentence_of(*judgement.belonging) : std::string{};
  }
  if (const auto steps =
          zero_steps_of(searching.every.split().fit, searching.every.plain_residuals(judgement.search.base))) {
    if (judgement.evidence.doubt_of_data.empty() && shape_the_search(*steps)) {
      judgement.evidence.doubt_of_data = sentence_of(*steps);
    } else {
      notes.push_back(sentence_of(*steps));
    }
  }
  judgement.verdict = verdict_of(judgement.evidence);
  return judgement;
}

}  // namespace

Judgement behind_asked_or_better(Searching searching, const std::string& asked, const SearchProgress& progress,
                                 std::vector<std::string>& notes) {
  double reached = 0.0;
  Search asked_search = search_behind(asked, searching, [&](double share, const std::string& stage) {
    reached = 0.5 * share;
    progress(reached, stage);
  });
  // So much of what is left from where it came.
  const auto next = [&](double part, const std::string& before = {}) {
    const double from = std::exchange(reached, reached + part * (1.0 - reached));
    return within(progress, from, reached, before);
  };
  const double of_first = asked_search.limited ? 0.2 : 0.9;
  Judgement first = judge_search(std::move(asked_search), searching, next(of_first));
  const std::string law = better_law(first.evidence);
  std::optional<Search> other;
  if (!law.empty()) {
    other = search_behind(law, searching, next(0.5, "behind " + law + ": "));
  }
  const bool beaten = other && squared(first.search.augmented.cost) > comparable * squared(other->augmented.cost);
  if (first.search.limited && !beaten) {
    searching.options.in_full = true;
    Search in_full = search_behind(asked, searching, next(0.6, "behind " + asked + " again: "));
    first = judge_search(std::move(in_full), searching, next(0.5));
  }
  if (!other) {
    return with_recording_checks(std::move(first), searching, next(1.0), notes);
  }
  const std::vector<LeftOut> both = left_out(searching.fine, {&first.search.augmented, &other->augmented});
  if (block_score(both[0].predicted, both[1].predicted, noise_of(searching.fine), searching.fine.motions()).z() <
      replacement_errors) {
    return with_recording_checks(std::move(first), searching, next(1.0), notes);
  }
  take_parts_of_law(*other, first.search, searching.quick, searching.options, next(0.1, "behind " + law + ": "));
  Judgement second = judge_search(std::move(*other), searching, next(0.9, "behind " + law + ": "));
  second.evidence.asked_for = asked;
  second.evidence.behind_asked = {first.evidence};
  second = with_recording_checks(std::move(second), searching, next(1.0), notes);
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

}  // namespace hysteron
