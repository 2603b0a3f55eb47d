#include "challenge/levels.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "challenge/effects.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron::challenge {
namespace {

using Ids = std::vector<std::string>;

constexpr std::array<std::pair<Level, std::string_view>, level_count> names = {{{Level::plain, "plain"},
                                                                                {Level::buried, "buried"},
                                                                                {Level::absorbed, "absorbed"},
                                                                                {Level::pairs, "pairs"},
                                                                                {Level::wrong_base, "wrong-base"},
                                                                                {Level::foreign, "foreign"},
                                                                                {Level::beside, "beside"},
                                                                                {Level::none, "none"},
                                                                                {Level::unexcited, "unexcited"}}};

// One round of campaigns: 12 plain, 8 beside, 1 to 7 of every other level, 39 in all, spread out.
constexpr std::array<Level, 39> mixture = {
    Level::plain,     Level::none,  Level::beside,   Level::plain,   Level::pairs,  Level::plain,
    Level::beside,    Level::none,  Level::absorbed, Level::plain,   Level::beside, Level::foreign,
    Level::buried,    Level::plain, Level::none,     Level::beside,  Level::plain,  Level::wrong_base,
    Level::plain,     Level::pairs, Level::beside,   Level::foreign, Level::plain,  Level::none,
    Level::beside,    Level::plain, Level::absorbed, Level::buried,  Level::beside, Level::plain,
    Level::none,      Level::plain, Level::foreign,  Level::none,    Level::beside, Level::wrong_base,
    Level::unexcited, Level::plain, Level::none};

// Whose change in any single sine is a change of the law's parameters.
constexpr std::array<std::string_view, 9> absorbed = {"inertia",           "magnetic-saturation", "compliance",
                                                      "sensor-delay",      "velocity-lag",        "shear-thinning",
                                                      "quadratic-damping", "series-dashpot",      "cubic-stiffness"};

bool holds(const Ids& ids, std::string_view id) { return std::ranges::find(ids, id) != ids.end(); }

// A whole number drawn with weights 5, 3, 2: one, two or three.
std::size_t few(Draws& draws) {
  const int which = draws.integer(0, 9);
  return which < 5 ? 1 : which < 8 ? 2 : 3;
}

void shuffle(Ids& ids, Draws& draws) {
  for (std::size_t k = ids.size(); k > 1; --k) {
    std::swap(ids[k - 1], ids[static_cast<std::size_t>(draws.integer(0, static_cast<int>(k) - 1))]);
  }
}

// Makes the tasks of one call one after another; what was used before decides what comes next.
class Planner {
 public:
  Planner(const Ids& wanted, std::uint64_t seed, const FormChoice& choice)
      : wanted_(wanted), seed_(seed), choice_(choice) {}

  [[nodiscard]] Ids candidates(Level level, bool foreign, const Ids& wanted) const {
    Ids ids;
    for (const HiddenEffect& effect : hidden_effects()) {
      if (effect.foreign != foreign) continue;
      if (level == Level::absorbed && std::ranges::find(absorbed, effect.id) == absorbed.end()) continue;
      if (level == Level::unexcited && !effect.can_starve) continue;
      if (!wanted.empty() && !holds(wanted, effect.id)) continue;
      if (allowed_forms(effect).empty()) continue;
      ids.emplace_back(effect.id);
    }
    return ids;
  }
  [[nodiscard]] Ids candidates(Level level) const {
    // Beside needs both; a foreign id among those asked for chooses the foreign ones.
    return candidates(level, level == Level::foreign, level == Level::beside ? asked(false) : wanted_);
  }
  [[nodiscard]] bool can(Level level) const {
    if (level == Level::none) return true;
    if (level == Level::beside && (!wanted_.empty() && asked(false).empty())) return false;
    if (candidates(level).empty()) return false;
    return level != Level::beside || !candidates(level, true, asked(true)).empty();
  }

  Task next(int number, Level level) {
    Task task;
    task.number = number;
    task.level = level;
    const std::size_t turn = made_[static_cast<std::size_t>(level)]++;
    // Without an effect: the negative controls, and every other campaign with a wrong base.
    if (level == Level::none || (level == Level::wrong_base && turn % 2 == 1)) return task;
    Draws draws(Stream(seed_).child("partner"), std::to_string(number));
    const std::size_t at = level == Level::wrong_base ? turn / 2 : turn;
    take(task, in_turn(level, candidates(level), "", at));
    if (level == Level::pairs) add_partners(task, 2, draws);
    if (level == Level::beside) {
      add_partners(task, few(draws), draws);
      const std::size_t all = task.effects.size() + few(draws);
      const Ids foreign = candidates(level, true, asked(true));
      // The first foreign cause in turn as well, where it goes with the effects, then at random.
      Ids order = foreign;
      shuffle(order, draws);
      order.insert(order.begin(), in_turn(level, foreign, "foreign ", at));
      for (const std::string& id : order) {
        if (task.effects.size() < all && fits(task, id)) take(task, id);
      }
    }
    return task;
  }

 private:
  [[nodiscard]] Ids asked(bool foreign) const {
    Ids ids;
    for (const std::string& id : wanted_) {
      if (hidden_effect(id).foreign == foreign) ids.push_back(id);
    }
    return ids;
  }

  [[nodiscard]] std::vector<const HiddenForm*> allowed_forms(const HiddenEffect& effect) const {
    std::vector<const HiddenForm*> forms;
    for (const HiddenForm& form : effect.forms) {
      if (choice_.allows(form.id)) forms.push_back(&form);
    }
    return forms;
  }

  // The order of effects is shuffled by the seed, once for all rounds, so that short runs differ too.
  [[nodiscard]] std::string in_turn(Level level, Ids order, const std::string& what, std::size_t at) const {
    Draws draws(Stream(seed_), "order of " + what + std::string(name_of(level)));
    shuffle(order, draws);
    return order[at % order.size()];
  }

  // The first form, from the one whose turn it is, that stands in series with those of the task.
  [[nodiscard]] const HiddenForm* form_for(const Task& task, const HiddenEffect& effect) const {
    std::vector<InSeries> chain;
    for (const std::string& form : task.forms) chain.push_back(hidden_form(form).form->chain);
    const std::vector<const HiddenForm*> forms = allowed_forms(effect);
    Draws draws(Stream(seed_).child("first form"), effect.id);
    const auto used = used_.find(std::string(effect.id));
    const std::size_t first = static_cast<std::size_t>(draws.integer(0, static_cast<int>(forms.size()) - 1)) +
                              (used == used_.end() ? 0 : used->second);
    for (std::size_t k = 0; k < forms.size(); ++k) {
      const HiddenForm* form = forms[(first + k) % forms.size()];
      chain.push_back(form->chain);
      if (can_stand_in_series(chain)) return form;
      chain.pop_back();
    }
    return nullptr;
  }

  void take(Task& task, const std::string& id) {
    const HiddenForm* form = form_for(task, hidden_effect(id));
    task.effects.push_back(id);
    task.forms.push_back(form->id);
    ++used_[id];
  }

  // Whether a cause goes with those of a task: a law that takes all, a force balance, another group of effects.
  [[nodiscard]] bool fits(const Task& task, const std::string& id) const {
    if (holds(task.effects, id)) return false;
    const HiddenEffect& effect = hidden_effect(id);
    for (const std::string& other : task.effects) {
      if (!effect.foreign && hidden_effect(other).group == effect.group) return false;
    }
    Ids all = task.effects;
    all.push_back(id);
    return !common_laws(all).empty() && form_for(task, effect) != nullptr;
  }

  void add_partners(Task& task, std::size_t count, Draws& draws) {
    Ids partners = candidates(task.level, false, {});
    shuffle(partners, draws);
    for (const std::string& id : partners) {
      if (task.effects.size() < count && fits(task, id)) take(task, id);
    }
  }

  Ids wanted_;
  std::uint64_t seed_;
  FormChoice choice_;
  std::array<std::size_t, level_count> made_{};
  std::map<std::string, std::size_t> used_;
};

}  // namespace

std::string_view name_of(Level level) {
  return std::ranges::find(names, level, [](const auto& entry) { return entry.first; })->second;
}

Level level_of(std::string_view name) {
  const auto found = std::ranges::find(names, name, [](const auto& entry) { return entry.second; });
  if (found != names.end()) return found->first;
  std::string known;
  std::vector<std::string> words;
  for (const auto& [level, word] : names) {
    known += (known.empty() ? "" : ", ") + std::string(word);
    words.emplace_back(word);
  }
  throw InputError("unknown level '" + std::string(name) + "'" + suggestion(name, words) + ", expected one of " +
                   known);
}

bool FormChoice::allows(const std::string& form) const {
  if (holds(without, form)) return false;
  if (hidden_form(form).effect->foreign) return foreign.empty() || holds(foreign, form);
  return only.empty() || holds(only, form);
}

std::vector<Law> common_laws(const std::vector<std::string>& effects) {
  std::vector<Law> laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis, Law::bingham, Law::lugre};
  for (const std::string& id : effects) {
    const std::vector<Law>& own = hidden_effect(id).laws;
    std::erase_if(laws, [&](Law law) { return std::ranges::find(own, law) == own.end(); });
  }
  return laws;
}

std::vector<Task> plan(int count, const std::vector<Level>& levels, const std::vector<std::string>& effects,
                       std::uint64_t seed, const FormChoice& choice) {
  Planner planner(effects, seed, choice);
  std::vector<Level> round;
  for (const Level level : mixture) {
    if (!levels.empty() && std::ranges::find(levels, level) == levels.end()) continue;
    if (!planner.can(level)) continue;
    if (level == Level::none && !effects.empty() && levels.empty()) continue;
    round.push_back(level);
  }
  if (round.empty()) throw InputError("no campaign is of these levels, effects and forms");
  std::vector<Task> tasks;
  for (int number = 1; number <= count; ++number) {
    tasks.push_back(planner.next(number, round[static_cast<std::size_t>(number - 1) % round.size()]));
  }
  return tasks;
}

}  // namespace hysteron::challenge
