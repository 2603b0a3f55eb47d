#include "recordings.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include "arguments.hpp"
#include "check/campaign.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "datasets/support/shipped.hpp"
#include "io/block_means.hpp"
#include "io/condition_faults.hpp"
#include "io/conditions.hpp"
#include "io/csv.hpp"
#include "io/csv_text.hpp"
#include "io/plausible.hpp"
#include "io/sha256.hpp"
#include "task/dataset.hpp"
#include "task/load.hpp"

namespace hysteron::python {
namespace py = pybind11;
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Text for people, and as it stands among the warnings of a result file.
using Remarks = std::vector<std::pair<std::string, std::string>>;

Remarks remarks_of(const std::vector<Remark>& remarks) {
  Remarks result;
  for (const Remark& remark : remarks)
    result.emplace_back(remark.file + ": " + with_mappings(remark.text.with(argument_name)), warning_of(remark));
  return result;
}

// Remarks on recordings from when they were read. Those that were read together share it.
struct ReadingRemarks {
  std::vector<Remark> of_each;
  std::vector<Remark> side_by_side;  // and of their sampling: what remarks_on finds
};
using ReadingRemarksPointer = std::shared_ptr<ReadingRemarks>;

// As load_with_remarks puts them: those of remarks_on are last.
ReadingRemarksPointer reading_remarks_of(const std::vector<Remark>& remarks, std::size_t of_each) {
  const auto middle = remarks.begin() + static_cast<std::ptrdiff_t>(of_each);
  return std::make_shared<ReadingRemarks>(ReadingRemarks{{remarks.begin(), middle}, {middle, remarks.end()}});
}

std::string word_of(Role role) { return role == Role::fit ? "fit" : role == Role::validate ? "validate" : ""; }

Role role_of(const std::string& word) {
  if (word.empty()) return Role::unassigned;
  if (word == "fit") return Role::fit;
  if (word == "validate") return Role::validate;
  throw InputError("unknown role '" + word + "', expected 'fit' or 'validate'");
}

// Recordings, roles, model, laws by current, by frequency and by conditions, remarks, and these as each
// recording keeps them.
py::tuple tuple_of(Loaded loaded) {
  py::list recordings;
  py::list roles;
  for (std::size_t k = 0; k < loaded.campaign.recordings.size(); ++k) {
    recordings.append(std::make_shared<Recording>(std::move(loaded.campaign.recordings[k])));
    roles.append(word_of(loaded.campaign.roles[k]));
  }
  return py::make_tuple(recordings, roles, loaded.campaign.model, loaded.campaign.by_current,
                        loaded.campaign.by_frequency, loaded.campaign.by, remarks_of(once_each(loaded.remarks)),
                        reading_remarks_of(loaded.remarks, loaded.of_each));
}

// Names of conditions as readers take them, each once.
std::vector<std::string> conditions_named(const std::vector<std::string>& names) {
  std::set<std::string> result;
  for (const std::string& name : names) result.insert(condition_name(name, "conditions"));
  return {result.begin(), result.end()};
}

// What a recording has to hold beside the time: force, motion or excitation.
Required required_of(const std::string& word) {
  return word == "excitation" ? Required::nothing : word == "motion" ? Required::motion : Required::motion_and_force;
}

// Model, laws, conditions whose laws are given, roles, whether model and laws may be given later.
using Taken = std::tuple<bool, bool, std::vector<std::string>, bool, bool>;

TakenOfCampaign taken_of(const Taken& words) {
  TakenOfCampaign taken;
  std::vector<std::string> given;
  std::tie(taken.model, taken.laws, given, taken.roles, taken.given_later) = words;
  taken.other_laws = {given.begin(), given.end()};
  return taken;
}

py::tuple load(const std::vector<std::string>& data, const std::map<std::string, std::string>& columns,
               const std::string& group, int skip, std::size_t keep_samples, const std::string& required,
               const std::vector<std::string>& conditions, const std::map<std::string, std::string>& at,
               bool without_time, const Taken& taken) {
  ReadOptions options;
  options.conditions = conditions_named(conditions);
  options.numbers = numbers_of(at);
  options.without_time = without_time;
  options.columns = columns;
  options.group = group;
  options.skip = skip;
  options.keep_samples = keep_samples;
  Loaded loaded;
  {
    const py::gil_scoped_release released;
    loaded = load_with_remarks(data, options, required_of(required), taken_of(taken));
  }
  return tuple_of(std::move(loaded));
}

// What the CSV file of this text would be read as.
Recording recording_of_text(const std::string& text, const std::string& file, const ReadOptions& options) {
  Recording recording = parse_csv(text, file, options);
  recording.file = file;
  recording.sha256 = sha256_hex(text);
  return recording;
}

std::string csv_text(const std::vector<std::string>& names, const std::vector<Numbers>& columns) {
  std::vector<std::span<const double>> spans;
  for (const Numbers& column : columns) spans.emplace_back(column.data(), static_cast<std::size_t>(column.size()));
  const py::gil_scoped_release released;
  return csv_of_columns(names, spans);
}

py::tuple recording(const std::vector<std::string>& names, const std::vector<Numbers>& arrays, const std::string& file,
                    const std::map<std::string, std::string>& columns, std::size_t keep_samples,
                    const std::string& required, const std::vector<std::string>& conditions, bool without_time) {
  const std::string text = csv_text(names, arrays);
  RecordingPointer result;
  std::vector<Remark> remarks;
  std::size_t of_each = 0;
  {
    const py::gil_scoped_release released;
    ReadOptions options;
    options.columns = columns;
    options.keep_samples = keep_samples;
    options.force_required = required_of(required) == Required::motion_and_force;
    options.displacement_required = required_of(required) != Required::nothing;
    options.conditions = conditions_named(conditions);
    options.without_time = without_time;
    options.remark = [&](const Remark& remark) { remarks.push_back(remark); };
    std::vector<Recording> alone{recording_of_text(text, file, options)};
    of_each = remarks.size();
    const std::vector<Remark> more =
        remarks_on(alone, options.displacement_required ? Moving::damper : Moving::excitation);
    remarks.insert(remarks.end(), more.begin(), more.end());
    result = std::make_shared<Recording>(std::move(alone.front()));
  }
  return py::make_tuple(result, remarks_of(once_each(remarks)), reading_remarks_of(remarks, of_each));
}

// The readers name a file by its path.
bool is_of(const Remark& remark, const Recording& recording) {
  return remark.file == recording.file || remark.file.ends_with("/" + recording.file);
}

bool same(const Remark& one, const Remark& other) {
  return one.file == other.file && one.key == other.key && one.text.plain() == other.text.plain();
}

// Recordings that come together in a command, each with its reading remarks. What they look like side by side was told
// of those that were read together, and is found here for others. The remarks that are new, and all as warnings of a
// result file.
py::tuple remarks_together(const std::vector<std::pair<RecordingPointer, ReadingRemarksPointer>>& given) {
  std::vector<Remark> fresh;
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release released;
    std::vector<Recording> recordings;
    std::vector<Remark> all;
    std::vector<Remark> before;
    for (const auto& [recording, reading] : given) {
      const Recording& one = recordings.emplace_back(*recording);
      const auto of_it = [&one](const Remark& remark) { return is_of(remark, one); };
      std::ranges::copy_if(reading->of_each, std::back_inserter(all), of_it);
      std::ranges::copy_if(reading->side_by_side, std::back_inserter(before), of_it);
    }
    const bool read_together =
        std::ranges::all_of(given, [&](const auto& one) { return one.second == given.front().second; });
    std::vector<Remark> now = before;
    if (!read_together) {
      // Without a displacement nothing moves a damper.
      const bool moving =
          std::ranges::none_of(recordings, [](const Recording& one) { return one.displacement.empty(); });
      now = remarks_on(recordings, moving ? Moving::damper : Moving::excitation);
      std::ranges::copy_if(now, std::back_inserter(fresh), [&](const Remark& remark) {
        return std::ranges::none_of(before, [&](const Remark& one) { return same(one, remark); });
      });
    }
    all.insert(all.end(), now.begin(), now.end());
    for (const Remark& remark : once_each(all)) warnings.push_back(warning_of(remark));
  }
  return py::make_tuple(remarks_of(once_each(fresh)), warnings);
}

py::tuple dataset(const std::string& id, const std::string& only, std::uint64_t seed) {
  const DatasetEntry* entry = find_dataset(id);
  if (entry == nullptr) {
    std::vector<std::string> known;
    for (const DatasetEntry* one : dataset_catalogue()) known.emplace_back(one->id);
    throw InputError("unknown dataset '" + id + "'" + suggestion(id, known) + ", see hysteron.list(\"datasets\")");
  }
  Loaded loaded;
  {
    const py::gil_scoped_release released;
    Campaign campaign = entry->generate(Stream(seed).child(entry->id));
    loaded.campaign.model = campaign.model;
    loaded.campaign.by_current = campaign.by_current;
    loaded.campaign.by_frequency = campaign.by_frequency;
    loaded.campaign.by = campaign.by;
    for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
      Recording& one = campaign.recordings[k];
      if (one.file.find(only) == std::string::npos) continue;
      loaded.campaign.roles.push_back(campaign.roles[k]);
      loaded.campaign.recordings.push_back(
          entry->licence.empty() ? recording_of_text(csv_of_simulated(one), one.file, {}) : std::move(one));
    }
  }
  if (loaded.campaign.recordings.empty()) throw InputError("only: no recording's name contains '" + only + "'");
  return tuple_of(std::move(loaded));
}

// A view of a channel, which keeps its recording alive; None where it was not recorded.
py::object view(const py::object& self, const std::vector<double>& channel) {
  if (channel.empty()) return py::none();
  py::array_t<double> array(static_cast<py::ssize_t>(channel.size()), channel.data(), self);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <std::vector<double> Recording::*channel>
py::object channel_of(const py::object& self) {
  return view(self, self.cast<const Recording&>().*channel);
}

// Of every condition its values, one where it does not vary, and its unit.
py::dict conditions_of(const py::object& self) {
  py::dict result;
  for (const ConditionChannel& condition : self.cast<const Recording&>().conditions) {
    result[py::str(condition.name)] = py::make_tuple(view(self, condition.values), condition.unit);
  }
  return result;
}

template <DriveKind kind>
py::object drive_of(const py::object& self) {
  const auto& recording = self.cast<const Recording&>();
  return recording.drive_kind == kind ? view(self, recording.drive) : py::none();
}

}  // namespace

std::map<std::string, ConditionNumber> numbers_of(const std::map<std::string, std::string>& at) {
  std::map<std::string, ConditionNumber> result;
  for (const auto& [word, text] : at) {
    std::optional<ConditionNumber> number = condition_number(text);
    if (!number) {
      throw InputError("at: '" + text + "' of " + word +
                       " is not a number with a unit, expected e.g. 2.1e5 or '2.1 bar'");
    }
    number->file = "at";
    const std::string name = condition_name(word, "at");
    if (const std::string fault = fault_of_condition(name, text); !fault.empty()) throw InputError("at: " + fault);
    result.insert_or_assign(name, *number);
  }
  return result;
}

Campaign campaign_of(const std::vector<std::pair<RecordingPointer, std::string>>& recordings) {
  Campaign campaign;
  for (const auto& [recording, role] : recordings) {
    campaign.recordings.push_back(*recording);
    campaign.roles.push_back(role_of(role));
  }
  // Others are refused where they are used.
  const auto same = [&](const Recording& one) {
    return std::ranges::equal(one.conditions, campaign.recordings.front().conditions, {}, &ConditionChannel::name,
                              &ConditionChannel::name);
  };
  if (std::ranges::all_of(campaign.recordings, same)) agree_on_units(campaign.recordings);
  return campaign;
}

void add_recordings(py::module_& module) {
  py::class_<ReadingRemarks, ReadingRemarksPointer>(module, "ReadingRemarks");
  py::class_<Recording, RecordingPointer>(module, "Recording")
      .def_readonly("file", &Recording::file)
      .def_readonly("sha256", &Recording::sha256)
      .def_readonly("velocity_measured", &Recording::velocity_measured)
      .def("__len__", &Recording::size)
      .def_property_readonly("time", &channel_of<&Recording::time>)
      .def_property_readonly("displacement", &channel_of<&Recording::displacement>)
      .def_property_readonly("velocity", &channel_of<&Recording::velocity>)
      .def_property_readonly("acceleration", &channel_of<&Recording::acceleration>)
      .def_property_readonly("force", &channel_of<&Recording::force>)
      .def_property_readonly("temperature", &channel_of<&Recording::temperature>)
      .def_property_readonly("base", &channel_of<&Recording::base>)
      .def_property_readonly("conditions", &conditions_of)
      .def_readonly("timed", &Recording::timed)
      .def_property_readonly("current", &drive_of<DriveKind::current>)
      .def_property_readonly("voltage", &drive_of<DriveKind::voltage>);
  module.attr("default_keep_samples") = default_keep_samples;
  module.def("load", &load);
  module.def("recording", &recording);
  module.def("dataset", &dataset);
  module.def("remarks_together", &remarks_together);
  module.def("csv_text", [](const std::vector<std::string>& names, const std::vector<Numbers>& columns) {
    return py::bytes(csv_text(names, columns));
  });
  module.def("condition_name", &condition_name);
  module.def("is_time",
             [](const std::string& column) { return quantity_of_column(split_column(column)) == Quantity::time; });
  module.def("look_beside", [](const std::string& folder) { look_beside(folder); });
}

}  // namespace hysteron::python
