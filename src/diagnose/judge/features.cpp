#include "diagnose/judge/features.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/judge/speaking.hpp"

namespace hysteron {
namespace {

// Where no contrast can be taken, nothing is known: half.
constexpr double unknown_contrast = 0.5;
// Standard errors of a contrast that is noise.
constexpr double of_noise = 1.0;
// From so many on a contrast is no surer.
constexpr double beyond_doubt = 4.0;
// Motions from which on they are left out as wholes (left_out.cpp), which tells most.
constexpr double enough_motions = 4.0;
// Where one size leaves less than this share, the sizes are even.
constexpr double least_unevenness = 1e-3;

double unit(double value) { return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0; }

// Standard errors of the contrast that speaks for it, from those of chance to those beyond doubt; where it cannot be
// told from its placebos it says nothing.
double contrast_of(const Candidate& candidate) {
  const std::optional<Speaking> contrast = speaking_for(candidate);
  if (!contrast) {
    return unknown_contrast;
  }
  return beyond_placebos(*contrast) ? unit((contrast->z - of_noise) / (beyond_doubt - of_noise)) : 0.0;
}

double above_chance(double value, double by_chance) { return std::max(0.0, value - std::max(by_chance, 0.0)); }

}  // namespace

double robustness_value(double f2) { return 0.5 * (std::sqrt(f2 * f2 + 4.0 * f2) - f2); }

double robustness_of(const Candidate& candidate, const Evidence& evidence) {
  // No estimate of the noise is better than a twentieth of it.
  const double excess = std::max(evidence.augmented.excess(), 0.05 * evidence.augmented.floor);
  return robustness_value(std::max(candidate.gain, 0.0) / std::max(excess, 1e-300));
}

std::vector<const Contender*> equally_good(const Candidate& candidate) {
  std::vector<const Contender*> result;
  for (const Contender& row : candidate.contenders) {
    if (row.law) {
      continue;
    }
    // Of related effects the catalogue holds one form each, and another form of the same would fit as well. What holds
    // the candidate as a limit takes off as much in any case.
    const bool form_alone = row.kin && !row.holds_the_candidate && row.share >= does_as_well;
    const bool told = row.refitted && row.squares > 0.0 && row.behind.surely_better() && !form_alone;
    const bool limit = row.held_by_the_candidate && !row.apart;
    // What holds the candidate as a limit always explains as much: it counts only where it is surely not at the limit.
    const bool idle = row.holds_the_candidate && !row.apart;
    if (row.ended_as || (!idle && row.share > may_do_as_well && (!told || limit))) {
      result.push_back(&row);
    }
  }
  return result;
}

std::vector<std::size_t> parts_of_the_law(const Evidence& evidence) {
  std::vector<std::size_t> result;
  if (evidence.behind_asked.empty()) {
    return result;
  }
  const Evidence& before = evidence.behind_asked.front();
  const auto law = std::ranges::find(before.other_laws, evidence.model, &OtherLaw::model);
  for (std::size_t k = 0; k < before.candidates.size() && law != before.other_laws.end(); ++k) {
    const std::string& id = before.candidates[k].id;
    const bool judged = std::ranges::find(evidence.candidates, id, &Candidate::id) != evidence.candidates.end();
    if (!judged && std::ranges::find(law->has, id) != law->has.end()) {
      result.push_back(k);
    }
  }
  return result;
}

const Evidence& evidence_of_base(const Candidate& candidate, const Evidence& evidence) {
  return candidate.of_law && !evidence.behind_asked.empty() ? evidence.behind_asked.front() : evidence;
}

NameFeatures features_of(const Candidate& candidate, const Evidence& evidence) {
  const double gain = std::max(candidate.gain, 1e-300);
  double law = 0.0;
  const double base = evidence_of_base(candidate, evidence).base_compared;
  const double all = std::max(base - evidence.augmented_compared, 1e-300);
  for (const OtherLaw& other : evidence.other_laws) {
    // A law that has the candidate as a part of its own speaks for it.
    if (std::ranges::find(other.has, candidate.id) == other.has.end() &&
        !leaves_the_contrast(candidate, other.model, true, evidence)) {
      law = std::max(law, (base - other.squares) / all);
    }
  }
  return {unit(candidate.score.agreement),
          unit(1.0 - law),
          unit(gain / (gain + above_chance(evidence.augmented.recurring, evidence.augmented.recurring_by_chance) *
                                  evidence.augmented.squares)),
          1.0 - static_cast<double>(candidate.on_bound) / std::max(candidate.parameters, 1),
          contrast_of(candidate),
          unit(candidate.gain_alone / gain),
          unit(1.0 - candidate.gain_of_relative / (candidate.gain_of_relative + gain)),
          unit((static_cast<double>(evidence.motions) - 1.0) / (enough_motions - 1.0)),
          -std::log10(std::max(1.0 - evenness_of(candidate.sizes), least_unevenness))};
}

AloneFeatures alone_features_of(const Candidate& candidate, const Evidence& evidence) {
  AloneFeatures result{};
  std::ranges::copy(features_of(candidate, evidence), result.begin());
  result.back() = 1.0 / (1.0 + static_cast<double>(equally_good(candidate).size()));
  return result;
}

MissingFeatures features_of(const Evidence& evidence) {
  const Left& base = evidence.base;
  const double noise = std::max(base.squares - base.structure, 1e-300);
  const double recurring =
      base.recurring_at_most > base.recurring_by_chance
          ? above_chance(base.recurring, base.recurring_by_chance) / (base.recurring_at_most - base.recurring_by_chance)
          : 0.0;
  return {std::log10(1.0 + std::max(base.structure, 0.0) / noise),
          unit(base.predictable),
          std::log1p(std::min(recurring, 1e3)),
          std::ranges::any_of(evidence.signatures,
                              [](const Signature& row) {
                                return speaks({&row, loudness(row)});
                              })
              ? 1.0
              : 0.0,
          std::log1p(std::clamp(evidence.augmented_over_base.z(), 0.0, 30.0)),
          unit(1.0 - evidence.augmented_compared / std::max(evidence.base_compared, 1e-300))};
}

}  // namespace hysteron
