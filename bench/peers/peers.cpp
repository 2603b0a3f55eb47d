// CPU time to target of one identification by Hysteron, pagmo2, NLopt and (read back from scipy_peers.py) SciPy.
//   Modified Bouc-Wen, 8 free parameters in Hysteron's box, N = 1000 samples at 1 kHz, 2 Hz 25 mm sine that starts from
//   rest (amplitude ramped over 0.125 s), 1 % white force noise. Target: NRMSE <= 1.01 x NRMSE at the true parameters.
// Two objectives: the one a user of a general library writes (plain_rk4.h, scalar, one RK4 step a sample) and
// Hysteron's own, for the peers with one candidate a call. Every method has the same budget and is started again from
// its next seed when it stops by itself. One thread; CPU time of that thread. See run.sh.
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <nlopt.hpp>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/peers/plain_twin.hpp"
#include "bench/program.hpp"
#include "fit/driver.hpp"
#include "fit/objective.hpp"
#include "pagmo_peers.hpp"

namespace hysteron::peers {
namespace {

using bench::cpu_seconds;

constexpr std::size_t sample_count = 1000;
constexpr double sampling = 1e-3;     // s
constexpr double frequency = 2.0;     // Hz
constexpr double amplitude = 0.025;   // m
constexpr double ramp = 0.125;        // s
constexpr double noise_share = 0.01;  // of the peak force
constexpr double target_factor = 1.01;

Recording make_recording() {
  Recording recording;
  recording.file = "peers.csv";
  recording.velocity_measured = true;
  const double omega = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < sample_count; ++n) {
    const double t = static_cast<double>(n) * sampling;
    const double r = std::min(t / ramp, 1.0);
    const double envelope = r * r * (3.0 - 2.0 * r);
    const double slope = 6.0 * r * (1.0 - r) / ramp;
    recording.time.push_back(t);
    recording.displacement.push_back(amplitude * envelope * std::sin(omega * t));
    recording.velocity.push_back(amplitude * (envelope * omega * std::cos(omega * t) + slope * std::sin(omega * t)));
  }
  const CompositeModel model = make_model("modified-bouc-wen", {});
  // Finer integration than either objective uses.
  recording.force =
      simulate(model, make_motion(recording.time, recording.displacement, recording.velocity, {}, 1e-9), truth);
  add_noise(recording, noise_share, Stream(1).child("peers").child("noise"));
  return recording;
}

struct Outcome {
  bool success = false;
  std::size_t evaluations = 0;  // to the target, or all
  double seconds = 0.0;
  double best = std::numeric_limits<double>::infinity();
};

struct Stop {};  // thrown through a method once the target or the budget is reached

// Counts and times a scalar objective; throws Stop when there is nothing left to do.
class Meter {
 public:
  Meter(ScalarObjective objective, double target, std::size_t budget)
      : objective_(std::move(objective)), target_(target), budget_(budget), begun_(cpu_seconds()) {}

  double operator()(const double* unit) {
    if (finished()) {
      throw Stop{};
    }
    const double cost = objective_(unit);
    ++outcome_.evaluations;
    outcome_.best = std::min(outcome_.best, cost);
    if (cost <= target_ || outcome_.evaluations >= budget_) {
      outcome_.success = cost <= target_;
      outcome_.seconds = cpu_seconds() - begun_;
      throw Stop{};
    }
    return cost;
  }

  [[nodiscard]] bool finished() const { return outcome_.success || outcome_.evaluations >= budget_; }
  [[nodiscard]] std::size_t left() const { return budget_ - outcome_.evaluations; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }

 private:
  ScalarObjective objective_;
  double target_;
  std::size_t budget_;
  double begun_;
  Outcome outcome_;
};

// Restarts `once(attempt, objective, evaluations left)` until target or budget.
template <class Once>
Outcome measure(const ScalarObjective& objective, double target, std::size_t budget, Once&& once) {
  Meter meter(objective, target, budget);
  const ScalarObjective metered = [&meter](const double* unit) { return meter(unit); };
  for (std::uint32_t attempt = 0; !meter.finished(); ++attempt) {
    const std::size_t before = meter.outcome().evaluations;
    try {
      once(attempt, metered, meter.left());
    } catch (const Stop&) {
      break;
    }
    if (meter.outcome().evaluations == before) {
      throw std::runtime_error("a method stopped without evaluating anything");
    }
  }
  return meter.outcome();
}

struct Setup {
  Recording recording;
  Layout layout;
  Objective objective;
  plain_problem plain;
  double plain_target;
  double own_target;
};

Setup make_setup() {
  Recording recording = make_recording();
  const Layout layout(make_model("modified-bouc-wen", {}), scale_of({recording}), {});
  ObjectiveOptions options;
  options.threads = 1;
  Objective objective(layout, {recording}, options);
  Setup setup{std::move(recording), layout, std::move(objective), {}, 0.0, 0.0};
  setup.plain = plain_problem_of(setup.recording, setup.layout);
  const std::vector<double> at_truth = truth_in(layout);
  setup.plain_target = target_factor * plain_residuals(&setup.plain, at_truth.data(), nullptr);
  setup.own_target = target_factor * setup.objective.evaluate({at_truth, false}).cost[0];
  return setup;
}

// What scipy_peers.py reads: one number a line after a word, then the samples.
void write_problem(const Setup& setup, const std::string& folder, std::size_t seeds, std::size_t budget) {
  std::ofstream box(folder + "/problem.csv");
  box << fmt::format("target,{}\nnormaliser,{}\nseeds,{}\nbudget,{}\n", setup.plain_target, setup.plain.normaliser,
                     seeds, budget);
  for (std::size_t k = 0; k < plain_dimension; ++k) {
    box << fmt::format("box,{},{},{}\n", setup.plain.lower[k], setup.plain.upper[k], setup.plain.logarithmic[k]);
  }
  std::ofstream data(folder + "/data.csv");
  data << "time [s],displacement [m],velocity [m/s],force [N]\n";
  for (std::size_t n = 0; n < setup.recording.size(); ++n) {
    data << fmt::format("{},{},{},{}\n", setup.recording.time[n], setup.recording.displacement[n],
                        setup.recording.velocity[n], setup.recording.force[n]);
  }
  if (!box || !data) {
    throw std::runtime_error("cannot write into " + folder);
  }
}

// A Hysteron solver with requests of any size answered by `evaluate`.
Outcome run_own(const SolverEntry& entry, const Evaluate& evaluate, const Layout& layout, double target,
                std::size_t budget, std::uint64_t seed) {
  Outcome outcome;
  const double begun = cpu_seconds();
  for (std::uint64_t attempt = 0; !outcome.success && outcome.evaluations < budget; ++attempt) {
    Problem problem;
    problem.dimension = layout.dimension();
    problem.budget = budget - outcome.evaluations;
    problem.stream = Stream(seed).child("peers").child(entry.id).child(attempt);
    problem.linear = layout.linear();
    problem.screening = true;
    const RunResult run =
        run_solver(entry, problem, evaluate, [&](const RunResult& partial) { return partial.cost > target; });
    if (run.evaluations == 0) {
      break;
    }
    outcome.best = std::min(outcome.best, run.cost);
    outcome.success = run.cost <= target;
    // Whole generations are evaluated at once: the count includes the rest of the last one, as the time does.
    outcome.evaluations += run.evaluations;
  }
  outcome.seconds = cpu_seconds() - begun;
  return outcome;
}

void run_nlopt(nlopt::algorithm algorithm, std::uint64_t seed, std::uint32_t attempt, const ScalarObjective& objective,
               std::size_t budget) {
  struct Call {
    const ScalarObjective* objective;
    bool stopped = false;
  } call{&objective};
  const auto evaluate = [](unsigned /*n*/, const double* x, double* /*gradient*/, void* data) {
    auto* own = static_cast<Call*>(data);
    try {
      return (*own->objective)(x);
    } catch (const Stop&) {
      own->stopped = true;
      throw nlopt::forced_stop();
    }
  };
  nlopt::srand(1000 * seed + attempt + 1);
  nlopt::opt method(algorithm, plain_dimension);
  method.set_lower_bounds(0.0);
  method.set_upper_bounds(1.0);
  method.set_min_objective(evaluate, &call);
  method.set_maxeval(static_cast<int>(budget) + 1);
  if (algorithm == nlopt::G_MLSL) {
    nlopt::opt local(nlopt::LN_BOBYQA, plain_dimension);
    local.set_ftol_rel(1e-6);
    local.set_xtol_rel(1e-5);
    method.set_local_optimizer(local);
  } else {
    method.set_ftol_rel(1e-8);
  }
  const Stream stream = Stream(seed).child("peers").child("nlopt").child(attempt);
  std::vector<double> x;
  for (std::uint32_t k = 0; k < plain_dimension; ++k) {
    x.push_back(stream.uniform(k));
  }
  double best = 0.0;
  try {
    method.optimize(x, best);
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {
  }
  if (call.stopped) {
    throw Stop{};
  }
}

RunPagmo load_pagmo(const std::string& program) {
  const auto slash = program.rfind('/');
  const std::string module = (slash == std::string::npos ? "./" : program.substr(0, slash + 1)) + HYSTERON_PAGMO_MODULE;
  void* library = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* symbol = library == nullptr ? nullptr : dlsym(library, run_pagmo_symbol);
  if (symbol == nullptr) {
    throw std::runtime_error(std::string("cannot load the pagmo module: ") + dlerror());
  }
  RunPagmo run = nullptr;
  std::memcpy(&run, &symbol, sizeof run);
  return run;
}

enum Column { plain_column, own_column, column_count };

struct Row {
  std::string method;
  std::vector<Outcome> outcomes[column_count];  // empty: not run
};

template <class Get>
std::optional<double> median(const std::vector<Outcome>& outcomes, Get&& get) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes) {
    values.push_back(outcome.success ? get(outcome) : std::numeric_limits<double>::infinity());
  }
  if (values.empty()) {
    return {};
  }
  std::ranges::sort(values);
  const double result = values[values.size() / 2];
  return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

std::optional<double> median_seconds(const std::vector<Outcome>& outcomes) {
  return median(outcomes, [](const Outcome& outcome) { return outcome.seconds; });
}

std::string shown(const std::optional<double>& value, double factor, const char* digits) {
  return value ? fmt::format(fmt::runtime(digits), *value * factor) : "-";
}

std::string ratio(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? fmt::format("{:.3g}", *a / *b) : "-";
}

const Row* find_row(const std::vector<Row>& rows, const std::string& method) {
  const auto found = std::ranges::find_if(rows, [&](const Row& row) { return row.method == method; });
  return found == rows.end() ? nullptr : &*found;
}

std::string table_of(const std::vector<Row>& rows, const Setup& setup, std::size_t seeds, std::size_t budget) {
  std::string text = fmt::format(
      "Time to target of one identification, one thread, CPU time; {} seeds, budget {} evaluations a run.\n"
      "Modified Bouc-Wen, {} free parameters, {} samples at 1 kHz, 2 Hz 25 mm sine, 1 % noise; target: {} x NRMSE at\n"
      "the true parameters ({:.6f} with the plain objective, {:.6f} with Hysteron's).\n"
      "Medians count a failed run as infinite; - means that half of the runs or more failed, or that the pair does "
      "not\n"
      "exist. An evaluation with derivatives counts as 1 + {} evaluations. Hysteron's own solvers use its objective "
      "in\n"
      "packs of eight; all others call it with one candidate at a time.\n\n",
      seeds, budget, setup.layout.dimension(), setup.recording.size(), target_factor,
      setup.plain_target / target_factor, setup.own_target / target_factor, setup.layout.dimension());
  text +=
      "| method | plain RK4: success | evaluations | ms | x multistart-lm | Hysteron's objective: success | "
      "evaluations "
      "| ms | x multistart-lm |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  const Row* reference = find_row(rows, "hysteron multistart-lm");
  const auto unit = reference == nullptr ? std::optional<double>() : median_seconds(reference->outcomes[own_column]);
  for (const Row& row : rows) {
    text += "| " + row.method;
    for (const auto& outcomes : row.outcomes) {
      if (outcomes.empty()) {
        text += " | | | | ";
        continue;
      }
      const auto successes = std::ranges::count_if(outcomes, [](const Outcome& outcome) { return outcome.success; });
      const auto seconds = median_seconds(outcomes);
      text += fmt::format(
          " | {}/{} | {} | {} | {}", successes, outcomes.size(),
          shown(median(outcomes, [](const Outcome& o) { return static_cast<double>(o.evaluations); }), 1.0, "{:.0f}"),
          shown(seconds, 1e3, "{:.3g}"), ratio(seconds, unit));
    }
    text += " |\n";
  }
  const Row* own = find_row(rows, "hysteron pso");
  const Row* other = find_row(rows, "pagmo2 pso");
  if (own != nullptr && other != nullptr) {
    const auto on = [&](auto column) {
      return ratio(median_seconds(other->outcomes[column]), median_seconds(own->outcomes[column]));
    };
    text += fmt::format(
        "\npagmo2 pso / hysteron pso on the same objective: {} on the plain one; {} on Hysteron's, which pagmo2 asks "
        "one "
        "candidate a call and Hysteron in packs of eight\n",
        on(plain_column), on(own_column));
  }
  std::optional<double> fastest;
  std::string name;
  for (const Row& row : rows) {
    if (row.method.starts_with("hysteron")) {
      continue;
    }
    for (const auto& outcomes : row.outcomes) {
      const auto seconds = median_seconds(outcomes);
      if (seconds && (!fastest || *seconds < *fastest)) {
        fastest = seconds;
        name = row.method + (&outcomes == &row.outcomes[plain_column] ? ", plain objective" : ", Hysteron's objective");
      }
    }
  }
  text += fmt::format("fastest peer / hysteron multistart-lm: {} ({})\n", ratio(fastest, unit), name);
  return text;
}

// method,seed,success,evaluations,seconds,best
void read_rows(const std::string& path, std::vector<Row>& rows) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string cell[6];
    for (std::string& text : cell) {
      std::getline(cells, text, ',');
    }
    if (find_row(rows, cell[0]) == nullptr) {
      rows.push_back({cell[0], {}});
    }
    auto& row = *std::ranges::find_if(rows, [&](const Row& candidate) { return candidate.method == cell[0]; });
    row.outcomes[plain_column].push_back({cell[2] == "1", std::stoul(cell[3]), std::stod(cell[4]), std::stod(cell[5])});
  }
}

struct Options {
  std::string folder;
  std::string scipy;
  std::string out;
  std::string only;  // methods whose name holds this word; empty: all
  std::size_t seeds = 11;
  std::size_t budget = 60000;
  bool prepare = false;
};

Options parse(int count, char** arguments) {
  Options options;
  for (int k = 1; k < count; ++k) {
    const std::string word = arguments[k];
    if (word == "--prepare") {
      options.prepare = true;
      continue;
    }
    if (k + 1 == count) {
      throw std::runtime_error("unknown or incomplete option " + word + ", see bench/peers/run.sh");
    }
    const std::string value = arguments[++k];
    if (word == "--folder") {
      options.folder = value;
    } else if (word == "--scipy") {
      options.scipy = value;
    } else if (word == "--out") {
      options.out = value;
    } else if (word == "--seeds") {
      options.seeds = std::stoul(value);
    } else if (word == "--only") {
      options.only = value;
    } else if (word == "--budget") {
      options.budget = std::stoul(value);
    } else {
      throw std::runtime_error("unknown option " + word + ", see bench/peers/run.sh");
    }
  }
  return options;
}

void run(int count, char** arguments) {
  const Options options = parse(count, arguments);
  const Setup setup = make_setup();
  if (options.prepare) {
    write_problem(setup, options.folder, options.seeds, options.budget);
    return;
  }
  const RunPagmo run_pagmo = load_pagmo(arguments[0]);
  const ScalarObjective objectives[column_count] = {
      [&](const double* unit) { return plain_residuals(&setup.plain, unit, nullptr); },
      [&](const double* unit) {
        return setup.objective.evaluate({std::vector<double>(unit, unit + plain_dimension), false}).cost[0];
      }};
  const double targets[column_count] = {setup.plain_target, setup.own_target};
  const Evaluate own = [&](const Request& request) { return setup.objective.evaluate(request); };
  const Evaluate plain = [&](const Request& request) {
    Response response;
    for (std::size_t at = 0; at < request.points.size(); at += plain_dimension) {
      response.cost.push_back(objectives[plain_column](request.points.data() + at));
    }
    return response;
  };

  std::vector<Row> rows;
  const auto note = [](const std::string& method) { fmt::print(stderr, "{}\n", method); };
  for (const char* id : {"multistart-lm", "pso", "cma-es", "de", "nelder-mead"}) {
    const SolverEntry* entry = find_solver(id);
    if (entry == nullptr) {
      throw std::runtime_error(std::string("no solver ") + id);
    }
    Row row{std::string("hysteron ") + id, {}};
    if (row.method.find(options.only) == std::string::npos) {
      continue;
    }
    note(row.method);
    for (std::size_t seed = 1; seed <= options.seeds; ++seed) {
      row.outcomes[own_column].push_back(run_own(*entry, own, setup.layout, targets[own_column], options.budget, seed));
      if (!entry->uses_derivatives) {
        row.outcomes[plain_column].push_back(
            run_own(*entry, plain, setup.layout, targets[plain_column], options.budget, seed));
      }
    }
    rows.push_back(std::move(row));
  }
  const auto add_peer = [&](const std::string& method, auto&& once) {
    Row row{method, {}};
    if (method.find(options.only) == std::string::npos) {
      return;
    }
    note(method);
    for (const Column column : {plain_column, own_column}) {
      for (std::size_t seed = 1; seed <= options.seeds; ++seed) {
        row.outcomes[column].push_back(measure(objectives[column], targets[column], options.budget,
                                               [&](std::uint32_t attempt, const ScalarObjective& objective,
                                                   std::size_t left) { once(seed, attempt, objective, left); }));
      }
    }
    rows.push_back(std::move(row));
  };
  for (const char* algorithm : {"cmaes", "pso", "de"}) {
    add_peer(std::string("pagmo2 ") + algorithm, [&](std::size_t seed, std::uint32_t attempt,
                                                     const ScalarObjective& objective, std::size_t left) {
      run_pagmo(algorithm, plain_dimension, left, static_cast<std::uint32_t>(1000 * seed) + attempt, objective);
    });
  }
  const std::pair<const char*, nlopt::algorithm> from_nlopt[] = {{"NLopt CRS2", nlopt::GN_CRS2_LM},
                                                                 {"NLopt MLSL + BOBYQA", nlopt::G_MLSL}};
  for (const auto& [name, algorithm] : from_nlopt) {
    add_peer(name, [&](std::size_t seed, std::uint32_t attempt, const ScalarObjective& objective, std::size_t left) {
      run_nlopt(algorithm, seed, attempt, objective, left);
    });
  }
  if (!options.scipy.empty()) {
    read_rows(options.scipy, rows);
  }
  const std::string text = table_of(rows, setup, options.seeds, options.budget);
  fmt::print("{}", text);
  if (!options.out.empty()) {
    std::ofstream out(options.out);
    out << "# The same identification by other libraries\n\nRe-made by `bench/peers/run.sh --out results/peers.md`. "
           "The "
           "times depend on the machine; the ratios are of one run.\n\n"
        << text;
    if (!out.flush()) {
      throw std::runtime_error("cannot write " + options.out);
    }
  }
}

}  // namespace
}  // namespace hysteron::peers

int main(int count, char** arguments) {
  try {
    hysteron::peers::run(count, arguments);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
