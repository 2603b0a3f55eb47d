#include "diagnose/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/interval_text.hpp"
#include "core/probability_text.hpp"
#include "diagnose/doubts.hpp"
#include "diagnose/judge/speaking.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"

namespace hysteron {
namespace {

// Held-out recordings show what leaves this part of their error, or less.
constexpr double shown_by_judges = 0.98;
// Times the noise floor above which more is left than an estimate of the noise is wrong by.
constexpr double clear_of_floor = 1.2;

// The first of the candidates that a recording can separate, with that recording; the id is empty where none can.
struct Separating {
  std::string id;
  std::string recording;
};
Separating separating(const std::vector<std::string>& candidates, DriveKind drive) {
  for (const std::string& id : candidates) {
    if (const std::string_view text = knowledge_of(id).experiment; !text.empty()) {
      return {id, worded(text, drive)};
    }
  }
  return {"", worded("the same motion at other frequencies[, amplitudes and currents| and amplitudes]", drive)};
}

// What does as well in the place of a named effect, in its set or less likely.
std::vector<std::string> alike_to(const Named& named) {
  std::vector<std::string> result = named.indistinguishable_from;
  result.insert(result.end(), named.less_likely.begin(), named.less_likely.end());
  return result;
}

std::vector<std::string> titles_of(const std::vector<std::string>& effects) {
  std::vector<std::string> result(effects.size());
  std::ranges::transform(effects, result.begin(), [](const std::string& id) { return title_of(id); });
  return result;
}

// "0.40 mm (0.38 to 0.42 mm)".
std::string interval_text(const ParameterInterval& p) {
  constexpr int digits = 3;
  const std::string value = size_text(p.value, p.unit, digits);
  if (!p.ci95) {
    return value + (p.bound ? fmt::format(" (at the {} end of its box)", word_of(*p.bound))
                            : " (not determined by these recordings)");
  }
  auto [low, high] = interval_ends(p.ci95->lower, p.ci95->upper, digits,
                                   [&](double end, int digits_of_it) { return size_text(end, p.unit, digits_of_it); });
  const std::size_t space = low.find(' ');
  if (space != std::string::npos && high.ends_with(low.substr(space))) {
    low.resize(space);
  }
  return fmt::format("{} ({} to {})", value, low, high);
}

}  // namespace

const Contrast* contrast_of(const Diagnosis& diagnosis, const Named& named) {
  const std::optional<Speaking> speaking = speaking_for(named, diagnosis.evidence);
  if (!speaking) {
    return nullptr;
  }
  const std::string& found = candidate_of(named, diagnosis.evidence).id;
  const std::vector<Found>& rows = search_of(diagnosis, named).found;
  const auto of = std::ranges::find_if(rows, [&](const Found& row) { return row.part.effect == found; });
  if (of == rows.end()) {
    return nullptr;
  }
  const std::vector<Contrast>& all = of->contrasts;
  const auto at =
      std::ranges::find_if(all, [&](const Contrast& one) { return card_of(one.kind).id == speaking->signature->id; });
  return at == all.end() ? nullptr : &*at;
}

const Contender* nearest_rival(const Named& named, const Evidence& evidence) {
  const std::vector<std::string> alike = alike_to(named);
  const Contender* best = nullptr;
  for (const Contender& row : candidate_of(named, evidence).contenders) {
    // What holds the candidate as its limit and is not told from it there is the candidate.
    const bool same = row.law || row.id == named.id || (row.holds_the_candidate && !row.apart);
    const bool does_as_well = std::ranges::find(alike, row.id) != alike.end();
    if (!same && !does_as_well && (best == nullptr || row.share > best->share)) {
      best = &row;
    }
  }
  return best;
}

std::string experiment_for(const Diagnosis& diagnosis, const Named& named) {
  std::vector<std::string> candidates = {named.id};
  std::ranges::copy(alike_to(named), std::back_inserter(candidates));
  if (const Contender* rival = nearest_rival(named, diagnosis.evidence)) {
    candidates.push_back(rival->id);
  }
  return separating(candidates, diagnosis.drive).recording;
}

std::string sizes_text(const std::vector<ParameterInterval>& parameters, std::size_t most) {
  // Those first that the recordings tell.
  std::vector<ParameterInterval> told_first = parameters;
  std::stable_partition(told_first.begin(), told_first.end(),
                        [](const ParameterInterval& p) { return p.ci95.has_value(); });
  std::vector<std::string> values;
  for (const ParameterInterval& p : told_first) {
    if (values.size() < most) {
      values.push_back(fmt::format("{} = {}", p.name, size_text(p.value, p.unit, 2)));
    }
  }
  return joined(values, " and ");
}

namespace {

// What a name has to do with the law that took the place of the one asked for; empty where none did.
std::string sentence_of_law(const Diagnosis& diagnosis, const Named& named) {
  const std::string law = law_instead(diagnosis.search);
  if (law.empty()) {
    return {};
  }
  const std::string taken = law + ", which takes the place of " + diagnosis.search.base.what.model;
  if (!named.of_law) {
    return " All this behind " + taken + ".";
  }
  if (named.in_place_of) {
    return " It is set in the place of a part that " + taken + ", has of its own: " + title_of(*named.in_place_of) +
           ".";
  }
  return " " + taken + ", has it as a part of its own.";
}

}  // namespace

std::string sentence_of(const Diagnosis& diagnosis, const Named& named,
                        const std::vector<ParameterInterval>& parameters) {
  std::vector<std::string> values;
  values.reserve(parameters.size());
  for (const ParameterInterval& p : parameters) {
    values.push_back(fmt::format("{} = {}", p.name, interval_text(p)));
  }
  std::string text = "Consistent with " + title_of(named.id);
  for (const Found& found : search_of(diagnosis, named).found) {
    if (found.part.effect == named.id && found.by_law) {
      text += ": " + *found.by_law + " rises ever less with the drive";
    }
  }
  if (!values.empty()) {
    text += ", " + joined(values, " and ");
  }
  const Fit& with = fit_of(diagnosis, named);
  const Fit& without = without_of(diagnosis, named);
  if (!has_fit(diagnosis, named)) {
    text += ", which was not refitted";
  } else if (held_out_shows(without.heldout, with.heldout)) {
    text += fmt::format(", which takes the held-out NRMSE from {:.3g} to {:.3g} (noise floor {:.2g})", without.heldout,
                        with.heldout, diagnosis.noise_floor_heldout);
  } else {
    text += fmt::format(
        ", which takes the fitted NRMSE from {:.3g} to {:.3g} (noise floor {:.2g}); held-out recordings do not show it "
        "(NRMSE {:.3g} without, {:.3g} with it)",
        without.cost, with.cost, diagnosis.noise_floor, without.heldout, with.heldout);
  }
  if (!named.indistinguishable_from.empty()) {
    text += "; these recordings cannot tell it from " + joined(titles_of(named.indistinguishable_from), " or ");
  }
  if (!named.less_likely.empty()) {
    text +=
        "; " + joined(titles_of(named.less_likely), " or ") + " cannot be ruled out in its place, and is less likely";
  }
  const Contender* rival = named.in_place_of ? nullptr : nearest_rival(named, diagnosis.evidence);
  if (rival != nullptr) {
    text += fmt::format("; next best in its place: {} ({:.0f} % of its gain)", title_of(rival->id),
                        100.0 * std::clamp(rival->share, 0.0, 1.0));
  }
  if (!named.in_place_of) {
    const InItsPlace others =
        in_its_place(candidate_of(named, diagnosis.evidence), evidence_for(named, diagnosis.evidence));
    if (others.leave_the_contrast > 0) {
      text += fmt::format(
          ". Its signature contrast vanishes with it and remains with {} of {} effects and laws tried in its place",
          others.leave_the_contrast, others.tried);
    }
    text += ". " + sentence_of_robustness(named, "it");
  }
  return text + "." + sentence_of_law(diagnosis, named);
}

std::string sentence_of_robustness(const Named& named, std::string_view it) {
  const std::string share = percent(named.robustness);
  return fmt::format(
      "To explain {} away, unmodelled physics would have to explain {} of what stays and share {} of its shape", it,
      share, share);
}

bool held_out_shows(double before, double after) { return after < shown_by_judges * before; }

std::string_view what_shapes_do(const Diagnosis& diagnosis) {
  return held_out_shows(diagnosis.search.base.heldout, diagnosis.search.augmented.heldout) ? "predict" : "fit";
}

std::vector<Rejected> rejected_of(const Diagnosis& diagnosis) {
  std::vector<Rejected> result;
  const auto is_listed = [&](const std::string& id) {
    const std::vector<Named> all = listed(diagnosis.verdict);
    return std::ranges::find(all, id, &Named::id) != all.end();
  };
  for (const Named& row : diagnosis.verdict.doubtful) {
    if (is_listed(row.id)) {
      continue;
    }
    if (row.had_by_law) {
      result.push_back({row.id, "in the augmented model beside what " + diagnosis.evidence.model + " has of its own"});
      continue;
    }
    result.push_back(
        {row.id,
         fmt::format("in the augmented model as a shape that {}s better; {}", what_shapes_do(diagnosis),
                     diagnosis.evidence.doubt_of_data.empty()
                         ? fmt::format("as a cause it is less likely than not ({})", probability_text(row.confidence))
                         : std::string("on these recordings no cause can be named"))});
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
      result.push_back({id, "alone it gains no more than chance"});
    } else if (!diagnosis.search.found.empty()) {
      result.push_back({id, fmt::format("alone it explains {:.0f} % of what the augmented model explains",
                                        100.0 * std::min(share / all, 1.0))});
    } else {
      result.push_back({id, fmt::format("alone it takes {:.2g} % off the squared error: too little, or not "
                                        "confirmed by recordings left out",
                                        100.0 * share / base)});
    }
  }
  return result;
}

std::string experiment_to_decide(const Verdict& verdict, const Evidence& evidence, DriveKind drive) {
  const std::vector<Named> stated = listed(verdict);
  const std::vector<Named>& rows = stated.empty() ? verdict.doubtful : stated;
  if (rows.empty()) {
    return separating({}, drive).recording;
  }
  const Named& likeliest = *std::ranges::max_element(rows, {}, &Named::confidence);
  std::vector<std::string> others = alike_to(likeliest);
  if (others.empty() && !likeliest.in_place_of) {
    if (const Contender* rival = nearest_rival(likeliest, evidence)) {
      others.push_back(rival->id);
    }
  }
  std::vector<std::string> candidates = {likeliest.id};
  candidates.insert(candidates.end(), others.begin(), others.end());
  const Separating decides = separating(candidates, drive);
  if (decides.id.empty()) {
    return decides.recording;
  }
  if (!likeliest.indistinguishable_from.empty()) {
    return fmt::format("{}; it would tell {} apart", decides.recording, joined(titles_of(candidates), " and "));
  }
  const bool is_name = std::ranges::find(verdict.effects, likeliest.id, &Named::id) != verdict.effects.end();
  const std::string rivals = joined(titles_of(others), " or ");
  return fmt::format("{}; it would {} {}{}", decides.recording, is_name ? "confirm" : "show whether there is",
                     title_of(likeliest.id), rivals.empty() ? "" : (is_name ? " against " : " and not ") + rivals);
}

std::string experiment_after(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  if (mixed(diagnosis.belonging)) {
    return "none yet: diagnose each group by itself, or record what was set between them as the drive";
  }
  if (!diagnosis.evidence.doubt_of_data.empty()) {
    return "none yet: mend these recordings first";
  }
  const bool unnamed = listed(verdict).empty();
  if (verdict.answer == Answer::complete && unnamed) {
    return "none is needed for this model; effects listed as not observable need their own recordings";
  }
  const std::string law = better_law(diagnosis.evidence);
  if (verdict.answer == Answer::unattributed && !law.empty() && law != diagnosis.search.augmented.what.model) {
    return "none yet: diagnose these recordings with the model " + law + " first";
  }
  if (verdict.answer == Answer::unattributed && unnamed && verdict.doubtful.empty() && diagnosis.tone) {
    return fmt::format(
        "the same rig running with the rod at rest; it would show whether the tone of {:.3g} Hz is the rig's",
        diagnosis.tone->frequency);
  }
  return experiment_to_decide(verdict, diagnosis.evidence, diagnosis.drive);
}

bool above_noise_floor(const Diagnosis& diagnosis) {
  const Fit& left = diagnosis.search.augmented;
  return left.cost > clear_of_floor * diagnosis.noise_floor ||
         left.heldout > clear_of_floor * diagnosis.noise_floor_heldout;
}

void note_verdict(Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  if (verdict.answer == Answer::complete && above_noise_floor(diagnosis)) {
    diagnosis.notes.push_back(fmt::format(
        "the residual is {:.2f} times the noise floor, {:.2f} times on held-out recordings; too little of it "
        "follows the motion to tell it from slow noise, which the floor underestimates",
        diagnosis.search.augmented.cost / diagnosis.noise_floor,
        diagnosis.search.augmented.heldout / diagnosis.noise_floor_heldout));
  }
  const bool tone_is_reason =
      diagnosis.tone_doubts && verdict.answer == Answer::unattributed && diagnosis.evidence.doubt_of_data.empty();
  if (diagnosis.tone && !tone_is_reason && !diagnosis.tone_taken_out) {
    diagnosis.notes.push_back(sentence_of(*diagnosis.tone));
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
                    : after->follows.empty() ? ", in the augmented model no longer"
                                             : ", in the augmented model still"));
  }
  for (const Named& named : verdict.effects) {
    if (named.in_place_of) {
      continue;
    }
    for (const GainBehindLaw& row : candidate_of(named, diagnosis.evidence).behind_laws) {
      diagnosis.notes.push_back(fmt::format("behind {} {} keeps {:.0f} % of its gain", row.law, named.id,
                                            100.0 * std::clamp(row.share, 0.0, 1.0)));
    }
  }
  if (const std::string richer = diagnosis.search.richer_dependence(); !richer.empty()) {
    diagnosis.notes.push_back("the recordings also ask for " + richer + "; the augmented model has it");
  }
}

}  // namespace hysteron
