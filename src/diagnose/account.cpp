#include "diagnose/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/search/relatives.hpp"

namespace hysteron {
namespace {

// The held-out recordings show an effect that takes this much off their error.
constexpr double shown_by_judges = 0.98;
// Times the noise floor above which more is left than an estimate of the noise is wrong by.
constexpr double clear_of_floor = 1.2;

// As it stands in a sentence.
std::string title_of(const std::string& effect) {
  const std::string_view in_words = knowledge_of(effect).in_words;
  const Part* part = find_effect(effect);
  return in_words.empty() ? std::string(part == nullptr ? effect : part->title) : std::string(in_words);
}

// What separates the first of the candidates that a recording can separate.
std::string next_experiment(const std::vector<std::string>& candidates) {
  for (const std::string& id : candidates) {
    if (const std::string_view separating = knowledge_of(id).experiment; !separating.empty()) {
      return std::string(separating);
    }
  }
  return "the same motion at other frequencies, amplitudes and currents";
}

}  // namespace

std::string joined(const std::vector<std::string>& words, const std::string& last) {
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
    } else {
      text += p.bound.empty() ? " (not told by these recordings)" : " (the " + p.bound + " end of what was searched)";
    }
    values.push_back(text);
  }
  std::string text = "Consistent with " + title_of(named.id);
  for (const Found& found : diagnosis.search.found) {
    if (found.part.effect == named.id && found.by_law) {
      text += ": " + *found.by_law + " rises ever less with the drive";
    }
  }
  if (!values.empty()) {
    text += ", " + joined(values, " and ");
  }
  const Fit& with = fit_of(diagnosis.search, named);
  const Fit& without = without_of(diagnosis.search, named);
  if (with.heldout < shown_by_judges * without.heldout) {
    text += fmt::format(", which takes the held-out NRMSE from {:.3g} to {:.3g} (noise floor {:.2g})", without.heldout,
                        with.heldout, diagnosis.noise_floor_heldout);
  } else {
    text += fmt::format(
        ", which takes the fitted NRMSE from {:.3g} to {:.3g} (noise floor {:.2g}); held-out recordings do not show it "
        "(NRMSE {:.3g} without, {:.3g} with it)",
        without.cost, with.cost, diagnosis.noise_floor, without.heldout, with.heldout);
  }
  if (!named.indistinguishable_from.empty()) {
    std::vector<std::string> others;
    for (const std::string& id : named.indistinguishable_from) {
      others.push_back(title_of(id));
    }
    text += "; these recordings cannot tell it from " + joined(others, " or ");
  }
  const std::vector<Contender>& contenders = diagnosis.evidence.candidates[named.candidate].contenders;
  const auto rival = std::ranges::find_if(contenders, [&](const Contender& row) {
    return !row.law && row.id != named.id &&
           std::ranges::find(named.indistinguishable_from, row.id) == named.indistinguishable_from.end();
  });
  if (!named.in_place_of && rival != contenders.end()) {
    text += fmt::format("; next best in its place: {} ({:.0f} % of its gain)", title_of(rival->id),
                        100.0 * std::clamp(rival->share, 0.0, 1.0));
  }
  if (!named.in_place_of) {
    text += fmt::format(
        ". To explain it away, unmodelled physics would have to explain {:.0f} % of what stays and share {:.0f} % of "
        "its shape",
        100.0 * named.robustness, 100.0 * named.robustness);
  }
  return text + ".";
}

std::vector<Rejected> rejected_of(const Diagnosis& diagnosis) {
  std::vector<Rejected> result;
  const auto is_listed = [&](const std::string& id) {
    const std::vector<Named> all = listed(diagnosis.verdict);
    return std::ranges::find(all, id, &Named::id) != all.end();
  };
  for (const Named& row : diagnosis.verdict.doubtful) {
    result.push_back({row.id, fmt::format("in the augmented model as a shape that predicts better; as a cause it is "
                                          "less likely than not ({:.0f} %)",
                                          100.0 * row.confidence)});
  }
  const double base = squared(diagnosis.search.quick_base.cost);
  const double all = std::max(base - squared(diagnosis.search.quick_augmented.cost), 1e-300);
  for (const Tried& tried : diagnosis.search.first_stage) {
    const std::string& id = tried.part.effect;
    const bool told =
        tried.part.is_law() || is_listed(id) || std::ranges::find(result, id, &Rejected::id) != result.end();
    if (told) {
      continue;
    }
    const double share = std::max(0.0, tried.gain);
    if (tried.evidence < 0.0) {
      result.push_back({id, "alone it explains no more than chance would"});
    } else if (!diagnosis.search.found.empty()) {
      result.push_back({id, fmt::format("alone it explains {:.0f} % of what the augmented model explains",
                                        100.0 * std::min(share / all, 1.0))});
    } else {
      result.push_back({id, fmt::format("alone it takes {:.2g} % off the squared error: too little, or not on "
                                        "recordings left out",
                                        100.0 * share / base)});
    }
  }
  return result;
}

std::string experiment_after(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  std::vector<std::string> candidates;
  for (const Named& named : listed(verdict)) {
    candidates.push_back(named.id);
  }
  if (verdict.answer == Answer::ambiguous) {
    return next_experiment(candidates);
  }
  if (verdict.answer == Answer::missing_physics || !candidates.empty()) {
    return "to confirm: " + next_experiment(candidates);
  }
  if (verdict.answer == Answer::complete) {
    return "none is needed for this model; effects listed as not observable need their own recordings";
  }
  if (const std::string law = better_law(diagnosis.evidence); !law.empty()) {
    return "none yet: diagnose these recordings with --model " + law + " first";
  }
  return next_experiment({});
}

bool above_noise_floor(const Diagnosis& diagnosis) {
  const Fit& left = diagnosis.search.augmented;
  return left.cost > clear_of_floor * diagnosis.noise_floor ||
         left.heldout > clear_of_floor * diagnosis.noise_floor_heldout;
}

void note_verdict(Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  if (!verdict.reason.empty()) {
    diagnosis.notes.push_back(verdict.reason);
  }
  if (verdict.answer == Answer::complete && above_noise_floor(diagnosis)) {
    diagnosis.notes.push_back(
        fmt::format("what is left is {:.2f} times the noise floor, {:.2f} times on the held-out recordings; too little "
                    "of it is seen to follow the motion to tell it from slow noise, of which the floor misses a part",
                    diagnosis.search.augmented.cost / diagnosis.noise_floor,
                    diagnosis.search.augmented.heldout / diagnosis.noise_floor_heldout));
  }
  std::vector<std::string> shapes;
  for (const Named& row : verdict.doubtful) {
    shapes.push_back(row.id);
  }
  if (!shapes.empty()) {
    diagnosis.notes.push_back("the augmented model uses " + joined(shapes, " and ") +
                              " as a shape that predicts better; it is not offered as the cause");
  }
  for (const DriftOfParameter& before : diagnosis.drift_of_base.parameters) {
    if (before.follows.empty()) {
      continue;
    }
    const std::vector<DriftOfParameter>& all = diagnosis.drift_of_augmented.parameters;
    const auto after = std::ranges::find(all, before.name, &DriftOfParameter::name);
    const auto [low, high] = std::ranges::minmax(before.change);
    diagnosis.notes.push_back(
        fmt::format("recording by recording the base model's {} {} with the {} ({:+.0f} to {:+.0f} %){}", before.name,
                    before.rank_correlation > 0.0 ? "rises" : "falls",
                    before.follows == "order" ? "order of recording" : before.follows, 100.0 * low, 100.0 * high,
                    diagnosis.search.augmented.what.effects.empty() || after == all.end() ? ""
                    : after->follows.empty() ? ", with the effects found no longer"
                                             : ", with the effects found still"));
  }
  for (const Named& named : verdict.effects) {
    const Candidate& candidate = diagnosis.evidence.candidates[named.candidate];
    for (std::size_t k = 0; k < candidate.kept.size() && !named.in_place_of; ++k) {
      diagnosis.notes.push_back(fmt::format("behind {} {} keeps {:.0f} % of its gain", diagnosis.search.swaps[k].model,
                                            named.id, 100.0 * std::clamp(candidate.kept[k], 0.0, 1.0)));
    }
  }
  const std::set<std::string> richer(diagnosis.search.richer.begin(), diagnosis.search.richer.end());
  if (!richer.empty()) {
    diagnosis.notes.push_back("the recordings also ask for a richer dependence of " +
                              joined({richer.begin(), richer.end()}, " and ") +
                              " on the drive; the augmented model has it");
  }
}

}  // namespace hysteron
