// Cost of one march per candidate, for every model of the catalogue and every scalar type. Items are candidates.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "simulate/composite.hpp"

namespace hysteron {
namespace {

Motion sine(std::size_t samples, double rate) {
  std::vector<double> time(samples);
  std::vector<double> x(samples);
  std::vector<double> v(samples);
  constexpr double omega = 2.0 * std::numbers::pi * 2.0;
  for (std::size_t n = 0; n < samples; ++n) {
    time[n] = static_cast<double>(n) / rate;
    x[n] = 0.025 * std::sin(omega * time[n]);
    v[n] = 0.025 * omega * std::cos(omega * time[n]);
  }
  return make_motion(time, x, v, {});
}

template <class T>
void march_model(benchmark::State& bench, const Part* part) {
  constexpr std::size_t samples = 1000;
  const Motion motion = sine(samples, 1000.0);
  CompositeModel model;
  model.law = part;
  std::vector<T> parameters;
  for (const Parameter& parameter : part->parameters) {
    parameters.emplace_back(parameter.initial);
  }
  std::vector<T> state(16);
  std::vector<T> force(samples);
  for (auto _ : bench) {
    std::fill(state.begin(), state.end(), T(0.0));
    model.march<T>(motion, parameters.data(), 0, 0, samples, state.data(), force.data());
    benchmark::DoNotOptimize(force.data());
    benchmark::ClobberMemory();
  }
  constexpr int candidates = std::is_same_v<T, double> ? 1 : lane_count;
  bench.SetItemsProcessed(bench.iterations() * candidates);
}

}  // namespace
}  // namespace hysteron

int main(int argc, char** argv) {
  for (const hysteron::Part* part : hysteron::model_catalogue()) {
    const std::string id(part->id);
    benchmark::RegisterBenchmark((id + "/double").c_str(), hysteron::march_model<double>, part);
    benchmark::RegisterBenchmark((id + "/lanes").c_str(), hysteron::march_model<hysteron::Lanes>, part);
    benchmark::RegisterBenchmark((id + "/dual").c_str(), hysteron::march_model<hysteron::LaneDual>, part);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
