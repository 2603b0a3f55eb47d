// The whole diagnosis of a campaign: base fit, noise, search, place, verdict.
#pragma once

#include <functional>
#include <memory>

#include "diagnose/acting.hpp"
#include "diagnose/column.hpp"
#include "diagnose/groups.hpp"
#include "diagnose/judge/verdict.hpp"
#include "diagnose/options.hpp"
#include "diagnose/residual/contrast_view.hpp"
#include "diagnose/residual/drift.hpp"
#include "diagnose/residual/locate.hpp"
#include "diagnose/residual/tone.hpp"
#include "diagnose/search/alias.hpp"
#include "diagnose/search/gather.hpp"
#include "diagnose/signal/noise.hpp"

namespace hysteron {

struct Rejected {
  std::string id;
  std::string reason;
};

struct Diagnosis {
  Diagnosis(Workbench on, std::vector<std::string> said) : bench(std::move(on)), notes(std::move(said)) {}

  Workbench bench;
  Search search;
  std::optional<Belonging> belonging;  // groups of the recordings, where some stand out
  std::optional<Tone> tone;            // that the recordings, or what is left of the fitted ones, hold, N
  bool tone_taken_out = false;         // whether it was, of their forces, before effects were looked for
  bool tone_doubts = false;            // whether it is what doubt_of_completeness of the evidence says
  bool too_few_values = false;         // likewise, that nothing can be told
  std::optional<ColumnTold> column;    // that the parameters follow and no model uses
  std::optional<Search> asked;         // behind the law asked for, where another took its place
  Evidence evidence;
  Verdict verdict;
  double noise_floor = 0.0;          // of the force, NRMSE over the fitted recordings
  double noise_floor_heldout = 0.0;  // likewise over those held out
  NoiseMethod noise_floor_method = NoiseMethod::unknown;
  DriveKind drive = DriveKind::none;
  std::vector<Contrast> contrasts;       // of what the base model leaves of the fitted recordings, in their order
  std::vector<Location> locations;       // of the base model's misfit
  std::vector<Location> locations_left;  // of the augmented model's
  Drift drift_of_base;
  Drift drift_of_augmented;
  // Of the verdict's effects, then of its suggestions.
  std::vector<std::vector<ParameterInterval>> parameters;
  std::vector<std::string> sentences;
  std::vector<std::optional<Seen>> seen;           // recordings that show each, where its contrast can be taken
  std::vector<std::optional<ContrastView>> views;  // of the fitted recordings, where each can be looked at
  // Of the shapes that the augmented model holds without a name, the verdict's doubtful ones.
  std::vector<std::vector<ParameterInterval>> shapes;
  std::vector<Rejected> rejected;
  std::vector<Unobservable> not_observable;
  AliasMap alias;  // of the effects considered, beside the base model
  std::string next_experiment;
  std::vector<std::string> summary;    // sentences of one paragraph, what matters most first, the next recording last
  std::vector<std::string> surprises;  // held-out recordings that miss by far more than every fitted one
  Fit final;                           // the augmented model fitted to everything that may be fitted
  std::vector<std::string> notes;
};

// The effects of the verdict, then its suggestions.
std::vector<Named> listed(const Verdict& verdict);
// The search that a name comes from.
const Search& search_of(const Diagnosis& diagnosis, const Named& named);
// The hypothesis that holds what is listed, and the same less it. References into the search that it comes from.
const Fit& fit_of(const Diagnosis& diagnosis, const Named& named);
// Whether that holds the name itself: what does as well in its place may not have been refitted.
bool has_fit(const Diagnosis& diagnosis, const Named& named);
const Fit& without_of(const Diagnosis& diagnosis, const Named& named);

// The law of the augmented model where that is not the one asked for; empty where it is.
std::string law_instead(const Search& search);

// Takes what stands out alone from the forces, and the noise from the drive, which thinned samples tell less well; the
// note that says so, empty where nothing stands out.
std::string without_outliers(Campaign& campaign);

// Without recordings that lie apart from all others (core/apart.hpp): what depends on position would be read from each
// of them alone, and a zero that is another looks like it.
Campaign without_apart(const Campaign& campaign);

// Of the recordings that without_apart leaves. Throws InputError for an unknown model or a campaign that leaves nothing
// to fit.
std::unique_ptr<Diagnosis> diagnose(const Campaign& campaign, const DiagnoseOptions& options,
                                    const SearchProgress& progress);

}  // namespace hysteron
