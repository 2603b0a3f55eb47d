// Figures 6 to 8 and 10 of the PSO paper, loops, as pictures, on the stand-in rd8040-twin. The figures print no
// numbers; beside each stand those of the table that the paper made of the same runs.
#include <fmt/format.h>

#include <algorithm>

#include "fit/predict.hpp"
#include "report/figure.hpp"
#include "report/terminal.hpp"
#include "study/reproduce_pso.hpp"

namespace hysteron::reproduce {
namespace {

constexpr const char* measured_colour = "#bbbbbb";
constexpr std::size_t points_of_loop = 300;
constexpr const char* condition = "2.0Hz_1.0A";

std::vector<double> force_of(const Plan& plan, std::size_t problem, const RunRecord& run) {
  const StudyProblem& of = plan.problems[problem];
  return predict(of.layout.model(), of.layout.held(), of.layout.terms(run.best),
                 make_target(of.recordings.front(), plan.study.objective));
}

// Force against velocity and against displacement.
struct Loops {
  FigurePanel by_velocity{"velocity [mm/s]", "force [N]", {}};
  FigurePanel by_displacement{"displacement [mm]", "force [N]", {}};

  // The last period of a recording of `frequency` (Hz).
  void add(const Recording& recording, double frequency, const std::vector<double>& force, const FigureCurve& style) {
    FigureCurve velocity = style;
    FigureCurve displacement = style;
    displacement.label.clear();
    const double from = recording.time.back() - 1.0 / frequency;
    const auto first =
        static_cast<std::size_t>(std::ranges::lower_bound(recording.time, from) - recording.time.begin());
    const std::size_t stride = std::max<std::size_t>(1, (recording.size() - first) / points_of_loop);
    for (std::size_t n = first; n < recording.size(); n += stride) {
      velocity.x.push_back(1e3 * recording.velocity[n]);
      displacement.x.push_back(1e3 * recording.displacement[n]);
      velocity.y.push_back(force[n]);
      displacement.y.push_back(force[n]);
    }
    by_velocity.curves.push_back(std::move(velocity));
    by_displacement.curves.push_back(std::move(displacement));
  }
};

FigureCurve measured_style() {
  FigureCurve style;
  style.colour = measured_colour;
  style.width = 5.0;
  style.label = "stand-in";
  return style;
}

FigureCurve model_style(std::size_t index, const std::string& label) {
  FigureCurve style;
  style.colour = curve_colour(index);
  style.label = label;
  return style;
}

// One curve of a figure of loops at 2 Hz, 1 A.
struct Curve {
  std::string label;
  std::size_t problem;
  std::size_t solver;
  std::string published;  // NRMSE
};

Reproduction loops_at_full_drive(const Plan& plan, const std::vector<RunRecord>& records, const std::string& id,
                                 const std::string& title, const std::vector<Curve>& curves) {
  Reproduction result;
  StudyTable table{id,
                   title,
                   "NRMSE: median [quartiles] over the seeds. The picture shows the run of the median.",
                   {"curve", "published", "obtained"},
                   {}};
  Loops loops;
  const Recording& recording = plan.problems.front().recordings.front();
  loops.add(recording, 2.0, recording.force, measured_style());
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const Curve& curve = curves[k];
    table.rows.push_back({curve.label, curve.published, spread(plan, records, curve.problem, curve.solver)});
    if (const RunRecord* run = median_run(plan, records, curve.problem, curve.solver)) {
      loops.add(recording, 2.0, force_of(plan, curve.problem, *run), model_style(k, curve.label));
    }
  }
  result.tables.push_back(std::move(table));
  result.pictures.push_back(
      {id, "Loops, " + title,
       figure_svg({loops.by_velocity, loops.by_displacement}, title + ", against velocity and displacement")});
  result.remade.push_back("Force against velocity and displacement at 2 Hz and 1 A.");
  result.not_remade.push_back(
      fmt::format("Solvers, budget ({} evaluations) and what is not known of the paper's swarm are those of its table, "
                  "made again by the `reproduce` of that table.",
                  plan.study.budgets.front()));
  pso::say_of_data(plan, result);
  return result;
}

// The study of a table, at 2 Hz and 1 A only and without the swarm as shipped.
Study at_full_drive(Study study, const std::string& title) {
  study.title = title;
  study.data.front().only = {condition};
  study.solvers.pop_back();
  return study;
}

std::string ratio_text(const Plan& plan, const std::vector<RunRecord>& records, const Curve& a, const Curve& b) {
  return format_number(
      median_nrmse(plan, records, a.problem, a.solver) / median_nrmse(plan, records, b.problem, b.solver), 3);
}

}  // namespace

Study pso_figure_6(const ReproduceOptions& options) { return at_full_drive(pso_table_v(options), "figure-6"); }

Reproduction pso_figure_6_result(const Plan& plan, const std::vector<RunRecord>& records) {
  const std::vector<Curve> curves{{"PSO as published", 0, 0, "0.0408"}, {"GA", 0, 1, "0.0529"}};
  Reproduction result = loops_at_full_drive(plan, records, "figure-6", "PSO against GA at 2 Hz and 1 A", curves);
  result.findings.push_back(fmt::format("Median NRMSE of PSO over that of GA: {}, published {}.",
                                        ratio_text(plan, records, curves[0], curves[1]),
                                        format_number(0.0408 / 0.0529, 3)));
  return result;
}

Study pso_figure_7(const ReproduceOptions& options) {
  Study study = at_full_drive(pso_table_vi(options), "figure-7");
  study.models.resize(5);  // those of the paper; the others are readings of table VI
  return study;
}

Reproduction pso_figure_7_result(const Plan& plan, const std::vector<RunRecord>& records) {
  const std::vector<Curve> curves{{"Bingham", 0, 0, "0.2045"},
                                  {"simple Bouc-Wen", 1, 0, "0.0454"},
                                  {"modified Bouc-Wen", 2, 0, "0.0408"},
                                  {"nonlinear biviscous", 3, 0, "0.2335"},
                                  {"hyperbolic tangent", 4, 0, "0.0971"}};
  Reproduction result = loops_at_full_drive(plan, records, "figure-7", "Five models at 2 Hz and 1 A", curves);
  result.findings.push_back(fmt::format(
      "The laws without hysteresis (Bingham, biviscous) have no loop against the velocity; Bingham's median "
      "NRMSE is {} times that of the modified Bouc-Wen model, published {}.",
      ratio_text(plan, records, curves[0], curves[2]), format_number(0.2045 / 0.0408, 3)));
  result.not_remade.push_back(
      "The twin is made of the modified Bouc-Wen model: that this fits best is by construction.");
  return result;
}

Study pso_figure_8(const ReproduceOptions& options) { return at_full_drive(pso_table_vii(options), "figure-8"); }

Reproduction pso_figure_8_result(const Plan& plan, const std::vector<RunRecord>& records) {
  const std::vector<Curve> curves{{"with offset force", 0, 0, "0.0408"}, {"without", 1, 0, "0.1061"}};
  Reproduction result =
      loops_at_full_drive(plan, records, "figure-8", "With and without offset force at 2 Hz and 1 A", curves);
  result.findings.push_back(fmt::format("Median NRMSE without over with offset force: {}, published {}.",
                                        ratio_text(plan, records, curves[1], curves[0]),
                                        format_number(0.1061 / 0.0408, 3)));
  result.not_remade.push_back("The paper does not say at which current and frequency its figure 8 is.");
  return result;
}

namespace {

constexpr double shown_currents[] = {0.0, 0.2, 0.4, 0.6, 0.8, 1.0};  // A
constexpr double shown_frequencies[] = {0.4, 2.0};                   // Hz
// Table VIII at these.
constexpr double published_nrmse[2][6] = {{0.129, 0.043, 0.021, 0.020, 0.028, 0.024},
                                          {0.021, 0.015, 0.025, 0.032, 0.037, 0.041}};

}  // namespace

Study pso_figure_10(const ReproduceOptions& options) {
  std::vector<std::string> conditions;
  for (const double frequency : shown_frequencies) {
    for (const double current : shown_currents)
      conditions.push_back(fmt::format("{:.1f}Hz_{:.1f}A", frequency, current));
  }
  Study study = pso_table_viii(options);
  study.title = "figure-10";
  study.data.front().only = conditions;
  study.solvers.pop_back();
  return study;
}

Reproduction pso_figure_10_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  StudyTable table{"figure-10",
                   "Loops with varied current",
                   "NRMSE: median [quartiles] over the seeds. The picture shows the run of the median.",
                   {"frequency", "current", "published", "obtained"},
                   {}};
  std::vector<FigurePanel> panels;
  std::size_t below = 0;
  for (std::size_t f = 0; f < std::size(shown_frequencies); ++f) {
    Loops loops;
    std::vector<std::pair<std::size_t, const RunRecord*>> runs;
    for (std::size_t c = 0; c < std::size(shown_currents); ++c) {
      const std::size_t problem = problem_index(
          plan, fmt::format("{} @ twin/{:.1f}Hz_{:.1f}A", pso::full_model, shown_frequencies[f], shown_currents[c]));
      if (problem >= plan.problems.size()) continue;
      table.rows.push_back({fmt::format("{:.1f} Hz", shown_frequencies[f]), fmt::format("{:.1f} A", shown_currents[c]),
                            fmt::format("{:.3f}", published_nrmse[f][c]), spread(plan, records, problem, 0)});
      below += median_nrmse(plan, records, problem, 0) < published_nrmse[f][c] ? 1 : 0;
      const Recording& recording = plan.problems[problem].recordings.front();
      FigureCurve style = measured_style();
      if (c > 0) style.label.clear();
      loops.add(recording, shown_frequencies[f], recording.force, style);
      runs.emplace_back(problem, median_run(plan, records, problem, 0));
    }
    // On top of the recordings of all currents.
    for (std::size_t c = 0; c < runs.size(); ++c) {
      const auto& [problem, run] = runs[c];
      if (run == nullptr) continue;
      loops.add(plan.problems[problem].recordings.front(), shown_frequencies[f], force_of(plan, problem, *run),
                model_style(c, fmt::format("{:.1f} A", shown_currents[c])));
    }
    for (FigurePanel* panel : {&loops.by_velocity, &loops.by_displacement}) {
      panel->y_label = fmt::format("force at {:.1f} Hz [N]", shown_frequencies[f]);
      panels.push_back(std::move(*panel));
    }
  }
  result.findings.push_back(fmt::format("Obtained below published in {} of {} conditions.", below, table.rows.size()));
  result.tables.push_back(std::move(table));
  result.pictures.push_back({"figure-10", "Force against velocity and displacement with varied current",
                             figure_svg(panels, "Loops at 0.4 Hz and 2 Hz with varied current", 2)});
  result.remade.push_back("Force against velocity and displacement at 0.4 Hz and 2 Hz.");
  result.not_remade.push_back(
      "The paper's figure is of its polynomials, of which the stand-in is made; here each condition is identified "
      "alone, "
      "as its table VIII is. The currents of the figure are not printed.");
  pso::say_of_data(plan, result);
  return result;
}

}  // namespace hysteron::reproduce
