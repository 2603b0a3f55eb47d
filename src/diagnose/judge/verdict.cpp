#include "diagnose/judge/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/relatives.hpp"

namespace hysteron {
namespace {

// An effect is named only if it explains at least this many times what stays beyond the noise ...
constexpr double least_gain_over_excess = 2.5;
// ... this many times, where what stays tells that more is missing, which may be the cause of all ...
constexpr double dominant = 10.0;
// ... fewer where another damper law, fitted in place of the one asked for, needs the effect for at least this part of
// the gain: then it does not make up for what the one law lacks.
constexpr double dominant_behind_both = 4.0;
constexpr double needed_share = 0.5;
// ... or where it acts, if that is at most this part of the samples and it was set against rivals: the rest of the
// stroke says nothing of an effect that does nothing there ...
constexpr double most_of_the_samples = 0.25;
// ... and this part of all that stays: quantisation and rig leave traces of that size.
constexpr double least_gain_over_noise = 0.05;
// What stays tells that where the motion predicts this share of it, or where more than so many effects are needed:
// these are the shape of something else.
constexpr double predicted_share = 0.15;
constexpr std::size_t most_effects = 2;
// Where what stays is like noise it is the noise, and the evidence decides: an effect of this much is named however
// little it is beside the noise, unless something further is worth this part of it.
constexpr double telling_evidence = 40.0;
constexpr double most_further_part = 0.15;
// With so many times the evidence, judging recordings that do not show the effect are no objection.
constexpr double sure_evidence = 3.0;
// Judging recordings on which the squared error falls by as large a share as on the fitted ones, and by this at least,
// bear an effect out, however few samples of these are independent.
constexpr double borne_out = 0.05;
// Effects that only make up for each other take off more one by one than all together: at most so many times as much.
constexpr double most_over_all = 3.0;
// What judging recordings may lose to an effect that they do not excite: this share of the squared error, or this part
// of the share that it takes off the fitted ones; and beside a plain gain this share.
constexpr double harmless = 0.002;
constexpr double harmless_part = 0.05;
constexpr double harmless_beside_much = 0.01;
// A gain below this share of the squared error must show in the judging recordings too, by this part of it.
constexpr double plain_gain = 0.3;
constexpr double confirmed_part = 0.25;
// A rival is as good when it explains all but this share of what the effect explains, or all but this part of what
// stays beyond the noise: what is unknown may favour either. Or when the criterion does not prefer the effect by this
// much.
constexpr double least_margin = 0.04;
constexpr double margin_of_excess = 0.5;
constexpr double least_evidence = 10.0;
// Kin need only explain all but this share where much of what stays repeats with the motion.
constexpr double margin_of_kin = 0.1;
// A descent that went astray still explains this part.
constexpr double astray_share = 0.5;
// None is good that leaves so many times the squared error on the judging recordings, with so much evidence of the
// fitted ones against it.
constexpr double refuting_factor = 1.2;
constexpr double refuting_evidence = 100.0;
// A further effect is named only where nothing but noise or at most this many times the noise stays, and not beside its
// own kin: what the form of the first one misses looks like another. It explains this part of what the strongest whose
// form may be missed does, or less, if it takes this share off the squared error of the judging recordings.
constexpr double near_noise = 1.5;
constexpr double least_share_of_strongest = 0.08;
constexpr double plain_heldout_gain = 0.2;
// Something is missing where an effect takes this share off the squared error and the judging recordings bear it out,
// or all effects together with telling evidence this share of theirs.
constexpr double shown_gain = 0.03;
// An effect survives another assumption where it keeps this part of its gain; else the confidence is multiplied by
// this.
constexpr double surviving_share = 0.25;
constexpr double unsteady_confidence = 0.7;
// Another damper law does as well when its squared error is within this factor of the augmented model's, and it takes
// this part of what the effects take off the base law's; or, where no effect helps, of the base law's squared error.
constexpr double law_factor = 1.1;
constexpr double law_part = 0.5;

// What stays, and what it asks of a name.
struct Standard {
  double excess;  // squared error beyond the noise
  bool settled;   // it is like noise in all: what an estimate of the noise without repeated cycles misses is its colour
  bool close;     // at most near_noise times the noise stays
  double dominance;  // times the excess that an effect must explain
};

Standard standard_of(const Findings& findings) {
  const Misfit& left = findings.misfit;
  Standard result{};
  result.excess = left.squares - left.floor;
  result.settled = noise_like(left) && !recurs(findings.recurrence) && findings.found.size() <= most_effects;
  result.close = left.squares < near_noise * left.floor;
  const bool more_is_missing =
      left.predictable > predicted_share || (findings.found.size() > most_effects && !result.close);
  result.dominance = more_is_missing ? dominant : least_gain_over_excess;
  return result;
}

// Shares that the effect takes off the squared errors.
Errors shares(const Finding& found, const Errors& augmented) {
  return {1.0 - squared(augmented.fit / found.without.fit), 1.0 - squared(augmented.heldout / found.without.heldout)};
}

// Whether the judging recordings bear the gain out. A plain gain, or one of `sure` evidence, may be of something that
// they do not excite.
bool confirmed(const Finding& found, const Errors& augmented, double sure) {
  const Errors share = shares(found, augmented);
  if (found.evidence > sure && share.heldout > -std::max(harmless, harmless_part * share.fit)) {
    return true;
  }
  return share.fit > plain_gain ? share.heldout > -harmless_beside_much : share.heldout > confirmed_part * share.fit;
}

// Whether the effect only makes up for what the others do.
bool makes_up(const Finding& found, const Findings& findings) {
  return found.gain > most_over_all * (squared(findings.base.fit) - squared(findings.augmented.fit));
}

// Whether the judging recordings show the effect as plainly as the fitted ones.
bool is_borne_out(const Finding& found, const Errors& augmented) {
  const Errors share = shares(found, augmented);
  return share.heldout > std::max(share.fit, borne_out);
}

// Whether the evidence alone is enough.
bool is_told(const Finding& found, const Findings& findings, const Standard& standard) {
  return standard.settled && found.evidence > telling_evidence && findings.further &&
         *findings.further < most_further_part * found.evidence;
}

// Whether another damper law needs the effect as much, and all other trials leave it as much.
bool needed_behind_another_law(const Finding& found, const Findings& findings) {
  return found.id == findings.tried && std::ranges::any_of(findings.trials, is_of_another_law) &&
         std::ranges::all_of(findings.trials, [](const Trial& trial) { return trial.share > needed_share; });
}

// Whether the effect dominates where it acts.
bool dominates_its_part(const Finding& found) {
  if (!found.locality || found.contenders.empty() || found.locality->share > most_of_the_samples) {
    return false;
  }
  const Locality& part = *found.locality;
  return part.before - part.after > dominant * std::max(part.after - part.noise, 0.0);
}

// Whether the effect, found beside those named already, is more than a trace and more than the shape of another.
bool deserves_a_name(const Finding& found, const Findings& findings, const Standard& standard,
                     const std::vector<Named>& named) {
  // What the law has of its own is no name: it makes up for what another effect's form misses.
  if (is_part_of(found.id, findings.model)) {
    return false;
  }
  if (makes_up(found, findings)) {
    return false;
  }
  // What stays is no doubt of a lag that the channels show without any model.
  if (found.as_channels && found.evidence > telling_evidence) {
    return true;
  }
  const Finding& strongest = findings.found.front();
  const auto formed = std::ranges::find_if(findings.found, [](const Finding& one) { return !has_one_form(one.id); });
  const bool plain =
      is_borne_out(found, findings.augmented) && shares(found, findings.augmented).heldout > plain_heldout_gain;
  if (formed != findings.found.end() && found.gain < least_share_of_strongest * formed->gain && !plain) {
    return false;
  }
  if (!named.empty() && (!(standard.close || standard.settled) || is_kin(found.id, named.front().id) ||
                         (is_of_place(found.id) && is_of_place(strongest.id)))) {
    return false;
  }
  const bool told = is_told(found, findings, standard);
  const double sure = sure_evidence * telling_evidence;
  if (!confirmed(found, findings.augmented, told ? sure : 1e300)) {
    return false;
  }
  const double dominance = needed_behind_another_law(found, findings)
                               ? std::min(standard.dominance, dominant_behind_both)
                               : standard.dominance;
  const bool dominates = found.gain > dominance * standard.excess || dominates_its_part(found);
  return told || (dominates && found.gain > least_gain_over_noise * findings.misfit.squares);
}

// How the contenders for an effect's place fare.
struct Contest {
  std::vector<std::size_t> as_good;
  std::vector<std::string> laws_as_good;
  std::optional<std::size_t> instead;  // to be named in place of the effect
  double lead = 0.0;                   // over the best of the others, in units of the margin
};

Contest contest_for(const Finding& found, const Findings& findings, const Standard& standard) {
  Contest result;
  const double unexplained = standard.settled ? 0.0 : standard.excess;
  const double margin = std::max(least_margin, margin_of_excess * unexplained / found.gain);
  double best_share = 0.0;
  for (std::size_t k = 0; k < found.contenders.size(); ++k) {
    const Contender& rival = found.contenders[k];
    const bool refuted =
        rival.evidence > refuting_evidence && squared(rival.heldout / findings.augmented.heldout) > refuting_factor;
    // Where structure stays, one that ends as the other at a bound may be a descent gone astray of the other.
    const BoxLimit* end = box_limit(found.id, rival.id);
    const bool unsure =
        structured(findings.misfit) && end != nullptr && end->end == BoxEnd::lower && rival.share > astray_share;
    // The catalogue's form is not that of the damper where much of what stays repeats: then kin that come near may be
    // it.
    const bool near_kin = findings.misfit.predictable > predicted_share && is_kin(found.id, rival.id) &&
                          rival.share > 1.0 - margin_of_kin;
    const bool close = unsure || near_kin ||
                       (!refuted && (rival.share > 1.0 - margin || rival.evidence < least_evidence)) || rival.ended_as;
    // What holds the effect as a limit always explains as much; only more than its further parameters are worth counts.
    if (is_limit(found.id, rival.id) && !rival.ended_as &&
        (rival.evidence > 0.0 || (close && !rival.apart && !standard.settled))) {
      continue;
    }
    if (!close) {
      best_share = std::max(best_share, rival.share);
    } else if (is_limit(rival.id, found.id) && rival.evidence < least_evidence && !rival.apart) {
      result.instead = k;
    } else if (rival.id == channel_lag && is_kin(channel_lag, found.id)) {
      // The channels tell a lag of one of them from a delay of the force.
      result.instead = rival.as_channels ? k : result.instead;
    } else if (found.id == channel_lag && is_kin(channel_lag, rival.id) && found.as_channels) {
      continue;
    } else if (!is_law(rival.id)) {
      result.as_good.push_back(k);
    } else if (found.id != saturation || !rival.follows_drive) {
      result.laws_as_good.push_back(parameter_of_law(rival.id));
    }
  }
  result.lead = (1.0 - best_share) / margin;
  return result;
}

Named named_of(std::size_t index, const Contest& contest, const Findings& findings) {
  const Finding& found = findings.found[index];
  Named named;
  named.id = found.id;
  named.found = index;
  named.share_of_misfit = found.share_of_misfit;
  named.laws_as_good = contest.laws_as_good;
  for (const std::size_t k : contest.as_good) {
    named.indistinguishable_from.push_back(found.contenders[k].id);
  }
  if (contest.instead) {
    named.rival = contest.instead;
    named.id = found.contenders[*contest.instead].id;
    named.share_of_misfit *= std::min(1.0, found.contenders[*contest.instead].share);
  }
  const std::size_t as_good = contest.as_good.size() + contest.laws_as_good.size();
  const bool better = findings.augmented.heldout < found.without.heldout;
  named.confidence = as_good > 0 ? 1.0 / static_cast<double>(1 + as_good)
                                 : std::min(0.99, 1.0 - 0.3 / std::max(contest.lead, 1.0)) * (better ? 1.0 : 0.8);
  if (named.id == findings.tried && !std::ranges::all_of(findings.trials, survived)) {
    named.confidence *= unsteady_confidence;
  }
  return named;
}

// The set of which `named` is one.
std::vector<Named> set_of(const Named& named, const Contest& contest, const Finding& found) {
  std::vector<Named> result = {named};
  for (const std::size_t k : contest.as_good) {
    Named other = named;
    other.id = found.contenders[k].id;
    other.rival = k;
    std::erase(other.indistinguishable_from, other.id);
    other.indistinguishable_from.insert(other.indistinguishable_from.begin(), named.id);
    other.share_of_misfit = named.share_of_misfit * std::min(1.0, found.contenders[k].share);
    result.push_back(std::move(other));
  }
  return result;
}

// Another law that does as well without effects; one that has what was found as a parameter of its own says the same in
// other words.
const OtherLaw* better_law(const Findings& findings) {
  const double base = findings.quick_base;
  const double augmented = findings.quick_augmented;
  const double most = findings.found.empty()
                          ? law_part * base
                          : std::min(law_factor * augmented, augmented + (1.0 - law_part) * (base - augmented));
  const OtherLaw* best = nullptr;
  for (const OtherLaw& law : findings.other_laws) {
    if (!law.has_found && law.squares < (best == nullptr ? most : best->squares)) {
      best = &law;
    }
  }
  return best;
}

// Whether something is missing, though it has no name.
bool something_shows(const Findings& findings) {
  double together = 0.0;
  for (const Finding& found : findings.found) {
    if (makes_up(found, findings)) {
      continue;
    }
    together += found.evidence;
    const double enough = telling_evidence;
    const bool much = found.evidence > enough ||
                      (found.evidence > least_evidence && found.gain > shown_gain * findings.base_misfit.squares);
    if (much && confirmed(found, findings.augmented, sure_evidence * enough)) {
      return true;
    }
  }
  return together > telling_evidence && squared(findings.augmented.heldout / findings.base.heldout) < 1.0 - shown_gain;
}

Verdict without_a_name(const Findings& findings) {
  Verdict verdict;
  verdict.word = "unattributed";
  if (!findings.found.empty()) {
    const bool quiet = !structured(findings.base_misfit) && !something_shows(findings);
    verdict.word = quiet ? "complete" : "unattributed";
    verdict.reason = quiet ? "the best known effect explains too little to be more than the colour of the noise"
                           : "the best known effect explains less of the misfit than stays unexplained, or not on the "
                             "held-out recordings";
  } else if (structured(findings.misfit)) {
    verdict.reason = "no known effect explains the misfit";
  } else if (findings.richer && squared(findings.augmented.fit / findings.base.fit) < 1.0 - shown_gain &&
             findings.augmented.heldout < findings.base.heldout) {
    verdict.reason = "a richer dependence of the damper's own parameters on the drive explains the misfit";
  } else {
    verdict.word = "complete";
  }
  return verdict;
}

Verdict undoubted(const Findings& findings) {
  const Standard standard = standard_of(findings);
  Verdict verdict;
  if (const OtherLaw* law = better_law(findings)) {
    verdict.word = "unattributed";
    verdict.better_law = law->model;
    verdict.reason = findings.found.empty()
                         ? "the damper law " + law->model + " leaves much less than " + findings.model +
                               ", which no known effect helps: the base law is in question"
                         : "the damper law " + law->model + " without any added effect does as well as " +
                               findings.model + " with them: the base law is in question";
    return verdict;
  }
  for (std::size_t n = 0; n < findings.found.size(); ++n) {
    const Finding& found = findings.found[n];
    if (!deserves_a_name(found, findings, standard, verdict.effects)) {
      continue;
    }
    const Contest contest = contest_for(found, findings, standard);
    const Named named = named_of(n, contest, findings);
    const bool alone = contest.as_good.empty() && contest.laws_as_good.empty();
    if (!alone && verdict.effects.empty()) {
      // The strongest cannot be told from its rivals: the answer is the set.
      verdict.word = "ambiguous";
      verdict.effects = set_of(named, contest, found);
      return verdict;
    }
    verdict.effects.push_back(named);
  }
  if (verdict.effects.empty()) {
    return without_a_name(findings);
  }
  verdict.word = "missing-physics";
  return verdict;
}

}  // namespace

bool survived(const Trial& trial) { return trial.evidence > least_evidence && trial.share > surviving_share; }

Verdict verdict_of(const Findings& findings) {
  Verdict verdict = undoubted(findings);
  verdict.remaining_structure = structured(findings.misfit);
  if (verdict.word == "complete" && !findings.doubt_of_completeness.empty()) {
    verdict.word = "unattributed";
    verdict.reason = findings.doubt_of_completeness;
  }
  if (!findings.doubt_of_data.empty()) {
    verdict.word = "unattributed";
    verdict.effects.clear();
    verdict.reason = findings.doubt_of_data;
  }
  return verdict;
}

const Fit& fit_of(const Search& search, const Named& named) {
  return named.rival ? search.found[named.found].rivals[*named.rival].fit : search.augmented;
}

const Fit& without_of(const Search& search, const Named& named) { return search.found[named.found].without; }

}  // namespace hysteron
