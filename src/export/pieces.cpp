#include "export/pieces.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron {

ChainFacts facts_of(const std::vector<ExportedLink>& links) {
  ChainFacts facts;
  for (const ExportedLink& link : links) {
    const PartEquations& e = link.equations;
    facts.series = facts.series || e.yield || e.loaded;
    facts.settles = facts.settles || e.settles >= 0;
    facts.recalls = facts.recalls || e.recall;
    facts.memories += link.memory >= 0 ? 1 : 0;
  }
  facts.alone = std::ranges::all_of(links.begin() + 1, links.end(), [](const ExportedLink& link) {
    return link.part->states == 0 && !link.equations.drive;
  });
  return facts;
}

std::string expression_of_parameter(const ExportedModel& exported, std::size_t k) {
  std::string value;
  for (const Term& term : exported.terms) {
    if (term.parameter != k) {
      continue;
    }
    std::string product = literal(term.value);
    for (int power = 0; power < term.drive_power; ++power) {
      product += " * drive";
    }
    for (int power = 0; power < term.frequency_power; ++power) {
      product += " * frequency";
    }
    value += (value.empty() ? "" : " + ") + product;
  }
  return value.empty() ? literal(exported.held[k]) : value;
}

std::vector<int> parameters_used(const Statements& statements) {
  std::vector<int> result;
  for (const ArgumentNumber& used : statements.used) {
    if (used.argument == Argument::parameter) {
      result.push_back(used.index);
    }
  }
  std::ranges::sort(result);
  return result;
}

const char* motion_member(Argument argument) {
  static constexpr const char* members[] = {"x", "v", "drive", "time", "age", "a", "jerk"};
  return members[static_cast<int>(argument) - static_cast<int>(Argument::x)];
}

std::string literals(const TestSample& sample) {
  return fmt::format("{}, {}, {}, {}, {}, {}, {}", literal(sample.time), literal(sample.displacement),
                     literal(sample.velocity), literal(sample.slope), literal(sample.acceleration),
                     literal(sample.jerk), literal(sample.drive));
}

std::string lines_of(const std::vector<double>& force) {
  std::string text;
  for (const double f : force) {
    text += fmt::format("    {},\n", literal(f));
  }
  return text;
}

}  // namespace hysteron
