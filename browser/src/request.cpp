#include "request.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace hysteron::browser {
namespace {

using nlohmann::json;

std::map<std::string, LawOrders> laws_in(const json& asked) {
  return asked.value("by", json::object()).get<std::map<std::string, LawOrders>>();
}

LayoutOptions layout_of(const json& asked) {
  LayoutOptions layout;
  for (const auto& [name, orders] : laws_in(asked)) {
    (name == "current" ? layout.by_current : name == "frequency" ? layout.by_frequency : layout.by[name]) = orders;
  }
  return layout;
}

}  // namespace

FitRequest fit_request(const json& asked) {
  FitRequest request;
  request.model = asked.value("model", std::string{});
  request.identify.budget = asked.value("budget", request.identify.budget);
  request.identify.seed = asked.value("seed", request.identify.seed);
  request.identify.effects = asked.value("effects", std::vector<std::string>{});
  request.identify.layout = layout_of(asked);
  return request;
}

DiagnoseOptions diagnose_options(const json& asked) {
  DiagnoseOptions options;
  options.model = asked.value("model", std::string{});
  options.seed = asked.value("seed", options.seed);
  options.layout = layout_of(asked);
  return options;
}

std::vector<std::string> conditions_of(const json& asked) {
  std::vector<std::string> result;
  for (const auto& [name, orders] : laws_in(asked)) {
    if (name != "current" && name != "frequency") result.push_back(name);
  }
  return result;
}

std::string command_of(const json& asked) {
  std::string text = fmt::format("hysteron {} recordings", asked.at("work").get<std::string>());
  if (const auto model = asked.value("model", std::string{}); !model.empty()) text += " --model " + model;
  for (const auto& [name, orders] : laws_in(asked)) {
    if (orders.empty()) continue;
    text += name == "current" || name == "frequency" ? " --by-" + name + " " : " --by " + name + "=";
    bool first = true;
    for (const auto& [parameter, order] : orders) {
      text += fmt::format("{}{}:{}", first ? "" : ",", parameter, order);
      first = false;
    }
  }
  if (const auto effects = asked.value("effects", std::vector<std::string>{}); !effects.empty()) {
    text += fmt::format(" --effects {}", fmt::join(effects, ","));
  }
  if (asked.contains("budget")) text += fmt::format(" --budget {}", asked["budget"].get<std::size_t>());
  if (asked.contains("seed")) text += fmt::format(" --seed {}", asked["seed"].get<std::uint64_t>());
  return text;
}

}  // namespace hysteron::browser
