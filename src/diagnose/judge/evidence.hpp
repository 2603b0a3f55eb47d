// All that a verdict rests on, in numbers: diagnosis.json holds it as its "evidence", and a verdict can be given again
// from there. Squares are of NRMSE.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/part_size.hpp"

namespace hysteron {

// What a fit leaves of the fitted recordings.
struct Left {
  double squares = 0.0;
  double floor = 0.0;        // of the noise, as estimated
  double white = 0.0;        // of the part of the noise that is white
  double structure = 0.0;    // what repeats beyond the noise
  double predictable = 0.0;  // share that the motion predicts within each recording
  double unevenness = 0.0;   // how far its size follows the motion, and how far that of noise would
  double unevenness_by_chance = 0.0;
  double recurring = 0.0;            // share that one smooth function of the motion takes off all recordings together
  double recurring_by_chance = 0.0;  // likewise of noise: mean and most of the surrogates
  double recurring_at_most = 0.0;
  double independent = 0.0;  // samples

  [[nodiscard]] double excess() const { return squares > floor ? squares - floor : 0.0; }
};

// Block score of one fit over another (residual/block_score.hpp), of recordings left out in turn.
struct Comparison {
  double mean = 0.0;
  double std_error = 0.0;
  double agreement = 0.0;
  std::size_t clusters = 0;

  [[nodiscard]] double z() const { return std_error > 0.0 ? mean / std_error : 0.0; }
  // Whether it is above zero as surely as two standard errors of many clusters: of few, the error itself is not well
  // known, and Student's distribution asks for more.
  [[nodiscard]] bool surely_better() const;
};

// What was set in the place of a candidate.
struct Contender {
  std::string id;
  bool law = false;                  // a richer law in the drive
  bool kin = false;                  // a related effect
  double share = 0.0;                // of the candidate's gain
  bool refitted = false;             // else the share is to first order
  double squares = 0.0;              // that it leaves; 0 where it was not refitted
  Comparison behind;                 // the candidate over it
  double evenness = 0.0;             // of its sizes in the parts of recordings left out; 0 where it was not refitted
  bool holds_the_candidate = false;  // as a limit of its own
  bool held_by_the_candidate = false;
  bool apart = true;           // of these: the parameter that tells them apart is surely not at that limit
  bool ended_as = false;       // the candidate ends as this one, at a bound of its box
  bool follows_drive = false;  // a richer law of a parameter that follows the drive anyhow
  bool as_channels = false;    // a lag of the velocity channel, and the one that the channels show
};

// What takes off no more than this part of the candidate's gain was never near, whatever recordings left out say. What
// takes off more is refitted and compared.
inline constexpr double may_do_as_well = 0.5;

// A signature contrast (residual/contrast.hpp) of what a fit leaves.
struct Signature {
  std::string id;
  std::string what;
  std::string unit;
  double value = 0.0;
  double std_error = 0.0;
  double z = 0.0;
  double consistency = 0.0;
  double placebo_quantile = 0.0;
  std::size_t recordings = 0;
  std::vector<std::string> speaks_for;  // effects, nearest first
  std::vector<int> sign;                // that the value has where each acts; 0: either
  bool of_all = false;                  // one number of all recordings together
};

// What an effect is worth behind another damper law that has all effects found.
struct GainBehindLaw {
  std::string law;
  double share = 0.0;  // of the effect's gain in the augmented model
};

// An effect of the augmented model.
struct Candidate {
  std::string id;
  double gain = 0.0;                  // squares without less squares with, over the same samples
  Comparison score;                   // with it over without it
  std::vector<SizeOfPart> sizes;      // of recordings left out
  double gain_alone = 0.0;            // alone behind the base
  double gain_of_relative = 0.0;      // the largest of the related effects that the augmented model has too
  std::vector<Contender> contenders;  // best first
  std::vector<GainBehindLaw> behind_laws;
  int parameters = 1;
  int on_bound = 0;          // of these, at an end of their box
  bool as_channels = false;  // told by the channels without a model, or a lag of one and as large as they show
  bool of_law = false;       // a part of the model's law, which the law asked for lacks
  bool had_by_law = false;   // the law has it of its own and imitates it wholly: nothing of it can be missing
  // Of what the model with everything but it leaves, refitted: other effects no longer cover what it does.
  std::vector<Signature> signatures;
};

// Another damper law without effects.
struct OtherLaw {
  std::string model;
  double squares = 0.0;
  bool has_what_was_found = false;  // as parts of its own, which the law asked for lacks
  std::vector<std::string> has;     // of the candidates, those that are parts of its own
};

// A hypothesis of the first stage, behind the base model alone.
struct FirstLook {
  std::string id;
  double gain = 0.0;      // squares that it takes off; to first order where it was not refitted
  bool refitted = false;  // one of those that came near the best to first order
};

// What is left of the contrast that speaks for a candidate where another part, or another law alone, explains the force
// in its place: a contender that leaves it does not do what the candidate does.
struct ContrastLeft {
  std::string effect;     // the candidate
  std::string signature;  // id of the contrast
  std::string instead;    // a contender or a law; empty: the augmented model as it is
  bool law = false;
  double z = 0.0;  // of the contrast, in the sense that the candidate has
};

struct Evidence {
  std::string model;
  std::string asked_for;  // the law whose place `model` took, empty where it took none
  std::size_t recordings = 0;
  std::size_t motions = 0;  // different ones among the recordings
  Left base;
  Left augmented;
  std::vector<FirstLook> first_stage;  // best first
  std::vector<Candidate> candidates;   // strongest first
  double base_compared = 0.0;          // squares of base and augmented model, as other laws were compared with them
  double augmented_compared = 0.0;
  Comparison augmented_over_base;
  std::vector<OtherLaw> other_laws;
  std::vector<Signature> signatures;         // of what the base model leaves
  std::vector<Signature> signatures_left;    // of what the augmented model leaves
  std::vector<ContrastLeft> contrasts_left;  // of candidates for which a contrast speaks
  // Where `model` took the place of `asked_for`: what was found behind that one. At most one.
  std::vector<Evidence> behind_asked = {};
  std::string doubt_of_completeness;  // why more than noise is left where no effect helps; empty when nothing shows it
  std::string doubt_of_data;          // why no name can be given on these recordings; empty when there is no reason
};

nlohmann::json evidence_json(const Evidence& evidence);
// The inverse. Throws nlohmann::json::exception where something is missing.
Evidence evidence_from(const nlohmann::json& json);

}  // namespace hysteron
