#include "diagnose/signal/split.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fit/identify.hpp"

namespace hysteron {
namespace {

Recording first_samples(const Recording& whole, std::size_t count) {
  Recording part = whole;
  for (std::vector<double>* channel : channels_of(part)) {
    if (!channel->empty()) {
      channel->resize(count);
    }
  }
  return part;
}

std::string names(const std::vector<Judged>& judged) {
  std::string list;
  for (const Judged& one : judged) {
    list += (list.empty() ? "" : ", ") + one.recording.file;
  }
  return list;
}

}  // namespace

Split split_of(const Campaign& campaign, const std::vector<std::string>& learn_from) {
  Split split;
  const std::vector<Recording>& all = campaign.recordings;
  std::vector<bool> judged(all.size(), false);
  if (std::ranges::any_of(campaign.roles, [](Role role) { return role == Role::validate; })) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      judged[k] = campaign.roles[k] == Role::validate;
    }
    if (std::ranges::all_of(judged, [](bool yes) { return yes; })) {
      throw InputError("campaign.toml: every recording has the role validate, expected at least one to fit");
    }
    split.how = "held out by campaign.toml: ";
  } else if (all.size() >= 4) {
    std::vector<std::size_t> free;
    std::vector<Recording> choice;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (std::ranges::find(learn_from, all[k].file) == learn_from.end()) {
        free.push_back(k);
        choice.push_back(all[k]);
      }
    }
    const bool all_free = choice.size() < 4;
    for (const std::size_t k : choose_heldout(all_free ? all : choice)) {
      judged[all_free ? k : free[k]] = true;
    }
    split.by_program = true;
    split.how = "held out by the program: ";
  } else {
    for (const Recording& recording : all) {
      const std::size_t count = recording.size() - recording.size() / 3;
      split.fit.push_back(first_samples(recording, count));
      split.judge.push_back({recording, count});
    }
    split.how = "fewer than four recordings: the last third of each is held out";
    return split;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (judged[k]) {
      split.judge.push_back({all[k], 0});
    } else {
      split.fit.push_back(all[k]);
    }
  }
  split.how += names(split.judge);
  return split;
}

}  // namespace hysteron
