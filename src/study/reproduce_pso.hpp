// What the tables and figures of the PSO paper share.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "study/reproduce.hpp"

namespace hysteron::reproduce::pso {

inline constexpr const char* full_model = "modified-bouc-wen+offset-force";

// The model with a box that holds what the paper found, and held what it holds: the published k0 is negative in 45 of
// 55 conditions, n = 1 and x0 = 0 are its constants. Measured dampers want a larger share than the card allows.
[[nodiscard]] ModelSpec model_spec(const std::string& label, const ReproduceOptions& options);
// Title, data (conditions of the twin by name, all when empty; or the recordings given), budget and seeds.
[[nodiscard]] Study base(const ReproduceOptions& options, const std::string& title,
                         const std::vector<std::string>& conditions);
// Whether the study is on the twin, not on recordings given.
[[nodiscard]] bool on_twin(const Plan& plan);
// beta, gamma, A, k1, k0, c0, c1, f0 of a run of the full model with n = 1, at the paper's alpha of 80.
[[nodiscard]] std::array<double, 8> paper_parameters(const RunRecord& run);
// What the median force errors of third order say, through the conditions and fitted to all at once (figure 9).
[[nodiscard]] std::string sentence_of_third_order(double through, double jointly);
// What is and is not as published in everything that is made on the twin or on recordings given, whatever the solver.
void say_of_data(const Plan& plan, Reproduction& result);
// That a figure whose subject (`about`) is no solver is not made by the paper's.
void say_of_descents(const Plan& plan, std::string_view about, Reproduction& result);

}  // namespace hysteron::reproduce::pso
