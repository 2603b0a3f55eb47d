// Figure 11 of the PSO paper as a picture: parameters of the modified Bouc-Wen model over the current, identified
// condition by condition on the stand-in rd8040-twin, beside the published polynomials that it is made of.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "presets/support/rd8040_polynomials.hpp"
#include "report/figure.hpp"
#include "report/terminal.hpp"
#include "study/reproduce_pso.hpp"

namespace hysteron::reproduce {
namespace {

struct Surface {
  const char* name;
  const char* label;
  double (*published)(double i, double f);
};
constexpr std::array<Surface, 8> surfaces{{{"beta", "beta [1/m]", rd8040::beta},
                                           {"gamma", "gamma [1/m]", rd8040::gamma},
                                           {"A", "A [1/m]", rd8040::A},
                                           {"k1", "k1 [N/m]", rd8040::k1},
                                           {"k0", "k0 [N/m]", rd8040::k0},
                                           {"c0", "c0 [N s/m]", rd8040::c0},
                                           {"c1", "c1 [N s/m]", rd8040::c1},
                                           {"f0", "f0 [N]", rd8040::f0}}};
constexpr double all_frequencies[] = {0.4, 0.8, 1.2, 1.6, 2.0};

}  // namespace

Study pso_figure_11(const ReproduceOptions& options) {
  Study study = pso_table_viii(options);
  study.title = "figure-11";
  study.solvers = {{"multistart-lm", "multistart-lm", {}, 0}};
  return study;
}

Reproduction pso_figure_11_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  std::vector<FigurePanel> panels;
  StudyTable table{"figure-11",
                   "Identified condition by condition against the published polynomials",
                   "Deviation of the identified value from the polynomial, over the polynomial's range in the 55 "
                   "conditions.",
                   {"parameter", "median", "largest", "within 5 % of the range"},
                   {}};
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    FigurePanel panel{"current [A]", surfaces[s].label, {}};
    std::vector<double> deviations;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    std::vector<FigureCurve> thin;
    for (std::size_t f = 0; f < std::size(all_frequencies); ++f) {
      FigureCurve published;
      published.colour = curve_colour(f);
      published.width = 4.0;
      panel.corner = LegendCorner::upper_right;
      if (s == 0) published.label = fmt::format("{:.1f} Hz", all_frequencies[f]);
      FigureCurve own;
      own.colour = curve_colour(f);
      own.width = 1.0;
      for (int step = 0; step <= 10; ++step) {
        const double i = 0.1 * step;
        const double value = surfaces[s].published(i, all_frequencies[f]);
        published.x.push_back(i);
        published.y.push_back(value);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
        const std::size_t problem =
            problem_index(plan, fmt::format("{} @ twin/{:.1f}Hz_{:.1f}A", pso::full_model, all_frequencies[f], i));
        const RunRecord* run = problem < plan.problems.size() ? median_run(plan, records, problem, 0) : nullptr;
        if (run == nullptr) continue;
        own.x.push_back(i);
        own.y.push_back(pso::paper_parameters(*run)[s]);
        deviations.push_back(std::fabs(own.y.back() - value));
      }
      panel.curves.push_back(std::move(published));
      thin.push_back(std::move(own));
    }
    // A valley without an end takes single values far off; the picture keeps to three times the polynomial's range.
    const double range = highest - lowest;
    for (FigureCurve& curve : thin) {
      for (double& y : curve.y) y = std::clamp(y, lowest - range, highest + range);
      if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
    }
    panels.push_back(std::move(panel));
    std::ranges::sort(deviations);
    if (deviations.empty()) continue;
    const auto near = std::ranges::count_if(deviations, [&](double value) { return value <= 0.05 * range; });
    table.rows.push_back({surfaces[s].name, format_number(deviations[deviations.size() / 2] / range, 3),
                          format_number(deviations.back() / range, 3),
                          fmt::format("{} of {}", near, deviations.size())});
  }
  result.findings.push_back(
      "Wide lines: the published polynomials (16) to (23), of which the stand-in is made. Thin lines: identified from "
      "each "
      "recording alone. Where both lie on each other one recording determines the parameter; where the thin line jumps "
      "it "
      "does not, and a surface through such values is not one of the damper.");
  result.tables.push_back(std::move(table));
  result.pictures.push_back({"figure-11", "Parameters over the current, one colour a frequency",
                             figure_svg(panels, "Parameters of the modified Bouc-Wen model over the current", 3)});
  result.remade.push_back("The eight parameters at alpha = 80, n = 1 and x0 = 0 over 11 currents and 5 frequencies.");
  result.not_remade.push_back(
      "The paper draws surfaces; here every frequency is a curve. Values beyond three times the "
      "range of the polynomial are drawn on its edge.");
  pso::say_of_descents(plan, "parameters", result);
  pso::say_of_data(plan, result);
  return result;
}

}  // namespace hysteron::reproduce
