#include "export/targets.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/suggest.hpp"

namespace hysteron {

std::span<const ExportTarget> export_targets() {
  static constexpr ExportTarget targets[] = {{"c", ".c", export_c},
                                             {"fmu", ".fmu", export_fmu},
                                             {"simulink", ".c", export_simulink},
                                             {"modelica", "", export_modelica},
                                             {"python", ".py", export_python}};
  return targets;
}

const ExportTarget& export_target(const std::string& id) {
  const auto found = std::ranges::find(export_targets(), id, &ExportTarget::id);
  if (found == export_targets().end()) {
    std::vector<std::string> known;
    for (const ExportTarget& target : export_targets()) {
      known.emplace_back(target.id);
    }
    throw OptionError(Option::to + ": '" + id + "' is not known" + suggestion(id, known) +
                      ", expected c, fmu, simulink, modelica or python");
  }
  return *found;
}

Export export_c(const ExportedModel& exported, const TestVector& vector) {
  return {c_files(exported, vector),
          "replay: cc -std=c99 -O2 " + exported.name + "_test.c " + exported.name + ".c -lm && ./a.out"};
}

}  // namespace hysteron
