#include "report/latex.hpp"

#include <string_view>
#include <utility>

#include "report/terminal.hpp"

namespace hysteron {

std::string latex_escape(const std::string& text) {
  static constexpr std::pair<std::string_view, std::string_view> signs[] = {{"\\", "\\textbackslash{}"},
                                                                            {"&", "\\&"},
                                                                            {"%", "\\%"},
                                                                            {"$", "\\$"},
                                                                            {"#", "\\#"},
                                                                            {"_", "\\_"},
                                                                            {"{", "\\{"},
                                                                            {"}", "\\}"},
                                                                            {"~", "\\textasciitilde{}"},
                                                                            {"^", "\\textasciicircum{}"},
                                                                            {"<", "$<$"},
                                                                            {">", "$>$"},
                                                                            {"|", "$|$"},
                                                                            {"≤", "$\\leq$"},
                                                                            {"≥", "$\\geq$"},
                                                                            {"∞", "$\\infty$"},
                                                                            {"±", "$\\pm$"},
                                                                            {"−", "$-$"},
                                                                            {"–", "--"},
                                                                            {"×", "$\\times$"}};
  std::string result;
  for (std::size_t k = 0; k < text.size();) {
    const std::string_view rest = std::string_view(text).substr(k);
    bool found = false;
    for (const auto& [from, to] : signs) {
      if (rest.starts_with(from)) {
        result += to;
        k += from.size();
        found = true;
        break;
      }
    }
    if (!found) result += text[k++];
  }
  return result;
}

std::string latex_table(const std::string& caption, const std::string& label, const std::vector<std::string>& header,
                        const std::vector<std::vector<std::string>>& rows) {
  const std::vector<bool> numeric = numeric_columns(header, rows);
  std::string text = "\\begin{table}\n  \\centering\n  \\caption{" + latex_escape(caption) + "}\n  \\label{" + label +
                     "}\n  \\begin{tabular}{";
  for (const bool number : numeric) text += number ? 'r' : 'l';
  text += "}\n    \\toprule\n";
  const auto line = [&](const std::vector<std::string>& cells) {
    text += "    ";
    for (std::size_t k = 0; k < numeric.size(); ++k) {
      if (k > 0) text += " & ";
      if (k < cells.size()) text += latex_escape(cells[k]);
    }
    text += " \\\\\n";
  };
  line(header);
  text += "    \\midrule\n";
  for (const auto& row : rows) line(row);
  text += "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
  return text;
}

}  // namespace hysteron
