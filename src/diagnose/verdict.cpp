#include "diagnose/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "diagnose/relatives.hpp"

namespace hysteron {
namespace {

// A rival is as good when it explains all but this share of what the effect explains, unless it then leaves this many
// times as much again above the noise ...
constexpr double least_margin = 0.04;
constexpr double clear_factor = 3.0;
// (the noise is known to this share of its mean square) ...
constexpr double floor_doubt = 0.2;
// ... or all but this part of what is left unexplained: what is unknown may favour either.
constexpr double margin_of_leftover = 0.5;
// ... or when the criterion does not prefer the effect by this much.
constexpr double least_evidence = 10.0;
// An effect is named only if it explains at least this many times what stays unexplained; more where what stays surely
// is structure, because the cause of that may be the cause of all.
constexpr double least_gain_over_leftover = 2.5;
constexpr double least_gain_over_structure = 3.0;
// ... and at least this part of all that stays: quantisation and rig leave traces of that size.
constexpr double least_gain_over_noise = 0.05;
// Where nothing of what stays follows the motion, this part of it is enough, of evidence that no noise gives.
constexpr double least_settled_gain = 0.1;
constexpr double least_settled_evidence = 150.0;
// Near the noise the evidence decides: an effect of this much is named however little it is beside the noise, where
// what stays is like noise and nothing further is worth this much, or this part of it. Rivals are as good then within
// this share of its gain, or this part of its evidence.
constexpr double telling_evidence = 40.0;
// From this part of the floor on that comes from the motion's noise, twice as much is asked.
constexpr double noisy_motion = 0.05;
// With so many times the evidence, judging recordings that do not show the effect are no objection.
constexpr double sure_evidence = 3.0;
// More effects than that are the shape of something else, which only a dominant one among them is not part of.
constexpr std::size_t most_told = 2;
constexpr double most_further_evidence = 15.0;
constexpr double most_further_part = 0.15;
// Judging recordings on which the squared error falls by as large a share as on the fitted ones, and by this at least,
// bear an effect out, however few samples of these are independent.
constexpr double borne_out = 0.05;
constexpr double told_margin = 0.12;
constexpr double told_evidence_part = 0.1;
// A further effect is named only where at most this many times the noise stays, and not beside its own kin: what the
// form of the first one misses looks like another.
constexpr double near_noise = 1.5;
// Where this many times the noise stays, the cause of what stays may be the cause of all, unless the effect explains
// this many times as much, or, for the strongest, has the same size in all recordings within this share.
constexpr double far_from_noise = 6.0;
constexpr double dominant = 10.0;
constexpr double steady_share = 0.2;
// Likewise where the motion predicts this share of what stays: that is physics still missing.
constexpr double predicted_share = 0.15;
constexpr double dominant_over_predicted = 20.0;
// A gain below this share of the squared error must show in the judging recordings too, by this part of it.
constexpr double plain_gain = 0.3;
constexpr double confirmed_part = 0.25;
// A gain of this share of the squared error that they bear out shows that something is missing; so does this share of
// theirs with telling evidence of all effects together.
constexpr double shown_gain = 0.05;
constexpr double shown_heldout_gain = 0.03;
// Of the residual beyond its white noise, this part counts as unexplained even where nothing shows that it repeats.
constexpr double doubtful_share = 0.2;
// A further effect must explain this part of what the strongest does: the equations of that one are not exact, and what
// they miss looks like an effect of its own. Less is enough for one that takes this share off the squared error of the
// judging recordings.
constexpr double least_share_of_strongest = 0.08;
constexpr double plain_heldout_gain = 0.2;
// An effect with such a share is named beside structure-like noise too where no rival explains this part of it.
constexpr double sole_share = 0.5;
// Twice the logarithm of the likelihood that a wider form gains, from which on near the noise it is as good as its
// limit, though not worth its parameters.
constexpr double wider_gain = 4.0;
// A rival that leaves this many times the squared error on the judging recordings is none, however it fits; where so
// much evidence of the fitted ones is against it too, this many times is enough.
constexpr double refuting_factor = 2.0;
constexpr double refuting_evidence = 100.0;
constexpr double refuting_factor_with_evidence = 1.2;
// An effect survives another assumption where it keeps this part of its gain; else the confidence is multiplied by
// this.
constexpr double surviving_share = 0.25;
constexpr double unsteady_confidence = 0.7;
// Another damper law does as well when its squared error is within this factor of the augmented model's, and it takes
// this part of what the effects take off the base law's; or, where no effect helps, of the base law's squared error.
constexpr double law_factor = 1.1;
constexpr double law_part = 0.5;

// Whether the judging recordings bear the gain out. A plain gain, or one of `sure` evidence, may be of something that
// they do not excite.
bool confirmed(const Finding& found, const Errors& augmented, double sure) {
  const double fit = 1.0 - squared(augmented.fit / found.without.fit);
  const double heldout = 1.0 - squared(augmented.heldout / found.without.heldout);
  if (found.evidence > sure && heldout > -0.002) {
    return true;
  }
  return fit > plain_gain ? heldout > -0.01 : heldout > confirmed_part * fit;
}

// Whether the judging recordings show the effect as plainly as the fitted ones.
bool is_borne_out(const Finding& found, const Errors& augmented) {
  const double fit = 1.0 - squared(augmented.fit / found.without.fit);
  const double heldout = 1.0 - squared(augmented.heldout / found.without.heldout);
  return heldout > std::max(fit, borne_out);
}

// Whether the judging recordings leave no doubt of it.
bool is_plain(const Finding& found, const Errors& augmented) {
  return is_borne_out(found, augmented) &&
         squared(augmented.heldout / found.without.heldout) < 1.0 - plain_heldout_gain;
}

// Whether a rival is out of the question by what it leaves on the judging recordings.
bool is_refuted(const Contender& rival, const Errors& augmented, double honest) {
  const double factor = squared(rival.heldout / augmented.heldout);
  return factor > refuting_factor ||
         (factor > refuting_factor_with_evidence && rival.evidence > refuting_evidence / honest);
}

// Whether the effect's size is much the same whichever recordings it is taken from.
bool steady(const Finding& found) { return found.spread > 0.0 && found.spread < steady_share; }

}  // namespace

bool survived(const Trial& trial) { return trial.evidence > least_evidence && trial.share > surviving_share; }

namespace {

Verdict undoubted(const Findings& findings) {
  Verdict verdict;
  verdict.remaining_structure = structured(findings.misfit);
  // Coloured noise and structure that no motion variable tells look alike: part of what exceeds the white noise counts
  // as unexplained.
  const double surely = verdict.remaining_structure ? findings.misfit.structure : 0.0;
  const double doubtful = doubtful_share * (findings.misfit.squares - findings.misfit.white);
  // What a noise estimate without repeated cycles does not see is its colour: where what is left is like noise in all,
  // it is the noise, and a gain that the uncertainty of the noise does not explain is enough for a name.
  const bool settled = noise_like(findings.misfit) && findings.found.size() <= most_told;
  const double beyond_estimate = findings.misfit.squares - findings.misfit.floor;
  const double above_floor = settled ? 0.0 : beyond_estimate;
  const double leftover = std::max({surely, doubtful, above_floor});
  const bool shape = findings.found.size() > most_told && findings.misfit.squares > near_noise * findings.misfit.floor;
  const double dominating =
      std::max(findings.misfit.squares > far_from_noise * findings.misfit.floor ? dominant * above_floor : 0.0,
               findings.misfit.predictable > predicted_share ? dominant_over_predicted * beyond_estimate : 0.0);
  const double wanted =
      std::max({least_gain_over_structure * surely, doubtful, least_gain_over_noise * findings.misfit.squares,
                std::min(least_gain_over_leftover * beyond_estimate,
                         settled ? least_settled_gain * findings.misfit.squares : 1e300)});
  // A law that has what was found as a parameter of its own says the same in other words.
  std::vector<OtherLaw> others;
  std::ranges::copy_if(findings.other_laws, std::back_inserter(others),
                       [](const OtherLaw& law) { return !law.has_found; });
  const auto law = std::ranges::min_element(others, {}, &OtherLaw::squares);
  if (findings.found.empty() && law != others.end() && law->squares < law_part * findings.quick_base) {
    verdict.word = "unattributed";
    verdict.better_law = law->model;
    verdict.reason = "the damper law " + law->model + " leaves much less than " + findings.model +
                     ", which no known effect helps: the base law is in question";
    return verdict;
  }
  if (findings.found.empty()) {
    const bool laws = findings.richer && squared(findings.augmented.fit / findings.base.fit) < 1.0 - shown_gain &&
                      findings.augmented.heldout < findings.base.heldout;
    verdict.word = verdict.remaining_structure || laws ? "unattributed" : "complete";
    if (verdict.remaining_structure) {
      verdict.reason = "no known effect explains the misfit";
    } else if (laws) {
      verdict.reason = "a richer dependence of the damper's own parameters on the drive explains the misfit";
    }
    return verdict;
  }
  const double with_effects = findings.quick_augmented;
  const double by_law = with_effects + (1.0 - law_part) * (findings.quick_base - with_effects);
  if (law != others.end() && law->squares < std::min(law_factor * with_effects, by_law)) {
    verdict.word = "unattributed";
    verdict.better_law = law->model;
    verdict.reason = "the damper law " + law->model + " without any added effect does as well as " + findings.model +
                     " with them: the base law is in question";
    return verdict;
  }
  // Evidence counts samples as independent that a slow noise under a white one makes alike: `honest` is the rest.
  const double honest =
      findings.misfit.effective > 0.0 ? std::min(1.0, findings.misfit.independent / findings.misfit.effective) : 1.0;
  const double told_at_best =
      telling_evidence * (findings.misfit.motion > noisy_motion * findings.misfit.floor ? 2.0 : 1.0);
  for (std::size_t n = 0; n < findings.found.size(); ++n) {
    const Finding& found = findings.found[n];
    const double telling = is_borne_out(found, findings.augmented) ? told_at_best : told_at_best / honest;
    const bool told = settled && found.evidence > telling && findings.further &&
                      *findings.further < std::max(most_further_evidence / honest, most_further_part * found.evidence);
    const bool close_to_noise = findings.misfit.squares < near_noise * findings.misfit.floor;
    const bool no_rival =
        std::ranges::all_of(found.contenders, [](const Contender& rival) { return rival.share < sole_share; });
    const bool sole = found.evidence > telling && is_plain(found, findings.augmented) && close_to_noise && no_rival &&
                      findings.found.size() <= most_told && findings.misfit.predictable < predicted_share;
    const bool of_its_kind = is_of_place(found.id) && is_of_place(findings.found.front().id);
    const bool too_small =
        found.gain < least_share_of_strongest * findings.found.front().gain && !is_plain(found, findings.augmented);
    // What the law has of its own is no name: it makes up for what another effect's form misses.
    if (is_part_of(found.id, findings.model)) {
      continue;
    }
    if (too_small || !confirmed(found, findings.augmented, told ? sure_evidence * telling : 1e300)) {
      continue;
    }
    if (!told && !sole &&
        (found.gain < wanted ||
         (found.evidence < least_settled_evidence && found.gain < least_gain_over_leftover * beyond_estimate))) {
      continue;
    }
    if (!verdict.effects.empty() && (!close_to_noise || of_its_kind || is_kin(found.id, verdict.effects.front().id))) {
      continue;
    }
    if (shape && found.gain < dominant * beyond_estimate) {
      continue;
    }
    if (found.gain < dominating && (!verdict.effects.empty() || !steady(found))) {
      continue;
    }
    Named named;
    named.id = found.id;
    named.found = n;
    named.share_of_misfit = found.share_of_misfit;
    const double clear_of_noise =
        clear_factor * std::max(above_floor, floor_doubt * findings.misfit.floor) / found.gain;
    const double usual_margin =
        std::max(std::min(least_margin, clear_of_noise), margin_of_leftover * leftover / found.gain);
    const double margin = told ? std::min(usual_margin, told_margin) : usual_margin;
    const double ahead = told ? std::max(least_evidence / honest, told_evidence_part * found.evidence) : least_evidence;
    double best_share = 0.0;
    std::vector<std::size_t> as_good;
    std::optional<std::size_t> instead;  // to be named in place of the effect
    for (std::size_t k = 0; k < found.contenders.size(); ++k) {
      const Contender& rival = found.contenders[k];
      const bool refuted = is_refuted(rival, findings.augmented, honest);
      // Where structure stays, one that ends as the other at a bound may be a descent gone astray of the other.
      const bool unsure = verdict.remaining_structure && !bound_parameter(found.id, rival.id).empty();
      const bool close =
          unsure || (!refuted && (rival.share > 1.0 - margin || rival.evidence < ahead)) || rival.ended_as;
      // What holds the effect as a limit always explains as much; only more than its further parameters are worth
      // counts.
      const bool wider_as_good = told && (rival.share - 1.0) * found.evidence > wider_gain;
      if (is_limit(found.id, rival.id) && !wider_as_good && (rival.evidence > 0.0 || (close && !rival.apart))) {
        continue;
      }
      if (close && is_limit(rival.id, found.id) && rival.evidence < telling_evidence / honest && !rival.apart) {
        instead = k;
        continue;
      }
      // The channels tell a lag of one of them from a delay of the force.
      if (close && rival.id == channel_lag && is_kin(channel_lag, found.id)) {
        instead = rival.as_channels ? k : instead;
        continue;
      }
      if (close && found.id == channel_lag && is_kin(channel_lag, rival.id) && found.as_channels) {
        continue;
      }
      if (close) {
        if (is_law(rival.id)) {
          if (found.id == saturation && rival.follows_drive) {
            continue;
          }
          named.laws_as_good.push_back(rival.id.substr(4));
        } else {
          named.indistinguishable_from.push_back(rival.id);
          as_good.push_back(k);
        }
      } else {
        best_share = std::max(best_share, rival.share);
      }
    }
    if (instead) {
      named.rival = instead;
      named.id = found.contenders[*instead].id;
      named.share_of_misfit *= std::min(1.0, found.contenders[*instead].share);
    }
    const bool alone = named.indistinguishable_from.empty() && named.laws_as_good.empty();
    const double clear = (1.0 - best_share) / margin;
    const bool better = findings.augmented.heldout < found.without.heldout;
    named.confidence =
        alone ? std::min(0.99, 1.0 - 0.3 / std::max(clear, 1.0)) * (better ? 1.0 : 0.8)
              : 1.0 / static_cast<double>(1 + named.indistinguishable_from.size() + named.laws_as_good.size());
    if (named.id == findings.tried && !std::ranges::all_of(findings.trials, survived)) {
      named.confidence *= unsteady_confidence;
    }
    verdict.effects.push_back(named);
    if (!alone && verdict.effects.size() == 1) {
      // The strongest cannot be told from its rivals: the answer is the set.
      for (const std::size_t k : as_good) {
        const Contender& rival = found.contenders[k];
        Named other = named;
        other.id = rival.id;
        other.rival = k;
        std::erase(other.indistinguishable_from, rival.id);
        other.indistinguishable_from.insert(other.indistinguishable_from.begin(), named.id);
        other.share_of_misfit = named.share_of_misfit * std::min(1.0, rival.share);
        verdict.effects.push_back(other);
      }
      verdict.word = "ambiguous";
      return verdict;
    }
  }
  if (verdict.effects.empty()) {
    // Gains that the held-out recordings bear out are of something, even where the residual looks like noise.
    const double telling = told_at_best / honest;
    double together = 0.0;
    for (const Finding& found : findings.found) {
      together += found.evidence;
    }
    const bool all_shown = together > told_at_best &&
                           squared(findings.augmented.heldout / findings.base.heldout) < 1.0 - shown_heldout_gain;
    const bool shown =
        all_shown || std::ranges::any_of(findings.found, [&](const Finding& found) {
          return (found.evidence > telling ||
                  (found.evidence > least_evidence && found.gain > shown_gain * findings.base_misfit.squares)) &&
                 confirmed(found, findings.augmented, sure_evidence * telling);
        });
    const bool quiet = !structured(findings.base_misfit) && !shown;
    verdict.word = quiet ? "complete" : "unattributed";
    verdict.reason = quiet ? "the best known effect explains too little to be more than the colour of the noise"
                           : "the best known effect explains less of the misfit than stays unexplained, or not on the "
                             "held-out recordings";
    return verdict;
  }
  verdict.word = "missing-physics";
  return verdict;
}

}  // namespace

Verdict verdict_of(const Findings& findings) {
  Verdict verdict = undoubted(findings);
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
