// What a diagnosis learns from and what it is judged on.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// A recording simulated as a whole and judged from sample `from` on.
struct Judged {
  Recording recording;
  std::size_t from = 0;
};

struct Split {
  std::vector<Recording> fit;
  std::vector<Judged> judge;
  std::string how = {};     // one sentence
  bool by_program = false;  // whole recordings held out, and not by the campaign's roles
};

// By the campaign's roles; else whole recordings spread over drive and severity are held out (fit/identify.hpp); with
// fewer than four recordings the last third of each. Of `learn_from`, file names, the program holds none out as long as
// four others are left.
// Throws InputError when roles leave nothing to fit.
Split split_of(const Campaign& campaign, const std::vector<std::string>& learn_from = {});

}  // namespace hysteron
