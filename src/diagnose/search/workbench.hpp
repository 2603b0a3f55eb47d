// Fits hypotheses: a damper law, the effects behind it, and parameter laws made one order richer.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bytes.hpp"
#include "diagnose/residual/drift.hpp"
#include "diagnose/residual/residuals.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "diagnose/search/residual_store.hpp"
#include "diagnose/signal/split.hpp"
#include "fit/objective.hpp"
#include "io/checkpoint.hpp"

namespace hysteron {

inline constexpr std::size_t start_count = 8;  // sizes that a refit starts from

// A hypothesis with its best parameters.
struct Fit {
  Hypothesis what;
  std::shared_ptr<const Layout> layout;
  std::vector<double> point;  // unit coordinates
  std::vector<Term> terms;
  double cost = 0.0;     // NRMSE over the fitted recordings
  double heldout = 0.0;  // NRMSE over the judged recordings

  [[nodiscard]] std::size_t dimension() const { return point.size(); }
};

// Points of a hypothesis' box to descend from.
struct Starts {
  std::shared_ptr<const Layout> layout;
  std::vector<std::vector<double>> points;
  std::vector<double> neutral;     // the known fit, what is new at its initial values
  std::vector<std::size_t> sizes;  // coordinates that scale what is new
};

class Workbench {
 public:
  // `scale` of the whole campaign, so that every workbench of it searches one box.
  // Once `stopped` is true fits end where they are: what they return is then of no use but for ending soon.
  Workbench(const DataScale& scale, Split split, LayoutOptions layout, ObjectiveOptions objective, std::uint64_t seed,
            std::function<bool()> stopped);

  [[nodiscard]] const Split& split() const { return *split_; }
  [[nodiscard]] const ObjectiveOptions& options() const { return options_; }

  // Many starts over the whole box.
  [[nodiscard]] Fit from_anywhere(const Hypothesis& what, std::size_t budget) const;
  // Descents from a fit of a smaller or equal hypothesis, half of them from `also` when given: its values, and a spread
  // of starts for what is new. `rounds` derivative evaluations of the best starts, fewer of the others.
  [[nodiscard]] Fit from_fit(const Hypothesis& what, const Fit& warm, int rounds, const Fit* also = nullptr) const;
  // Points to descend from: those of from_fit, twice as many where what is new has shapes; and descents from the best
  // `most` of given ones.
  [[nodiscard]] Starts starts(const Hypothesis& what, const Fit& warm, const Fit* also = nullptr) const;
  [[nodiscard]] Fit from_starts(const Hypothesis& what, const Starts& starts, int rounds, std::size_t most) const;
  // As many descents as share one pack with all their derivatives.
  [[nodiscard]] static std::size_t starts_of_a_pack(std::size_t dimension);
  // Continues the best of a fit itself.
  [[nodiscard]] Fit polished(const Fit& fit, int rounds) const;
  // The same hypothesis fitted to all recordings, judged ones too.
  [[nodiscard]] Fit on_all(const Fit& fit, const std::vector<Recording>& all, int rounds) const;
  // Costs of a fit as they are on this workbench, nothing refitted.
  [[nodiscard]] Fit scored(const Fit& fit) const;
  // The fit with one effect more, which stands at its initial values: mostly where it does nothing. Nothing is refitted
  // and the costs are those of `fit`.
  [[nodiscard]] Fit with_neutral(const Fit& fit, const std::string& effect) const;
  // The fit less one of its effects, all else as it is, without costs.
  [[nodiscard]] Fit less(const Fit& fit, const std::string& effect) const;
  // For a part in series and a fit without any: the fit with the part at its neutral size, with its costs. Where a
  // force balance is solved in every step, coarse motions are marched in another way; what that is worth is no gain of
  // the part. Nothing for any other part.
  [[nodiscard]] std::optional<Fit> beside(const Fit& fit, const Extension& part) const;
  // Several at once, in parallel; results in order.
  [[nodiscard]] std::vector<Fit> from_fit(const std::vector<Hypothesis>& what, const Fit& warm, int rounds,
                                          const Fit* also = nullptr) const;
  [[nodiscard]] std::vector<Fit> polished(const std::vector<Fit>& fits, int rounds) const;

  // For a loop of so many tasks at a time: the same with one thread for each, or with all where there is one task.
  [[nodiscard]] Workbench shared_by(std::size_t tasks) const;
  // Of a fit on a recording.
  [[nodiscard]] Residual residual(const Fit& fit, const Recording& recording) const;
  // Of a fit on the fitted recordings, in parallel.
  [[nodiscard]] std::vector<Residual> plain_residuals(const Fit& fit) const;
  // The same with all that is told of them: two simulations of each, in parallel.
  [[nodiscard]] Residuals residuals(const Fit& fit) const;
  // Takes noise and motions of the same files from `whole`, whose recordings are not thinned and tell them better.
  void take_noise_and_motions_of(const Workbench& whole);
  // Noise of the force of each fitted recording, in their order.
  [[nodiscard]] const std::vector<NoiseFloor>& noise() const { return noise_; }
  // Number of the motion of each fitted recording (residual/conditions.hpp), in their order.
  [[nodiscard]] const std::vector<std::size_t>& motions() const { return motions_; }
  // How the residuals of a fit, those given, change with each parameter of its damper law that cannot be zero.
  [[nodiscard]] std::vector<Sensitivity> sensitivities(const Fit& fit, const Residuals& residuals) const;
  [[nodiscard]] Layout layout(const Hypothesis& what) const;

  // From now on pieces of work are kept there, and what it holds is not worked out again. It outlives the workbench and
  // its copies.
  void keep_in(Checkpoint& checkpoint);
  // The bytes that `work` gives, a function of this workbench and of what is in the key alone. From any thread.
  [[nodiscard]] std::string piece(const ByteWriter& key, const std::function<std::string()>& work) const;
  [[nodiscard]] bool has_piece(const ByteWriter& key) const;

 private:
  // The values that the fit has for what both hypotheses have; what else there is stands at its initial values.
  [[nodiscard]] Fit carried_over(const Fit& fit, Hypothesis what) const;
  [[nodiscard]] Fit finished(const Hypothesis& what, const Layout& layout, std::vector<double> point,
                             double cost) const;
  [[nodiscard]] Fit searched(const Hypothesis& what, const Layout& layout, std::size_t budget) const;
  [[nodiscard]] std::string key_of(const ByteWriter& key) const;
  [[nodiscard]] Residual simulated(const Fit& fit, const Recording& recording) const;
  // Of a piece: a point of the hypothesis' box with its costs.
  [[nodiscard]] Fit fit_piece(const ByteWriter& key, const Hypothesis& what, const Layout& layout,
                              const std::function<Fit()>& work) const;
  // On the fitted recordings, or on others.
  [[nodiscard]] Fit descended(const Hypothesis& what, const Layout& layout,
                              const std::vector<std::vector<double>>& starts, int rounds,
                              const std::vector<Recording>* others = nullptr) const;
  struct Reached {
    std::vector<double> point;
    double cost;
  };
  [[nodiscard]] Reached reached(const Layout& layout, const Objective& objective,
                                const std::vector<std::vector<double>>& starts, int rounds) const;
  // The starts, best first.
  [[nodiscard]] std::vector<std::vector<double>> eased(const Starts& starts) const;
  [[nodiscard]] std::vector<double> under_measured_force(const Starts& starts, int rounds) const;

  DataScale scale_;
  std::shared_ptr<const Split> split_;  // copies of the workbench share it, and what they simulate of it
  std::shared_ptr<ResidualStore> residuals_ = std::make_shared<ResidualStore>();
  std::vector<NoiseFloor> noise_;
  std::vector<std::size_t> motions_;
  LayoutOptions layout_;
  ObjectiveOptions options_;
  std::uint64_t seed_;
  std::function<bool()> stopped_;
  Checkpoint* checkpoint_ = nullptr;
  std::string identity_;  // hash of all that decides what the workbench does
};

// Parts of keys. The parameters of a fit need not be those of its point.
void add_fit(ByteWriter& key, const Fit& fit);
void add_parameters(ByteWriter& key, const Fit& fit);
void add_layout(ByteWriter& key, const Layout& layout);
void add_recordings(ByteWriter& key, const std::vector<Recording>& recordings);

}  // namespace hysteron
