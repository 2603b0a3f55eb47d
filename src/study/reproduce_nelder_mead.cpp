// The Nelder-Mead paper: a sine fitted to the displacement first, then sixteen parameters of the asymmetric sigmoid at
// each of six currents, tables 1 and 2, and the residual held against a normal distribution. The law is
// models/wang_sigmoid.cpp; what the paper prints of it differs, and the readings are compared on its own tables.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "datasets/dataset.hpp"
#include "presets/support/nelder_mead_rows.hpp"
#include "report/terminal.hpp"
#include "study/quantile.hpp"
#include "study/reproduce_recording.hpp"
#include "study/sine_fit.hpp"

namespace hysteron::reproduce {
namespace {

using nelder_mead::Row;
using nlohmann::json;

constexpr const char* law = "wang-sigmoid";
constexpr double rounding = 0.02;  // m/s^2, a_s
// Standard deviation of the simulated displacement sensor over the amplitude.
constexpr double sensor_noise = 0.005;
constexpr const char* press = "utfsm-mr-damper";
constexpr const char* press_motion = "2mm5Hz";

enum Index { f0, a0, a1, a2, a3, a4, k0, k1c, k1e, k2, k3, k4, k5, k6, I0, I1, parameter_count };
constexpr std::array<const char*, parameter_count> names{"f0",  "a0", "a1", "a2", "a3", "a4", "k0", "k1c",
                                                         "k1e", "k2", "k3", "k4", "k5", "k6", "I0", "I1"};
// The rows of the two tables.
constexpr std::array<Index, 8> table_1{a0, a1, a2, a3, a4, I0, I1, f0};
constexpr std::array<Index, 8> table_2{k0, k1c, k1e, k2, k3, k4, k5, k6};

double logistic(double u) { return 1.0 / (1.0 + std::exp(-u)); }

// What acts at one current and one sine: the characteristic quantities of equations (4) to (8).
struct Characteristic {
  double f_t, v_h, steepness, k_vc, k_ve, f_d, v_d;
};
constexpr std::array<const char*, 7> characteristic_names{"f_t [N]",    "v_h [mm/s]", "alpha [s/m]", "k_vc [s/m]",
                                                          "k_ve [s/m]", "f_d [N]",    "v_d [mm/s]"};
std::array<double, 7> shown(const Characteristic& c) {
  return {c.f_t, 1e3 * c.v_h, c.steepness, c.k_vc, c.k_ve, c.f_d, 1e3 * c.v_d};
}

// Readings of f_t and v_h.
struct Reading {
  const char* name;
  bool inverse;         // (1 + e^(a1 v_m))^-1 as printed, not (1 + e^(a1 v_m))
  bool force_restored;  // f_0 (...) (1 + k2 (...)), not f_0 (...) + k2 (...)
  bool width_restored;  // k4 v_m (1 + k3 (...)), not k4 v_m k3 (...)
};
constexpr Reading readings[] = {{"as printed", true, false, false},
                                {"1 + restored, exponent -1", true, true, true},
                                {"sum, exponent 1", false, false, true},
                                {"Wang et al.: 1 + restored, exponent 1", false, true, true}};

Characteristic characteristic(const std::array<double, parameter_count>& p, double current, double v_m,
                              const Reading& reading) {
  const double base = 1.0 + std::exp(p[a1] * v_m);
  const double gain = p[k2] * (logistic(p[a2] * (current + p[I0])) - logistic(p[a2] * p[I0]));
  const double widening = p[k3] * (logistic(p[a3] * (current + p[I1])) - logistic(p[a3] * p[I1]));
  const double at_rest = reading.inverse ? p[f0] / base : p[f0] * base;
  Characteristic c{};
  c.f_t = reading.force_restored ? at_rest * (1.0 + gain) : at_rest + gain;
  c.v_h = p[k4] * v_m * (reading.width_restored ? 1.0 + widening : widening);
  c.steepness = p[a0] / (1.0 + p[k0] * v_m);
  c.k_vc = p[k1c] * std::exp(-p[a4] * v_m);
  c.k_ve = p[k1e] * std::exp(-p[a4] * v_m);
  c.f_d = p[k5] * c.f_t;
  c.v_d = p[k6] * v_m;
  return c;
}
Characteristic of_wang(const std::array<double, parameter_count>& p, double current, double v_m) {
  return characteristic(p, current, v_m, readings[std::size(readings) - 1]);
}

std::string recording_name(double current) { return fmt::format("{:.1f}A.csv", current); }

// The damper of the tables on its sine, the displacement as a sensor would give it; noise on the force.
Recording measured(const Row& row) {
  std::vector<double> parameters(row.values.begin(), row.values.end());
  parameters.push_back(rounding);
  Recording recording =
      sine_recording(make_model(law, {}), parameters, recording_name(row.current),
                     {nelder_mead::amplitude, nelder_mead::frequency, row.current, DriveKind::current}, noise_share);
  const Stream stream = Stream(1).child("displacement sensor").child(recording.file);
  for (std::size_t k = 0; k < recording.size(); ++k) {
    recording.displacement[k] += sensor_noise * nelder_mead::amplitude * stream.normal(k);
  }
  return recording;
}

// The middle four fifths of the stretch that moves: the rig rests before and after its sine.
Recording moving_part(const Recording& recording) {
  double fastest = 0.0;
  for (const double v : recording.velocity) fastest = std::max(fastest, std::fabs(v));
  const auto moves = [&](double v) { return std::fabs(v) > 0.5 * fastest; };
  const auto first = std::ranges::find_if(recording.velocity, moves) - recording.velocity.begin();
  const auto last =
      std::find_if(recording.velocity.rbegin(), recording.velocity.rend(), moves).base() - recording.velocity.begin();
  const auto margin = (last - first) / 10;
  Recording cut = recording;
  for (std::vector<double>* channel : channels_of(cut)) {
    if (channel->empty()) continue;
    *channel = std::vector<double>(channel->begin() + first + margin, channel->begin() + last - margin);
  }
  return cut;
}

std::vector<Recording> press_recordings() {
  const DatasetEntry* entry = find_dataset(press);
  std::vector<Recording> result;
  for (const Recording& recording : entry->generate(Stream(1).child(entry->id)).recordings) {
    if (recording.file.find(press_motion) != std::string::npos) result.push_back(moving_part(recording));
  }
  return result;
}

std::array<double, parameter_count> parameters_of(const RunRecord& run) {
  const json p = json::parse(run.parameters);
  std::array<double, parameter_count> result{};
  for (std::size_t k = 0; k < names.size(); ++k) result[k] = p.at(names[k]).get<double>();
  return result;
}

// Residual of a run on its own recordings over its root mean square.
std::vector<double> standardised_residual(const Plan& plan, std::size_t problem, const RunRecord& run) {
  const StudyProblem& own = plan.problems[problem];
  std::vector<double> result;
  for (const Recording& recording : own.recordings) {
    const std::vector<double> force = predict(own.layout.model(), own.layout.held(), own.layout.terms(run.best),
                                              make_target(recording, plan.study.objective));
    double sum = 0.0;
    std::vector<double> residual;
    for (std::size_t n = 0; n < force.size(); ++n) {
      residual.push_back(recording.force[n] - force[n]);
      sum += residual.back() * residual.back();
    }
    const double rms = std::sqrt(sum / static_cast<double>(force.size()));
    for (const double value : residual) result.push_back(value / rms);
  }
  return result;
}

double moment(const std::vector<double>& values, int power) {
  double sum = 0.0;
  for (const double value : values) sum += std::pow(value, power);
  return sum / static_cast<double>(values.size());
}

}  // namespace

Study nelder_mead_tables(const ReproduceOptions& options) {
  Study study = round_trip(options, "nelder-mead-tables");
  study.objective.tolerance = 1e-4;
  study.solvers = {{"nelder-mead", "nelder-mead", {}, 0}};
  ModelSpec model = model_on(law, law, {"simulated", "press"});
  model.layout.fix["a_s"] = rounding;
  // A box that holds what the tables print for 0.1 to 0.5 A. At 0 A a2, a3, k2, k3, I0 and I1 have no effect.
  model.layout.bounds = {{"f0", {1.0, 1e3}},      {"a0", {50.0, 2e4}},    {"a1", {-200.0, 200.0}},
                         {"a2", {0.01, 20.0}},    {"a3", {-20.0, 100.0}}, {"a4", {-100.0, 100.0}},
                         {"k0", {1.0, 2e3}},      {"k1c", {0.0, 200.0}},  {"k1e", {0.0, 200.0}},
                         {"k2", {-200.0, 100.0}}, {"k3", {-5.0, 5.0}}};
  study.models = {model};
  ModelSpec joint = model_on("one set", law, {"press, all"});
  joint.layout = model.layout;
  joint.layout.bounds["f0"] = {1.0, 2e3};
  joint.layout.bounds["k2"] = {-0.9, 100.0};
  study.models.push_back(joint);
  DataSpec simulated;
  simulated.label = "simulated";
  simulated.each = true;
  for (const Row& row : nelder_mead::rows) {
    const Recording recording = measured(row);
    simulated.made.push_back(with_motion_of(fit_sine(recording), recording));
  }
  DataSpec one_by_one;
  one_by_one.label = "press";
  one_by_one.each = true;
  for (const Recording& recording : press_recordings()) {
    one_by_one.made.push_back(with_motion_of(fit_sine(recording), recording));
  }
  DataSpec together = one_by_one;
  together.label = "press, all";
  together.each = false;
  study.data = {simulated, one_by_one, together};
  return study;
}

Reproduction nelder_mead_tables_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  const double v_m = 2.0 * std::numbers::pi * nelder_mead::frequency * nelder_mead::amplitude;

  // ---- readings
  StudyTable reading_table{
      "nelder-mead-readings",
      "Readings of equations (4) and (5) on the printed tables",
      "f_t in N and the loop's half width over the peak speed, |v_h| / v_m, at the six currents (1 Hz, "
      "2.5 mm, v_m = 15.7 mm/s). The force of a magnetorheological damper rises with the current and "
      "its loops are open.",
      {"reading"},
      {}};
  for (const Row& row : nelder_mead::rows) reading_table.header.push_back(fmt::format("f_t, {:.1f} A", row.current));
  for (const Row& row : nelder_mead::rows) reading_table.header.push_back(fmt::format("width, {:.1f} A", row.current));
  reading_table.header.emplace_back("f_t rises");
  reading_table.header.emplace_back("open loops");
  std::vector<std::string> sensible;
  std::string others;
  for (const Reading& reading : readings) {
    std::vector<std::string> cells{reading.name};
    std::vector<std::string> widths;
    std::size_t rises = 0;
    std::size_t open = 0;
    double before = 0.0;
    for (const Row& row : nelder_mead::rows) {
      const Characteristic c = characteristic(row.values, row.current, v_m, reading);
      cells.push_back(format_number(c.f_t, 3));
      widths.push_back(fmt::format("{:.2f}", std::fabs(c.v_h) / v_m));
      rises += row.current > 0.0 && c.f_t > before ? 1 : 0;
      open += std::fabs(c.v_h) > 0.01 * v_m ? 1 : 0;
      before = c.f_t;
    }
    cells.insert(cells.end(), widths.begin(), widths.end());
    cells.push_back(fmt::format("{} of 5 steps", rises));
    cells.push_back(fmt::format("{} of 6", open));
    if (rises == 5 && open == 6) {
      sensible.emplace_back(reading.name);
    } else {
      others += fmt::format("{}{}: {} of 5 steps rise, {} of 6 loops are open", others.empty() ? "" : "; ",
                            reading.name, rises, open);
    }
    reading_table.rows.push_back(std::move(cells));
  }
  result.tables.push_back(std::move(reading_table));

  // ---- sine
  StudyTable sines{"nelder-mead-sine",
                   "The sine fitted to the displacement first",
                   "Simulated displacement with 0.5 % sensor noise; below, the measured damper.",
                   {"recording", "amplitude true [mm]", "fitted", "frequency true [Hz]", "fitted", "phase true [rad]",
                    "fitted", "left, RMS [mm]"},
                   {}};
  double worst_amplitude = 0.0;
  for (const Row& row : nelder_mead::rows) {
    const SineFit sine = fit_sine(measured(row));
    const double phase = sine.phase > std::numbers::pi ? sine.phase - 2.0 * std::numbers::pi : sine.phase;
    sines.rows.push_back({fmt::format("{:.1f} A", row.current), "2.500", fmt::format("{:.4f}", 1e3 * sine.amplitude),
                          "1", fmt::format("{:.5f}", sine.frequency), "0", fmt::format("{:.4f}", phase),
                          format_number(1e3 * sine.rms, 3)});
    worst_amplitude = std::max(worst_amplitude, std::fabs(sine.amplitude / nelder_mead::amplitude - 1.0));
  }
  for (const Recording& recording : press_recordings()) {
    const SineFit sine = fit_sine(recording);
    sines.rows.push_back({recording.file.substr(0, recording.file.rfind('.')), "-",
                          fmt::format("{:.4f}", 1e3 * sine.amplitude), "-", fmt::format("{:.5f}", sine.frequency), "-",
                          fmt::format("{:.4f}", sine.phase), format_number(1e3 * sine.rms, 3)});
  }
  result.tables.push_back(std::move(sines));

  // ---- tables 1 and 2, and what of them acts
  std::vector<StudyTable> published{
      {"nelder-mead-table-1",
       "Table 1: physical constants, published (p) and obtained (o)",
       "The best of the seeds. At one current and one sine seven combinations act, so that these need not agree.",
       {""},
       {}},
      {"nelder-mead-table-2", "Table 2: hysteresis parameters, published (p) and obtained (o)", "", {""}, {}}};
  StudyTable acting{"nelder-mead-characteristic",
                    "What acts: the quantities of equations (4) to (8)",
                    "Published: from the printed tables in the form of Wang et al.",
                    {""},
                    {}};
  for (const Index k : table_1) published[0].rows.push_back({names[k]});
  for (const Index k : table_2) published[1].rows.push_back({names[k]});
  for (const char* name : characteristic_names) acting.rows.push_back({name});
  acting.rows.push_back({"NRMSE"});
  double worst_sixteen = 0.0;
  double worst_acting = 0.0;
  std::vector<double> errors;
  std::vector<double> residual;
  for (const Row& row : nelder_mead::rows) {
    const std::size_t problem = problem_index(plan, fmt::format("{} @ simulated/{:.1f}A", law, row.current));
    const RunRecord* run = problem < plan.problems.size() ? best_run(plan, records, problem) : nullptr;
    if (run == nullptr) continue;
    const auto own = parameters_of(*run);
    for (StudyTable* table : {&published[0], &published[1], &acting}) {
      table->header.push_back(fmt::format("{:.1f} A p", row.current));
      table->header.emplace_back("o");
    }
    const auto add = [&](StudyTable& table, const std::array<Index, 8>& rows) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        table.rows[k].push_back(fmt::format("{:g}", row.values[rows[k]]));
        table.rows[k].push_back(format_number(own[rows[k]], 3));
        worst_sixteen = std::max(worst_sixteen, std::fabs(own[rows[k]] / row.values[rows[k]] - 1.0));
      }
    };
    add(published[0], table_1);
    add(published[1], table_2);
    const auto truth = shown(of_wang(row.values, row.current, v_m));
    const auto found = shown(of_wang(own, row.current, v_m));
    for (std::size_t k = 0; k < truth.size(); ++k) {
      acting.rows[k].push_back(format_number(truth[k], 3));
      acting.rows[k].push_back(format_number(found[k], 3));
      worst_acting = std::max(worst_acting, std::fabs(found[k] / truth[k] - 1.0));
    }
    acting.rows.back().emplace_back("0.010 noise");
    acting.rows.back().push_back(format_number(*run->nrmse, 3));
    errors.push_back(*run->nrmse);
    const std::vector<double> rest = standardised_residual(plan, problem, *run);
    residual.insert(residual.end(), rest.begin(), rest.end());
  }
  for (StudyTable& table : published) result.tables.push_back(std::move(table));
  result.tables.push_back(std::move(acting));

  // ---- measured damper
  StudyTable real{"nelder-mead-press",
                  "The same on a measured damper",
                  "utfsm-mr-damper, 2 mm at 5 Hz, the middle of its sine, on the fitted one. NRMSE of sixteen "
                  "parameters for each current, and of "
                  "one set for all five.",
                  {"recording", "NRMSE, a set each", "NRMSE, one set"},
                  {}};
  std::vector<double> measured_residual;
  const std::size_t joint_problem = problem_index(plan, "one set @ press, all");
  const RunRecord* joint = joint_problem < plan.problems.size() ? best_run(plan, records, joint_problem) : nullptr;
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    const StudyProblem& problem = plan.problems[p];
    if (!problem.data.starts_with("press/")) continue;
    const RunRecord* run = best_run(plan, records, p);
    if (run == nullptr) continue;
    const std::vector<double> rest = standardised_residual(plan, p, *run);
    measured_residual.insert(measured_residual.end(), rest.begin(), rest.end());
    real.rows.push_back(
        {problem.data.substr(problem.data.find('/') + 1), format_number(*run->nrmse, 3),
         joint == nullptr ? "-" : format_number(nrmse_on(plan, joint_problem, *joint, problem.recordings.front()), 3)});
  }
  if (!real.rows.empty()) result.tables.push_back(std::move(real));

  // ---- residual
  StudyTable histogram{"nelder-mead-histogram",
                       "Residual histogram (figure 6)",
                       "Share of the samples, all currents together, by residual over its root mean square.",
                       {"residual / RMS", "normal", "simulated", "measured damper"},
                       {}};
  const boost::math::normal normal;
  constexpr double edges[] = {-3.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0};
  const auto share = [](const std::vector<double>& values, double low, double high) {
    const auto inside = std::ranges::count_if(values, [&](double v) { return v >= low && v < high; });
    return values.empty() ? std::string("-")
                          : fmt::format("{:.3f}", static_cast<double>(inside) / static_cast<double>(values.size()));
  };
  for (std::size_t k = 0; k <= std::size(edges); ++k) {
    const double low = k == 0 ? -1e300 : edges[k - 1];
    const double high = k == std::size(edges) ? 1e300 : edges[k];
    const double expected = (k == std::size(edges) ? 1.0 : cdf(normal, high)) - (k == 0 ? 0.0 : cdf(normal, low));
    histogram.rows.push_back({k == 0                  ? fmt::format("below {:g}", high)
                              : k == std::size(edges) ? fmt::format("{:g} and more", low)
                                                      : fmt::format("{:g} to {:g}", low, high),
                              fmt::format("{:.3f}", expected), share(residual, low, high),
                              share(measured_residual, low, high)});
  }
  result.tables.push_back(std::move(histogram));
  StudyTable plot{"nelder-mead-quantiles",
                  "Normal quantile-quantile plot (figure 7)",
                  "Quantiles of residual / RMS against those of the normal distribution: on a straight line when it is "
                  "normal.",
                  {"share below", "normal", "simulated", "measured damper"},
                  {}};
  for (const double p : {0.001, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99, 0.999}) {
    plot.rows.push_back({fmt::format("{:g}", p), fmt::format("{:.2f}", boost::math::quantile(normal, p)),
                         residual.empty() ? "-" : fmt::format("{:.2f}", quantile(residual, p)),
                         measured_residual.empty() ? "-" : fmt::format("{:.2f}", quantile(measured_residual, p))});
  }
  result.tables.push_back(std::move(plot));

  std::string chosen;
  for (const std::string& name : sensible) chosen += (chosen.empty() ? "\"" : ", \"") + name + "\"";
  result.findings.push_back(
      fmt::format("Readings with which the printed parameters give a transition force that rises at every step of the "
                  "current and an "
                  "open loop at every current: {}. {}. Used is f_t = f0 (1 + e^(a1 v_m)) (1 + k2 (...)), v_h = k4 v_m "
                  "(1 + k3 (...)).",
                  chosen.empty() ? "none" : chosen, others));
  result.findings.push_back(
      fmt::format("The sine comes back with an amplitude within {} %.", format_number(100.0 * worst_amplitude, 2)));
  if (!errors.empty()) {
    result.findings.push_back(fmt::format(
        "Sixteen parameters at one current: NRMSE {} to {} (noise 0.010), the characteristic quantities within {} %, "
        "the "
        "sixteen off by up to {} %: the tables of the paper are one of many equivalent sets for each current.",
        format_number(std::ranges::min(errors), 3), format_number(std::ranges::max(errors), 3),
        format_number(100.0 * worst_acting, 2), format_number(100.0 * worst_sixteen, 2)));
  }
  if (!residual.empty() && !measured_residual.empty()) {
    result.findings.push_back(
        fmt::format("Kurtosis of the residual (normal: 3): {} simulated, {} on the measured damper; skewness (normal: "
                    "0) {} and {}.",
                    format_number(moment(residual, 4), 3), format_number(moment(measured_residual, 4), 3),
                    format_number(moment(residual, 3), 2), format_number(moment(measured_residual, 3), 2)));
    result.findings.push_back(
        "On simulated recordings the residual is normal because the noise put in is. That a straight quantile plot "
        "shows "
        "the error to be random, as the paper says, does not follow: it does not see the order of the samples.");
  }
  result.remade.push_back(
      "Sine of the displacement by Nelder-Mead first (amplitude, frequency, phase), sixteen parameters by Nelder-Mead "
      "at "
      "each of six currents, 1 Hz and 2.5 mm, sum of squares.");
  result.not_remade.push_back(
      "The recordings are not public: simulated from the printed tables in the form of Wang et al., with 1 % noise on "
      "the "
      "force. The printed loops are figures without numbers; what is compared is what a figure of them must show.");
  result.not_remade.push_back(
      "The equation of the force is not in the text: F = f_t tanh(alpha (v - v_d + v_h) / 2) (1 + k_v |v|) + f_d of "
      "the "
      "quoted source is used, with k_vc at positive and k_ve at negative velocity. The sign of v_d is not printed "
      "either; "
      "the other sign mirrors k6.");
  result.not_remade.push_back(
      "Start and stopping of the paper's simplex are not printed; here the start is drawn in a box that holds the "
      "tables, "
      "and a collapsed simplex is restarted until the budget is used.");
  result.not_remade.push_back(
      "At 0.3 A the printed I0 and I1 look exchanged against their neighbours; used as printed.");
  return result;
}

}  // namespace hysteron::reproduce
