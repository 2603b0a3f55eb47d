#include "app/unfinished.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "core/bytes.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/sha256.hpp"
#include "plugin/plugin.hpp"
#include "report/terminal.hpp"
#include "task/command_text.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

void add_words(ByteWriter& bytes, const std::vector<std::string>& words) {
  bytes.whole(words.size());
  for (const std::string& word : words) bytes.text(word);
}

template <class Map, class Value>
void add_map(ByteWriter& bytes, const Map& map, const Value& value) {
  bytes.whole(map.size());
  for (const auto& [name, of] : map) {
    bytes.text(name);
    value(of);
  }
}

std::string error_text(double nrmse) { return nrmse < diverged_cost ? format_number(nrmse, 3) : std::string("-"); }

std::string with_effects(const Hypothesis& what) {
  std::string text = what.model;
  for (std::size_t k = 0; k < what.effects.size(); ++k) text += (k == 0 ? " with " : " + ") + what.effects[k];
  return text;
}

}  // namespace

std::string identity_of(const Campaign& campaign, const DiagnoseOptions& options) {
  ByteWriter bytes;
  bytes.text(sha256_hex(read_file("/proc/self/exe")));
  for (const std::string& plugin : loaded_plugins()) bytes.text(sha256_hex(read_file(plugin)));
  add_recordings(bytes, campaign.recordings);
  for (const Recording& recording : campaign.recordings) {
    bytes.text(recording.sha256);
    bytes.whole(recording.unused.size());
    for (const UnusedColumn& column : recording.unused) {
      bytes.text(column.name);
      bytes.number(column.mean);
    }
  }
  for (const Role role : campaign.roles) bytes.whole(static_cast<std::uint64_t>(role));
  bytes.text(options.model);
  const auto whole = [&](int order) { bytes.whole(static_cast<std::uint64_t>(order)); };
  add_map(bytes, options.layout.by_current, whole);
  add_map(bytes, options.layout.by_frequency, whole);
  for (const auto& [condition, orders] : options.layout.by) {
    bytes.text(condition);
    add_map(bytes, orders, whole);
  }
  whole(static_cast<int>(options.objective.normalisation));
  whole(static_cast<int>(options.objective.weighting));
  bytes.number(options.objective.tolerance);
  bytes.whole(options.seed);
  whole(options.most_effects);
  add_words(bytes, options.candidates);
  add_words(bytes, options.laws);
  return bytes.bytes();
}

void Unfinished::stage(double share, const std::string& name) {
  share_ = share;
  stage_ = name;
}

void Unfinished::stands(const Fit& fit) {
  best_ = Model{fit.what, fit.cost};
  if (!base_) base_ = best_;
}

std::string Unfinished::sentence() const {
  std::string text = "while " + stage_;
  if (best_) text += ": " + with_effects(best_->what) + ", NRMSE " + error_text(best_->nrmse);
  if (best_ && !(best_->what == base_->what)) {
    text += fmt::format(" ({} alone {})", base_->what.model, error_text(base_->nrmse));
  }
  return text;
}

void Unfinished::write(const std::filesystem::path& path, std::size_t pieces) const {
  const auto row = [](const std::optional<Model>& model) {
    if (!model) return json(nullptr);
    return json{{"model", model->what.model},
                {"effects", model->what.effects},
                {"richer_laws", model->what.richer},
                {"nrmse_compared", model->nrmse < diverged_cost ? json(model->nrmse) : json(nullptr)}};
  };
  write_file_atomically(
      path,
      json_text({{"schema", "hysteron.interrupted/1"},
                 {"finished", false},
                 {"stage", stage_},
                 {"share", share_},
                 {"baseline", row(base_)},
                 {"so_far", row(best_)},
                 {"pieces_kept", pieces},
                 {"note",
                  "not a result: the effects so far have not been set against their rivals, and the errors are of "
                  "the recordings on which hypotheses are compared; rerun the command to resume"},
                 {"command", command_line() + " --out " + quoted_word(path.parent_path().string())}}));
}

}  // namespace hysteron::app
