#include "core/message.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace hysteron {
namespace {

struct Named {
  Option option;
  std::string_view name;
};

constexpr std::array named{
    Named{Option::at, "at"},
    Named{Option::bounds, "bounds"},
    Named{Option::budget, "budget"},
    Named{Option::by, "by"},
    Named{Option::by_current, "by-current"},
    Named{Option::by_frequency, "by-frequency"},
    Named{Option::column, "column"},
    Named{Option::drive, "drive"},
    Named{Option::effects, "effects"},
    Named{Option::excitation, "excitation"},
    Named{Option::fix, "fix"},
    Named{Option::group, "group"},
    Named{Option::interpolation, "interpolation"},
    Named{Option::keep_samples, "keep-samples"},
    Named{Option::laws, "laws"},
    Named{Option::model, "model"},
    Named{Option::most_substeps, "most-substeps"},
    Named{Option::name, "name"},
    Named{Option::normalisation, "normalisation"},
    Named{Option::out, "out"},
    Named{Option::set, "set"},
    Named{Option::skip, "skip"},
    Named{Option::solver, "solver"},
    Named{Option::stages, "stages"},
    Named{Option::substeps, "substeps"},
    Named{Option::to, "to"},
    Named{Option::tolerance, "tolerance"},
    Named{Option::weighting, "weighting"},
    Named{Option::without_time, "without-time"},
};

std::string in_plain_words(Option option) {
  std::string words(name_of(option));
  std::ranges::replace(words, '-', ' ');
  return words;
}

}  // namespace

std::string_view name_of(Option option) { return std::ranges::find(named, option, &Named::option)->name; }

std::span<const Option> all_options() {
  static const std::vector<Option> all = [] {
    std::vector<Option> result;
    for (const Named& row : named) result.push_back(row.option);
    return result;
  }();
  return all;
}

Message& Message::operator+=(Message more) {
  parts_.insert(parts_.end(), std::make_move_iterator(more.parts_.begin()), std::make_move_iterator(more.parts_.end()));
  return *this;
}

std::string Message::with(std::string (*called)(Option)) const {
  std::string text;
  for (const auto& part : parts_) {
    const Option* option = std::get_if<Option>(&part);
    text += option != nullptr ? called(*option) : std::get<std::string>(part);
  }
  return text;
}

std::string Message::plain() const { return with(in_plain_words); }

Message operator+(Message a, const Message& b) { return std::move(a += b); }
Message operator+(Message a, Option b) { return std::move(a += b); }
Message operator+(Option a, const Message& b) { return Message(a) + b; }

}  // namespace hysteron
