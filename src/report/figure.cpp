#include "report/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/html.hpp"

namespace hysteron {
namespace {

constexpr double panel_width = 340.0;
constexpr double panel_height = 250.0;
constexpr double left = 58.0;
constexpr double right = 12.0;
constexpr double top = 12.0;
constexpr double bottom = 42.0;

// One axis of a panel: from values to pixels.
struct Axis {
  double low;
  double high;
  double begin;  // pixel of low
  double end;
  bool logarithmic;

  [[nodiscard]] double forward(double value) const { return logarithmic ? std::log10(value) : value; }
  [[nodiscard]] double pixel(double value) const {
    return begin + (forward(value) - forward(low)) / (forward(high) - forward(low)) * (end - begin);
  }
};

Axis axis_of(const std::vector<FigureCurve>& curves, std::vector<double> FigureCurve::*values, bool logarithmic,
             double begin, double end) {
  double low = 1e300;
  double high = -1e300;
  for (const FigureCurve& curve : curves) {
    for (const double value : curve.*values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (logarithmic) {
    const double gap = std::pow(std::max(high / low, 1.1), 0.05);
    return {low / gap, high * gap, begin, end, true};
  }
  const double gap = high > low ? 0.05 * (high - low) : std::max(1.0, std::fabs(low));
  return {low - gap, high + gap, begin, end, false};
}

std::vector<double> ticks(const Axis& axis) {
  std::vector<double> result;
  if (axis.logarithmic) {
    const bool few = axis.high / axis.low < 30.0;
    for (double decade = std::floor(std::log10(axis.low)); decade <= std::log10(axis.high); decade += 1.0) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, decade);
        if ((few || factor == 1.0) && value >= axis.low && value <= axis.high) {
          result.push_back(value);
        }
      }
    }
    return result;
  }
  const double raw = (axis.high - axis.low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    step = factor * power >= raw ? factor * power : step;
  }
  for (double k = std::ceil(axis.low / step); k * step <= axis.high; k += 1.0) {
    result.push_back(k * step + 0.0);  // no negative zero
  }
  return result;
}

std::string curve_path(const FigureCurve& curve, const Axis& x, const Axis& y) {
  std::string path;
  std::string before;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    const std::string across = fmt::format("{:.1f}", x.pixel(curve.x[k]));
    const std::string up = fmt::format("{:.1f}", y.pixel(curve.y[k]));
    const std::string point = path.empty() ? "M" + across + " " + up
                              : curve.step ? "H" + across + "V" + up
                                           : "L" + across + " " + up;
    if (point != before) {
      path += point;
    }
    before = point;
  }
  return path;
}

// Curves with a label, on white that lets the others through, in a corner of the frame that ends at `end`.
std::string legend_svg(const FigurePanel& panel, double end) {
  std::size_t longest = 0;
  std::size_t count = 0;
  for (const FigureCurve& curve : panel.curves) {
    longest = std::max(longest, curve.label.size());
    count += curve.label.empty() ? 0 : 1;
  }
  if (count == 0) return {};
  const double wide = 32.0 + 5.6 * static_cast<double>(longest);
  const double high = 6.0 + 14.0 * static_cast<double>(count);
  const double begin = end - wide - 3.0;
  const double upper = panel.corner == LegendCorner::upper_right ? top + 3.0 : panel_height - bottom - high - 3.0;
  std::string out = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#fff\" opacity=\"0.75\"/>\n", begin,
      upper, wide, high);
  double line = upper + 14.0;
  for (const FigureCurve& curve : panel.curves) {
    if (curve.label.empty()) continue;
    out += fmt::format("<path class=\"c\" stroke=\"{}\" stroke-width=\"{:.1f}\" d=\"M{:.1f} {:.1f}h16\"/>\n",
                       curve.colour, curve.width, begin + 4.0, line - 4.0);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", begin + 25.0, line, html_escape(curve.label));
    line += 14.0;
  }
  return out;
}

std::string panel_svg(const FigurePanel& panel, double offset) {
  const Axis x = axis_of(panel.curves, &FigureCurve::x, panel.logarithmic, offset + left, offset + panel_width - right);
  const Axis y = axis_of(panel.curves, &FigureCurve::y, panel.logarithmic, panel_height - bottom, top);
  std::string out;
  const auto text = [&](double at_x, double at_y, const std::string& anchor, const std::string& words) {
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", at_x, at_y, anchor,
                       html_escape(words));
  };
  for (const double tick : ticks(x)) {
    out += fmt::format("<path class=\"g\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", x.pixel(tick), top, panel_height - bottom);
    text(x.pixel(tick), panel_height - bottom + 15.0, "middle", fmt::format("{:.6g}", tick));
  }
  for (const double tick : ticks(y)) {
    out += fmt::format("<path class=\"g\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", x.begin, y.pixel(tick), x.end);
    text(x.begin - 5.0, y.pixel(tick) + 4.0, "end", fmt::format("{:.6g}", tick));
  }
  out += fmt::format("<rect class=\"f\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", x.begin, top,
                     x.end - x.begin, panel_height - bottom - top);
  for (const FigureCurve& curve : panel.curves) {
    out += fmt::format("<path class=\"c\" stroke=\"{}\" stroke-width=\"{:.1f}\" d=\"{}\"/>\n", curve.colour,
                       curve.width, curve_path(curve, x, y));
  }
  out += legend_svg(panel, x.end);
  text(0.5 * (x.begin + x.end), panel_height - 8.0, "middle", panel.x_label);
  out += fmt::format("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     offset + 12.0, 0.5 * (top + panel_height - bottom), html_escape(panel.y_label));
  return out;
}

}  // namespace

std::string curve_colour(std::size_t index) {
  static constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
  return colours[index % std::size(colours)];
}

std::string figure_svg(const std::vector<FigurePanel>& panels, const std::string& description, std::size_t columns) {
  const std::size_t across = columns == 0 ? panels.size() : std::min(columns, panels.size());
  const std::size_t down = (panels.size() + across - 1) / across;
  const double width = panel_width * static_cast<double>(across);
  const double height = panel_height * static_cast<double>(down);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "role=\"img\" aria-label=\"{2}\">\n<style>text{{font:11px sans-serif;fill:#222}}.g{{stroke:#ddd}}"
      ".f{{fill:none;stroke:#888}}.c{{fill:none;stroke-linejoin:round}}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height, html_escape(description));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::string panel = panel_svg(panels[k], panel_width * static_cast<double>(k % across));
    const std::size_t row = k / across;
    out += row == 0 ? panel
                    : fmt::format("<g transform=\"translate(0 {:.0f})\">\n{}</g>\n",
                                  panel_height * static_cast<double>(row), panel);
  }
  return out + "</svg>\n";
}

}  // namespace hysteron
