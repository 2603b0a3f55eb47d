// The report of a study: tables as text, and one self-contained HTML page. Reads what the analysis computed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hysteron {

struct StudyTable {
  std::string id;  // "ranking", "fixed-budget", ...
  std::string title;
  std::string note;  // what the columns mean and how they were computed
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

// Tables of an analysis ("hysteron.study-analysis/1") in reading order. `times` ("hysteron.study-times/1") may be null.
[[nodiscard]] std::vector<StudyTable> study_tables(const nlohmann::json& analysis, const nlohmann::json& times);

// One sentence that answers the question of the study: who leads, who ties, or that nothing was shown.
[[nodiscard]] std::string study_verdict(const nlohmann::json& analysis);

[[nodiscard]] std::string study_terminal(const nlohmann::json& analysis, const nlohmann::json& times);
[[nodiscard]] std::string study_markdown(const nlohmann::json& analysis, const nlohmann::json& times);
[[nodiscard]] std::string study_latex(const nlohmann::json& analysis, const nlohmann::json& times);
// One page with data, plot library, styles and script; opening it loads nothing else.
[[nodiscard]] std::string study_html(const nlohmann::json& analysis, const nlohmann::json& times);

}  // namespace hysteron
