// A law with its effects as the march sees them: the parts of a model as one system of equations.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "simulate/composite.hpp"
#include "simulate/march.hpp"

namespace hysteron {

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

}  // namespace hysteron
