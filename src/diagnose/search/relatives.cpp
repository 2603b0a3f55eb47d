#include "diagnose/search/relatives.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "simulate/part.hpp"

namespace hysteron {
namespace {

bool names(std::span<const std::string_view> kin, std::string_view effect) {
  return std::ranges::find(kin, effect) != kin.end();
}

// Said by the wider effect or by the one that it holds.
const Limit* find_limit(const std::string& effect, const std::string& wider) {
  const auto row_of = [](std::span<const Limit> rows, std::string_view id) {
    const auto at = std::ranges::find(rows, id, &Limit::effect);
    return at == rows.end() ? nullptr : &*at;
  };
  const Limit* said_by_wider = row_of(knowledge_of(wider).holds, effect);
  return said_by_wider != nullptr ? said_by_wider : row_of(knowledge_of(effect).limit_of, wider);
}

std::string how_related(const std::string& effect, const std::string& other) {
  const auto where_zero = [](const std::string& parameter) {
    return parameter.empty() ? std::string("in a limit") : fmt::format("where its {} is zero", parameter);
  };
  const auto at_end = [](const BoxLimit& limit) {
    return fmt::format("at the {} end of its {}", limit.end == BoxEnd::lower ? "lower" : "upper", limit.parameter);
  };
  std::vector<std::string> ways;
  if (is_limit(other, effect)) {
    ways.push_back(fmt::format("which {} is {}", effect, where_zero(limit_parameter(other, effect))));
  }
  if (is_limit(effect, other)) {
    ways.push_back(fmt::format("which is {} {}", effect, where_zero(limit_parameter(effect, other))));
  }
  if (const BoxLimit* limit = box_limit(effect, other)) {
    ways.push_back(fmt::format("which {} is {}", effect, at_end(*limit)));
  }
  if (const BoxLimit* limit = box_limit(other, effect)) {
    ways.push_back(fmt::format("which is {} {}", effect, at_end(*limit)));
  }
  return fmt::format("{}", fmt::join(ways, "; "));
}

}  // namespace

const Knowledge& knowledge_of(std::string_view effect) {
  static constexpr Knowledge nothing = {};
  const Part* part = find_effect(effect);
  return part == nullptr || part->knowledge == nullptr ? nothing : *part->knowledge;
}

std::vector<std::string> relatives(const std::string& id) {
  std::vector<std::string> result;
  if (find_effect(id) == nullptr) {
    return result;
  }
  for (const std::string_view other : knowledge_of(id).kin) {
    if (find_effect(other) != nullptr) {
      result.emplace_back(other);
    }
  }
  for (const Part* other : effect_catalogue()) {
    if (other->knowledge != nullptr && names(other->knowledge->kin, id) &&
        std::ranges::find(result, other->id) == result.end()) {
      result.emplace_back(other->id);
    }
  }
  return result;
}

bool is_kin(const std::string& effect, const std::string& other) {
  return names(knowledge_of(effect).kin, other) || names(knowledge_of(other).kin, effect);
}

bool has_one_form(const std::string& effect) { return knowledge_of(effect).one_form; }

bool is_limit(const std::string& effect, const std::string& wider) { return find_limit(effect, wider) != nullptr; }

std::string limit_parameter(const std::string& effect, const std::string& wider) {
  const Limit* limit = find_limit(effect, wider);
  return limit == nullptr ? std::string{} : std::string(limit->parameter);
}

const BoxLimit* box_limit(const std::string& effect, const std::string& other) {
  if (effect == other) {
    return nullptr;
  }
  const std::span<const BoxLimit> ends = knowledge_of(effect).ends_as;
  const auto at = std::ranges::find(ends, other, &BoxLimit::other);
  return at == ends.end() ? nullptr : &*at;
}

bool is_plain_end(const std::string& effect, const std::string& parameter, BoxEnd end) {
  return std::ranges::any_of(knowledge_of(effect).ends_as, [&](const BoxLimit& row) {
    return row.other == effect && row.parameter == parameter && row.end == end;
  });
}

const PartOfLaw* part_of_law(const std::string& effect, const std::string& law) {
  const std::span<const PartOfLaw> rows = knowledge_of(effect).part_of;
  const auto at = std::ranges::find(rows, law, &PartOfLaw::law);
  return at == rows.end() ? nullptr : &*at;
}

std::string rest_of_law(const std::string& effect, const std::string& law) {
  const PartOfLaw* part = part_of_law(effect, law);
  return part == nullptr ? std::string{} : std::string(part->rest);
}

bool is_part_of(const std::string& effect, const std::string& law) {
  if (part_of_law(effect, law) != nullptr) {
    return true;
  }
  const Part* part = find_effect(effect);
  const Part* model = find_model(law);
  if (part == nullptr || model == nullptr || part->parameters.size() != 1) {
    return false;
  }
  const PhysicalRole role = part->parameters.front().role;
  return role != PhysicalRole::none &&
         std::ranges::any_of(model->parameters, [&](const Parameter& own) { return own.linear && own.role == role; });
}

std::vector<std::string> parts_of(const std::string& law) {
  std::vector<std::string> result;
  for (const Part* effect : effect_catalogue()) {
    if (is_part_of(std::string(effect->id), law)) {
      result.emplace_back(effect->id);
    }
  }
  return result;
}

std::vector<Kindred> kindred() {
  std::vector<Kindred> result;
  for (const Part* effect : effect_catalogue()) {
    for (const KindredParameter& row : knowledge_of(effect->id).kindred) {
      const std::string own = fmt::format("{}.{}", effect->id, row.parameter);
      const std::string other = fmt::format("{}.{}", row.effect, row.its);
      result.push_back({own, other, row.factor});
      result.push_back({other, own, 1.0 / row.factor});
    }
  }
  return result;
}

std::vector<Relation> relations_of(const std::string& effect) {
  std::vector<Relation> result;
  const std::vector<std::string> kin = relatives(effect);
  for (const std::string& other : kin) {
    result.push_back({other, how_related(effect, other)});
  }
  for (const Part* part : effect_catalogue()) {
    const std::string other(part->id);
    if (const std::string how = how_related(effect, other);
        !how.empty() && std::ranges::find(kin, other) == kin.end()) {
      result.push_back({other, how});
    }
  }
  return result;
}

std::vector<Voice> voices_of(ContrastKind kind) {
  std::vector<Voice> result;
  for (const Part* effect : effect_catalogue()) {
    for (const ContrastSense& told : knowledge_of(effect->id).contrasts) {
      if (told.contrast == kind) result.push_back({effect->id, told.sense});
    }
  }
  return result;
}

}  // namespace hysteron
