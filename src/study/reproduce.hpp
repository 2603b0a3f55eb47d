// Published tables, made again: the study that does it, and published beside obtained numbers.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/study.hpp"
#include "study/plan.hpp"
#include "study/store.hpp"

namespace hysteron {

struct ReproduceOptions {
  std::size_t seeds = 0;          // 0: the table's default
  std::size_t budget = 0;         // likewise
  std::vector<std::string> data;  // recordings instead of the stand-in, for tables that can
};

// A figure of the paper made again, as an SVG file of its own.
struct ReproducedPicture {
  std::string id;  // name of the file
  std::string title;
  std::string svg;
};

struct Reproduction {
  std::vector<StudyTable> tables;
  std::vector<std::string> findings;    // what the numbers say
  std::vector<std::string> remade;      // what is as published
  std::vector<std::string> not_remade;  // what is not, and why
  std::vector<ReproducedPicture> pictures = {};
};

// Told the share of the work behind the runs that is done.
using Done = std::function<void(double share)>;

struct PublishedTable {
  std::string_view id;
  std::string_view title;
  std::string_view source;
  std::size_t seeds;  // defaults that finish in minutes on two cores
  std::size_t budget;
  bool takes_data;
  Study (*study)(const ReproduceOptions& options);  // with seeds and budget filled in
  // Throws Stopped once the plan's objective is.
  Reproduction (*result)(const Plan& plan, const std::vector<RunRecord>& records, const Done& done);
};

std::span<const PublishedTable> published_tables();
const PublishedTable* find_published_table(std::string_view id);

// For the tables' own files.
namespace reproduce {

// Median and quartiles of the final NRMSE of a (problem, solver), as "0.0102 [0.0101, 0.0104]"; "-" without runs.
[[nodiscard]] std::string spread(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem,
                                 std::size_t solver);
// Median of the same; infinite without runs.
[[nodiscard]] double median_nrmse(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem,
                                  std::size_t solver);
// The run of that median, the lower of two; null without runs that stayed finite.
[[nodiscard]] const RunRecord* median_run(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem,
                                          std::size_t solver);
// The run with the smallest NRMSE of a problem; null without runs.
[[nodiscard]] const RunRecord* best_run(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem);
// Index of the problem with this label; the number of problems where there is none.
[[nodiscard]] std::size_t problem_index(const Plan& plan, const std::string& label);

Study pso_table_v(const ReproduceOptions& options);
Study pso_table_vi(const ReproduceOptions& options);
Study pso_table_vii(const ReproduceOptions& options);
Study pso_table_viii(const ReproduceOptions& options);
Study pso_figure_6(const ReproduceOptions& options);
Study pso_figure_7(const ReproduceOptions& options);
Study pso_figure_8(const ReproduceOptions& options);
Study pso_figure_9(const ReproduceOptions& options);
Study pso_figure_10(const ReproduceOptions& options);
Study pso_figure_11(const ReproduceOptions& options);
Reproduction pso_table_v_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_table_vi_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_table_vii_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_table_viii_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_figure_6_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_figure_7_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_figure_8_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_figure_9_result(const Plan& plan, const std::vector<RunRecord>& records, const Done& done);
Reproduction pso_figure_10_result(const Plan& plan, const std::vector<RunRecord>& records);
Reproduction pso_figure_11_result(const Plan& plan, const std::vector<RunRecord>& records);

Study least_squares_table_2(const ReproduceOptions& options);
Reproduction least_squares_table_2_result(const Plan& plan, const std::vector<RunRecord>& records);
Study lm_table_1(const ReproduceOptions& options);
Reproduction lm_table_1_result(const Plan& plan, const std::vector<RunRecord>& records);
Study nelder_mead_tables(const ReproduceOptions& options);
Reproduction nelder_mead_tables_result(const Plan& plan, const std::vector<RunRecord>& records);
Study review_polynomials(const ReproduceOptions& options);
Reproduction review_polynomials_result(const Plan& plan, const std::vector<RunRecord>& records);

}  // namespace reproduce
}  // namespace hysteron
