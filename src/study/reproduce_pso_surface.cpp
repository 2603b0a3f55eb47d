// Figure 9 of the PSO paper: the order of the parameter polynomials in current and frequency against error, in two
// ways. As in the paper, a surface through the parameters of the 55 conditions, each identified alone; and all
// coefficients fitted to all recordings at once,
//   minimise  mean over conditions of NRMSE^2( theta(i, f) ),   theta_j(i, f) = sum_t C_jt m_t(i, f),
// by Levenberg-Marquardt on C, theta being beta, gamma, A, k1, k0, c0, c1, f0 of equations (16) to (23). A condition
// alone does not determine all eight, so that its values scatter along a valley that a surface through them leaves; the
// joint fit has no such values.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "fit/objective.hpp"
#include "report/figure.hpp"
#include "report/terminal.hpp"
#include "study/quantile.hpp"
#include "study/reproduce_pso.hpp"

namespace hysteron::reproduce {
namespace {

using nlohmann::json;

constexpr double paper_alpha = 80.0;
constexpr const char* offset_name = "offset-force.f0";
constexpr int highest_order = 5;
constexpr int count = 8;  // parameters of the paper: beta, gamma, A, k1, k0, c0, c1, f0
using Theta = Eigen::Matrix<double, count, 1>;

// From the normal form at n = 1 to the paper's, alpha = 80:  beta + gamma = 1 / x_y, A = alpha_normal / (80 x_y).
Theta paper_form(const json& p) {
  const double sum = 1.0 / p.at("x_y").get<double>();
  const double gamma = p.at("share").get<double>() * sum;
  Theta theta;
  theta << sum - gamma, gamma, p.at("alpha").get<double>() * sum / paper_alpha, p.at("k1").get<double>(),
      p.at("k0").get<double>(), p.at("c0").get<double>(), p.at("c1").get<double>(), p.at(offset_name).get<double>();
  return theta;
}

// A value of the normal form and its derivatives by theta.
struct NormalValue {
  double value;
  Theta slope;
};

// Back again; empty where the polynomials left the range in which the model means something.
std::map<std::string, NormalValue> normal_values(const Theta& v) {
  const double sum = v[0] + v[1];
  if (!(sum > 0.0) || !(v[2] > 0.0) || !(v[5] + v[6] > 0.0)) return {};
  std::map<std::string, NormalValue> result;
  Theta slope = Theta::Zero();
  slope << -paper_alpha * v[2] / (sum * sum), -paper_alpha * v[2] / (sum * sum), paper_alpha / sum, 0, 0, 0, 0, 0;
  result["alpha"] = {paper_alpha * v[2] / sum, slope};
  slope << -1.0 / (sum * sum), -1.0 / (sum * sum), 0, 0, 0, 0, 0, 0;
  result["x_y"] = {1.0 / sum, slope};
  slope << -v[1] / (sum * sum), v[0] / (sum * sum), 0, 0, 0, 0, 0, 0;
  result["share"] = {v[1] / sum, slope};
  const std::array<const char*, 5> same{"k1", "k0", "c0", "c1", offset_name};
  for (int k = 0; k < 5; ++k) result[same[static_cast<std::size_t>(k)]] = {v[3 + k], Theta::Unit(3 + k)};
  return result;
}

// Monomials of total order up to `order` in i / 1 A and f / 2 Hz.
Eigen::VectorXd monomials(double i, double f, int order) {
  std::vector<double> values;
  for (int total = 0; total <= order; ++total) {
    for (int power = 0; power <= total; ++power) {
      values.push_back(std::pow(i, total - power) * std::pow(0.5 * f, power));
    }
  }
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// One condition, its recording ready to be simulated with any theta.
struct Surroundings {
  double current;    // A
  double frequency;  // Hz
  Objective objective;
};

// Of one condition at a theta: NRMSE^2 with gradient and Gauss-Newton matrix by theta.
struct Misfit {
  double squares = std::numeric_limits<double>::infinity();
  Theta gradient = Theta::Zero();
  Eigen::Matrix<double, count, count> matrix = Eigen::Matrix<double, count, count>::Zero();
};

Misfit misfit(const Objective& objective, const Theta& theta) {
  Misfit result;
  const auto values = normal_values(theta);
  if (values.empty()) return result;
  const Layout& layout = objective.layout();
  const auto d = static_cast<Eigen::Index>(layout.dimension());
  // Beyond the box too: u is not cut at 0 and 1.
  std::vector<double> u;
  Eigen::MatrixXd chain(d, count);
  for (std::size_t c = 0; c < layout.dimension(); ++c) {
    const Coordinate& at = layout.coordinates()[c];
    const NormalValue& own = values.at(layout.names()[at.parameter]);
    const bool logarithmic = at.scale == Scale::logarithmic;
    if (logarithmic && !(own.value > 0.0)) return result;
    u.push_back(logarithmic ? std::log(own.value / at.lower) / std::log(at.upper / at.lower)
                            : (own.value - at.lower) / (at.upper - at.lower));
    chain.row(static_cast<Eigen::Index>(c)) = own.slope.transpose() / layout.slope(c, u.back());
  }
  const Linearised one = objective.linearised(u).front();
  const auto n = static_cast<Eigen::Index>(one.residual.size());
  const Eigen::Map<const Eigen::VectorXd> r(one.residual.data(), n);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(one.jacobian.data(),
                                                                                                   n, d);
  const double squares = r.squaredNorm();
  // NRMSE of 10: the force ran away.
  if (!std::isfinite(squares) || squares > 100.0 || !j.allFinite()) return result;
  const Eigen::MatrixXd by_theta = j * chain;
  result.squares = squares;
  result.gradient = by_theta.transpose() * r;
  result.matrix = by_theta.transpose() * by_theta;
  return result;
}

// Coefficients: one row a parameter, one column a monomial.
using Surface = Eigen::MatrixXd;

Theta at(const Surface& surface, const Surroundings& where, int order) {
  return surface * monomials(where.current, where.frequency, order);
}

struct Total {
  double squares = 0.0;  // a condition that does not simulate counts as NRMSE 1
  std::size_t broken = 0;
  std::vector<Misfit> each;
};

Total total(const std::vector<Surroundings>& conditions, const Surface& surface, int order) {
  Total result;
  for (const Surroundings& condition : conditions) {
    result.each.push_back(misfit(condition.objective, at(surface, condition, order)));
    const bool broken = !std::isfinite(result.each.back().squares);
    result.broken += broken ? 1 : 0;
    result.squares += broken ? 1.0 : result.each.back().squares;
  }
  return result;
}

struct Joint {
  Surface surface;
  Total total;
  std::size_t simulations = 0;  // of all conditions, each with its derivatives
};

// `done` is told the share of the simulations that it may take.
Joint fit_jointly(const std::vector<Surroundings>& conditions, const Surface& surface, int order, std::size_t most,
                  const Done& done) {
  Joint best{surface, total(conditions, surface, order), 1};
  const Eigen::Index terms = surface.cols();
  const Eigen::Index size = count * terms;
  double damping = 1e-3;
  std::size_t stalled = 0;
  while (best.simulations < most && damping < 1e8 && stalled < 3) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      const Misfit& own = best.total.each[k];
      if (!std::isfinite(own.squares)) continue;
      const Eigen::VectorXd m = monomials(conditions[k].current, conditions[k].frequency, order);
      for (int a = 0; a < count; ++a) {
        gradient.segment(a * terms, terms) += own.gradient[a] * m;
        for (int b = 0; b < count; ++b) {
          matrix.block(a * terms, b * terms, terms, terms) += own.matrix(a, b) * m * m.transpose();
        }
      }
    }
    const Eigen::VectorXd scale = matrix.diagonal().cwiseMax(1e-30);
    for (bool better = false; !better && best.simulations < most && damping < 1e8;) {
      Eigen::MatrixXd damped = matrix;
      damped.diagonal() += damping * scale;
      const Eigen::VectorXd step = -damped.ldlt().solve(gradient);
      Surface moved = best.surface;
      for (int a = 0; a < count; ++a) moved.row(a) += step.segment(a * terms, terms).transpose();
      Total there = total(conditions, moved, order);
      ++best.simulations;
      done(static_cast<double>(best.simulations) / static_cast<double>(most));
      better = there.squares < best.total.squares;
      if (better) {
        stalled = there.squares > (1.0 - 1e-4) * best.total.squares ? stalled + 1 : 0;
        best.surface = std::move(moved);
        best.total = std::move(there);
        damping = std::max(1e-12, 0.2 * damping);
      } else {
        damping *= 4.0;
      }
    }
  }
  return best;
}

// The surface of a lower order as one of a higher.
Surface raised(const Surface& surface, Eigen::Index terms) {
  Surface result = Surface::Zero(count, terms);
  result.leftCols(surface.cols()) = surface;
  return result;
}

std::string quartile(const std::vector<double>& values, double share) {
  return values.empty() ? "-" : format_number(quantile(values, share), 3);
}

// Errors from order 1 up; the paper's third curve, the computation time, is that of a machine.
ReproducedPicture error_picture(const std::vector<double>& curve_fitting, const std::vector<double>& through,
                                const std::vector<double>& jointly) {
  const auto curve = [](const std::vector<double>& errors, const char* colour, const char* label) {
    FigureCurve result;
    result.colour = colour;
    result.label = label;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (!std::isfinite(errors[k])) continue;
      result.x.push_back(static_cast<double>(k + 1));
      result.y.push_back(errors[k]);
    }
    return result;
  };
  FigurePanel of_parameters{
      "order", "curve fitting error", {curve(curve_fitting, "#0072b2", "through the conditions")}};
  FigurePanel of_force{
      "order",
      "force NRMSE, median",
      {curve(through, "#0072b2", "through the conditions"), curve(jointly, "#d55e00", "fitted to all at once")}};
  of_parameters.corner = LegendCorner::upper_right;
  of_force.corner = LegendCorner::upper_right;
  return {"figure-9", "Errors against the order of the polynomials",
          figure_svg({of_parameters, of_force}, "Curve fitting error and force error against the order")};
}

std::vector<double> nrmse_of(const Total& total) {
  std::vector<double> result;
  for (const Misfit& one : total.each) {
    if (std::isfinite(one.squares)) result.push_back(std::sqrt(one.squares));
  }
  return result;
}

}  // namespace

std::array<double, 8> pso::paper_parameters(const RunRecord& run) {
  const Theta theta = paper_form(json::parse(run.parameters));
  std::array<double, 8> result{};
  std::ranges::copy(theta, result.begin());
  return result;
}

std::string pso::sentence_of_third_order(double through, double jointly) {
  constexpr double noise = 0.010;   // of the stand-in, over the peak force
  constexpr double at_noise = 1.1;  // times the noise that is reached
  constexpr double clear_of = 1.5;  // times the error of the one that the other is above it
  const std::string third = fmt::format("The stand-in is of third order, with noise of {:.3f}: ", noise);
  if (!(jointly <= at_noise * noise)) {
    return third +
           "fitted to all at once that order does not reach the noise here, so that nothing follows for a surface "
           "through the conditions.";
  }
  if (!(through > clear_of * jointly)) {
    return third + "that order reaches the noise, and a surface through the conditions comes near it.";
  }
  return third +
         "that order reaches the noise, so that what a surface through the conditions lacks at order 3 is not the "
         "order but the parameters, identified condition by condition, that it goes through.";
}

Study pso_figure_9(const ReproduceOptions& options) {
  Study study = pso::base(options, "figure-9", {});
  study.models = {pso::model_spec(pso::full_model, options)};
  study.solvers = {{"multistart-lm", "multistart-lm", {}, 0}};
  return study;
}

Reproduction pso_figure_9_result(const Plan& plan, const std::vector<RunRecord>& records, const Done& done) {
  Reproduction result;
  std::vector<Theta> values;
  std::vector<Surroundings> conditions;
  std::vector<double> direct;
  ObjectiveOptions one_thread = plan.study.objective;
  one_thread.threads = 1;
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    const RunRecord* run = best_run(plan, records, p);
    if (run == nullptr) continue;
    values.push_back(paper_form(json::parse(run->parameters)));
    const StudyProblem& problem = plan.problems[p];
    // Named FREQUENCYHz_CURRENTA.csv.
    conditions.push_back({problem.recordings.front().drive.front(), std::stod(problem.recordings.front().file),
                          Objective(problem.layout, problem.recordings, one_thread)});
    direct.push_back(*run->nrmse);
  }
  StudyTable table{
      "figure-9",
      "Polynomials of total order p in current and frequency, 55 conditions",
      "Through the conditions, as in the paper: curve fitting error is the RMS over the 8 parameters of RMS deviation "
      "/ "
      "range, force error the NRMSE with the polynomials' values over the conditions that simulate with them. All at "
      "once: the coefficients fitted to all recordings; work: simulations of all conditions with derivatives.",
      {"order", "terms", "curve fitting error", "force NRMSE, median", "upper quartile", "not simulable",
       "all at once, median", "upper quartile", "largest", "not simulable", "work"},
      {}};
  // The smallest budgets are those of tests.
  const std::size_t most = std::min<std::size_t>(60, std::max<std::size_t>(2, plan.study.budgets.front() / 5));
  std::vector<double> curve_fitting;
  std::vector<double> through;
  std::vector<double> jointly;
  Surface before;
  constexpr double joint_fits = 2.0 * highest_order - 1.0;
  double fitted = 0.0;
  const Done of_fit = [&](double share) {
    if (done) done((fitted + std::min(share, 1.0)) / joint_fits);
  };
  for (int order = 1; order <= highest_order; ++order) {
    const auto n = static_cast<Eigen::Index>(values.size());
    const Eigen::Index terms = monomials(0.0, 0.0, order).size();
    if (n < terms) continue;
    Eigen::MatrixXd design(n, terms);
    Eigen::MatrixXd y(n, count);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Surroundings& where = conditions[static_cast<std::size_t>(k)];
      design.row(k) = monomials(where.current, where.frequency, order).transpose();
      y.row(k) = values[static_cast<std::size_t>(k)].transpose();
    }
    const Surface surface = design.colPivHouseholderQr().solve(y).transpose();
    double squares = 0.0;
    for (int j = 0; j < count; ++j) {
      const double range = std::max(y.col(j).maxCoeff() - y.col(j).minCoeff(), 1e-300);
      squares +=
          (design * surface.row(j).transpose() - y.col(j)).squaredNorm() / static_cast<double>(n) / range / range;
    }
    const Total as_published = total(conditions, surface, order);
    // From the surface through the conditions, and from that of the order below.
    Joint joint = fit_jointly(conditions, surface, order, most, of_fit);
    ++fitted;
    if (before.size() > 0) {
      Joint warm = fit_jointly(conditions, raised(before, terms), order, most, of_fit);
      ++fitted;
      const std::size_t work = joint.simulations + warm.simulations;
      if (warm.total.squares < joint.total.squares) joint = std::move(warm);
      joint.simulations = work;
    }
    before = joint.surface;
    const std::vector<double> own = nrmse_of(as_published);
    const std::vector<double> all = nrmse_of(joint.total);
    curve_fitting.push_back(std::sqrt(squares / count));
    through.push_back(own.empty() ? std::numeric_limits<double>::infinity() : quantile(own, 0.5));
    jointly.push_back(all.empty() ? std::numeric_limits<double>::infinity() : quantile(all, 0.5));
    table.rows.push_back({std::to_string(order), std::to_string(terms), format_number(std::sqrt(squares / count), 3),
                          quartile(own, 0.5), quartile(own, 0.75), std::to_string(as_published.broken),
                          quartile(all, 0.5), quartile(all, 0.75), quartile(all, 1.0),
                          std::to_string(joint.total.broken), std::to_string(joint.simulations)});
  }
  result.tables.push_back(std::move(table));
  result.pictures.push_back(error_picture(curve_fitting, through, jointly));
  if (!direct.empty()) {
    result.findings.push_back(fmt::format("Identified condition by condition, without polynomials: median NRMSE {}.",
                                          format_number(quantile(direct, 0.5), 3)));
  }
  result.findings.push_back(
      "Published (figure without printed numbers): both errors fall with the order, computation time grows, third "
      "order was chosen.");
  if (through.size() == highest_order) {
    result.findings.push_back(fmt::format(
        "Through the conditions the force error {} from order 1 to 3 ({} to {}) and {} from 3 to 5 ({}).",
        through[2] < through[0] ? "falls" : "does not fall", format_number(through[0], 3), format_number(through[2], 3),
        through[4] < through[2] ? "falls" : "does not fall", format_number(through[4], 3)));
    result.findings.push_back(fmt::format("All at once: median {} at order 1, {} at 2, {} at 3, {} at 5. {}",
                                          format_number(jointly[0], 3), format_number(jointly[1], 3),
                                          format_number(jointly[2], 3), format_number(jointly[4], 3),
                                          pso::sentence_of_third_order(through[2], jointly[2])));
  }
  result.remade.push_back("Orders 1 to 5, curve fitting error and force error.");
  result.not_remade.push_back(
      "The figure prints no numbers, so that only its shape can be compared. Its computation time depends on the "
      "machine; "
      "the work beside the errors is what does not.");
  result.not_remade.push_back("The columns \"all at once\" are not of the paper.");
  pso::say_of_descents(plan, "polynomials", result);
  pso::say_of_data(plan, result);
  return result;
}

}  // namespace hysteron::reproduce
