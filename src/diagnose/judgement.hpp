// A search with what it allows to say, behind the law asked for or the one that takes its place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/column.hpp"
#include "diagnose/groups.hpp"
#include "diagnose/intervals.hpp"
#include "diagnose/judge/verdict.hpp"
#include "diagnose/residual/tone.hpp"
#include "diagnose/search/search.hpp"

namespace hysteron {

// A search with what it allows to say.
struct Judgement {
  Search search;
  std::vector<std::string> surprising;
  std::optional<Tone> tone;
  bool tone_doubts = false;
  bool too_few_values = false;
  std::vector<Contrast> contrasts;
  std::optional<Belonging> belonging;
  std::optional<ColumnTold> column;
  Evidence evidence;
  Verdict verdict;
  std::optional<Estimates> estimates;
  std::optional<Search> asked;  // behind the law whose place this one takes
};

// Recordings, and how they are searched.
struct Searching {
  const Workbench& bench;
  const Workbench& quick;
  const Workbench& fine;
  const Workbench& every;
  SearchOptions options;
  std::string doubt_of_data;      // why no name can be given on these recordings, known before any search
  std::optional<Tone> taken_out;  // of their forces, the strongest, N
};

// Behind `asked`. Where another damper law does as well without any effect, what is missing behind that one is looked
// for. It takes the place of the one asked for where it surely predicts recordings left out better, effects and all,
// than the one asked for with all the effects that the recordings ask for (with two of them where these leave twice the
// squares of the other): a law that does no better than that is no reason to doubt it.
Judgement behind_asked_or_better(Searching searching, const std::string& asked, const SearchProgress& progress,
                                 std::vector<std::string>& notes);

}  // namespace hysteron
