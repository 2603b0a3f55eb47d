#include "diagnose/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/probability_text.hpp"
#include "diagnose/account.hpp"
#include "diagnose/judge/speaking.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"
#include "diagnose/shown.hpp"

namespace hysteron {
// It is more often the rig's than the damper's.
bool only_a_tone(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  return diagnosis.tone_doubts && verdict.effects.empty() && verdict.suggestions.empty() && verdict.doubtful.empty();
}

namespace {

constexpr std::size_t most_sizes = 2;  // of an effect, in its sentence

std::string capital(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text;
}

std::string with_sizes(const std::string& effect, const std::vector<ParameterInterval>& parameters) {
  const std::string sizes = sizes_text(parameters, most_sizes);
  return title_of(effect) + (sizes.empty() ? "" : ", " + sizes);
}

// "series dashpot, c = 12 kN s/m (the force relaxes while the rod is held; seen in 20 of 20 recordings)".
std::string phrase_of(const Diagnosis& diagnosis, const Named& named, std::size_t index) {
  std::string text = with_sizes(named.id, diagnosis.parameters[index]);
  std::string shown = worded(knowledge_of(named.id).shows, diagnosis.drive);
  const std::optional<Speaking> speaking = speaking_for(named, diagnosis.evidence);
  if (speaking && shows(*speaking)) {
    const std::optional<Seen>& seen = diagnosis.seen[index];
    shown += (shown.empty() ? "" : "; ") +
             (seen ? fmt::format("seen in {} of {} recordings", seen->seen, seen->of)
                   : fmt::format("seen in {} recordings taken together", speaking->signature->recordings));
  }
  if (!shown.empty()) {
    text += " (" + shown + ")";
  }
  if (named.of_law) {
    text += ", a part of " + *named.of_law;
  }
  if (!named.indistinguishable_from.empty()) {
    std::vector<std::string> others;
    for (const std::string& id : named.indistinguishable_from) {
      others.push_back(title_of(id));
    }
    text += "; " + joined(others, " or ") + " cannot be ruled out in its place";
  }
  if (!named.less_likely.empty()) {
    std::vector<std::string> others;
    for (const std::string& id : named.less_likely) {
      others.push_back(title_of(id));
    }
    text += "; " + joined(others, " or ") + " cannot be ruled out in its place, and is less likely";
  }
  return text;
}

// "Established: ..., with 97 %."; empty where no name has the grade. Sets are told once, by the first of them.
std::string sentence_of_grade(const Diagnosis& diagnosis, Grade grade) {
  const std::vector<Named> names = listed(diagnosis.verdict);
  std::vector<std::string> phrases;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k].grade == grade && !names[k].in_place_of) {
      phrases.push_back(phrase_of(diagnosis, names[k], k));
    }
  }
  std::string text;
  for (const std::string& phrase : phrases) {
    text += (text.empty() ? "" : ". Also ") + phrase;
  }
  return text.empty() ? text : capital(std::string(name_of(grade))) + ": " + text + ".";
}

std::string sentence_of_shapes(const Diagnosis& diagnosis) {
  const std::vector<Named>& doubtful = diagnosis.verdict.doubtful;
  std::vector<std::string> shapes;
  // A probability is that of recordings without a fault.
  const bool faulty = !diagnosis.evidence.doubt_of_data.empty();
  std::vector<std::string> had;
  for (std::size_t k = 0; k < doubtful.size(); ++k) {
    const std::string shape = with_sizes(doubtful[k].id, diagnosis.shapes[k]);
    if (doubtful[k].had_by_law) {
      had.push_back(shape);
    } else {
      shapes.push_back(faulty ? shape : fmt::format("{} ({})", shape, probability_text(doubtful[k].confidence)));
    }
  }
  const std::string of_the_law =
      had.empty()
          ? std::string{}
          : fmt::format("The augmented model also has {}, beside what {} has of its own: nothing of {} is missing.",
                        joined(had, " and "), diagnosis.evidence.model, had.size() == 1 ? "it" : "them");
  if (shapes.empty()) {
    return of_the_law;
  }
  return fmt::format("{}: {}; {} {} better.", faulty ? "Not named for that" : "Too uncertain to name",
                     fmt::format("{}", fmt::join(shapes, "; ")),
                     shapes.size() == 1 ? "it is a shape that" : "they are shapes that",
                     std::string(what_shapes_do(diagnosis)) + (shapes.size() == 1 ? "s" : "")) +
         (of_the_law.empty() ? "" : " " + of_the_law);
}

// "modified-bouc-wen, which includes a series dashpot,": what the cards say that it has and the law asked for lacks.
std::string law_with_parts(const std::string& law, const std::string& asked) {
  std::vector<std::string> parts;
  for (const std::string& effect : parts_of(law)) {
    if (!is_part_of(effect, asked)) {
      parts.push_back(title_of(effect));
    }
  }
  return parts.empty() ? law : law + ", which includes " + joined(parts, " and ") + ",";
}

// "noise 0.010"; where the motion does not repeat slow noise is not seen, and the rest is an estimate, which an error
// may come out below.
std::string noise_text(const Diagnosis& diagnosis, double error) {
  return fmt::format("noise {}{:#.2g}",
                     diagnosis.noise_floor_method == NoiseMethod::cycles ? ""
                     : error < diagnosis.noise_floor_heldout             ? "about "
                                                                         : "at least ",
                     diagnosis.noise_floor_heldout);
}

// `behind_names`: the sentence before is that of the names, so that "it" is one of them.
std::string sentence_of_errors(const Diagnosis& diagnosis, bool behind_names) {
  const Search& search = diagnosis.search;
  const double before = search.base.heldout;
  const double after = search.augmented.heldout;
  const std::string instead = law_instead(search);
  // Members of a set are one cause.
  const std::vector<Named> names = listed(diagnosis.verdict);
  const auto causes = std::ranges::count_if(names, [](const Named& named) { return !named.in_place_of; });
  // What laws take off is not told of the effects.
  std::string subject = !diagnosis.verdict.doubtful.empty() || causes == 0 || !behind_names ? "The augmented model"
                        : causes == 1                                                       ? "It"
                                                                                            : "Together they";
  if (const std::string richer = search.richer_dependence(); !richer.empty()) {
    subject = "The augmented model, with " + richer + ",";
  }
  if (!instead.empty()) {
    subject = fmt::format("With {} in place of {}, the augmented model",
                          law_with_parts(instead, search.base.what.model), search.base.what.model);
  }
  if (search.augmented.what == search.base.what) {
    return fmt::format("The held-out error of {} is {:#.2g} ({}).", search.base.what.model, before,
                       noise_text(diagnosis, before));
  }
  const bool many = subject == "Together they";
  // As printed, with two digits: what is the same there has not changed.
  const std::string from = fmt::format("{:#.2g}", before);
  const std::string to = fmt::format("{:#.2g}", after);
  const std::string noise = noise_text(diagnosis, after);
  if (from == to) {
    return fmt::format("{} {} the held-out error at {} ({}).", subject, many ? "leave" : "leaves", from, noise);
  }
  if (!held_out_shows(before, after) && !held_out_shows(after, before)) {
    return fmt::format("{} hardly {} the held-out error: {} before, {} after ({}).", subject,
                       many ? "change" : "changes", from, to, noise);
  }
  return fmt::format("{} {} the held-out error from {} to {} ({}).", subject,
                     after < before ? (many ? "take" : "takes") : (many ? "raise" : "raises"), from, to, noise);
}

// Of the other law that needs no effect to describe the recordings as well; empty without one.
std::string sentence_of_law_alone(const Diagnosis& diagnosis) {
  const Evidence& evidence = diagnosis.evidence;
  if (evidence.candidates.empty() || !evidence.doubt_of_data.empty()) {
    return {};
  }
  const auto best = std::ranges::min_element(evidence.other_laws, {}, &OtherLaw::squares);
  if (best == evidence.other_laws.end() || best->has_what_was_found || best->squares > evidence.augmented_compared) {
    return {};
  }
  return fmt::format(
      "But {} alone describes the recordings as well: they do not tell whether {} lacks {} or is the wrong "
      "law.",
      best->model, evidence.model, evidence.candidates.size() == 1 ? "an effect" : "effects");
}

std::string sentence_of_unknown(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  if (verdict.answer == Answer::complete) {
    return {};
  }
  if (only_a_tone(diagnosis) && diagnosis.tone_taken_out && !structured(diagnosis.search.misfit)) {
    return "Without the tone only noise is left.";
  }
  const std::string richer = diagnosis.search.richer_dependence();
  const std::string instead = law_instead(diagnosis.search);
  constexpr double printed = 0.005;  // less is printed as 0 %
  if (verdict.unknown_share < printed) {
    const std::string effects = !verdict.effects.empty()       ? "what is named"
                                : !verdict.suggestions.empty() ? "what is suggested"
                                                               : "";
    if (instead.empty() && !verdict.effects.empty()) return "All of the misfit above the noise has a name.";
    const std::string by = instead.empty()   ? (effects.empty() ? richer : effects)
                           : effects.empty() ? instead
                                             : instead + " and " + effects;
    return by.empty() ? by : "All of the misfit above the noise is explained by " + by + ".";
  }
  std::string rest;
  if (!instead.empty()) {
    // A part of the law is gone with the law.
    const auto beside_the_law = [](const Named& named) { return !named.of_law; };
    const bool by_names = std::ranges::any_of(verdict.effects, beside_the_law);
    const bool by_suggestions = std::ranges::any_of(verdict.suggestions, beside_the_law);
    rest = "; the rest is explained by " + instead +
           (by_names && by_suggestions ? " and what is named or suggested"
            : by_names                 ? " and what is named"
            : by_suggestions           ? " and what is suggested"
                                       : "");
  } else if (!richer.empty()) {
    const double left = diagnosis.search.misfit.structure / diagnosis.search.base_misfit.structure;
    if (const double by_laws = verdict.unknown_share - left; by_laws >= printed) {
      rest = fmt::format("; {} goes with {}", percent(by_laws), richer);
    }
  }
  // Shapes and names may explain the same, so that the share of a name and this may add to more than all.
  const auto shape = [](const Named& named) { return !named.of_law && named.share_of_misfit > 0.0; };
  const bool with_shapes = rest.empty() && !verdict.effects.empty() && std::ranges::any_of(verdict.doubtful, shape);
  const bool only_suggested = !verdict.suggestions.empty() && verdict.effects.empty() && instead.empty();
  return fmt::format("{} of the misfit of {} above the noise {}{}.", capital(percent(verdict.unknown_share)),
                     diagnosis.search.base.what.model,
                     only_suggested                 ? "is explained by nothing that is suggested"
                     : !verdict.suggestions.empty() ? "is explained by nothing named or suggested"
                     : with_shapes ? "has no name: it stays or is the part of unnamed shapes in what names and "
                                     "shapes explain together"
                                   : "has no name",
                     rest);
}

// Of what stays, else of what the base model misses.
std::string sentence_of_place(const Diagnosis& diagnosis) {
  const bool left = !diagnosis.locations_left.empty();
  const std::vector<Location>& places = left ? diagnosis.locations_left : diagnosis.locations;
  if (places.empty() || diagnosis.verdict.answer == Answer::complete) {
    return {};
  }
  const Location& place = places.front();
  const bool named = place.where.starts_with(place.variable);
  const std::string where =
      named ? "where the " + place.variable + " is" + place.where.substr(place.variable.size()) : place.where;
  return fmt::format("{} of {} sits {} ({} of the samples, each recording weighing the same).",
                     capital(percent(place.share_of_misfit)),
                     left ? "what stays" : "the misfit of " + diagnosis.search.base.what.model, where,
                     percent(place.share_of_samples));
}

// "What looks like cavitation may also come from outside the damper: a joint that lifts off in one direction."; of the
// likeliest name or suggestion.
std::string sentence_of_rig(const Diagnosis& diagnosis) {
  const std::vector<Named> stated = listed(diagnosis.verdict);
  if (stated.empty()) {
    return {};
  }
  const Named& likeliest = *std::ranges::max_element(stated, {}, &Named::confidence);
  const std::string cause = worded(knowledge_of(likeliest.id).rig_cause, diagnosis.drive);
  return cause.empty() ? std::string()
                       : fmt::format("What looks like {} may also come from outside the damper: {}.",
                                     title_of(likeliest.id), cause);
}

void add(std::vector<std::string>& summary, const std::string& sentence) {
  if (!sentence.empty()) {
    summary.push_back(sentence);
  }
}

}  // namespace

std::vector<std::string> summary_of(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  std::vector<std::string> summary;
  if (verdict.answer == Answer::complete) {
    add(summary, above_noise_floor(diagnosis) ? "The residual cannot be told from noise: the base model is complete as "
                                                "far as these recordings show."
                                              : "Only noise is left: the base model is complete for these recordings.");
  } else if (mixed(diagnosis.belonging)) {
    add(summary, capital(sentence_of(*diagnosis.belonging)) + ".");
  } else if (verdict.effects.empty()) {
    const bool may_be_noise = diagnosis.too_few_values && diagnosis.evidence.doubt_of_data.empty();
    const bool faulty = !diagnosis.evidence.doubt_of_data.empty();
    add(summary, (may_be_noise             ? "Whether physics is missing cannot be told: "
                  : faulty                 ? "The recordings have a fault, and no effect can be named: "
                  : only_a_tone(diagnosis) ? "More than noise is left, of the damper or of the rig: "
                                           : "Physics is missing, but no effect is certain enough to name: ") +
                     verdict.reason + ".");
  }
  if (diagnosis.column) {
    add(summary, capital(sentence_of(*diagnosis.column)) + ".");
  }
  for (const Grade grade : {Grade::established, Grade::supported, Grade::suggested}) {
    add(summary, sentence_of_grade(diagnosis, grade));
  }
  // Where the answer is that nothing is missing they would be those of chance.
  std::string contrasts;
  if (verdict.answer != Answer::complete && diagnosis.evidence.doubt_of_data.empty()) {
    contrasts = sentence_of_contrasts(diagnosis.evidence, listed(verdict));
  }
  add(summary, contrasts);
  add(summary, sentence_of_shapes(diagnosis));
  add(summary, sentence_of_errors(diagnosis, contrasts.empty()));
  add(summary, sentence_of_law_alone(diagnosis));
  add(summary, sentence_of_unknown(diagnosis));
  add(summary, sentence_of_place(diagnosis));
  if (!verdict.effects.empty()) {
    const Named& first = verdict.effects.front();
    const bool alone = std::ranges::all_of(verdict.effects.begin() + 1, verdict.effects.end(),
                                           [](const Named& named) { return named.in_place_of.has_value(); });
    add(summary, sentence_of_robustness(first, alone ? "it" : "the first") + ".");
  }
  add(summary, sentence_of_rig(diagnosis));
  add(summary, "Next recording: " + diagnosis.next_experiment + ".");
  return summary;
}

}  // namespace hysteron
