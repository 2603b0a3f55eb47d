#include "io/mat.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/block_means.hpp"
#include "io/conditions.hpp"
#include "io/file.hpp"
#include "io/mat5.hpp"
#include "io/mat73.hpp"
#include "io/plausible.hpp"
#include "io/rounded_times.hpp"
#include "io/sha256.hpp"
#include "io/text.hpp"
#include "io/time_packets.hpp"

namespace hysteron {
namespace {

bool is_numeric(const MatVariable& variable) { return variable.damaged || variable.kind == MatVariable::Kind::numbers; }

// A vector variable or one column of a matrix.
struct Slice {
  std::size_t variable;
  std::size_t first;
  std::size_t count;
};

class MatReader {
 public:
  MatReader(std::string_view bytes, const std::string& file, const ReadOptions& options)
      : bytes_(bytes), file_(file), options_(options) {}

  void read_variables() {
    const bool level_5 = bytes_.size() >= 128 && (bytes_.substr(126, 2) == "IM" || bytes_.substr(126, 2) == "MI");
    const bool level_73 = is_mat73(bytes_);
    if (!level_5 && !level_73) fail("not a readable MAT file, expected MATLAB level 5 or 7.3");
    try {
      variables_ = level_73 ? read_mat73(bytes_) : read_mat5(bytes_);
    } catch (const MatDamage& damage) {
      fail(std::string(damage.what()) + ", expected a complete MAT file");
    }
    if (variables_.empty()) fail("no variables, the file is empty or damaged, expected one per channel or a matrix");
  }

  // After read_variables(), which is done with the bytes.
  Recording run() {
    list_columns();
    const Sources sources = assign_columns(columns_, options_, file_, 0);
    Channels channels;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].column >= 0) channels[i] = read(sources[i]);
    }
    const bool made_time = make_time(channels);
    check(channels, sources);
    const std::size_t samples = channels[0].size();
    const std::vector<ConditionSource> followed = assign_conditions(columns_, sources, options_, file_, 0);
    std::vector<std::vector<double>> values = read(followed, samples);
    const std::vector<UnusedColumn> others = unused(sources, followed, samples);
    variables_ = {};  // as large as the channels
    Sources present = sources;
    if (made_time) present[0].column = 0;
    even_out_rounded_times(channels, options_, file_);
    even_out_packets(channels, options_, file_);
    thin(channels, present, options_, file_);
    thin_conditions(values, samples, options_);
    remark_on_settings(sources, channels, followed, values, columns_, options_, file_);
    std::vector<ConditionChannel> conditions = make_conditions(followed, std::move(values), channels);
    Recording recording = make_recording(std::move(channels));
    recording.conditions = std::move(conditions);
    recording.timed = !made_time;
    recording.unused.insert(recording.unused.end(), others.begin(), others.end());
    remark_on_sizes(recording, sources, columns_, options_, file_);
    return recording;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, 0, message); }

  // Units by lower-case variable name, of the struct `units`, or `unit` where that is one.
  [[nodiscard]] std::map<std::string, std::string> read_units() const {
    std::map<std::string, std::string> units;
    for (const auto& variable : variables_) {
      const bool one = lower_case(variable.name) == "unit" && variable.kind == MatVariable::Kind::texts;
      if (!one && lower_case(variable.name) != "units") continue;
      const std::string whose = in_quotes(variable.name);
      if (variable.damaged)
        fail("variable " + whose + " cannot be read, the file is damaged, expected a complete MAT file");
      if (variable.kind != MatVariable::Kind::texts) {
        fail("variable " + whose + " is not a struct, expected one text per channel");
      }
      for (const auto& [name, text] : variable.fields) {
        if (!text) fail("field " + in_quotes(name) + " of " + whose + " is not text, expected a unit such as 'mm'");
        const auto [known, fresh] = units.emplace(lower_case(name), *text);
        if (!fresh && known->second != *text) {
          fail("the unit of " + in_quotes(name) + " is " + in_quotes(known->second) + " and " + in_quotes(*text) +
               ", expected one");
        }
      }
    }
    return units;
  }

  // A unit whose variable is not there belongs to a channel of another name, or to what was left out of the file.
  void doubt_units(const std::map<std::string, std::string>& units) const {
    for (const auto& entry : units) {
      // References: clang 14 does not capture structured bindings.
      const std::string& name = entry.first;
      const std::string& unit = entry.second;
      if (std::ranges::any_of(variables_, [&](const auto& one) { return lower_case(one.name) == name; })) continue;
      const auto quantity = quantity_of_name(name);
      const auto meant = std::ranges::find_if(columns_, [&](const Column& column) {
        return quantity && column.unit.empty() && quantity_of_column(column) == quantity;
      });
      if (meant != columns_.end()) {
        fail("there is a unit of " + in_quotes(name) + ", " + in_quotes(unit) + ", and none of " +
             in_quotes(meant->name) + ", expected the name of the variable");
      }
      if (options_.remark) {
        options_.remark({file_, Remark::Kind::dialect, "units " + name,
                         "there is a unit of " + in_quotes(name) + " and no variable of that name: it is not used"});
      }
    }
  }

  void list_columns() {
    const auto units = read_units();
    const auto is_matrix = [](const MatVariable& variable) {
      return is_numeric(variable) && variable.rows > 1 && variable.columns > 1;
    };
    const bool one_matrix = std::ranges::count_if(variables_, is_matrix) == 1;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const auto& variable = variables_[i];
      if (variable.name.empty() || !is_numeric(variable)) continue;
      const std::size_t rows = variable.rows;
      const std::size_t columns = variable.columns;
      if (!is_matrix(variable)) {
        const auto unit = units.find(lower_case(variable.name));
        add(vector_column(variable.name, unit == units.end() ? std::string{} : unit->second), {i, 0, rows * columns});
        continue;
      }
      for (std::size_t k = 0; k < columns; ++k) {
        const std::string number = std::to_string(k + 1);
        const std::string name = variable.name + ":" + number;
        add({name, name, {}, one_matrix ? number : std::string{}}, {i, k * rows, rows});
      }
    }
    refuse_structs_alone();
    if (columns_.empty()) fail("no numeric variables, expected one vector per channel or a matrix");
    doubt_units(units);
  }

  // "Force_kN" names its unit as a header of CSV does; `unit` is that of the struct of units.
  static Column vector_column(const std::string& name, const std::string& unit) {
    Column column = split_column(name);
    if (!unit.empty()) column.other_unit = std::exchange(column.unit, unit);
    return column;
  }

  // Where nothing else can be a channel, the channels are fields of a struct.
  void refuse_structs_alone() const {
    const auto is_struct = [](const MatVariable& variable) {
      return variable.kind == MatVariable::Kind::texts && lower_case(variable.name) != "unit" &&
             lower_case(variable.name) != "units";
    };
    const auto found = std::ranges::find_if(variables_, is_struct);
    const bool may_be_read = std::ranges::any_of(columns_, [](const Column& column) {
      return !column.alias.empty() || quantity_of_column(column) || quantity_of_last_word(column.name);
    });
    if (found == variables_.end() || may_be_read || !options_.columns.empty()) return;
    fail(
        "variable " + in_quotes(found->name) +
        " is a struct, whose fields are not read, expected them as variables, as MATLAB saves them by save('FILE.mat', "
        "'-struct', '" +
        found->name + "')");
  }

  void add(Column column, Slice slice) {
    columns_.push_back(std::move(column));
    slices_.push_back(slice);
  }

  // Of conditions: a value a sample, or one.
  [[nodiscard]] std::vector<std::vector<double>> read(const std::vector<ConditionSource>& conditions,
                                                      std::size_t samples) const {
    std::vector<std::vector<double>> result(conditions.size());
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      if (conditions[c].column < 0) continue;
      result[c] = read({conditions[c].column, conditions[c].unit.conversion, false});
      if (result[c].size() != samples && result[c].size() != 1) {
        fail("variable " + in_quotes(columns_[static_cast<std::size_t>(conditions[c].column)].text) + " has " +
             std::to_string(result[c].size()) + " values and time has " + std::to_string(samples) +
             ", expected as many or one");
      }
    }
    return result;
  }

  [[nodiscard]] std::vector<double> read(const Source& source) const {
    const auto index = static_cast<std::size_t>(source.column);
    const auto& slice = slices_[index];
    const auto& variable = variables_[slice.variable];
    const std::string name = in_quotes(columns_[index].text);
    if (variable.damaged) {
      fail("variable " + name + " cannot be read, the file is damaged, expected a complete MAT file");
    }
    if (variable.complex) fail("variable " + name + " is complex, expected real numbers");
    if (slice.count == 0) fail("variable " + name + " is empty, expected numbers");
    const auto first = variable.values.begin() + static_cast<std::ptrdiff_t>(slice.first);
    std::vector<double> values(first, first + static_cast<std::ptrdiff_t>(slice.count));
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) {
        fail("value " + std::to_string(i + 1) + " of " + name + " is " + (std::isnan(values[i]) ? "NaN" : "infinite") +
             ", expected a finite number");
      }
      values[i] = source.unit.to_si(values[i]);
      if (!(std::abs(values[i]) <= largest_value)) {
        fail("value " + std::to_string(i + 1) + " of " + name + " is too large, expected at most 1e30 in SI units");
      }
    }
    return values;
  }

  // Variables that are no channel, of as many numbers as there are samples or of one.
  [[nodiscard]] std::vector<UnusedColumn> unused(const Sources& sources, const std::vector<ConditionSource>& followed,
                                                 std::size_t samples) const {
    std::vector<UnusedColumn> result;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto taken = [&](const auto& source) { return source.column == static_cast<int>(i); };
      const Slice& slice = slices_[i];
      const auto& variable = variables_[slice.variable];
      if (std::ranges::any_of(sources, taken) || std::ranges::any_of(followed, taken) || variable.damaged ||
          variable.complex || (slice.count != samples && slice.count != 1)) {
        continue;
      }
      const auto first = variable.values.begin() + static_cast<std::ptrdiff_t>(slice.first);
      const double sum = std::accumulate(first, first + static_cast<std::ptrdiff_t>(slice.count), 0.0);
      if (std::isfinite(sum)) result.push_back({columns_[i].text, sum / static_cast<double>(slice.count)});
    }
    return result;
  }

  void check(const Channels& channels, const Sources& sources) const {
    const auto& time = channels[0];
    for (std::size_t i = 1; i < channels.size(); ++i) {
      if (sources[i].column < 0 || channels[i].size() == time.size()) continue;
      fail("variable " + in_quotes(columns_[static_cast<std::size_t>(sources[i].column)].text) + " has " +
           std::to_string(channels[i].size()) + " values and time has " + std::to_string(time.size()) +
           ", expected the same number");
    }
    if (time.size() < fewest_rows) {
      fail(std::to_string(time.size()) + (time.size() == 1 ? " row" : " rows") + " of numbers, expected at least " +
           std::to_string(fewest_rows));
    }
    for (std::size_t i = 1; i < time.size(); ++i) {
      if (!(time[i] - time[i - 1] > shortest_step)) {
        fail("time does not increase at value " + std::to_string(i + 1) + ", expected strictly increasing times");
      }
    }
  }

  std::string_view bytes_;
  const std::string& file_;
  const ReadOptions& options_;
  std::vector<MatVariable> variables_;
  std::vector<Column> columns_;
  std::vector<Slice> slices_;
};

}  // namespace

Recording parse_mat(std::string_view bytes, const std::string& file, const ReadOptions& options) {
  MatReader reader(bytes, file, options);
  reader.read_variables();
  return reader.run();
}

Recording read_mat(const std::filesystem::path& path, const ReadOptions& options) {
  std::string bytes = read_file(path);
  const std::string sha256 = sha256_hex(bytes);
  const std::string name = path.string();
  MatReader reader(bytes, name, options);
  reader.read_variables();
  std::string().swap(bytes);
  Recording recording = reader.run();
  recording.sha256 = sha256;
  return recording;
}

}  // namespace hysteron
