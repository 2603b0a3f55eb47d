// A study's TOML.
#include <algorithm>

#include "study/study_file.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  Study study;
  const std::string text(fuzz::text_of(data, size));
  if (!fuzz::taken([&] { study = parse_study_file(text, "study.toml"); })) return 0;
  fuzz::require(!study.models.empty() && !study.data.empty() && !study.solvers.empty(), "a study has its three lists");
  fuzz::require(!study.budgets.empty() && std::ranges::is_sorted(study.budgets) && study.budgets.front() > 0,
                "budgets ascend from one");
  fuzz::require(!study.seeds.empty(), "a study has seeds");
  return 0;
}
