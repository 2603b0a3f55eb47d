#include "diagnose/search/relatives.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "simulate/part.hpp"

namespace hysteron {

std::vector<std::string> relatives(const std::string& id) {
  static const std::vector<std::vector<std::string>> families = {
      {"offset-force", "gas-spring"},
      {"linear-stiffness", "gas-spring", "cubic-stiffness", "end-stop"},
      {"compliance", "clearance", "entrapped-gas"},
      {"compliance", "series-dashpot"},
      {"inertia", "sensor-delay", "velocity-lag"},
      {"coulomb-friction", "seal-friction", "pre-yield-hysteresis"},
      {"viscous-damping", "quadratic-damping", "shear-thinning"},
      {"coulomb-friction", "shear-thinning"},
      {"self-heating", "degradation", "stiction"},
      {"coil-lag", "magnetic-remanence", "magnetic-saturation"},
      {"asymmetry", "cavitation"},
      {"pinching", "cubic-stiffness"},
  };
  std::vector<std::string> result;
  for (const std::vector<std::string>& family : families) {
    if (std::ranges::find(family, id) == family.end()) {
      continue;
    }
    for (const std::string& other : family) {
      if (other != id && std::ranges::find(result, other) == result.end()) {
        result.push_back(other);
      }
    }
  }
  return result;
}

bool is_kin(const std::string& effect, const std::string& other) {
  const std::vector<std::string> alike = relatives(effect);
  return std::ranges::find(alike, other) != alike.end();
}

bool is_of_place(const std::string& effect) {
  constexpr std::array<std::string_view, 6> ids = {"offset-force", "linear-stiffness", "cubic-stiffness",
                                                   "end-stop",     "gas-spring",       "pinching"};
  return std::ranges::find(ids, effect) != ids.end();
}

bool acts_in_a_part(const std::string& effect) { return effect == "end-stop"; }

bool has_one_form(const std::string& effect) {
  constexpr std::array<std::string_view, 4> ids = {"offset-force", "linear-stiffness", "viscous-damping", "inertia"};
  return std::ranges::find(ids, effect) != ids.end();
}

namespace {

struct Limit {
  std::string_view effect;
  std::string_view wider;
  std::string_view parameter;
};

constexpr std::array<Limit, 7> limits = {{{"offset-force", "gas-spring", "g"},
                                          {"linear-stiffness", "gas-spring", ""},
                                          {"coulomb-friction", "seal-friction", "fb"},
                                          {"coulomb-friction", "shear-thinning", "m"},
                                          {"compliance", "entrapped-gas", "d_a"},
                                          {"compliance", "clearance", "gap"},
                                          {"cubic-stiffness", "end-stop", "x_up"}}};

// A gas that is compressed by next to no force is a play, damping that thins out entirely is a friction, and a friction
// that turns over as slowly as it can is a damping that thins out.
constexpr std::array<BoxLimit, 4> box_limits = {{{"entrapped-gas", "clearance", "f_a", BoxEnd::lower},
                                                 {"shear-thinning", "coulomb-friction", "m", BoxEnd::lower},
                                                 {"coulomb-friction", "shear-thinning", "v_t", BoxEnd::upper},
                                                 {"seal-friction", "shear-thinning", "v_t", BoxEnd::upper}}};

const Limit* find_limit(const std::string& effect, const std::string& wider) {
  const auto* at =
      std::ranges::find_if(limits, [&](const Limit& row) { return row.effect == effect && row.wider == wider; });
  return at == limits.end() ? nullptr : at;
}

constexpr std::array<Kindred, 8> kindred_parameters = {{{"entrapped-gas.d_a", "clearance.gap", 2.0},
                                                        {"entrapped-gas.C_c", "clearance.C_c", 1.0},
                                                        {"clearance.gap", "entrapped-gas.d_a", 0.5},
                                                        {"clearance.C_c", "entrapped-gas.C_c", 1.0},
                                                        {"compliance.C", "clearance.C_c", 1.0},
                                                        {"compliance.C", "entrapped-gas.C_c", 1.0},
                                                        {"clearance.C_c", "compliance.C", 1.0},
                                                        {"entrapped-gas.C_c", "compliance.C", 1.0}}};

}  // namespace

std::span<const Kindred> kindred() { return kindred_parameters; }

bool is_limit(const std::string& effect, const std::string& wider) { return find_limit(effect, wider) != nullptr; }

bool is_part_of(const std::string& effect, const std::string& law) {
  const Part* part = find_effect(effect);
  const Part* model = find_model(law);
  if (part == nullptr || model == nullptr || part->parameters.size() != 1 || !part->parameters.front().linear) {
    return false;
  }
  const Parameter& size = part->parameters.front();
  return std::ranges::any_of(model->parameters, [&](const Parameter& own) {
    return own.linear && own.unit == size.unit && own.lower == size.lower && own.upper == size.upper;
  });
}

std::string limit_parameter(const std::string& effect, const std::string& wider) {
  const Limit* limit = find_limit(effect, wider);
  return limit == nullptr ? std::string{} : std::string(limit->parameter);
}

const BoxLimit* box_limit(const std::string& effect, const std::string& other) {
  const auto* at =
      std::ranges::find_if(box_limits, [&](const BoxLimit& row) { return row.effect == effect && row.other == other; });
  return at == box_limits.end() ? nullptr : at;
}

}  // namespace hysteron
