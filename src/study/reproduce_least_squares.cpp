// The least squares paper: all parameters free, then n and the initial deflection held at their means and the rest
// identified again in a box that shrinks, then alpha linear and c0 quadratic in the current. Round trip: the recordings
// are simulated with the published parameters; the same three steps on a measured damper stand beside it.
//   z0' = -gamma |v| z0 |z0|^(n-1) - beta v |z0|^n + A v,   F = c0 v + k0 (x - x0) + alpha0 z0
// is used in the normal form of models/bouc_wen.cpp: Z = (A / (beta + gamma))^(1/n), alpha = alpha0 Z, x_y = Z / A,
// share = gamma / (beta + gamma), f0 = -k0 x0. Only these can be identified: the published form holds one parameter too
// many, which is compared here at the published A.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "presets/support/bouc_wen_form.hpp"
#include "report/terminal.hpp"
#include "study/reproduce_recording.hpp"

namespace hysteron::reproduce {
namespace {

using nlohmann::json;

constexpr SineTest test_at(double current) { return {0.010, 0.4, current, DriveKind::current}; }
constexpr SineTest validation_at(double current) { return {0.0075, 0.7, current, DriveKind::current}; }

struct Row {
  double current;
  double alpha;
  double c0;
  double k0;
};
constexpr Row rows[] = {{0.0, 15.71, 33.78, 75.04},
                        {0.25, 21.4, 46.08, 68.13},
                        {0.5, 27.13, 49.5, 65.87},
                        {0.75, 31.69, 56.5, 70.87},
                        {1.0, 35.82, 53.6, 61.65}};
// Means stated in the text below the table, and the values fixed before.
constexpr double published_A = 3507.8;
constexpr double published_beta = -1013.6;
constexpr double published_gamma = 1235.8;
constexpr double published_n = 1.01;
constexpr double published_x0 = -0.02564;  // m

constexpr const char* all_free = "stage 1";
constexpr const char* n_held = "stage 2";
constexpr const char* with_laws = "eq. 4";

std::vector<double> parameters(const Row& row) {
  const NormalForm z = normal_form(row.alpha, published_A, published_gamma, published_beta, published_n);
  return {z.yield_force, row.c0, row.k0, -row.k0 * published_x0, z.x_y, z.share, published_n};
}

Recording simulated(const Row& row, const SineTest& test, double noise) {
  return sine_recording(make_model("bouc-wen", {}), parameters(row), fmt::format("{:.2f}A.csv", row.current), test,
                        noise);
}

// In the published form at the published A.
struct Form {
  double alpha, c0, k0, beta, gamma, n;
};
Form form_of(const RunRecord& run) {
  const json p = json::parse(run.parameters);
  const double n = p.value("n", published_n);
  const double z = published_A * p.at("x_y").get<double>();
  const double sum = published_A / std::pow(z, n);
  const double gamma = p.at("share").get<double>() * sum;
  return {p.at("alpha").get<double>() / z, p.at("c0").get<double>(), p.at("k0").get<double>(), sum - gamma, gamma, n};
}

const RunRecord* run_of(const Plan& plan, const std::vector<RunRecord>& records, const std::string& label) {
  const std::size_t problem = problem_index(plan, label);
  return problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
}

// Laws through values at the five currents: alpha_1 + alpha_2 I and c_1 I^2 + c_2 I + c_3.
struct Laws {
  std::vector<double> alpha;
  std::vector<double> c0;
};
Laws laws_through(const std::vector<double>& current, const std::vector<double>& alpha, const std::vector<double>& c0) {
  return {polynomial_through(current, alpha, 1), polynomial_through(current, c0, 2)};
}

}  // namespace

Study least_squares_table_2(const ReproduceOptions& options) {
  Study study = round_trip(options, "least-squares-table-2");
  study.solvers = {{"shrinking-box-lm", "shrinking-box-lm", {}, 0}};
  // The published loop shape, gamma / (beta + gamma) = 5.6, lies outside the card's box.
  const std::pair<double, double> shapes{0.1, 20.0};
  ModelSpec free = model_on(all_free, "bouc-wen", {"clean", "noise", "press"});
  free.layout.bounds["share"] = shapes;
  ModelSpec held = model_on(n_held, "bouc-wen", {"clean", "noise", "press"});
  held.layout = free.layout;
  held.layout.fix["n"] = published_n;
  ModelSpec laws = model_on(with_laws, "bouc-wen", {"all/clean", "all/noise", "all/press"});
  laws.layout = held.layout;
  laws.layout.by_current = {{"alpha", 1}, {"c0", 2}};
  study.models = {free, held, laws};
  for (const bool together : {false, true}) {
    for (const double noise : {0.0, noise_share}) {
      DataSpec data;
      data.label = std::string(together ? "all/" : "") + (noise > 0.0 ? "noise" : "clean");
      data.each = !together;
      for (const Row& row : rows) data.made.push_back(simulated(row, test_at(row.current), noise));
      study.data.push_back(std::move(data));
    }
    DataSpec press;
    press.label = together ? "all/press" : "press";
    press.dataset = "utfsm-mr-damper";
    press.only = {"2mm5Hz"};
    press.each = !together;
    study.data.push_back(std::move(press));
  }
  return study;
}

Reproduction least_squares_table_2_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  double worst_clean = 0.0;
  // With noise, of alpha, c0, k0; and what the two small ones contribute, beside the noise.
  double worst_noisy[3] = {0.0, 0.0, 0.0};
  double viscous_force = 0.0;
  double spring_force = 0.0;
  double least_noise = std::numeric_limits<double>::infinity();
  double validation[2] = {-1.0, -1.0};  // stage 2, eq. 4
  std::vector<double> currents;
  std::vector<double> alphas;
  std::vector<double> dampings;
  for (const Row& row : rows) {
    currents.push_back(row.current);
    alphas.push_back(row.alpha);
    dampings.push_back(row.c0);
  }
  const Laws published = laws_through(currents, alphas, dampings);

  StudyTable first{"least-squares-stage-1",
                   "Stage 1: all parameters free",
                   "From recordings with 1 % noise, at the published A = 3507.8. The deflection is f0 / k0: it moves "
                   "the force by one constant, which is all that can be known of it.",
                   {"current [A]", "alpha", "beta", "gamma", "c0", "k0", "n", "-k0 x0 [N]", "NRMSE"},
                   {}};
  double sum_n = 0.0;
  std::size_t count_n = 0;
  for (const Row& row : rows) {
    const RunRecord* run = run_of(plan, records, fmt::format("{} @ noise/{:.2f}A", all_free, row.current));
    if (run == nullptr) continue;
    const Form form = form_of(*run);
    first.rows.push_back(
        {fmt::format("{:.2f}", row.current), format_number(form.alpha, 4), format_number(form.beta, 4),
         format_number(form.gamma, 4), format_number(form.c0, 4), format_number(form.k0, 4), format_number(form.n, 4),
         format_number(json::parse(run->parameters).at("f0").get<double>(), 3), format_number(*run->nrmse, 3)});
    sum_n += form.n;
    ++count_n;
  }
  if (!first.rows.empty()) result.tables.push_back(std::move(first));

  StudyTable laws{
      "least-squares-eq-4",
      "Equation 4: alpha = alpha_1 + alpha_2 I, c0 = c_1 I^2 + c_2 I + c_3",
      "The paper prints no coefficients; \"through table 2\" is the least squares curve through its printed "
      "values. Obtained through the values of stage 2, and from all five recordings at once.",
      {"", "alpha_1", "alpha_2", "c_1", "c_2", "c_3", "NRMSE, all five"},
      {}};
  const auto add_laws = [&](const std::string& name, const Laws& own, const std::string& nrmse) {
    laws.rows.push_back({name, format_number(own.alpha[0], 4), format_number(own.alpha[1], 4),
                         format_number(own.c0[2], 4), format_number(own.c0[1], 4), format_number(own.c0[0], 4), nrmse});
  };
  add_laws("through table 2 as printed", published, "-");

  for (const char* data : {"clean", "noise"}) {
    const bool clean = std::string_view(data) == "clean";
    StudyTable table{std::string("least-squares-table-2-") + data,
                     std::string("Stage 2 (table 2): n and x0 held, ") +
                         (clean ? "simulated recordings without noise" : "simulated recordings with 1 % noise"),
                     "p: published, o: obtained, at the published A = 3507.8. Deviations in percent.",
                     {"current [A]", "alpha p", "alpha o", "dev.", "c0 p", "c0 o", "dev.", "k0 p", "k0 o", "dev.",
                      "beta o", "gamma o", "NRMSE"},
                     {}};
    std::vector<double> own_alphas;
    std::vector<double> own_dampings;
    for (const Row& row : rows) {
      const std::size_t problem = problem_index(plan, fmt::format("{} @ {}/{:.2f}A", n_held, data, row.current));
      const RunRecord* run = problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
      if (run == nullptr) continue;
      const Form form = form_of(*run);
      own_alphas.push_back(form.alpha);
      own_dampings.push_back(form.c0);
      table.rows.push_back({fmt::format("{:.2f}", row.current), format_number(row.alpha, 4),
                            format_number(form.alpha, 4), deviation(form.alpha, row.alpha), format_number(row.c0, 4),
                            format_number(form.c0, 4), deviation(form.c0, row.c0), format_number(row.k0, 4),
                            format_number(form.k0, 4), deviation(form.k0, row.k0), format_number(form.beta, 4),
                            format_number(form.gamma, 4), format_number(*run->nrmse, 3)});
      const double off[3] = {std::fabs(form.alpha / row.alpha - 1.0), std::fabs(form.c0 / row.c0 - 1.0),
                             std::fabs(form.k0 / row.k0 - 1.0)};
      for (int k = 0; k < 3; ++k) {
        (clean ? worst_clean : worst_noisy[k]) = std::max(clean ? worst_clean : worst_noisy[k], off[k]);
      }
      if (clean) continue;
      const SineTest test = test_at(row.current);
      viscous_force = std::max(viscous_force, row.c0 * test.amplitude * 2.0 * std::numbers::pi * test.frequency);
      spring_force = std::max(spring_force, row.k0 * test.amplitude);
      double peak = 0.0;
      for (const double force : plan.problems[problem].recordings.front().force)
        peak = std::max(peak, std::fabs(force));
      least_noise = std::min(least_noise, noise_share * peak);
      if (row.current == 0.5) {
        validation[0] = nrmse_on(plan, problem, *run, simulated(row, validation_at(row.current), 0.0));
      }
    }
    result.tables.push_back(std::move(table));
    if (own_alphas.size() == currents.size()) {
      add_laws(std::string("through stage 2, ") + data, laws_through(currents, own_alphas, own_dampings), "-");
    }
    const std::size_t problem = problem_index(plan, fmt::format("{} @ all/{}", with_laws, data));
    const RunRecord* run = problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
    if (run == nullptr) continue;
    const json p = json::parse(run->parameters);
    const double z = published_A * p.at("x_y").get<double>();
    const auto term = [&](const char* name) { return p.at(name).get<double>(); };
    add_laws(std::string("all at once, ") + data,
             {{term("alpha") / z, term("alpha*i") / z}, {term("c0"), term("c0*i"), term("c0*i^2")}},
             format_number(*run->nrmse, 3));
    if (!clean) validation[1] = nrmse_on(plan, problem, *run, simulated(rows[2], validation_at(0.5), 0.0));
  }
  result.tables.push_back(std::move(laws));

  StudyTable press{"least-squares-press",
                   "The same steps on a measured damper",
                   "utfsm-mr-damper, 2 mm at 5 Hz. NRMSE; stage 2 holds n at the paper's 1.01.",
                   {"current [A]", "stage 1", "n", "stage 2", "alpha x_y A [N]", "c0 [N s/m]"},
                   {}};
  for (const Row& row : rows) {
    const std::string name = fmt::format("press/2mm5Hz_{:.2f}A", row.current);
    const RunRecord* one = run_of(plan, records, std::string(all_free) + " @ " + name);
    const RunRecord* two = run_of(plan, records, std::string(n_held) + " @ " + name);
    if (one == nullptr || two == nullptr) continue;
    const json p = json::parse(two->parameters);
    press.rows.push_back({fmt::format("{:.2f}", row.current), format_number(*one->nrmse, 3),
                          format_number(json::parse(one->parameters).at("n").get<double>(), 3),
                          format_number(*two->nrmse, 3), format_number(p.at("alpha").get<double>(), 4),
                          format_number(p.at("c0").get<double>(), 4)});
  }
  press.header[4] = "yield force [N]";
  const RunRecord* joint = run_of(plan, records, std::string(with_laws) + " @ all/press");
  if (joint != nullptr) {
    press.rows.push_back({"all, eq. 4", "-", "-", format_number(*joint->nrmse, 3), "-", "-"});
  }
  if (!press.rows.empty()) result.tables.push_back(std::move(press));

  result.findings.push_back(fmt::format("Without noise alpha, c0 and k0 of table 2 come back within {} %.",
                                        format_number(100.0 * worst_clean, 2)));
  result.findings.push_back(fmt::format(
      "With 1 % noise alpha comes back within {} %, c0 within {} % and k0 within {} %. The published c0 "
      "and k0 contribute at most {} N and {} N; the noise is at least {} N: such recordings do not determine "
      "them, nor the law of c0.",
      format_number(100.0 * worst_noisy[0], 2), format_number(100.0 * worst_noisy[1], 2),
      format_number(100.0 * worst_noisy[2], 2), format_number(viscous_force, 2), format_number(spring_force, 2),
      format_number(least_noise, 2)));
  if (count_n > 0) {
    result.findings.push_back(fmt::format("Mean n of stage 1: {} (published 1.01, held in stage 2).",
                                          format_number(sum_n / static_cast<double>(count_n), 4)));
  }
  double bend = 0.0;
  for (std::size_t k = 0; k < currents.size(); ++k) {
    bend = std::max(bend, std::fabs((published.alpha[0] + published.alpha[1] * currents[k]) / alphas[k] - 1.0));
  }
  result.findings.push_back(fmt::format(
      "The straight line of equation 4 misses the printed alpha by up to {} %, which is more than all that c0 "
      "contributes: "
      "fitted to all five recordings at once, c0 takes up that misfit and has nothing of the printed one left.",
      format_number(100.0 * bend, 2)));
  if (validation[0] >= 0.0 && validation[1] >= 0.0) {
    result.findings.push_back(fmt::format(
        "Validation at 0.7 Hz, 7.5 mm, 0.5 A with parameters identified from noise at 0.4 Hz, 10 mm: NRMSE {} "
        "against the noise-free force by stage 2, {} by the laws of equation 4.",
        format_number(validation[0], 3), format_number(validation[1], 3)));
  }
  if (joint != nullptr) {
    result.findings.push_back(fmt::format(
        "On the measured damper equation 4, one set for five currents, leaves {}; the stages, a set for each, "
        "leave what the table says.",
        format_number(*joint->nrmse, 3)));
  }
  result.remade.push_back(
      "Excitation (0.4 Hz, 10 mm), currents, the two stages with n = 1.01 held in the second, least squares in a box "
      "that "
      "shrinks step by step (`shrinking-box-lm`), alpha linear and c0 quadratic in the current, validation at 0.7 Hz "
      "and "
      "7.5 mm.");
  result.not_remade.push_back(
      "The measured recordings are not public: simulated ones stand in, so that model error is absent; the measured "
      "damper "
      "beside them is another one.");
  result.not_remade.push_back(
      "The printed beta contradicts itself: the column of table 2 has the mean -1204 (in the unit of A and gamma), the "
      "text states -1013.6. With the column beta + gamma is zero or negative at four currents and z does not saturate; "
      "the "
      "text's means of A, beta and gamma are used with the table's alpha, c0 and k0. Lengths in metres, as only that "
      "gives "
      "forces of an MR damper.");
  result.not_remade.push_back(
      "How far the box shrinks at a step is not printed: the schedule is that of `hysteron describe shrinking-box-lm`. "
      "x0 "
      "and k0 enter the force as one offset, -k0 x0, which stays free. The paper starts stage 2 from the values of "
      "stage "
      "1 at 0.5 A; here it starts from a point drawn from the seed, which is harder.");
  return result;
}

}  // namespace hysteron::reproduce
