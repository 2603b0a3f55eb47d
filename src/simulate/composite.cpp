#include "simulate/composite.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "simulate/assembly.hpp"
#include "simulate/march.hpp"

namespace hysteron {
namespace {

// The chain at run time: drives act from the outermost effect inwards, forces from the law outwards.
template <class T>
struct Chain {
  struct Link {
    const PartOperations<T>* operations;
    std::size_t parameter;
    int state;
    int states;
  };
  std::vector<Link> links;  // law first
  int total;

  explicit Chain(const CompositeModel& model) : total(model.states()) {
    model.for_links([this](const hysteron::Link& link) {
      links.push_back({&link.part->on<T>(), link.parameter, link.state, link.part->states});
    });
  }

  [[nodiscard]] int states() const { return total; }

  void rate(const T* p, const T* s, Input<T> in, T* rates) const {
    for (std::size_t i = links.size(); i-- > 0;) {
      const Link& link = links[i];
      if (link.states > 0) {
        link.operations->rate(p + link.parameter, s + link.state, in, rates + link.state);
      }
      if (link.operations->drive != nullptr) {
        link.operations->drive(p + link.parameter, s + link.state, in);
      }
    }
  }

  [[nodiscard]] bool settles() const {
    return std::ranges::any_of(links, [](const Link& link) { return link.operations->settles >= 0; });
  }
  void rest(const T* p, const T* s, Input<T> in, T* rates) const {
    for (std::size_t i = links.size(); i-- > 0;) {
      const Link& link = links[i];
      if (link.operations->settles >= 0) {
        link.operations->rest(p + link.parameter, s + link.state, in, rates + link.state);
      }
      if (link.operations->drive != nullptr) {
        link.operations->drive(p + link.parameter, s + link.state, in);
      }
    }
  }
  value_t<T> stiffness_now(const T* p, const T* /*s*/, const T* rates, const Input<T>& /*in*/, double speed,
                           double /*change*/) const {
    value_t<T> bound(0.0);
    for (const Link& link : links) {
      if (link.states == 0) continue;
      const value_t<T> whole = link.operations->stiffness(p + link.parameter, speed);
      bound = bound + (link.operations->settles < 0
                           ? whole
                           : select(detail::rests(value_of(rates[link.state + link.operations->settles])),
                                    link.operations->slack(p + link.parameter), whole));
    }
    return bound;
  }
  // The links see motions that their own states may bend.
  static constexpr bool knows_kinks() { return false; }
  auto kinked(const T* /*p*/, const T* /*before*/, const Input<T>& /*in_before*/, const T* /*now*/,
              const Input<T>& in_now) const {
    return value_of(in_now.v) < value_of(in_now.v);
  }
  auto woken(const T* before, const T* now, const value_t<T>& little) const {
    auto result = little < value_t<T>(0.0);
    for (const Link& link : links) {
      if (link.operations->settles < 0) continue;
      const int k = link.state + link.operations->settles;
      result = result | (detail::rests(value_of(before[k])) & (abs(value_of(now[k])) > little));
    }
    return result;
  }

  T force(const T* p, const T* s, const Input<T>& in) const {
    std::array<Input<T>, max_links> seen;
    seen[links.size() - 1] = in;
    for (std::size_t i = links.size(); i-- > 1;) {
      seen[i - 1] = seen[i];
      if (links[i].operations->drive != nullptr) {
        links[i].operations->drive(p + links[i].parameter, s + links[i].state, seen[i - 1]);
      }
    }
    T result(0.0);
    for (std::size_t i = 0; i < links.size(); ++i) {
      links[i].operations->force(p + links[i].parameter, s + links[i].state, seen[i], result);
    }
    return result;
  }

  value_t<T> stiffness(const T* p, double speed) const {
    value_t<T> bound(0.0);
    for (const Link& link : links) {
      if (link.states > 0) {
        bound = bound + link.operations->stiffness(p + link.parameter, speed);
      }
    }
    return bound;
  }
};

// Knows its number of states while compiling: room for all that a chain may have would be cleared at every step.
template <class T, int N>
struct SizedChain : Chain<T> {
  explicit SizedChain(const CompositeModel& model) : Chain<T>(model) {}
  static constexpr int states() { return N; }
};

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
  if (needs_assembly<T>(*this)) {
    march_assembly<T>(*this, motion, p, stride, begin, end, state, out);
    return;
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
