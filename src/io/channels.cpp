#include "io/channels.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/extent.hpp"
#include "core/message.hpp"
#include "core/suggest.hpp"
#include "io/stillness.hpp"
#include "io/text.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr std::pair<std::string_view, Quantity> synonyms[] = {
    {"time", Quantity::time},
    {"t", Quantity::time},
    {"displacement", Quantity::displacement},
    {"disp", Quantity::displacement},
    {"x", Quantity::displacement},
    {"displ", Quantity::displacement},
    {"position", Quantity::displacement},
    {"pos", Quantity::displacement},
    {"travel", Quantity::displacement},
    {"lvdt", Quantity::displacement},
    {"stroke", Quantity::displacement},
    {"crosshead", Quantity::displacement},
    {"extension", Quantity::displacement},
    {"deflection", Quantity::displacement},
    {"velocity", Quantity::velocity},
    {"vel", Quantity::velocity},
    {"v", Quantity::velocity},
    {"xdot", Quantity::velocity},
    {"speed", Quantity::velocity},
    {"acceleration", Quantity::acceleration},
    {"acc", Quantity::acceleration},
    {"a", Quantity::acceleration},
    {"accel", Quantity::acceleration},
    {"force", Quantity::force},
    {"f", Quantity::force},
    {"load", Quantity::force},
    {"load cell", Quantity::force},
    {"current", Quantity::current},
    {"curr", Quantity::current},
    {"i", Quantity::current},
    {"amps", Quantity::current},
    {"voltage", Quantity::voltage},
    {"u", Quantity::voltage},
    {"volt", Quantity::voltage},
    {"volts", Quantity::voltage},
    {"temperature", Quantity::temperature},
    {"temp", Quantity::temperature},
    {"base", Quantity::base},
    {"base displacement", Quantity::base},
};

// Words of the languages that many rigs speak; none that is another channel's word in English.
constexpr std::pair<std::string_view, Quantity> words_elsewhere[] = {
    {"zeit", Quantity::time},
    {"temps", Quantity::time},
    {"tempo", Quantity::time},
    {"tiempo", Quantity::time},
    {"weg", Quantity::displacement},
    {"hub", Quantity::displacement},
    {"verschiebung", Quantity::displacement},
    {"auslenkung", Quantity::displacement},
    {"posizione", Quantity::displacement},
    {"posición", Quantity::displacement},
    {"posicion", Quantity::displacement},
    {"déplacement", Quantity::displacement},
    {"deplacement", Quantity::displacement},
    {"spostamento", Quantity::displacement},
    {"desplazamiento", Quantity::displacement},
    {"geschwindigkeit", Quantity::velocity},
    {"vitesse", Quantity::velocity},
    {"velocità", Quantity::velocity},
    {"velocita", Quantity::velocity},
    {"velocidad", Quantity::velocity},
    {"beschleunigung", Quantity::acceleration},
    {"accélération", Quantity::acceleration},
    {"accelerazione", Quantity::acceleration},
    {"aceleración", Quantity::acceleration},
    {"aceleracion", Quantity::acceleration},
    {"kraft", Quantity::force},
    {"forza", Quantity::force},
    {"fuerza", Quantity::force},
    {"strom", Quantity::current},
    {"courant", Quantity::current},
    {"corrente", Quantity::current},
    {"corriente", Quantity::current},
    {"temperatur", Quantity::temperature},
    {"température", Quantity::temperature},
    {"temperatura", Quantity::temperature},
};

// Words for a load that mean other things as well: taken where their unit is one of a force.
constexpr std::string_view loads_elsewhere[] = {"last", "charge", "carico", "carga"};

bool is_load(std::string_view word, std::string_view unit) {
  return find_unit(Quantity::force, unit) &&
         std::ranges::find(loads_elsewhere, lower_case(word)) != std::end(loads_elsewhere);
}

// Ends of German words made of several: "Prüfzeit", "Standardkraft", "Traversenweg".
constexpr std::pair<std::string_view, Quantity> ends_of_words[] = {{"zeit", Quantity::time},
                                                                   {"weg", Quantity::displacement},
                                                                   {"kraft", Quantity::force},
                                                                   {"strom", Quantity::current}};

// Words of columns that hold what was asked for or worked out, and of those that hold what was measured.
constexpr std::string_view unmeasured_words[] = {
    "command",   "commanded", "cmd",     "target",      "setpoint", "set",        "demand",  "demanded",
    "desired",   "reference", "nominal", "soll",        "computed", "calculated", "calc",    "estimated",
    "predicted", "simulated", "model",   "theoretical", "error",    "max",        "maximum", "min",
    "minimum",   "mean",      "average", "peak",        "rms"};
constexpr std::string_view measured_words[] = {"measured", "actual", "feedback", "sensor", "response", "ist"};

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  const std::string lower = lower_case(name);
  for (std::size_t at = 0; at < lower.size();) {
    const std::size_t end = std::min(lower.find_first_of(" _-.", at), lower.size());
    if (end > at) words.push_back(lower.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

bool has_one_of(std::string_view name, std::span<const std::string_view> words) {
  return std::ranges::any_of(words_of(name), [&](const std::string& word) {
    return std::ranges::find(words, std::string_view(word)) != words.end();
  });
}

bool is_unmeasured(std::string_view name) { return has_one_of(name, unmeasured_words); }

// A single letter may be anything.
bool has_word_of(Quantity quantity, std::string_view name) {
  return std::ranges::any_of(
      words_of(name), [&](const std::string& word) { return word.size() > 1 && quantity_of_name(word) == quantity; });
}

// "Position(Linear:Position)" -> "Position": the axis and the name again, as some testing machines write it.
std::string_view without_axis(std::string_view name) {
  name = trimmed(name);
  const std::size_t open = name.find('(');
  if (open == 0 || open == std::string_view::npos) return name;
  const std::string_view head = trimmed(name.substr(0, open));
  return name.ends_with(":" + std::string(head) + ")") ? head : name;
}

std::string names_of(Quantity quantity) {
  std::string result;
  for (const auto& [name, of] : synonyms) {
    if (of == quantity) result += (result.empty() ? "" : ", ") + std::string(name);
  }
  return result + " (or its German, French, Italian or Spanish word)";
}

std::string list_of(const std::vector<Column>& columns) {
  constexpr std::size_t most = 20;
  std::string result;
  for (std::size_t i = 0; i < std::min(columns.size(), most); ++i) {
    result += (i > 0 ? ", " : "") + in_quotes(columns[i].text);
  }
  if (columns.size() > most) result += " and " + std::to_string(columns.size() - most) + " more";
  return result;
}

std::string list_of_channels() {
  std::string result;
  for (int i = 0; i < quantity_count; ++i) {
    result += (i > 0 ? ", " : "") + std::string(quantity_name(static_cast<Quantity>(i)));
  }
  return result;
}

class Assigner {
 public:
  Assigner(const std::vector<Column>& columns, const ReadOptions& options, const std::string& file, int line)
      : columns_(columns),
        options_(options),
        file_(file),
        line_(line),
        taken_(columns.size(), false),
        told_(columns.size(), false) {}

  Sources run() {
    for (const auto& [channel, value] : options_.columns) {
      if (std::ranges::find(options_.conditions, lower_case(trimmed(channel))) == options_.conditions.end() ||
          quantity_of_name(channel)) {
        map(channel, value);
      }
    }
    keep_for_conditions();
    for (std::size_t i = 0; i < columns_.size(); ++i) match(i);
    match_last_words();
    refuse_absolute();
    refuse_shared();
    for (std::size_t i = 0; i < columns_.size(); ++i) doubt_unit(i);
    for (int q = 0; q < quantity_count; ++q) doubt_without_unit(static_cast<Quantity>(q));
    doubt_unread_current();
    for (const Quantity quantity : {Quantity::time, Quantity::displacement, Quantity::force}) {
      if (is_required(quantity)) require(quantity);
    }
    return sources_;
  }

 private:
  Source& source(Quantity quantity) { return sources_[static_cast<std::size_t>(quantity)]; }

  [[noreturn]] void fail(const Message& message) const { throw OptionError(file_, line_, message); }

  // The columns `text` names: those with exactly this text, else without case, else by name or alias.
  [[nodiscard]] std::vector<std::size_t> matches(std::string_view text) const {
    const std::string lower = lower_case(text);
    for (int attempt = 0; attempt < 3; ++attempt) {
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        const auto& column = columns_[i];
        const bool same = attempt == 0   ? column.text == text
                          : attempt == 1 ? lower_case(column.text) == lower
                                         : lower_case(column.name) == lower || column.alias == text;
        if (same) found.push_back(i);
      }
      if (!found.empty()) return found;
    }
    return {};
  }

  // Columns of conditions are no channel's, whatever their last words are.
  void keep_for_conditions() {
    for (const std::string& name : options_.conditions) {
      if (quantity_of_name(name)) continue;
      const auto mapped = std::ranges::find_if(
          options_.columns, [&](const auto& entry) { return lower_case(trimmed(entry.first)) == name; });
      const std::string& text = mapped == options_.columns.end() ? name : mapped->second;
      auto found = matches(trimmed(text));
      if (found.empty()) found = matches(split_column(text).name);
      for (const std::size_t i : found) taken_[i] = true;
    }
  }

  void map(const std::string& channel, const std::string& value) {
    const auto quantity = quantity_of_name(channel);
    if (!quantity) {
      std::vector<std::string> known;
      known.reserve(quantity_count);
      for (int i = 0; i < quantity_count; ++i) known.emplace_back(quantity_name(static_cast<Quantity>(i)));
      const std::string_view meant = nearest(channel, known, channel.size() / 3);
      throw OptionError(Option::column + " " + channel + "=" + value + ": unknown channel " + in_quotes(channel) +
                        (meant.empty() ? "" : " (did you mean " + in_quotes(meant) + "?)") + ", expected one of " +
                        list_of_channels());
    }
    const std::string name(quantity_name(*quantity));
    const Column wanted = split_column(value);
    auto found = matches(trimmed(value));
    if (found.empty()) found = matches(wanted.name);
    if (found.empty()) {
      fail("no column " + in_quotes(wanted.name) + " for " + name + ", expected one of " + list_of(columns_));
    }
    if (found.size() > 1) {
      fail(std::to_string(found.size()) + " columns are named " + in_quotes(wanted.name) + " for " + name +
           ", expected one; the columns are " + list_of(columns_));
    }
    if (source(*quantity).column >= 0) fail("two mappings for " + name + ", expected one");
    assign(*quantity, found.front(), wanted.unit);
  }

  void match(std::size_t i) {
    if (taken_[i]) return;
    const auto quantity = quantity_of_column(columns_[i]);
    if (!quantity) return;
    const auto& present = source(*quantity);
    const std::string name(quantity_name(*quantity));
    if (present.column < 0) {
      if (!leave_rotation(*quantity, i)) assign(*quantity, i, {});
      return;
    }
    const bool mapped = std::ranges::any_of(
        options_.columns, [&](const auto& entry) { return quantity_of_name(entry.first) == *quantity; });
    if (mapped) return;
    fail("two columns for " + name + " (" + in_quotes(columns_[static_cast<std::size_t>(present.column)].text) +
         " and " + in_quotes(columns_[i].text) + "), expected one, or " + Option::column + " " + name +
         "=NAME to choose");
  }

  // "speed [rpm]" is that of the drive of the rig, not of the rod.
  [[nodiscard]] bool leave_rotation(Quantity quantity, std::size_t i) const {
    static constexpr std::string_view rotations[] = {"rpm",   "rev/min", "r/min", "1/min",
                                                     "u/min", "rad/s",   "deg/s", "\xC2\xB0/s"};
    const Column& column = columns_[i];
    if (quantity != Quantity::velocity ||
        std::ranges::find(rotations, lower_case(column.unit)) == std::end(rotations)) {
      return false;
    }
    if (options_.remark) {
      options_.remark({file_, Remark::Kind::dialect, "rotation",
                       in_quotes(column.text) + " is not read as the velocity: its unit is one of a rotation"});
    }
    return true;
  }

  // "Total Time", "Axial_Force": a channel that no column names alone is the one column whose last word names it.
  void match_last_words() {
    for (const Quantity quantity : {Quantity::time, Quantity::displacement, Quantity::force, Quantity::current}) {
      if (source(quantity).column >= 0 || (quantity == Quantity::current && source(Quantity::voltage).column >= 0) ||
          (quantity == Quantity::time && !options_.time_required)) {
        continue;
      }
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        const Column& column = columns_[i];
        const bool named =
            quantity_of_last_word(column.name) == quantity ||
            (quantity == Quantity::force && is_load(column.name.substr(column.name.rfind(' ') + 1), column.unit));
        if (!taken_[i] && named) found.push_back(i);
      }
      // Beside it there is a time since the last cycle or step, which begins again.
      const auto total =
          std::ranges::find_if(found, [&](std::size_t i) { return lower_case(columns_[i].name) == "total time"; });
      if (quantity == Quantity::time && total != found.end()) found = {*total};
      const std::string channel(quantity_name(quantity));
      const std::vector<std::size_t> set = take_out_unmeasured(quantity, found);
      if (found.size() > 1 && quantity != Quantity::current) {
        fail(std::to_string(found.size()) + " columns may be the " + channel + " (" +
             in_quotes(columns_[found[0]].text) + ", " + in_quotes(columns_[found[1]].text) + "), expected one, or " +
             Option::column + " " + channel + "=NAME to choose");
      }
      if (found.size() != 1) continue;
      assign(quantity, found.front(), {});
      if (options_.remark) {
        const std::string text = in_quotes(columns_[found.front()].text) + " is taken for the " + channel;
        options_.remark({file_, Remark::Kind::dialect, text, text + beside(quantity, found.front(), set)});
      }
    }
  }

  // Beside a base the displacement is that relative to it, and "absolute displacement" holds the base as well.
  void refuse_absolute() {
    const Source& taken = source(Quantity::displacement);
    if (taken.column < 0 || source(Quantity::base).column < 0) return;
    const bool mapped = std::ranges::any_of(
        options_.columns, [&](const auto& entry) { return quantity_of_name(entry.first) == Quantity::displacement; });
    const Column& column = columns_[static_cast<std::size_t>(taken.column)];
    // Of "absolute", "Absoluter" and "absolu" alike.
    if (mapped || lower_case(column.name).find("absolu") == std::string::npos) return;
    fail(Message("column " + in_quotes(column.text) +
                 " is not the displacement relative to the base, expected a column displacement that is: the absolute "
                 "one less that of the base; or ") +
         Option::column + " displacement=NAME");
  }

  // "command position" gives way to a measured one, by its last word as well or, as "LVDT feedback [mm]", by a word
  // that says so, any other word and its unit. Gives those that gave way.
  std::vector<std::size_t> take_out_unmeasured(Quantity quantity, std::vector<std::size_t>& found) const {
    const auto gives_way = [&](std::size_t i) { return is_unmeasured(columns_[i].name); };
    if (quantity == Quantity::time || std::ranges::none_of(found, gives_way)) return {};
    std::vector<std::size_t> measured;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      const bool said = has_one_of(column.name, measured_words) && has_word_of(quantity, column.name) &&
                        find_unit(quantity, column.unit).has_value();
      const bool named = said || std::ranges::find(found, i) != found.end();
      if (!taken_[i] && named && !gives_way(i)) measured.push_back(i);
    }
    if (measured.empty()) return {};
    std::vector<std::size_t> unmeasured;
    std::ranges::copy_if(found, std::back_inserter(unmeasured), gives_way);
    found = std::move(measured);
    return unmeasured;
  }

  // What a remark on a column taken by one of its words tells of others: those that gave way to it, or, where it is not
  // a measured one itself, the first that has a unit of the channel.
  [[nodiscard]] Message beside(Quantity quantity, std::size_t taken, const std::vector<std::size_t>& set) const {
    if (!set.empty()) return ", not " + in_quotes(columns_[set.front()].text);
    if (quantity == Quantity::time || !is_unmeasured(columns_[taken].name)) return "";
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (taken_[i] || columns_[i].unit.empty() || !find_unit(quantity, columns_[i].unit)) continue;
      return ", not " + in_quotes(columns_[i].text) + ", which has a unit of it; " + Option::column + " " +
             std::string(quantity_name(quantity)) + "=NAME chooses";
    }
    return "";
  }

  void assign(Quantity quantity, std::size_t i, const std::string& unit) {
    const std::string& text = unit.empty() ? columns_[i].unit : unit;
    if (unit.empty()) refuse_two_units(columns_[i], std::string(quantity_name(quantity)), file_, line_);
    source(quantity) = {static_cast<int>(i), text.empty() ? UnitConversion{} : parse_unit(quantity, text, file_, line_),
                        text.empty()};
    taken_[i] = true;
  }

  // Two mappings may name one column.
  void refuse_shared() const {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      for (std::size_t k = i + 1; k < sources_.size(); ++k) {
        if (sources_[i].column < 0 || sources_[i].column != sources_[k].column) continue;
        fail("column " + in_quotes(columns_[static_cast<std::size_t>(sources_[i].column)].text) +
             " is mapped to both " + std::string(quantity_name(static_cast<Quantity>(i))) + " and " +
             std::string(quantity_name(static_cast<Quantity>(k))) + ", expected one channel per column");
      }
    }
  }

  [[nodiscard]] bool is_required(Quantity quantity) const {
    return quantity == Quantity::time           ? options_.time_required && !options_.without_time
           : quantity == Quantity::displacement ? options_.displacement_required
                                                : quantity == Quantity::force && options_.force_required;
  }

  // "force_kn": what stands behind the name of a channel that no column is taken for is nearly a unit of it.
  void doubt_unit(std::size_t i) {
    const std::string_view text = columns_[i].name;
    const std::size_t cut = text.find_last_of("/_");
    if (taken_[i] || !columns_[i].unit.empty() || cut == std::string_view::npos) return;
    auto quantity = quantity_of_name(text.substr(0, cut));
    if (!quantity) quantity = quantity_of_last_word(trimmed(text.substr(0, cut)));
    const std::string_view unit = trimmed(text.substr(cut + 1));
    if (!quantity || source(*quantity).column >= 0) return;
    const std::vector<std::string> similar = similar_units(*quantity, unit);
    if (similar.empty()) return;
    if (is_required(*quantity)) (void)parse_unit(*quantity, unit, file_, line_);
    if (!options_.remark) return;
    const std::string channel(quantity_name(*quantity));
    told_[i] = true;
    options_.remark({file_, Remark::Kind::dialect, "unit of " + channel,
                     in_quotes(columns_[i].text) + " is not read as the " + channel + ": " + in_quotes(unit) +
                         " is no unit, " + similar.front() + " is"});
  }

  // "f" beside "Reaction [N]": a letter may be anything, a frequency too, where another column has the unit; and so may
  // "current" be beside "coil current [A]", the number of a run.
  void doubt_without_unit(Quantity quantity) const {
    const int taken = sources_[static_cast<std::size_t>(quantity)].column;
    if (taken < 0 || !options_.remark) return;
    const Column& column = columns_[static_cast<std::size_t>(taken)];
    const bool mapped = std::ranges::any_of(
        options_.columns, [&](const auto& entry) { return quantity_of_name(entry.first) == quantity; });
    if (mapped || !column.unit.empty()) return;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (taken_[i] || columns_[i].unit.empty() || !find_unit(quantity, columns_[i].unit)) continue;
      if (column.name.size() != 1 && quantity_of_last_word(columns_[i].name) != quantity) continue;
      const std::string channel(quantity_name(quantity));
      options_.remark({file_, Remark::Kind::dialect, "no unit of " + channel,
                       in_quotes(column.text) + ", without a unit, is taken for the " + channel + ", and " +
                           in_quotes(columns_[i].text) + " has a unit of one; " + Option::column + " " + channel +
                           "=NAME chooses"});
      return;
    }
  }

  // Currents of several coils, or one that no last word names: a recording may do without a drive, and one that is
  // left out without a word looks like a damper without any.
  void doubt_unread_current() const {
    const auto is_read = [&](Quantity quantity) { return sources_[static_cast<std::size_t>(quantity)].column >= 0; };
    if (is_read(Quantity::current) || is_read(Quantity::voltage) || !options_.remark) return;
    std::vector<std::string> found;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      const bool of_unit = column.unit.empty() || find_unit(Quantity::current, column.unit).has_value();
      if (!taken_[i] && !told_[i] && of_unit && has_word_of(Quantity::current, column.name)) {
        found.push_back(in_quotes(column.text));
      }
    }
    if (found.empty()) return;
    options_.remark({file_, Remark::Kind::dialect, "no current",
                     (found.size() == 1 ? found.front() + " may be the current and is not read"
                                        : std::to_string(found.size()) + " columns may be the current (" + found[0] +
                                              ", " + found[1] + ") and none is read") +
                         "; " + Option::column + " current=NAME chooses"});
  }

  // A column whose name, or the last word of it, is nearly one of the channel, and whose unit may be.
  [[nodiscard]] std::string nearly(Quantity quantity) const {
    constexpr std::size_t shortest = 4;  // letters
    std::vector<std::string> words;
    for (const auto& [word, of] : synonyms) {
      if (of == quantity && word.size() >= shortest) words.emplace_back(word);
    }
    for (const auto& [word, of] : words_elsewhere) {
      if (of == quantity && word.size() >= shortest) words.emplace_back(word);
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      if (taken_[i] || (!column.unit.empty() && !find_unit(quantity, column.unit))) continue;
      const std::string_view name = column.name;
      for (const std::string_view word : {name, name.substr(name.find_last_of(" _-.") + 1)}) {
        if (word.size() < shortest || nearest(word, words, std::max<std::size_t>(1, word.size() / 5)).empty()) continue;
        return " (did you mean " + in_quotes(column.text) + "?)";
      }
    }
    return {};
  }

  void require(Quantity quantity) {
    if (source(quantity).column >= 0) return;
    const std::string name(quantity_name(quantity));
    fail("no " + name + " column" + nearly(quantity) + ", expected one named " + names_of(quantity) + ", or " +
         Option::column + " " + name + "=NAME; the columns are " + list_of(columns_) +
         (quantity == Quantity::time && source(Quantity::displacement).column >= 0
              ? "; a law whose force does not depend on the rate needs none, with " + Option::without_time
              : Message("")));
  }

  const std::vector<Column>& columns_;
  const ReadOptions& options_;
  const std::string& file_;
  int line_;
  std::vector<bool> taken_;
  std::vector<bool> told_;  // columns of which a remark says that their unit is none
  Sources sources_;
};

}  // namespace

std::optional<Quantity> quantity_of_name(std::string_view name) {
  std::string lower = lower_case(without_axis(name));
  std::ranges::replace(lower, '_', ' ');
  using Words = std::span<const std::pair<std::string_view, Quantity>>;
  for (const Words words : {Words(synonyms), Words(words_elsewhere)}) {
    for (const auto& [word, quantity] : words) {
      if (lower == word) return quantity;
    }
  }
  return std::nullopt;
}

std::optional<Quantity> quantity_of_column(const Column& column) {
  const auto quantity = quantity_of_name(column.name);
  if (!quantity && is_load(column.name, column.unit)) return Quantity::force;
  if (!quantity || column.unit.empty()) return quantity;
  if (lower_case(column.name) == "v" && find_unit(Quantity::voltage, column.unit)) return Quantity::voltage;
  if (lower_case(column.name) == "a" && find_unit(Quantity::current, column.unit)) return Quantity::current;
  if (*quantity == Quantity::time && find_unit(Quantity::temperature, column.unit)) return Quantity::temperature;
  return quantity;
}

std::optional<Quantity> quantity_of_last_word(std::string_view name) {
  name = without_axis(name);
  const std::size_t cut = name.find_last_of(" _-.");
  const std::string_view last = cut == std::string_view::npos ? std::string_view{} : name.substr(cut + 1);
  // A single letter may be anything.
  const auto quantity = last.size() > 1 ? quantity_of_name(last) : std::nullopt;
  if (quantity) return quantity;
  const std::string lower = lower_case(name.substr(cut + 1));
  for (const auto& [word, of] : ends_of_words) {
    if (lower.size() > word.size() && lower.ends_with(word)) return of;
  }
  return std::nullopt;
}

namespace {

// "force / kN", "force/kN", "force_kN", "force in kN" and "force, kN": what stands behind the mark is a unit of what
// stands before it.
void split_at_mark(Column& column) {
  const std::string_view text = column.text;
  for (const std::string_view mark : {" / ", "/", "_", " in ", ","}) {
    const bool is_stroke = mark.find('/') != std::string_view::npos;
    const std::size_t cut = is_stroke ? text.find(mark) : text.rfind(mark);
    if (cut == std::string_view::npos) continue;
    const std::string_view name = trimmed(text.substr(0, cut));
    const std::string_view unit = trimmed(text.substr(cut + mark.size()));
    std::optional<Quantity> quantity = quantity_of_column({{}, std::string(name), std::string(unit), {}});
    if (!quantity) quantity = quantity_of_last_word(name);
    // With blanks around the stroke, as standards write it, the name may be that of any channel.
    if (quantity ? find_unit(*quantity, unit).has_value() : mark == " / " && is_any_unit(unit)) {
      column.name = name;
      column.unit = unit;
      return;
    }
  }
}

}  // namespace

Column split_column(std::string_view text) {
  text = without_blanks(text);
  Column column{plain_blanks(text), plain_blanks(text), {}, {}};
  if (text.empty()) return column;
  if (text.back() != ']' && text.back() != ')') {
    split_at_mark(column);
    return column;
  }
  const auto open = text.rfind(text.back() == ']' ? '[' : '(');
  if (open == std::string_view::npos || without_axis(text) != text) return column;
  column.name = plain_blanks(without_blanks(text.substr(0, open)));
  column.unit = trimmed(text.substr(open + 1, text.size() - open - 2));
  return column;
}

bool contradict(std::string_view unit, std::string_view other) {
  const auto is_unit = [](std::string_view text) { return is_any_unit(text) || find_pressure(text).has_value(); };
  if (!is_unit(unit) || !is_unit(other)) return false;
  // "mm" and "millimetres" are one.
  bool same = find_pressure(unit) == find_pressure(other);
  for (int i = 0; i < quantity_count; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    same = same && find_unit(quantity, unit) == find_unit(quantity, other);
  }
  return !same;
}

void refuse_two_units(const Column& column, const std::string& name, const std::string& file, int line) {
  if (!contradict(column.unit, column.other_unit)) return;
  throw OptionError(file, line,
                    "column " + in_quotes(column.text) + " is given in " + in_quotes(column.unit) + " and in " +
                        in_quotes(column.other_unit) + ", expected one unit, or " + Option::column + " " + name +
                        "=\"" + column.name + " [UNIT]\" to choose");
}

Sources assign_columns(const std::vector<Column>& columns, const ReadOptions& options, const std::string& file,
                       int line) {
  return Assigner(columns, options, file, line).run();
}

bool make_time(Channels& channels) {
  std::vector<double>& time = channels[static_cast<std::size_t>(Quantity::time)];
  const std::vector<double>& x = channels[static_cast<std::size_t>(Quantity::displacement)];
  if (!time.empty() || x.empty()) return false;
  constexpr double fastest = 0.1;  // m/s
  double widest = 0.0;
  for (std::size_t n = 1; n < x.size(); ++n) widest = std::max(widest, std::abs(x[n] - x[n - 1]));
  const double step = widest > 0.0 ? widest / fastest : 1.0;
  for (std::size_t n = 0; n < x.size(); ++n) time.push_back(static_cast<double>(n) * step);
  return true;
}

Recording make_recording(Channels&& channels) {
  const auto take = [&](Quantity quantity) { return std::move(channels[static_cast<std::size_t>(quantity)]); };
  Recording recording;
  recording.time = take(Quantity::time);
  recording.displacement = take(Quantity::displacement);
  recording.velocity = take(Quantity::velocity);
  recording.acceleration = take(Quantity::acceleration);
  recording.force = take(Quantity::force);
  recording.temperature = take(Quantity::temperature);
  recording.base = take(Quantity::base);
  // A channel that is zero while the rod moves was not connected, one that is any other number while it goes to and fro
  // holds what was set: remark_on_sizes tells of both.
  constexpr double to_and_fro = 0.1;
  if (peak_of(recording.velocity) == 0.0 && span_of(recording.displacement) > 0.0) {
    recording.velocity.clear();
  } else if (!recording.velocity.empty() && span_of(recording.velocity) == 0.0 &&
             turned_by(recording.displacement) > to_and_fro * span_of(recording.displacement)) {
    recording.unused.push_back({std::string(set_velocity), recording.velocity.front()});
    recording.velocity.clear();
  }
  recording.velocity_measured = !recording.velocity.empty();
  recording.drive = take(Quantity::current);
  recording.drive_kind = DriveKind::current;
  if (recording.drive.empty()) {
    recording.drive = take(Quantity::voltage);
    recording.drive_kind = recording.drive.empty() ? DriveKind::none : DriveKind::voltage;
  }
  // Beside a current, a voltage is used by nothing.
  if (const std::vector<double> voltage = take(Quantity::voltage); !voltage.empty()) {
    recording.unused.push_back(
        {"voltage [V]", std::accumulate(voltage.begin(), voltage.end(), 0.0) / static_cast<double>(voltage.size())});
  }
  if (recording.displacement.empty()) return recording;  // an excitation without motion
  if (!recording.velocity_measured) recording.velocity = derive_velocity(recording.time, recording.displacement);
  recording.derived_acceleration =
      derive_acceleration(recording.time, recording.displacement, recording.velocity, recording.velocity_measured);
  hold_still(recording);
  return recording;
}

}  // namespace hysteron
