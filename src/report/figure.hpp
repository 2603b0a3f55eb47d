// Small line charts as SVG files for the documentation: the same bytes for the same numbers.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

// Colours that people who see few tell apart (Okabe and Ito); after six from the first again.
std::string curve_colour(std::size_t index);

struct FigureCurve {
  std::vector<double> x;
  std::vector<double> y;  // of equal length
  std::string colour = "#0072b2";
  double width = 1.5;
  bool step = false;       // a value holds until the next one
  std::string label = {};  // in the legend; empty: not there
};

enum class LegendCorner { lower_right, upper_right };

struct FigurePanel {
  std::string x_label;
  std::string y_label;
  std::vector<FigureCurve> curves;
  bool logarithmic = false;  // both axes; all values positive
  LegendCorner corner = LegendCorner::lower_right;
};

// Panels in rows of `columns`, 0: all side by side. `description` is read out in place of the picture.
std::string figure_svg(const std::vector<FigurePanel>& panels, const std::string& description, std::size_t columns = 0);

}  // namespace hysteron
