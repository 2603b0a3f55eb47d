// Tables for papers.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

// A `table` environment with booktabs rules; columns of numbers are flush right. Needs \usepackage{booktabs}.
[[nodiscard]] std::string latex_table(const std::string& caption, const std::string& label,
                                      const std::vector<std::string>& header,
                                      const std::vector<std::vector<std::string>>& rows);

// Text with the characters LaTeX gives a meaning made plain.
[[nodiscard]] std::string latex_escape(const std::string& text);

}  // namespace hysteron
