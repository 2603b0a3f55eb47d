#include "challenge/levels.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "challenge/effects.hpp"
#include "core/error.hpp"

namespace hysteron::challenge {
namespace {

constexpr std::array<std::pair<Level, std::string_view>, level_count> names = {{{Level::plain, "plain"},
                                                                                {Level::buried, "buried"},
                                                                                {Level::absorbed, "absorbed"},
                                                                                {Level::pairs, "pairs"},
                                                                                {Level::wrong_base, "wrong-base"},
                                                                                {Level::foreign, "foreign"},
                                                                                {Level::none, "none"},
                                                                                {Level::unexcited, "unexcited"}}};

// One round of campaigns: 12 plain, 2 to 5 of every other level, 30 in all, spread out.
constexpr std::array<Level, 30> mixture = {
    Level::plain,    Level::none,       Level::plain,    Level::pairs,      Level::plain,     Level::none,
    Level::absorbed, Level::plain,      Level::foreign,  Level::buried,     Level::plain,     Level::none,
    Level::plain,    Level::wrong_base, Level::plain,    Level::pairs,      Level::foreign,   Level::plain,
    Level::none,     Level::plain,      Level::absorbed, Level::buried,     Level::plain,     Level::none,
    Level::plain,    Level::foreign,    Level::none,     Level::wrong_base, Level::unexcited, Level::plain};

// Whose change in any single sine is a change of the law's parameters.
constexpr std::array<std::string_view, 9> absorbed = {"inertia",           "magnetic-saturation", "compliance",
                                                      "sensor-delay",      "velocity-lag",        "shear-thinning",
                                                      "quadratic-damping", "series-dashpot",      "cubic-stiffness"};

std::vector<std::string> candidates(Level level, const std::vector<std::string>& wanted) {
  std::vector<std::string> ids;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.foreign != (level == Level::foreign)) continue;
    if (level == Level::absorbed && std::ranges::find(absorbed, effect.id) == absorbed.end()) continue;
    if (level == Level::unexcited && !effect.can_starve) continue;
    if (!wanted.empty() && std::ranges::find(wanted, effect.id) == wanted.end()) continue;
    ids.emplace_back(effect.id);
  }
  return ids;
}

bool go_together(const HiddenEffect& a, const HiddenEffect& b) {
  if (a.group == b.group || (a.series && b.series)) return false;
  return std::ranges::any_of(a.laws, [&](Law law) { return std::ranges::find(b.laws, law) != b.laws.end(); });
}

}  // namespace

std::string_view name_of(Level level) {
  return std::ranges::find(names, level, [](const auto& entry) { return entry.first; })->second;
}

Level level_of(std::string_view name) {
  const auto found = std::ranges::find(names, name, [](const auto& entry) { return entry.second; });
  if (found != names.end()) return found->first;
  throw InputError("unknown level '" + std::string(name) +
                   "', expected plain, buried, absorbed, pairs, wrong-base, foreign, none or unexcited");
}

std::vector<Task> plan(int count, const std::vector<Level>& levels, const std::vector<std::string>& effects,
                       std::uint64_t seed) {
  std::vector<Level> round;
  for (const Level level : mixture) {
    if (!levels.empty() && std::ranges::find(levels, level) == levels.end()) continue;
    if (level != Level::none && !effects.empty() && candidates(level, effects).empty()) continue;
    if (level == Level::none && !effects.empty() && levels.empty()) continue;
    round.push_back(level);
  }
  if (round.empty()) throw InputError("no campaign is of these levels and effects");
  std::array<std::size_t, level_count> made{};
  std::vector<Task> tasks;
  for (int number = 1; number <= count; ++number) {
    Task task;
    task.number = number;
    task.level = round[static_cast<std::size_t>(number - 1) % round.size()];
    const std::size_t turn = made[static_cast<std::size_t>(task.level)]++;
    const std::vector<std::string> ids = candidates(task.level, effects);
    // Without an effect: the negative controls, and every other campaign with a wrong base.
    if (task.level != Level::none && !(task.level == Level::wrong_base && turn % 2 == 1)) {
      const std::size_t at = task.level == Level::wrong_base ? turn / 2 : turn;
      // The order of effects is shuffled by the seed, once for all rounds, so that short runs differ too.
      std::vector<std::string> order = ids;
      Draws draws(Stream(seed), std::string("order of ") + std::string(name_of(task.level)));
      for (std::size_t k = order.size(); k > 1; --k) {
        std::swap(order[k - 1], order[static_cast<std::size_t>(draws.integer(0, static_cast<int>(k) - 1))]);
      }
      task.effects = {order[at % order.size()]};
      if (task.level == Level::pairs) {
        const HiddenEffect& first = hidden_effect(task.effects[0]);
        std::vector<std::string> partners;
        for (const std::string& id : candidates(task.level, {})) {
          if (go_together(first, hidden_effect(id))) partners.push_back(id);
        }
        Draws partner(Stream(seed).child("partner"), std::to_string(number));
        task.effects.push_back(partner.pick(partners));
      }
    }
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace hysteron::challenge
