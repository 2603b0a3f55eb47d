#include "diagnose/search/gather.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnose/judge/speaking.hpp"
#include "diagnose/residual/sizes.hpp"
#include "diagnose/search/left_out.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"

namespace hysteron {
namespace {

// Contenders of a candidate that are compared on the same samples as it, beside those that may do as well; the others
// keep the share the search saw.
constexpr std::size_t compared_closely = 4;
constexpr double least_share_compared = 0.3;
// A fitted lag of the velocity channel and the one between the channels agree within this share, or within the interval
// of the one or the other.
constexpr double channel_agreement = 0.25;
// What was found with less than this part of the strongest effect's gain is a trace beside it.
constexpr double trace = 0.05;

// Whether the lag of the velocity channel that a fit found is the one that the channels show.
bool as_channels_show(const Fit& fit, const Circumstances& known) {
  const std::vector<ParameterInterval> intervals = known.intervals(fit, channel_lag);
  if (!known.channel || intervals.empty()) {
    return false;
  }
  const double error = std::fabs(intervals.front().value - known.channel->lag);
  return error < std::max({channel_agreement * std::fabs(known.channel->lag), 3.0 * known.channel->std_error,
                           intervals.front().half_width.value_or(0.0)});
}

// Whether the parameter by which a wider form differs from its limit is surely not at the limit.
bool stands_apart(const Fit& fit, const std::string& wider, const std::string& parameter, const Circumstances& known) {
  if (parameter.empty()) {
    return true;
  }
  const std::vector<ParameterInterval> intervals = known.intervals(fit, wider);
  const auto at = std::ranges::find(intervals, parameter, &ParameterInterval::name);
  return at != intervals.end() && at->half_width && std::fabs(at->value) > *at->half_width;
}

// Whether the effect ends as the other one: the parameter that tells them apart sits on the end of its box where they
// are the same, or, at the lower end, has no interval or one that reaches it.
bool ends_as(const Fit& fit, const std::string& effect, const std::string& other, const Circumstances& known) {
  const BoxLimit* limit = box_limit(effect, other);
  if (limit == nullptr) {
    return false;
  }
  const std::vector<ParameterInterval> intervals = known.intervals(fit, effect);
  const auto at = std::ranges::find(intervals, limit->parameter, &ParameterInterval::name);
  if (at == intervals.end()) {
    return false;
  }
  return limit->end == BoxEnd::upper ? at->bound == BoxEnd::upper
                                     : !at->half_width || at->value - *at->half_width <= at->lower;
}

// A parameter that follows the drive in the base model.
bool follows_drive(const Fit& base, const std::string& parameter) {
  return base.layout != nullptr && std::ranges::any_of(base.layout->laws(), [&](const ParameterLaw& law) {
           return base.layout->names()[law.parameter] == parameter && law.drive_nodes.size() > 1;
         });
}

// What the fitted recordings tell of any fit.
struct Fitted {
  const std::vector<Recording>* recordings;
  const std::vector<std::size_t>* motions;
  std::vector<double> noise;
};

Comparison comparison(const LeftOut& with, const LeftOut& without, const Fitted& fitted) {
  const BlockScore score = block_score(without.predicted, with.predicted, fitted.noise, *fitted.motions);
  return {score.mean, score.std_error, score.agreement, score.clusters};
}

Left left_of(const Misfit& misfit, const Workbench& bench, const Fit& fit) {
  const Recurrence again = recurrence_of(bench, fit);
  return {misfit.squares,
          misfit.floor,
          misfit.white,
          misfit.structure,
          misfit.predictable,
          misfit.evenness.deviation,
          misfit.evenness.by_chance,
          again.share,
          again.mean_by_chance,
          again.most_by_chance,
          misfit.independent};
}

// The fits that are compared closely, each looked at once.
class Looked {
 public:
  void want(const Fit& fit) { fits_.push_back(&fit); }
  void look(const Workbench& bench, const std::function<void(double share)>& done) {
    const std::vector<LeftOut> all = left_out(bench, fits_, done);
    for (std::size_t k = 0; k < fits_.size(); ++k) {
      of_[fits_[k]] = all[k];
    }
  }
  [[nodiscard]] const LeftOut* find(const Fit& fit) const {
    const auto at = of_.find(&fit);
    return at == of_.end() ? nullptr : &at->second;
  }

 private:
  std::vector<const Fit*> fits_;
  std::map<const Fit*, LeftOut> of_;
};

// Rivals in the place of `found` that are compared closely.
std::vector<const Rival*> close_rivals(const Found& found) {
  std::vector<const Rival*> result;
  for (const Rival& rival : found.rivals) {
    const bool kin = !rival.part.is_law() && is_kin(found.part.effect, rival.part.effect);
    const bool near = !rival.part.is_law() && rival.share > may_do_as_well;
    if (rival.fit && rival.share > least_share_compared && (result.size() < compared_closely || kin || near)) {
      result.push_back(&rival);
    }
  }
  return result;
}

Contender contender_of(const Rival& rival, const Found& found, const Search& search, const Circumstances& known) {
  Contender row;
  row.id = name_of(rival.part);
  row.law = rival.part.is_law();
  row.share = rival.share;
  row.refitted = rival.fit.has_value();
  if (row.law) {
    row.follows_drive = follows_drive(search.base, rival.part.parameters.front());
    return row;
  }
  const std::string& id = found.part.effect;
  row.kin = is_kin(id, row.id);
  row.holds_the_candidate = is_limit(id, row.id);
  row.held_by_the_candidate = is_limit(row.id, id);
  if (row.holds_the_candidate && rival.fit) {
    row.apart = stands_apart(*rival.fit, row.id, limit_parameter(id, row.id), known);
  } else if (row.held_by_the_candidate) {
    row.apart = stands_apart(search.augmented, id, limit_parameter(row.id, id), known);
  }
  row.ended_as = ends_as(search.augmented, id, row.id, known);
  row.as_channels = rival.fit && row.id == channel_lag && as_channels_show(*rival.fit, known);
  return row;
}

std::vector<Signature> signatures_of(const std::vector<Contrast>& contrasts) {
  std::vector<Signature> result;
  for (const Contrast& contrast : contrasts) {
    Signature row;
    row.id = card_of(contrast.kind).id;
    row.what = contrast.what;
    row.unit = contrast.unit;
    row.value = contrast.value;
    row.std_error = contrast.std_error;
    row.z = contrast.z;
    row.consistency = contrast.consistency;
    row.placebo_quantile = contrast.placebo_quantile;
    row.recordings = contrast.recordings;
    row.of_all = contrast.of_all;
    for (const Voice& voice : voices_of(contrast.kind)) {
      row.speaks_for.emplace_back(voice.effect);
      row.sign.push_back(sign_of(voice.sense));
    }
    result.push_back(std::move(row));
  }
  return result;
}

// What the augmented model, the rivals of each candidate and the other laws leave of the contrast that speaks for it.
class ContrastsLeft {
 public:
  ContrastsLeft(const Circumstances& known, const Evidence& evidence) : known_(&known), evidence_(&evidence) {}

  void add(std::vector<ContrastLeft>& rows, const std::string& effect, const Fit& fit, const std::string& instead,
           bool law) {
    const auto candidate = std::ranges::find(evidence_->candidates, effect, &Candidate::id);
    const std::optional<Speaking> speaking = speaking_for(*candidate);
    if (!speaking || !speaks(*speaking)) {
      return;
    }
    const std::string& id = speaking->signature->id;
    rows.push_back({effect, id, instead, law, z_of(fit, id, effect)});
  }

 private:
  // 0 where the contrast cannot be taken any more, as the fit's own force holds all of it.
  double z_of(const Fit& fit, const std::string& id, const std::string& effect) {
    auto at = of_.find(&fit);
    if (at == of_.end()) {
      at = of_.emplace(&fit, signatures_of(known_->contrasts_of(fit))).first;
    }
    const auto left = std::ranges::find(at->second, id, &Signature::id);
    return left == at->second.end() ? 0.0 : z_for(effect, *left);
  }

  const Circumstances* known_;
  const Evidence* evidence_;
  std::map<const Fit*, std::vector<Signature>> of_;
};

}  // namespace

std::vector<std::string> told_by_channels(const std::vector<Recording>& recordings,
                                          const std::vector<std::string>& candidates) {
  Evidence channels;
  channels.signatures = signatures_of(channel_contrasts(recordings));
  std::vector<std::string> result;
  for (const std::string& candidate : candidates) {
    const std::optional<Speaking> speaking = speaking_for(candidate, channels.signatures);
    if (speaking && speaks(*speaking)) {
      result.push_back(candidate);
    }
  }
  return result;
}

namespace {

// The fits of a search that are compared closely, by what they would predict of recordings left out.
Looked looked_at(const Search& search, const Workbench& fine, const Circumstances& known) {
  Looked looked;
  looked.want(search.base);
  looked.want(search.augmented);
  for (const Found& found : search.found) {
    looked.want(found.without);
    for (const Rival* rival : close_rivals(found)) {
      looked.want(*rival->fit);
    }
  }
  looked.look(fine, known.looked);
  return looked;
}

// Base and augmented model: what they leave, what was tried first, and the contrasts of what the base leaves.
Evidence evidence_of_models(const Search& search, const Workbench& fine, const Circumstances& known,
                            const Looked& looked, const Fitted& fitted) {
  Evidence result;
  result.model = search.base.what.model;
  result.recordings = fine.split().fit.size();
  result.motions = count_of(fine.motions());
  result.base = left_of(search.base_misfit, fine, search.base);
  const bool same = search.augmented.what == search.base.what;
  result.augmented = same ? result.base : left_of(search.misfit, fine, search.augmented);
  result.base_compared = squared(search.quick_base.cost);
  result.augmented_compared = squared(search.quick_augmented.cost);
  for (const Tried& tried : search.first_stage) {
    result.first_stage.push_back({name_of(tried.part), tried.gain, tried.fit.has_value()});
  }
  result.signatures = signatures_of(known.contrasts);
  result.signatures_left = same ? result.signatures : signatures_of(known.contrasts_of(search.augmented));
  LeftOut before = *looked.find(search.base);
  for (const Found& found : search.found) {
    before = found.of_law ? std::move(before) : left_out_beside(fine, search.base, found.part, std::move(before));
  }
  result.augmented_over_base = comparison(*looked.find(search.augmented), before, fitted);
  return result;
}

// Its gain alone behind the base, of the first stage too.
double gain_alone_of(const Found& found, const Search& search) {
  double gain = found.alone;
  for (const Tried& tried : search.first_stage) {
    // An effect that a richer law in the drive shows was tried as such a law.
    if (!found.of_law && (found.by_law ? tried.part == law_extension({*found.by_law}) : tried.part == found.part)) {
      gain = std::max(gain, tried.gain);
    }
  }
  return gain;
}

// What was set in the place of `found`, best first; `without` is left without it, and `gain` what it takes off that.
std::vector<Contender> contenders_of(const Found& found, const Search& search, const Circumstances& known,
                                     const Looked& looked, const LeftOut& without, double gain, const Fitted& fitted) {
  const LeftOut& augmented = *looked.find(search.augmented);
  const std::vector<const Rival*> close = close_rivals(found);
  std::vector<Contender> result;
  for (const Rival& rival : found.rivals) {
    Contender row = contender_of(rival, found, search, known);
    if (std::ranges::find(close, &rival) != close.end()) {
      const LeftOut& instead = *looked.find(*rival.fit);
      row.squares = instead.squares;
      row.share = (without.squares - instead.squares) / std::max(gain, 1e-300);
      row.behind = comparison(augmented, instead, fitted);
      row.evenness = evenness_of(sizes_of_parts(*fitted.recordings, without.residuals, instead.residuals));
    }
    result.push_back(std::move(row));
  }
  std::ranges::stable_sort(result, [](const Contender& a, const Contender& b) { return a.share > b.share; });
  return result;
}

// The k-th effect that was found.
Candidate candidate_found(std::size_t k, const Search& search, const Workbench& fine, const Circumstances& known,
                          const Looked& looked, const Fitted& fitted) {
  const Found& found = search.found[k];
  const LeftOut& augmented = *looked.find(search.augmented);
  // A law's own part is marched as the law is.
  const LeftOut& less = *looked.find(found.without);
  const LeftOut without = found.of_law ? less : left_out_beside(fine, found.without, found.part, less);
  Candidate one;
  one.id = found.part.effect;
  one.gain = without.squares - augmented.squares;
  one.score = comparison(augmented, without, fitted);
  one.sizes = sizes_of_parts(*fitted.recordings, without.residuals, augmented.residuals);
  one.gain_alone = gain_alone_of(found, search);
  one.contenders = contenders_of(found, search, known, looked, without, one.gain, fitted);
  for (const Swap& swap : search.swaps) {
    // A law that has the effect as a parameter of its own loses nothing without it, and one that runs away tells
    // nothing.
    if (!is_part_of(one.id, swap.model) && std::max(swap.without[k], swap.squares) < diverged_cost) {
      one.behind_laws.push_back({swap.model, (swap.without[k] - swap.squares) / std::max(found.gain, 1e-300)});
    }
  }
  const std::vector<ParameterInterval> intervals = known.intervals(search.augmented, one.id);
  one.parameters = static_cast<int>(intervals.size());
  one.on_bound = static_cast<int>(std::ranges::count_if(
      intervals, [&](const ParameterInterval& p) { return p.bound && !is_plain_end(one.id, p.name, *p.bound); }));
  one.signatures = signatures_of(found.contrasts);
  one.of_law = found.of_law.has_value();
  one.had_by_law = std::ranges::find(search.had_by_law, one.id) != search.had_by_law.end();
  one.as_channels = found.told || (one.id == channel_lag && as_channels_show(search.augmented, known));
  return one;
}

void add_gains_of_relatives(std::vector<Candidate>& candidates) {
  for (Candidate& one : candidates) {
    for (const Candidate& other : candidates) {
      if (is_kin(one.id, other.id)) {
        one.gain_of_relative = std::max(one.gain_of_relative, other.gain);
      }
    }
  }
}

// Of candidates in the order of `search.found`.
std::vector<ContrastLeft> contrasts_left_of(const Search& search, const Circumstances& known,
                                            const Evidence& evidence) {
  std::vector<ContrastLeft> rows;
  ContrastsLeft left(known, evidence);
  for (const Found& found : search.found) {
    const std::string& id = found.part.effect;
    left.add(rows, id, search.augmented, {}, false);
    for (const Rival* rival : close_rivals(found)) {
      left.add(rows, id, *rival->fit, name_of(rival->part), false);
    }
    for (const Fit& law : search.other_laws) {
      left.add(rows, id, law, law.what.model, true);
    }
  }
  return rows;
}

// Of candidates, strongest first.
std::vector<OtherLaw> other_laws_of(const Search& search, const Evidence& evidence) {
  std::vector<OtherLaw> result;
  for (const Fit& law : search.other_laws) {
    OtherLaw row{law.what.model, squared(law.cost), !evidence.candidates.empty(), {}};
    for (const Candidate& candidate : evidence.candidates) {
      const bool has = is_part_of(candidate.id, row.model) && !is_part_of(candidate.id, evidence.model);
      if (has) {
        row.has.push_back(candidate.id);
      }
      row.has_what_was_found =
          row.has_what_was_found && (has || candidate.gain < trace * evidence.candidates.front().gain);
    }
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace

Evidence evidence_of(const Search& search, const Workbench& fine, const Circumstances& known) {
  const Looked looked = looked_at(search, fine, known);
  const Fitted fitted{&fine.split().fit, &fine.motions(), noise_of(fine)};
  Evidence result = evidence_of_models(search, fine, known, looked, fitted);
  for (std::size_t k = 0; k < search.found.size(); ++k) {
    result.candidates.push_back(candidate_found(k, search, fine, known, looked, fitted));
  }
  add_gains_of_relatives(result.candidates);
  result.contrasts_left = contrasts_left_of(search, known, result);
  std::ranges::stable_sort(result.candidates, [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  result.other_laws = other_laws_of(search, result);
  return result;
}

}  // namespace hysteron
