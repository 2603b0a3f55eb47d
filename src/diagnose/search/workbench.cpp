#include "diagnose/search/workbench.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/residual/conditions.hpp"
#include "fit/score.hpp"

namespace hysteron {

Workbench::Workbench(const DataScale& scale, Split split, LayoutOptions layout, ObjectiveOptions objective,
                     std::uint64_t seed, std::function<bool()> stopped)
    : scale_(scale),
      split_(std::make_shared<const Split>(std::move(split))),
      layout_(std::move(layout)),
      options_(std::move(objective)),
      seed_(seed),
      stopped_(std::move(stopped)) {
  noise_.reserve(split_->fit.size());
  for (const Recording& recording : split_->fit) {
    noise_.push_back(noise_floor(recording));
  }
  motions_ = motions_of(split_->fit);
}

void Workbench::take_noise_and_motions_of(const Workbench& whole) {
  for (std::size_t k = 0; k < split_->fit.size(); ++k) {
    const auto at = std::ranges::find(whole.split_->fit, split_->fit[k].file, &Recording::file);
    if (at != whole.split_->fit.end()) {
      noise_[k] = whole.noise_[static_cast<std::size_t>(at - whole.split_->fit.begin())];
      motions_[k] = whole.motions_[static_cast<std::size_t>(at - whole.split_->fit.begin())];
    }
  }
}

Workbench Workbench::shared_by(std::size_t tasks) const {
  Workbench result = *this;
  if (tasks > 1) {
    result.options_.threads = 1;
  }
  return result;
}

Layout Workbench::layout(const Hypothesis& what) const {
  LayoutOptions options = layout_;
  const CompositeModel model = make_model(what.model, what.effects);
  const std::vector<std::string> names = model.parameter_names();
  // Another base law need not have the parameters of the first. Its yield force then follows the drive as theirs.
  int lost = 0;
  std::erase_if(options.by_current, [&](const auto& law) {
    const bool absent = std::ranges::find(names, law.first) == names.end();
    lost = absent ? std::max(lost, law.second) : lost;
    return absent;
  });
  for (const Parameter& parameter : model.law->parameters) {
    if (lost > 0 && parameter.role == PhysicalRole::yield_force && !parameter.fixed) {
      options.by_current.try_emplace(std::string(parameter.name), lost);
    }
  }
  options = only_of(names, std::move(options));
  // A damping that an effect takes away or adds follows the drive as the law's own does.
  const std::vector<Parameter> cards = model.parameters();
  int order = 0;
  for (const auto& [name, power] : options.by_current) {
    const auto at = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    order = cards[at].role == PhysicalRole::damping ? std::max(order, power) : order;
  }
  for (std::size_t k = model.law->parameters.size(); k < names.size() && order > 0; ++k) {
    if (cards[k].role == PhysicalRole::damping && !cards[k].fixed) {
      options.by_current[names[k]] = order;
    }
  }
  for (const std::string& name : what.richer) {
    options.by_current[name] += 1;
  }
  return Layout(model, scale_, options);
}

Fit Workbench::carried_over(const Fit& fit, Hypothesis what) const {
  Fit result;
  result.what = std::move(what);
  result.layout = std::make_shared<const Layout>(layout(result.what));
  result.point = result.layout->initial();
  carry_over(*fit.layout, fit.terms, *result.layout, result.point);
  result.terms = result.layout->terms(result.point);
  return result;
}

Fit Workbench::with_neutral(const Fit& fit, const std::string& effect) const {
  Fit result = carried_over(fit, with(fit.what, effect_extension(effect)));
  result.cost = fit.cost;
  result.heldout = fit.heldout;
  return result;
}

Fit Workbench::less(const Fit& fit, const std::string& effect) const {
  return carried_over(fit, without(fit.what, effect_extension(effect)));
}

std::optional<Fit> Workbench::beside(const Fit& fit, const Extension& part) const {
  if (!in_series(part.effect) || std::ranges::any_of(fit.what.effects, in_series)) {
    return std::nullopt;
  }
  return scored(with_neutral(fit, part.effect));
}

Fit Workbench::finished(const Hypothesis& what, const Layout& layout, std::vector<double> point, double cost) const {
  Fit fit;
  fit.what = what;
  fit.layout = std::make_shared<const Layout>(layout);
  fit.terms = layout.terms(point);
  fit.point = std::move(point);
  fit.cost = cost;
  double sum = 0.0;
  for (const Judged& judged : split_->judge) {
    const double norm = normaliser(judged.recording, options_.normalisation);
    sum += residual(fit, judged.recording).mean_square(judged.from) / (norm * norm);
  }
  fit.heldout = std::sqrt(sum / static_cast<double>(split_->judge.size()));
  if (!std::isfinite(fit.heldout)) {
    fit.heldout = diverged_cost;
  }
  return fit;
}

Fit Workbench::scored(const Fit& fit) const {
  ByteWriter key;
  key.text("costs");
  add_fit(key, fit);
  return fit_piece(key, fit.what, *fit.layout, [&] {
    const Objective objective(*fit.layout, split_->fit, options_);
    return finished(fit.what, *fit.layout, fit.point, objective.evaluate({fit.point, false}).cost[0]);
  });
}

}  // namespace hysteron
