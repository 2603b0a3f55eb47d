#include "simulate/composite.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "simulate/assembly.hpp"
#include "simulate/chain.hpp"
#include "simulate/implicit.hpp"
#include "simulate/march.hpp"
#include "simulate/under_load.hpp"

namespace hysteron {
namespace {

std::vector<std::string> ids(std::span<const Part* const> catalogue) {
  std::vector<std::string> result;
  for (const Part* part : catalogue) {
    result.emplace_back(part->id);
  }
  return result;
}

const Part* find(std::span<const Part* const> catalogue, std::string_view id) {
  const auto found = std::ranges::find_if(catalogue, [&](const Part* part) { return part->id == id; });
  return found == catalogue.end() ? nullptr : *found;
}

}  // namespace

const Part* find_model(std::string_view id) { return find(model_catalogue(), id); }
const Part* find_effect(std::string_view id) { return find(effect_catalogue(), id); }

std::vector<Parameter> CompositeModel::parameters() const {
  std::vector<Parameter> result(law->parameters.begin(), law->parameters.end());
  for (const Part* effect : effects) {
    if (effect->bends) {
      for (Parameter& below : result) {
        below.linear = false;
      }
    }
    result.insert(result.end(), effect->parameters.begin(), effect->parameters.end());
  }
  return result;
}

std::vector<std::string> CompositeModel::parameter_names() const {
  std::vector<std::string> result;
  for (const Parameter& parameter : law->parameters) {
    result.emplace_back(parameter.name);
  }
  for (const Part* effect : effects) {
    for (const Parameter& parameter : effect->parameters) {
      result.push_back(std::string(effect->id) + "." + std::string(parameter.name));
    }
  }
  return result;
}

std::size_t CompositeModel::parameter_count() const {
  std::size_t count = 0;
  for_links([&](const Link& link) { count += link.part->parameters.size(); });
  return count;
}

int CompositeModel::states() const {
  int count = 0;
  for_links([&](const Link& link) { count += link.part->states; });
  return count;
}

bool CompositeModel::balances() const {
  return std::ranges::any_of(effects, [](const Part* effect) { return effect->balances(); });
}

template <class T>
void CompositeModel::march(const Motion& motion, const T* p, std::size_t stride, std::size_t begin, std::size_t end,
                           T* state, T* out) const {
  if (effects.empty()) {
    law->on<T>().march(motion, p, stride, begin, end, state, out);
    return;
  }
  const bool additive = std::ranges::all_of(
      effects, [](const Part* effect) { return effect->states == 0 && effect->on<T>().drive == nullptr; });
  if (additive) {
    law->on<T>().march(motion, p, stride, begin, end, state, out);
    for_links([&](const Link& link) {
      if (link.part == law) return;
      for (std::size_t n = begin; n < end; ++n) {
        link.part->on<T>().force(p + (n - begin) * stride + link.parameter, state,
                                 detail::input_of_sample<T>(motion, n), out[n - begin]);
      }
    });
    return;
  }
  if constexpr (!std::is_same_v<T, WideLanes>) {
    if (balances()) {
      const bool implicit = motion.implicit_elements && takes_implicit_steps(*this);
      const auto march_balanced = !motion.load.empty() ? march_under_load<T>
                                  : implicit           ? march_implicit<T>
                                                       : march_assembly<T>;
      march_balanced(*this, motion, p, stride, begin, end, state, out);
      return;
    }
  }
  const auto run = [&](const auto& chain) { hysteron::march<T>(chain, motion, p, stride, begin, end, state, out); };
  switch (states()) {
    case 1:
      return run(SizedChain<T, 1>(*this));
    case 2:
      return run(SizedChain<T, 2>(*this));
    case 3:
      return run(SizedChain<T, 3>(*this));
    default:
      return run(Chain<T>(*this));
  }
}

template void CompositeModel::march<double>(const Motion&, const double*, std::size_t, std::size_t, std::size_t,
                                            double*, double*) const;
template void CompositeModel::march<Lanes>(const Motion&, const Lanes*, std::size_t, std::size_t, std::size_t, Lanes*,
                                           Lanes*) const;
template void CompositeModel::march<WideLanes>(const Motion&, const WideLanes*, std::size_t, std::size_t, std::size_t,
                                               WideLanes*, WideLanes*) const;
template void CompositeModel::march<LaneDual>(const Motion&, const LaneDual*, std::size_t, std::size_t, std::size_t,
                                              LaneDual*, LaneDual*) const;

CompositeModel make_model(std::string_view law, const std::vector<std::string>& effects) {
  CompositeModel model;
  model.law = find_model(law);
  if (model.law == nullptr) {
    throw InputError("unknown model '" + std::string(law) + "'" + suggestion(law, ids(model_catalogue())) +
                     ", see `hysteron list models`");
  }
  for (const std::string& id : effects) {
    const Part* effect = find_effect(id);
    if (effect == nullptr) {
      throw InputError("unknown effect '" + id + "'" + suggestion(id, ids(effect_catalogue())) +
                       ", see `hysteron list effects`");
    }
    model.effects.push_back(effect);
  }
  if (model.effects.size() >= max_links) {
    throw InputError("too many effects at once: " + std::to_string(effects.size()) + ", expected at most " +
                     std::to_string(max_links - 1));
  }
  if (model.states() > max_states) {
    throw InputError("too many effects at once: more than " + std::to_string(max_states) + " state variables");
  }
  return model;
}

std::vector<double> simulate(const CompositeModel& model, const Motion& motion, const std::vector<double>& parameters) {
  std::vector<double> force(motion.time.size());
  std::vector<double> state(static_cast<std::size_t>(max_states), 0.0);
  model.march<double>(motion, parameters.data(), 0, 0, motion.time.size(), state.data(), force.data());
  return force;
}

}  // namespace hysteron
