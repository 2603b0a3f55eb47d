// Learns the tables that grades are read from (src/diagnose/judge/table_data.cpp) from diagnosed challenges:
//
//   hysteron_learn_grades FOLDER... [--out src/diagnose/judge/table_data.cpp] [--page results/grades.md] [--list]
//
// FOLDER is an --out of `hysteron challenge`, diagnosed. Three logistic functions with weights that are never negative
// are fitted: that a name of the augmented model is in the truth, that it or one that does as well in its place is,
// that physics is missing at all. Names have an offset of their effect besides, which says how often that is found
// where it is not. What calibrates them are the scores of campaigns that a function had not seen: forms
// of effects and foreign causes are dealt to ten parts, and a campaign is scored by the function that was learned from
// the campaigns that hold none of the forms and causes of its part. The log odds of being right rise with these scores
// along three straight pieces, each over a third of them: the lowest third is flatter, as what is unknown looks like
// anything.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/program.hpp"
#include "challenge/score.hpp"
#include "challenge/seal.hpp"
#include "diagnose/judge/features.hpp"
#include "diagnose/judge/speaking.hpp"
#include "diagnose/judge/table.hpp"
#include "diagnose/judge/verdict.hpp"
#include "io/file.hpp"
#include "io/output.hpp"

namespace {

using nlohmann::json;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int parts = 10;
constexpr double ridge = 3.0;  // of standardised weights
constexpr int iterations = 4000;
constexpr std::size_t default_pieces = 3;  // of the log odds over the score
// What the channels of a recording show without a model.
const std::string channel_effect = "velocity-lag";

struct Row {
  std::vector<double> features;
  bool right = false;
  std::set<int> parts;  // of the forms and foreign causes of its campaign
  std::string campaign;
  std::string level;
  std::string id;
  std::string truth;
};

struct Rows {
  std::vector<Row> alone;
  std::vector<Row> names;
  std::vector<Row> missing;
  // Campaigns in which a contrast that needs no model speaks, and of these with the effect it speaks for.
  std::size_t told = 0;
  std::size_t told_rightly = 0;
};

int part_of(const std::string& form) {
  // FNV-1a: the same on every machine.
  std::uint32_t hash = 2166136261U;
  for (const char c : form) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  }
  return static_cast<int>(hash % parts);
}

template <std::size_t N>
std::vector<double> listed(const std::array<double, N>& values) {
  return {values.begin(), values.end()};
}

void read(const std::filesystem::path& folder, Rows& rows) {
  const json answers = hysteron::challenge::open_seal(folder);
  for (const json& answer : answers.at("campaigns")) {
    const std::string name = answer.at("campaign");
    const std::filesystem::path path = folder / "diagnoses" / name / "diagnosis.json";
    if (!std::filesystem::exists(path)) {
      continue;
    }
    const json diagnosis = json::parse(hysteron::read_file(path));
    const hysteron::Evidence evidence = hysteron::evidence_from(diagnosis.at("evidence"));
    if (!evidence.doubt_of_data.empty()) {
      continue;
    }
    std::set<std::string> truth;
    for (const json& id : answer.at("acceptable")) {
      truth.insert(id.get<std::string>());
    }
    Row row;
    row.campaign = folder.filename().string() + "/" + name.substr(name.size() - 4);
    row.level = answer.at("level");
    bool detectable = false;
    for (const json& effect : answer.at("effects")) {
      const std::string id = effect.at("id");
      detectable = detectable || effect.at("detectability").get<double>() >= hysteron::challenge::detectable_from;
      if (effect.at("foreign").get<bool>()) {
        row.truth += " " + id;
        row.parts.insert(part_of(id));
      } else {
        truth.insert(id);
        row.truth += " " + id;
        row.parts.insert(part_of(effect.value("form", id)));
      }
    }
    const std::optional<hysteron::Speaking> channels = hysteron::speaking_for(channel_effect, evidence.signatures);
    if (channels && hysteron::speaks(*channels)) {
      ++rows.told;
      rows.told_rightly += truth.contains(channel_effect) ? 1 : 0;
    }
    const auto add = [&](const hysteron::Candidate& candidate, const hysteron::Evidence& of) {
      row.id = candidate.id;
      row.features = listed(hysteron::alone_features_of(candidate, of));
      row.right = truth.contains(candidate.id);
      rows.alone.push_back(row);
      row.features = listed(hysteron::features_of(candidate, of));
      for (const hysteron::Contender* other : hysteron::equally_good(candidate)) {
        row.right = row.right || truth.contains(other->id);
      }
      rows.names.push_back(row);
    };
    for (const hysteron::Candidate& candidate : evidence.candidates) {
      add(candidate, evidence);
    }
    for (const std::size_t k : hysteron::parts_of_the_law(evidence)) {
      add(evidence.behind_asked.front().candidates[k], evidence.behind_asked.front());
    }
    if (row.level != "wrong-base" && row.level != "beside") {
      row.id = "missing";
      row.features = listed(hysteron::features_of(evidence));
      row.right = detectable;
      rows.missing.push_back(row);
    }
  }
}

struct Logistic {
  double intercept = 0.0;
  Vector weights;
  std::map<std::string, double> offsets;  // of effects

  [[nodiscard]] double score(const Row& row) const {
    const auto offset = offsets.find(row.id);
    return intercept + (offset == offsets.end() ? 0.0 : offset->second) +
           weights.dot(Eigen::Map<const Vector>(row.features.data(), weights.size()));
  }
};

// Penalised maximum likelihood with weights >= 0, by projected gradient descent on standardised features. Offsets of
// effects are normal about zero beforehand, with unit variance.
Logistic learned(const std::vector<const Row*>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  const auto d = static_cast<Eigen::Index>(rows.front()->features.size());
  Matrix x(n, d);
  Vector y(n);
  std::map<std::string, Eigen::Index> effects;
  std::vector<Eigen::Index> effect(rows.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& row = *rows[static_cast<std::size_t>(i)];
    x.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.features.data(), d);
    y[i] = row.right ? 1.0 : 0.0;
    effect[static_cast<std::size_t>(i)] =
        effects.try_emplace(row.id, static_cast<Eigen::Index>(effects.size())).first->second;
  }
  const Eigen::RowVectorXd mean = x.colwise().mean();
  x.rowwise() -= mean;
  const Eigen::RowVectorXd spread = (x.colwise().squaredNorm() / static_cast<double>(n)).cwiseSqrt().cwiseMax(1e-9);
  x.array().rowwise() /= spread.array();
  double intercept = 0.0;
  Vector w = Vector::Zero(d);
  Vector offsets = Vector::Zero(static_cast<Eigen::Index>(effects.size()));
  // Curvature of the likelihood at most: that of all features, of the intercept and of one effect in each row.
  const double step = 4.0 / (static_cast<double>(n) * static_cast<double>(d + 2) + ridge);
  const bool with_offsets = effects.size() > 1;
  for (int k = 0; k < iterations; ++k) {
    Vector s = x * w;
    for (Eigen::Index i = 0; i < n; ++i) {
      s[i] += offsets[effect[static_cast<std::size_t>(i)]];
    }
    const Vector p = ((-s.array() - intercept).exp() + 1.0).inverse();
    const Vector error = p - y;
    intercept -= step * error.sum();
    w -= step * (x.transpose() * error + ridge * w);
    w = w.cwiseMax(0.0);
    Vector slope = offsets;
    for (Eigen::Index i = 0; i < n; ++i) {
      slope[effect[static_cast<std::size_t>(i)]] += error[i];
    }
    offsets -= (with_offsets ? step : 0.0) * slope;
  }
  Logistic result;
  for (const auto& [id, at] : effects) {
    result.offsets[id] = offsets[at];
  }
  result.weights = w.array() / spread.transpose().array();
  result.intercept = intercept - result.weights.dot(mean.transpose());
  return result;
}

bool meets(const std::set<int>& a, int part) { return a.contains(part); }

// Scores of all rows, each by a function that knows none of the forms of one of its parts.
std::vector<double> unseen_scores(const std::vector<Row>& rows) {
  std::vector<double> sum(rows.size(), 0.0);
  std::vector<int> count(rows.size(), 0);
  for (int part = 0; part < parts; ++part) {
    std::vector<const Row*> others;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      // Campaigns in which nothing is hidden are dealt by their number.
      const bool held = rows[k].parts.empty() ? part_of(rows[k].campaign) == part : meets(rows[k].parts, part);
      if (!held) {
        others.push_back(&rows[k]);
      }
    }
    const Logistic logistic = learned(others);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const bool held = rows[k].parts.empty() ? part_of(rows[k].campaign) == part : meets(rows[k].parts, part);
      if (held) {
        sum[k] += logistic.score(rows[k]);
        ++count[k];
      }
    }
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    sum[k] /= std::max(count[k], 1);
  }
  return sum;
}

// Lengths of the pieces of a score's range, parted by `ends`, up to the score.
std::vector<double> lengths_up_to(const std::vector<double>& ends, double score) {
  std::vector<double> result;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    result.push_back(std::clamp(score, ends[k - 1], ends[k]) - ends[k - 1]);
  }
  return result;
}

// The log odds of being right over the scores of campaigns not seen.
std::vector<hysteron::Knot> knots_of(const std::vector<Row>& rows, const std::vector<double>& scores,
                                     std::size_t pieces = default_pieces) {
  std::vector<double> sorted = scores;
  std::ranges::sort(sorted);
  std::vector<double> ends;
  for (std::size_t k = 0; k <= pieces; ++k) {
    ends.push_back(sorted[k * (sorted.size() - 1) / pieces]);
  }
  std::vector<Row> on_pieces(rows.size());
  std::vector<const Row*> all;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    on_pieces[k].features = lengths_up_to(ends, scores[k]);
    on_pieces[k].right = rows[k].right;
    all.push_back(&on_pieces[k]);
  }
  const Logistic logistic = learned(all);
  std::vector<hysteron::Knot> knots;
  Row at;
  for (const double end : ends) {
    at.features = lengths_up_to(ends, end);
    knots.push_back({end, logistic.score(at)});
  }
  return knots;
}

// Names of like probability.
struct Bin {
  double from = 0.0;
  std::size_t rows = 0;
  std::size_t right = 0;
  double stated = 0.0;  // sum
};

// A table with what it was learned from.
struct Learned {
  std::string name;
  std::string of;  // in words
  Logistic logistic;
  std::vector<hysteron::Knot> knots;
  std::size_t rows = 0;
  std::size_t right = 0;
  std::map<std::string, std::array<std::size_t, 3>> levels;  // right ones, let through and right, let through and wrong
  std::vector<Bin> bins;

  [[nodiscard]] double probability(double score) const {
    static constexpr double one[] = {1.0};
    return hysteron::Table{0.0, one, knots}.probability(std::span(&score, 1));
  }
};

Learned learned_table(const std::string& name, const std::string& of, const std::vector<Row>& rows) {
  std::vector<const Row*> all;
  for (const Row& row : rows) {
    all.push_back(&row);
  }
  Learned result{name, of, learned(all), {}, rows.size(), 0, {}, {}};
  const std::vector<double> scores = unseen_scores(rows);
  result.knots = knots_of(rows, scores);
  for (const double from : {0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98}) {
    result.bins.push_back({from});
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::array<std::size_t, 3>& level = result.levels[rows[k].level];
    result.right += rows[k].right ? 1 : 0;
    level[0] += rows[k].right ? 1 : 0;
    const double probability = result.probability(scores[k]);
    if (probability >= hysteron::supported_from) {
      ++level[rows[k].right ? 1 : 2];
    }
    Bin& bin = *std::prev(std::ranges::upper_bound(result.bins, probability, {}, &Bin::from));
    ++bin.rows;
    bin.right += rows[k].right ? 1 : 0;
    bin.stated += probability;
  }
  return result;
}

std::string source_of(const Learned& table) {
  std::string text = fmt::format("constexpr double {}_weights[] = {{", table.name);
  for (Eigen::Index k = 0; k < table.logistic.weights.size(); ++k) {
    text += fmt::format("{}{:.4g}", k == 0 ? "" : ", ", table.logistic.weights[k]);
  }
  if (table.logistic.offsets.size() > 1) {
    text += fmt::format("}};\nconstexpr Offset {}_offsets[] = {{", table.name);
    for (const auto& [effect, offset] : table.logistic.offsets) {
      text += fmt::format("{{\"{}\", {:.3g}}}, ", effect, offset);
    }
  }
  text += fmt::format("}};\nconstexpr Knot {}_knots[] = {{", table.name);
  for (std::size_t k = 0; k < table.knots.size(); ++k) {
    text += fmt::format("{}{{{:.4g}, {:.4g}}}", k == 0 ? "" : ", ", table.knots[k].score, table.knots[k].log_odds);
  }
  return text + fmt::format("}};\nconstexpr double {}_intercept = {:.5g};\n", table.name, table.logistic.intercept);
}

std::string page_of(const Learned& table, std::span<const hysteron::Feature> features) {
  std::string text = fmt::format("\n## {}\n\n{} rows, {} of them right. Intercept {:.3f}.\n\n", table.of, table.rows,
                                 table.right, table.logistic.intercept);
  text += "| feature | weight | meaning |\n|---|--:|---|\n";
  for (std::size_t k = 0; k < features.size(); ++k) {
    text += fmt::format("| {} | {:.3f} | {} |\n", features[k].name,
                        table.logistic.weights[static_cast<Eigen::Index>(k)], features[k].meaning);
  }
  if (table.logistic.offsets.size() > 1) {
    std::vector<std::pair<double, std::string>> offsets;
    for (const auto& [effect, offset] : table.logistic.offsets) {
      offsets.emplace_back(offset, effect);
    }
    std::ranges::sort(offsets);
    text += "\nOffsets of effects, those first that are found most often where they are not:";
    for (const auto& [offset, effect] : offsets) {
      text += fmt::format("{} {} {:.2f}", &offset == &offsets.front().first ? "" : ",", effect, offset);
    }
    text += ".\n";
  }
  text += "\nLog odds over the score, straight between:";
  for (const hysteron::Knot& knot : table.knots) {
    text += fmt::format("{} {:.2f} at {:.2f}", &knot == &table.knots.front() ? "" : ",", knot.log_odds, knot.score);
  }
  text +=
      ".\n\nWhat they say of forms and foreign causes left out:\n\n| from | stated | right | of | share "
      "|\n|--:|--:|--:|--:|--:|\n";
  for (const Bin& bin : table.bins) {
    if (bin.rows > 0) {
      const auto count = static_cast<double>(bin.rows);
      text += fmt::format("| {:.2f} | {:.3f} | {} | {} | {:.3f} |\n", bin.from, bin.stated / count, bin.right, bin.rows,
                          static_cast<double>(bin.right) / count);
    }
  }
  text += fmt::format(
      "\nAt {:.2f} and more, likewise:\n\n| level | right ones | let through | and wrong |\n|---|--:|--:|--:|\n",
      hysteron::supported_from);
  for (const auto& [level, counts] : table.levels) {
    text += fmt::format("| {} | {} | {} | {} |\n", level, counts[0], counts[1] + counts[2], counts[2]);
  }
  return text;
}

std::string folder_of(const Row& row) { return row.campaign.substr(0, row.campaign.find('/')); }

// What is said of the rows of a folder by a table that was learned from the others.
struct Judged {
  std::size_t rows = 0;
  double log_loss = 0.0;                    // sum
  std::array<std::size_t, 2> right = {};    // of those stated with supported_from and more, established_from and more
  std::array<std::size_t, 2> stated = {};   // likewise, right and wrong
  std::array<double, 2> promised = {0, 0};  // sum of their probabilities

  void add(double probability, bool is_right) {
    constexpr double most_sure = 0.99;
    const double p = std::clamp(probability, 1.0 - most_sure, most_sure);
    ++rows;
    log_loss -= std::log(is_right ? p : 1.0 - p);
    for (std::size_t k = 0; k < 2; ++k) {
      if (probability >= (k == 0 ? hysteron::supported_from : hysteron::established_from)) {
        ++stated[k];
        right[k] += is_right ? 1 : 0;
        promised[k] += probability;
      }
    }
  }
  [[nodiscard]] std::string line(const std::string& name) const {
    std::string text = fmt::format("| {} | {} | {:.3f} |", name, rows, log_loss / static_cast<double>(rows));
    for (std::size_t k = 0; k < 2; ++k) {
      text += fmt::format(" {} of {}, {:.1f} |", right[k], stated[k], promised[k]);
    }
    return text + "\n";
  }
};

// A folder of campaigns, and what was learned from all others.
struct LeftOutFolder {
  std::string folder;
  std::vector<Row> others;
  Logistic logistic;
  std::vector<double> scores;  // of the others, each by a function that did not know it

  [[nodiscard]] std::vector<double> probabilities(const std::vector<Row>& rows, std::size_t pieces) const {
    const std::vector<hysteron::Knot> knots = knots_of(others, scores, pieces);
    static constexpr double one[] = {1.0};
    const hysteron::Table table{0.0, one, knots};
    std::vector<double> result(rows.size());
    std::ranges::transform(rows, result.begin(), [&](const Row& row) {
      const double score = logistic.score(row);
      return table.probability(std::span(&score, 1));
    });
    return result;
  }
};

std::vector<LeftOutFolder> left_out_in_turn(const std::vector<Row>& rows) {
  std::set<std::string> folders;
  for (const Row& row : rows) {
    folders.insert(folder_of(row));
  }
  std::vector<LeftOutFolder> result;
  for (const std::string& folder : folders) {
    LeftOutFolder one{folder, {}, {}, {}};
    std::ranges::copy_if(rows, std::back_inserter(one.others),
                         [&](const Row& row) { return folder_of(row) != folder; });
    std::vector<const Row*> all(one.others.size());
    std::ranges::transform(one.others, all.begin(), [](const Row& row) { return &row; });
    one.logistic = learned(all);
    one.scores = unseen_scores(one.others);
    result.push_back(std::move(one));
  }
  return result;
}

std::vector<Row> of_folder(const std::vector<Row>& rows, const std::string& folder) {
  std::vector<Row> result;
  std::ranges::copy_if(rows, std::back_inserter(result), [&](const Row& row) { return folder_of(row) == folder; });
  return result;
}

std::string page_of_others(const std::string& title, const std::vector<Row>& rows,
                           const std::vector<LeftOutFolder>& left_out) {
  std::string text = fmt::format(
      "\n## {}: each folder judged by a table learned from the others\n\nLogarithmic loss of a name, probabilities "
      "between 1 and 99 %; names that are right of those stated, and how many were promised.\n\n"
      "| folder | names | loss | {:.2f} and more | {:.2f} and more |\n|---|--:|--:|--:|--:|\n",
      title, hysteron::supported_from, hysteron::established_from);
  std::string of_pieces =
      "\nThe same of all, with so many straight pieces of the log odds:\n\n"
      "| pieces | names | loss | " +
      fmt::format("{:.2f} and more | {:.2f} and more", hysteron::supported_from, hysteron::established_from) +
      " |\n|---|--:|--:|--:|--:|\n";
  for (const std::size_t pieces : {1, 2, 3, 4, 6}) {
    Judged all;
    for (const LeftOutFolder& one : left_out) {
      const std::vector<Row> own = of_folder(rows, one.folder);
      const std::vector<double> probabilities = one.probabilities(own, pieces);
      Judged judged;
      for (std::size_t k = 0; k < own.size(); ++k) {
        judged.add(probabilities[k], own[k].right);
        all.add(probabilities[k], own[k].right);
      }
      if (pieces == default_pieces) {
        text += judged.line(one.folder);
      }
    }
    if (pieces == default_pieces) {
      text += all.line("all");
    }
    of_pieces += all.line(std::to_string(pieces));
  }
  return text + of_pieces;
}

// What names and sets would be stated if a set had to be so much surer than its first member to be told in its place.
std::string page_of_sets(const Rows& rows, const std::vector<LeftOutFolder>& alone,
                         const std::vector<LeftOutFolder>& names) {
  std::string text = fmt::format(
      "\n## A name or its set\n\nWhat would be stated with {:.2f} and more, each folder judged by tables learned from "
      "the others, if a set had to be so much surer than the effect that was found to be told in its place.\n\n"
      "| surer by | names, right | names, wrong | sets, right | sets, wrong |\n|--:|--:|--:|--:|--:|\n",
      hysteron::supported_from);
  for (const double worth : {0.0, 0.05, hysteron::worth_of_a_set, 0.15, 0.2, 1.0}) {
    std::array<std::array<std::size_t, 2>, 2> stated{};  // name or set, right or wrong
    for (std::size_t f = 0; f < alone.size(); ++f) {
      const std::vector<Row> own = of_folder(rows.alone, alone[f].folder);
      const std::vector<Row> own_sets = of_folder(rows.names, alone[f].folder);
      const std::vector<double> of_one = alone[f].probabilities(own, default_pieces);
      const std::vector<double> of_set = names[f].probabilities(own_sets, default_pieces);
      for (std::size_t k = 0; k < own.size(); ++k) {
        const bool single = own[k].features.back() == 1.0;
        const double all = std::max(of_one[k], of_set[k]);
        const bool told_alone = single || hysteron::stands_alone(of_one[k], all, worth);
        const double confidence = told_alone ? of_one[k] : all;
        if (confidence >= hysteron::supported_from) {
          ++stated[told_alone ? 0 : 1][(told_alone ? own[k].right : own_sets[k].right) ? 0 : 1];
        }
      }
    }
    text += fmt::format("| {:.2f}{} | {} | {} | {} | {} |\n", worth, worth == hysteron::worth_of_a_set ? " (used)" : "",
                        stated[0][0], stated[0][1], stated[1][0], stated[1][1]);
  }
  return text;
}

int run(int argc, char** argv) {
  CLI::App program("learns the tables of grades from diagnosed challenges");
  std::vector<std::string> folders;
  std::string out;
  std::string page_file;
  bool list = false;
  program.add_option("FOLDER", folders, "--out of a challenge")->required()->check(CLI::ExistingDirectory);
  program.add_option("--out", out, "table_data.cpp to write");
  program.add_option("--page", page_file, "page to write; else printed");
  program.add_flag("--list", list, "a line for every name with its features");
  CLI11_PARSE(program, argc, argv);
  Rows rows;
  for (const std::string& folder : folders) {
    read(folder, rows);
  }
  if (list) {
    const std::vector<double> scores = unseen_scores(rows.names);
    for (std::size_t k = 0; k < rows.names.size(); ++k) {
      const Row& row = rows.names[k];
      fmt::print("{:.2f} {} {} {} {} [{}]", scores[k], row.campaign, row.level, row.id, row.right ? "right" : "wrong",
                 row.truth);
      for (const double value : row.features) {
        fmt::print(" {:.2f}", value);
      }
      fmt::print("\n");
    }
  }
  const std::array<Learned, 3> tables = {
      learned_table("alone", "An effect of the augmented model is in the truth", rows.alone),
      learned_table("name", "An effect of the augmented model, or one that does as well in its place, is in the truth",
                    rows.names),
      learned_table("missing", "Physics is missing at all", rows.missing)};
  std::string page = "# What grades are read from\n\nWritten by `build/release/bench/hysteron_learn_grades";
  std::string source =
      "// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.\n"
      "#include \"diagnose/judge/table.hpp\"\n\nnamespace hysteron {\nnamespace {\n";
  for (const std::string& folder : folders) {
    page += " " + std::filesystem::path(folder).filename().string();
  }
  page +=
      " --page results/grades.md --out\nsrc/diagnose/judge/table_data.cpp`. results/challenge/README.md says how the "
      "folders are "
      "made.\n";
  for (const Learned& table : tables) {
    source += "\n" + source_of(table);
  }
  std::vector<hysteron::Feature> alone_features(hysteron::name_features.begin(), hysteron::name_features.end());
  alone_features.push_back(hysteron::of_set);
  std::vector<LeftOutFolder> alone;
  std::vector<LeftOutFolder> names;
  if (folders.size() > 1) {
    alone = left_out_in_turn(rows.alone);
    names = left_out_in_turn(rows.names);
  }
  page += page_of(tables[0], alone_features) + page_of_others("One name", rows.alone, alone) +
          page_of(tables[1], hysteron::name_features) + page_of_others("A name or its set", rows.names, names) +
          page_of_sets(rows, alone, names) + page_of(tables[2], hysteron::missing_features);
  const double told = (static_cast<double>(rows.told_rightly) + 0.5) / (static_cast<double>(rows.told) + 1.0);
  page += fmt::format(
      "\n## The channels tell it without a model\n\nThe contrast of a lag between velocity and displacement speaks in "
      "{} "
      "campaigns, in {} of them rightly: probability {:.3f}.\n",
      rows.told, rows.told_rightly, told);
  source += fmt::format("\nconstexpr double of_channels = {:.4g};\n\n}}  // namespace\n", told);
  for (const Learned& table : tables) {
    source += fmt::format(
        "\nconst Table& {0}_table() {{\n  static constexpr Table table{{{0}_intercept, {0}_weights, {0}_knots{1}}};\n"
        "  return table;\n}}\n",
        table.name, table.logistic.offsets.size() > 1 ? ", " + table.name + "_offsets" : "");
  }
  source += "\ndouble channel_probability() { return of_channels; }\n\n}  // namespace hysteron\n";
  if (!out.empty()) {
    hysteron::write_file_atomically(out, source);
  }
  if (!page_file.empty()) {
    hysteron::write_file_atomically(page_file, page);
  } else if (!list) {
    fmt::print("{}", page);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
