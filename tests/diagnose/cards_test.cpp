// What the cards of laws and effects say, asked as the diagnosis asks, against what is meant: entry by entry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "diagnose/diagnose.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/stage.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

using Names = std::vector<std::string>;
using Pairs = std::set<std::pair<std::string, std::string>>;
using NameSet = std::set<std::string>;

Names ids_of(std::span<const Part* const> catalogue) {
  Names result;
  for (const Part* part : catalogue) {
    result.emplace_back(part->id);
  }
  return result;
}

NameSet effects_that(bool (*is)(const std::string&)) {
  NameSet result;
  for (const std::string& id : ids_of(effect_catalogue())) {
    if (is(id)) {
      result.insert(id);
    }
  }
  return result;
}

// Orders above zero of the laws of a layout.
std::map<std::string, int> orders_of(const Layout& layout) {
  std::map<std::string, int> result;
  for (const ParameterLaw& law : layout.laws()) {
    if (law.drive_nodes.size() > 1) {
      result[layout.names()[law.parameter]] = static_cast<int>(law.drive_nodes.size()) - 1;
    }
  }
  return result;
}

Workbench bench_with(const std::map<std::string, int>& by_current) {
  DataScale scale;
  scale.drive_high = 1.0;
  LayoutOptions layout;
  layout.by_current = by_current;
  return {scale, {}, layout, {}, 1, [] { return false; }};
}

const std::map<std::string, Names> yield_forces = {{"algebraic-hysteresis", {"alpha"}},
                                                   {"asymmetric-sigmoid", {"f_t"}},
                                                   {"baber-noori", {"alpha"}},
                                                   {"bingham", {"fc"}},
                                                   {"bingham-maxwell", {"fc"}},
                                                   {"bouc-wen", {"alpha"}},
                                                   {"extended-bingham", {"fc"}},
                                                   {"guo-hu", {"f_y"}},
                                                   {"hyperbolic-tangent", {"alpha"}},
                                                   {"hysteretic-spring", {}},
                                                   {"lugre", {"alpha"}},
                                                   {"modified-bouc-wen", {"alpha"}},
                                                   {"modified-dahl", {"alpha"}},
                                                   {"nonlinear-biviscous", {"fy"}},
                                                   {"polynomial-hysteresis", {}},
                                                   {"preisach", {"f_y"}},
                                                   {"quasi-static-flow", {}},
                                                   {"viscous", {}},
                                                   {"wang-sigmoid", {}}};  // has the drive in its equations

const std::map<std::string, Names> dampings = {{"algebraic-hysteresis", {"c0"}},
                                               {"asymmetric-sigmoid", {"c_c", "c_e"}},
                                               {"baber-noori", {"c0"}},
                                               {"bingham", {"c0"}},
                                               {"bingham-maxwell", {"c0"}},
                                               {"bouc-wen", {"c0"}},
                                               {"extended-bingham", {"c0", "c1"}},
                                               {"guo-hu", {"c0"}},
                                               {"hyperbolic-tangent", {"c0"}},
                                               {"hysteretic-spring", {"c0"}},
                                               {"lugre", {"c0", "c1"}},
                                               {"modified-bouc-wen", {"c0", "c1"}},
                                               {"modified-dahl", {"c0"}},
                                               {"nonlinear-biviscous", {"c0"}},
                                               {"polynomial-hysteresis", {}},
                                               {"preisach", {"c0"}},
                                               {"quasi-static-flow", {}},
                                               {"viscous", {"c0"}},
                                               {"wang-sigmoid", {}}};

TEST(Cards, YieldForceAndDampingsOfEveryLawFollowADriveThatVaries) {
  Recording low;
  low.drive = {0.0};
  Recording high;
  high.drive = {1.0};
  NameSet laws;
  for (const std::string& law : ids_of(model_catalogue())) {
    laws.insert(law);
    ASSERT_TRUE(yield_forces.contains(law) && dampings.contains(law)) << law << " is new: say what follows the drive";
    std::map<std::string, int> meant;
    for (const Names& names : {yield_forces.at(law), dampings.at(law)}) {
      for (const std::string& name : names) {
        meant[name] = 1;
      }
    }
    EXPECT_EQ(base_laws(law, {low, high}), meant) << law;
    EXPECT_TRUE(base_laws(law, {low, low}).empty()) << law;
  }
  EXPECT_EQ(laws.size(), yield_forces.size());
}

TEST(Cards, ASettingThatScattersIsNoDriveThatVaries) {
  std::vector<Recording> recordings;
  for (const double drive : {1.0, 1.002, 1.004, 1.001}) {
    recordings.emplace_back().drive = {drive};
  }
  EXPECT_TRUE(base_laws("bingham", recordings).empty());
  recordings.emplace_back().drive = {0.5};
  EXPECT_FALSE(base_laws("bingham", recordings).empty());
}

TEST(Cards, AYieldForceTakesOverTheLawOfOneThatAnotherLawLacks) {
  const Workbench bench = bench_with({{"of_another_law", 2}});
  for (const std::string& law : ids_of(model_catalogue())) {
    std::map<std::string, int> meant;
    for (const std::string& name : yield_forces.at(law)) {
      meant[name] = 2;
    }
    EXPECT_EQ(orders_of(bench.layout({law, {}, {}})), meant) << law;
  }
}

TEST(Cards, ADampingOfAnEffectFollowsTheDriveAsTheLawsOwn) {
  const std::map<std::string, std::string> meant = {
      {"asymmetry", "c_d"}, {"self-heating", "c_h"}, {"shear-thinning", "c_t"}, {"viscous-damping", "c"}};
  const Workbench damped = bench_with({{"c0", 2}});
  const Workbench hardened = bench_with({{"alpha", 2}});
  for (const std::string& effect : ids_of(effect_catalogue())) {
    std::map<std::string, int> orders = {{"c0", 2}};
    if (const auto at = meant.find(effect); at != meant.end()) {
      orders[effect + "." + at->second] = 2;
    }
    EXPECT_EQ(orders_of(damped.layout({"bouc-wen", {effect}, {}})), orders) << effect;
    EXPECT_EQ(orders_of(hardened.layout({"bouc-wen", {effect}, {}})), (std::map<std::string, int>{{"alpha", 2}}))
        << effect;
  }
}

// A field changes forces, dampings and stiffnesses. Where a yield displacement seems to grow with it, a spring in
// series gives way, and a law that bends would hide that.
TEST(Cards, APlaceOrAShareDoesNotFollowTheDrive) {
  Split split;
  for (const double level : {0.2, 0.6, 1.0}) {
    Recording recording = testing::motion("r.csv", {{0.01, 1.0}}, 3.0, 300, 0.5);
    testing::set_drive(recording, level);
    recording.force = recording.velocity;
    split.fit.push_back(recording);
  }
  LayoutOptions layout;
  layout.by_current = {{"alpha", 1}};
  const Workbench bench(scale_of(split.fit), split, layout, {}, 1, [] { return false; });
  std::set<std::string> meant = {"alpha", "c0", "k0", "f0"};
  for (const Extension& law : law_candidates(bench, {"bouc-wen", {}, {}})) {
    ASSERT_EQ(law.parameters.size(), 1U);
    EXPECT_EQ(meant.erase(law.parameters.front()), 1U) << law.parameters.front();
  }
  EXPECT_TRUE(meant.empty()) << *meant.begin();
}

TEST(Cards, WhatALawHasOfItsOwn) {
  const std::map<std::string, NameSet> laws_without = {
      {"offset-force", {"modified-bouc-wen", "polynomial-hysteresis", "wang-sigmoid"}},
      {"linear-stiffness",
       {"asymmetric-sigmoid", "bingham", "bingham-maxwell", "extended-bingham", "guo-hu", "nonlinear-biviscous",
        "polynomial-hysteresis", "preisach", "quasi-static-flow", "wang-sigmoid"}},
      {"viscous-damping",
       {"extended-bingham", "modified-bouc-wen", "polynomial-hysteresis", "quasi-static-flow", "wang-sigmoid"}}};
  const std::set<std::pair<std::string, std::string>> said_on_the_card = {{"degradation", "baber-noori"},
                                                                          {"magnetic-remanence", "preisach"},
                                                                          {"pinching", "baber-noori"},
                                                                          {"series-dashpot", "modified-bouc-wen"}};
  for (const std::string& effect : ids_of(effect_catalogue())) {
    for (const std::string& law : ids_of(model_catalogue())) {
      const auto at = laws_without.find(effect);
      const bool as_parameter = at != laws_without.end() && !at->second.contains(law);
      EXPECT_EQ(is_part_of(effect, law), as_parameter || said_on_the_card.contains({effect, law}))
          << effect << " " << law;
    }
  }
  EXPECT_FALSE(is_part_of("offset-force", "no-such-law"));
  EXPECT_FALSE(is_part_of("no-such-effect", "viscous"));
}

// With the part's parameter where it does nothing, the law is the one that its card calls the rest.
TEST(Cards, ALawWithoutItsPartIsTheRest) {
  EXPECT_EQ(rest_of_law("series-dashpot", "modified-bouc-wen"), "bouc-wen");
  EXPECT_EQ(rest_of_law("pinching", "baber-noori"), "") << "degradation is left";
  EXPECT_EQ(rest_of_law("inertia", "modified-bouc-wen"), "");
  const std::map<std::string, double> common = {{"alpha", 600.0}, {"c0", 1500.0}, {"k0", 2000.0},
                                                {"x_y", 8e-4},    {"share", 0.6}, {"n", 1.5}};
  const std::map<std::string, double> absent = {{"c1", 1e12}};
  const Recording recording = testing::motion("r.csv", {{0.01, 1.3}}, 2.0, 400, 0.2);
  const auto force_of = [&](const std::string& law, bool without) {
    const CompositeModel model = make_model(law, {});
    std::vector<double> values;
    for (const std::string& name : model.parameter_names()) {
      const auto at = common.find(name);
      values.push_back(at != common.end() ? at->second : without && absent.contains(name) ? absent.at(name) : 0.0);
    }
    return simulate(model, make_motion(recording.time, recording.displacement, recording.velocity, {}), values);
  };
  for (const std::string& effect : ids_of(effect_catalogue())) {
    for (const PartOfLaw& part : knowledge_of(effect).part_of) {
      if (part.rest.empty()) {
        continue;
      }
      const std::vector<double> with = force_of(std::string(part.law), true);
      const std::vector<double> rest = force_of(std::string(part.rest), false);
      double largest = 0.0;
      double apart = 0.0;
      for (std::size_t n = 0; n < rest.size(); ++n) {
        largest = std::max(largest, std::fabs(rest[n]));
        apart = std::max(apart, std::fabs(with[n] - rest[n]));
      }
      EXPECT_LT(apart, 1e-4 * largest) << effect << " of " << part.law;
      EXPECT_GT(largest, 100.0);
    }
  }
}

TEST(Cards, RelativesInTheOrderTheyAreTried) {
  const std::map<std::string, Names> meant = {
      {"asymmetry", {"cavitation"}},
      {"cavitation", {"asymmetry"}},
      {"clearance", {"compliance", "entrapped-gas"}},
      {"coil-lag", {"magnetic-remanence", "magnetic-saturation"}},
      {"compliance", {"clearance", "entrapped-gas", "series-dashpot", "sensor-delay"}},
      {"coulomb-friction", {"seal-friction", "pre-yield-hysteresis", "shear-thinning"}},
      {"cubic-stiffness", {"linear-stiffness", "gas-spring", "end-stop", "pinching"}},
      {"degradation", {"self-heating", "stiction"}},
      {"end-stop", {"linear-stiffness", "gas-spring", "cubic-stiffness"}},
      {"entrapped-gas", {"compliance", "clearance"}},
      {"force-drift", {}},
      {"gas-spring", {"offset-force", "linear-stiffness", "cubic-stiffness", "end-stop"}},
      {"inertia", {"sensor-delay", "velocity-lag"}},
      {"linear-stiffness", {"gas-spring", "cubic-stiffness", "end-stop"}},
      {"magnetic-remanence", {"coil-lag", "magnetic-saturation"}},
      {"magnetic-saturation", {"coil-lag", "magnetic-remanence"}},
      {"offset-force", {"gas-spring"}},
      {"pinching", {"cubic-stiffness"}},
      {"pre-yield-hysteresis", {"coulomb-friction", "seal-friction"}},
      {"quadratic-damping", {"viscous-damping", "shear-thinning"}},
      {"seal-friction", {"coulomb-friction", "pre-yield-hysteresis"}},
      {"self-heating", {"degradation", "stiction"}},
      {"sensor-delay", {"inertia", "velocity-lag", "compliance"}},
      {"series-dashpot", {"compliance"}},
      {"shear-thinning", {"viscous-damping", "quadratic-damping", "coulomb-friction"}},
      {"stiction", {"self-heating", "degradation"}},
      {"velocity-lag", {"inertia", "sensor-delay"}},
      {"viscous-damping", {"quadratic-damping", "shear-thinning"}}};
  for (const std::string& effect : ids_of(effect_catalogue())) {
    ASSERT_TRUE(meant.contains(effect)) << effect << " is new: say what it is mistaken for";
    EXPECT_EQ(relatives(effect), meant.at(effect)) << effect;
    for (const std::string& other : ids_of(effect_catalogue())) {
      EXPECT_EQ(is_kin(effect, other), std::ranges::count(meant.at(effect), other) == 1) << effect << " " << other;
    }
  }
}

TEST(Cards, PlaceAndForm) {
  EXPECT_EQ(effects_that(has_one_form), (NameSet{"offset-force", "linear-stiffness", "viscous-damping", "inertia"}));
}

TEST(Cards, Limits) {
  const std::map<std::pair<std::string, std::string>, std::string> meant = {
      {{"offset-force", "gas-spring"}, "g"},         {{"linear-stiffness", "gas-spring"}, ""},
      {{"coulomb-friction", "seal-friction"}, "fb"}, {{"coulomb-friction", "shear-thinning"}, "m"},
      {{"compliance", "entrapped-gas"}, "d_a"},      {{"compliance", "clearance"}, "gap"},
      {{"cubic-stiffness", "end-stop"}, "x_up"}};
  const std::map<std::pair<std::string, std::string>, std::pair<std::string, BoxEnd>> ends = {
      {{"entrapped-gas", "clearance"}, {"f_a", BoxEnd::lower}},
      {{"shear-thinning", "coulomb-friction"}, {"m", BoxEnd::lower}},
      {{"coulomb-friction", "shear-thinning"}, {"v_t", BoxEnd::upper}},
      {{"seal-friction", "shear-thinning"}, {"v_t", BoxEnd::upper}},
      {{"stiction", "degradation"}, {"L", BoxEnd::upper}}};
  for (const std::string& effect : ids_of(effect_catalogue())) {
    for (const std::string& other : ids_of(effect_catalogue())) {
      const auto at = meant.find({effect, other});
      EXPECT_EQ(is_limit(effect, other), at != meant.end()) << effect << " " << other;
      EXPECT_EQ(limit_parameter(effect, other), at == meant.end() ? "" : at->second) << effect << " " << other;
      const BoxLimit* limit = box_limit(effect, other);
      const auto end = ends.find({effect, other});
      ASSERT_EQ(limit != nullptr, end != ends.end()) << effect << " " << other;
      if (limit != nullptr) {
        EXPECT_EQ(limit->parameter, end->second.first) << effect << " " << other;
        EXPECT_EQ(limit->end, end->second.second) << effect << " " << other;
      }
    }
  }
}

TEST(Cards, PlainEnds) {
  const std::set<std::tuple<std::string, std::string, BoxEnd>> meant = {
      {"coulomb-friction", "x_b", BoxEnd::lower}, {"coulomb-friction", "v_t", BoxEnd::lower},
      {"seal-friction", "x_b", BoxEnd::lower},    {"seal-friction", "v_t", BoxEnd::lower},
      {"end-stop", "p", BoxEnd::lower},           {"magnetic-remanence", "s", BoxEnd::lower},
      {"magnetic-remanence", "s", BoxEnd::upper}, {"gas-spring", "kappa", BoxEnd::lower},
      {"gas-spring", "kappa", BoxEnd::upper},     {"self-heating", "tau", BoxEnd::upper},
      {"self-heating", "y", BoxEnd::lower},       {"self-heating", "y", BoxEnd::upper},
      {"self-heating", "c_h", BoxEnd::lower},     {"clearance", "C_c", BoxEnd::lower},
      {"entrapped-gas", "C_c", BoxEnd::lower},    {"end-stop", "p", BoxEnd::upper}};
  for (const Part* effect : effect_catalogue()) {
    for (const Parameter& parameter : effect->parameters) {
      for (const BoxEnd end : {BoxEnd::lower, BoxEnd::upper}) {
        const std::string id(effect->id);
        const std::string name(parameter.name);
        EXPECT_EQ(is_plain_end(id, name, end), meant.contains({id, name, end})) << id << " " << name;
      }
    }
  }
}

// Each card of the catalogue stands alone: it says everything, names only what there is, and says of its kin what
// they say of it; what one of two effects says of both the other does not say again.
TEST(Cards, EveryEffectHasAWholeCard) {
  std::map<std::string_view, std::string_view> families;
  Pairs limits;
  for (const Part* part : effect_catalogue()) {
    const std::string id(part->id);
    ASSERT_NE(part->knowledge, nullptr) << id;
    const Knowledge& known = *part->knowledge;
    for (const std::string_view text :
         {known.family.id, known.family.title, known.in_words, known.shows, known.experiment}) {
      EXPECT_FALSE(text.empty()) << id;
    }
    EXPECT_EQ(families.try_emplace(known.family.id, known.family.title).first->second, known.family.title) << id;
    for (const std::string_view other : known.kin) {
      ASSERT_NE(find_effect(other), nullptr) << id << " " << other;
      EXPECT_EQ(std::ranges::count(knowledge_of(other).kin, part->id), 1) << id << " " << other;
      EXPECT_NE(other, part->id);
    }
    const auto has = [](std::string_view effect, std::string_view parameter) {
      const Part* other = find_effect(effect);
      return other != nullptr && std::ranges::count(other->parameters, parameter, &Parameter::name) == 1;
    };
    for (const Limit& row : known.holds) {
      EXPECT_NE(find_effect(row.effect), nullptr) << id;
      EXPECT_TRUE(limits.emplace(row.effect, id).second) << id << " " << row.effect << " is said twice";
    }
    for (const Limit& row : known.limit_of) {
      EXPECT_TRUE(row.parameter.empty() || has(row.effect, row.parameter)) << id << " " << row.effect;
      EXPECT_TRUE(limits.emplace(id, row.effect).second) << id << " " << row.effect << " is said twice";
    }
    for (const BoxLimit& row : known.ends_as) {
      EXPECT_NE(find_effect(row.other), nullptr) << id;
    }
    for (const KindredParameter& row : known.kindred) {
      EXPECT_TRUE(has(row.effect, row.its)) << id << " " << row.effect << "." << row.its;
    }
  }
}

TEST(Cards, Families) {
  const std::map<std::string, NameSet> meant = {
      {"free-travel", {"clearance", "entrapped-gas"}},
      {"series", {"compliance", "series-dashpot"}},
      {"friction", {"coulomb-friction", "seal-friction", "pre-yield-hysteresis"}},
      {"fluid", {"viscous-damping", "quadratic-damping", "shear-thinning"}},
      {"place", {"offset-force", "linear-stiffness", "cubic-stiffness", "gas-spring", "end-stop", "pinching"}},
      {"direction", {"asymmetry", "cavitation"}},
      {"phase", {"inertia", "sensor-delay", "velocity-lag"}},
      {"slow-loss", {"self-heating", "degradation", "stiction"}},
      {"drive-path", {"coil-lag", "magnetic-remanence", "magnetic-saturation"}},
      {"force-channel", {"force-drift"}}};
  std::map<std::string, NameSet> families;
  for (const std::string& effect : ids_of(effect_catalogue())) {
    families[std::string(knowledge_of(effect).family.id)].insert(effect);
  }
  EXPECT_EQ(families, meant);
}

// Whether a spring or dashpot is that of a law or of an effect; yield forces and dampings of laws are asked for above.
TEST(Cards, RolesOfEffectsAndOfSpringsAndOffsetsOfLaws) {
  std::map<std::string, NameSet> of_effects;
  std::map<std::string, NameSet> of_laws;
  for (const Part* part : effect_catalogue()) {
    for (const Parameter& card : part->parameters) {
      if (card.role != PhysicalRole::none) {
        of_effects[std::string(part->id)].insert(std::string(card.name));
      }
    }
  }
  for (const Part* part : model_catalogue()) {
    for (const Parameter& card : part->parameters) {
      if (card.role == PhysicalRole::stiffness || card.role == PhysicalRole::offset_force) {
        of_laws[std::string(part->id)].insert(std::string(card.name));
      }
    }
  }
  EXPECT_EQ(of_effects, (std::map<std::string, NameSet>{{"asymmetry", {"c_d"}},
                                                        {"coulomb-friction", {"fc"}},
                                                        {"end-stop", {"k_b"}},
                                                        {"inertia", {"m"}},
                                                        {"linear-stiffness", {"k"}},
                                                        {"offset-force", {"f0"}},
                                                        {"pre-yield-hysteresis", {"f_h"}},
                                                        {"seal-friction", {"fc"}},
                                                        {"self-heating", {"c_h"}},
                                                        {"shear-thinning", {"c_t"}},
                                                        {"viscous-damping", {"c"}}}));
  EXPECT_EQ(of_laws, (std::map<std::string, NameSet>{{"algebraic-hysteresis", {"k0", "f0"}},
                                                     {"asymmetric-sigmoid", {"f_d"}},
                                                     {"baber-noori", {"k0", "f0"}},
                                                     {"bingham", {"f0"}},
                                                     {"bingham-maxwell", {"f0"}},
                                                     {"bouc-wen", {"k0", "f0"}},
                                                     {"extended-bingham", {"k1", "k2", "f0"}},
                                                     {"guo-hu", {"f0"}},
                                                     {"hyperbolic-tangent", {"k0", "f0"}},
                                                     {"hysteretic-spring", {"k0", "f0"}},
                                                     {"lugre", {"k0", "f0"}},
                                                     {"modified-bouc-wen", {"k0", "k1"}},
                                                     {"modified-dahl", {"k0", "f0"}},
                                                     {"nonlinear-biviscous", {"f0"}},
                                                     {"preisach", {"f0"}},
                                                     {"quasi-static-flow", {"f0"}},
                                                     {"viscous", {"k0", "f0"}}}));
}

// Where two rows lead to one parameter, the later counts.
// Of the reference device (simulate/parameter.hpp): what an effect does alone, it may do with all of the force.
TEST(Cards, BoxesOfEffectsHoldWhatMakesTheWholeForce) {
  constexpr double force = 1000.0;  // N
  constexpr double length = 0.025;  // m
  constexpr double speed = 0.3;     // m/s
  const std::map<PhysicalRole, double> made = {{PhysicalRole::mass, speed * speed / length},
                                               {PhysicalRole::damping, speed},
                                               {PhysicalRole::stiffness, length},
                                               {PhysicalRole::yield_force, 1.0},
                                               {PhysicalRole::offset_force, 1.0}};
  for (const Part* effect : effect_catalogue()) {
    for (const Parameter& card : effect->parameters) {
      if (card.linear && card.role != PhysicalRole::none) {
        EXPECT_GE(card.box.upper * made.at(card.role), force) << effect->id << "." << card.name;
      }
    }
  }
}

TEST(Cards, KindredParameters) {
  std::map<std::string, std::vector<std::pair<std::string, double>>> to;
  for (const Kindred& row : kindred()) {
    to[std::string(row.to)].emplace_back(row.from, row.factor);
  }
  const std::map<std::string, std::vector<std::pair<std::string, double>>> meant = {
      {"clearance.gap", {{"entrapped-gas.d_a", 2.0}}},
      {"entrapped-gas.d_a", {{"clearance.gap", 0.5}}},
      {"clearance.C_c", {{"entrapped-gas.C_c", 1.0}, {"compliance.C", 1.0}}},
      {"entrapped-gas.C_c", {{"clearance.C_c", 1.0}, {"compliance.C", 1.0}}},
      {"compliance.C", {{"clearance.C_c", 1.0}, {"entrapped-gas.C_c", 1.0}}}};
  EXPECT_EQ(to, meant);
}

TEST(Cards, InputsNeeded) {
  // Constant drives at two levels, a velocity that was derived.
  Recording low;
  low.time = {0.0, 1.0};
  low.drive = {0.5, 0.5};
  low.drive_kind = DriveKind::current;
  Recording high = low;
  high.drive = {1.0, 1.0};
  Recording undriven = low;
  undriven.drive.clear();
  NameSet without_drive;
  NameSet with_two_levels;
  NameSet with_three_levels;
  Recording higher = low;
  higher.drive = {1.5, 1.5};
  for (const std::string& effect : ids_of(effect_catalogue())) {
    if (excluded_by_inputs(effect, {undriven})) {
      without_drive.insert(effect);
    }
    if (excluded_by_inputs(effect, {low, high})) {
      with_two_levels.insert(effect);
    }
    if (excluded_by_inputs(effect, {low, high, higher})) {
      with_three_levels.insert(effect);
    }
  }
  const NameSet all = {"coil-lag", "magnetic-remanence", "magnetic-saturation", "velocity-lag"};
  EXPECT_EQ(without_drive, all);
  EXPECT_EQ(with_two_levels, all);
  EXPECT_EQ(with_three_levels, (NameSet{"coil-lag", "magnetic-remanence", "velocity-lag"}));
  EXPECT_EQ(unmet(Need::velocity, {low}), "the velocity was not recorded");
  EXPECT_EQ(unmet(Need::drive, {undriven, low}), std::nullopt);
  Recording measured = low;
  measured.velocity_measured = true;
  EXPECT_EQ(unmet(Need::velocity, {low, measured}), std::nullopt);
  Recording steps = low;
  steps.drive = {0.5, 1.0};
  EXPECT_EQ(unmet(Need::changing_drive, {low, steps}), std::nullopt);
  EXPECT_EQ(excluded_by_inputs("coil-lag", {steps}), std::nullopt);
  EXPECT_EQ(excluded_by_inputs("magnetic-remanence", {low, steps}),
            "the current does not both rise and fall in any recording");
  steps.drive = {0.5, 1.0, 0.7};
  EXPECT_EQ(excluded_by_inputs("magnetic-remanence", {low, steps}), std::nullopt);
  EXPECT_EQ(excluded_by_inputs("coil-lag", {undriven}), "no current or voltage was recorded");
  EXPECT_EQ(excluded_by_inputs("coil-lag", {low, high}), "the current is constant in every recording");
  EXPECT_EQ(excluded_by_inputs("velocity-lag", {low}),
            "the velocity was not recorded but derived from the displacement without lag");
}

}  // namespace
}  // namespace hysteron
