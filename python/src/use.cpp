// What is done with an identified model: simulate, score, compare, respond, export; results are texts of files.
#include "use.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"
#include "recordings.hpp"
#include "report/html.hpp"
#include "task/compare.hpp"
#include "task/export.hpp"
#include "task/json_text.hpp"
#include "task/predict.hpp"
#include "task/published.hpp"
#include "task/respond.hpp"
#include "task/result_file.hpp"
#include "watched.hpp"

namespace hysteron::python {
namespace py = pybind11;
namespace {

using Remarks = std::vector<std::string>;

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

std::pair<py::array_t<double>, Remarks> simulate(const StoredModel& stored, const std::string& path,
                                                 const RecordingPointer& recording, double tolerance) {
  std::vector<double> force;
  Remarks remarks;
  {
    const py::gil_scoped_release released;
    force = simulated_force(stored, path, *recording, tolerance, remarks);
  }
  return {array_of(force), remarks};
}

std::pair<py::array_t<double>, Remarks> simulate_preset(const std::string& preset,
                                                        const std::map<std::string, double>& quantities,
                                                        const std::optional<double>& drive,
                                                        const RecordingPointer& recording, double tolerance) {
  std::vector<double> force;
  Remarks remarks;
  {
    const py::gil_scoped_release released;
    force = force_of_preset(preset_called(preset), quantities, drive.value_or(std::nan("")), *recording, tolerance,
                            remarks);
  }
  return {array_of(force), remarks};
}

// `hysteron score --json`, the table of its --out, and remarks.
py::tuple score(const StoredModel& stored, const std::string& path, const WithRoles& recordings,
                const py::dict& values) {
  const Campaign campaign = campaign_of(recordings);
  const ObjectiveOptions objective = objective_of(Options(values));
  Remarks remarks;
  std::string told;
  std::string table;
  {
    const py::gil_scoped_release released;
    const CampaignScore result = score_campaign(stored, path, campaign.recordings, objective, remarks);
    told = json_text(score_json(result, campaign.recordings, objective.normalisation));
    table = score_csv(result, campaign.recordings);
  }
  return py::make_tuple(told, table, remarks);
}

// Files of `hysteron compare --mat` by name, what it prints, and remarks.
py::tuple compare(const std::vector<std::pair<std::string, const StoredModel*>>& models, const WithRoles& recordings,
                  const py::dict& values, const std::string& command) {
  const Campaign campaign = campaign_of(recordings);
  const ObjectiveOptions objective = objective_of(Options(values));
  std::vector<ComparedModel> compared;
  for (const auto& [file, stored] : models) compared.push_back({file, *stored});
  Remarks remarks;
  std::map<std::string, std::string> files;
  std::string text;
  {
    const py::gil_scoped_release released;
    const ModelComparison result = compare_models(compared, campaign.recordings, objective, command, remarks);
    files["compare.json"] = json_text(result.file);
    files["report.html"] = compare_page_html(result.page);
    for (auto& [name, bytes] : comparison_tables(result.file, true)) files[name] = std::move(bytes);
    text = comparison_text(result.file);
  }
  return py::make_tuple(bytes_of(files), text, remarks);
}

ResponseRequest response_request(const Options& options) {
  ResponseRequest request;
  request.mass = options.get<double>("mass");
  request.stiffness = options.get<double>("stiffness");
  request.damping = options.get<double>("damping");
  request.excitation = excites_of(options.get<std::string>("excitation"));
  request.interpolation = interpolation_of(options.get<std::string>("interpolation"));
  request.periods = options.get<int>("periods");
  if (options.given("frequency")) request.frequency = options.get<double>("frequency");
  if (options.given("drive")) request.drive = options.get<double>("drive");
  request.respond.tolerance = options.get<double>("tolerance");
  request.respond.displacement = options.get<double>("x0");
  request.respond.velocity = options.get<double>("v0");
  return request;
}

// Names with units, columns, the CSV file of `hysteron respond`, and remarks.
py::tuple respond(const StoredModel& stored, const std::string& path, const RecordingPointer& recording,
                  const py::dict& values) {
  ResponseRequest request = response_request(Options(values));
  Remarks remarks;
  MassResponse response;
  watch(
      [&](Watched& watched) {
        request.respond.stopped = [&] { return watched.stopped(); };
        response = response_to(stored, path, *recording, request, remarks);
      },
      py::none());
  py::list columns;
  for (const std::vector<double>& column : response.columns) columns.append(array_of(column));
  return py::make_tuple(response.names, columns, py::bytes(response.csv()), remarks);
}

// Files by name, the paths they were written to where `out` says, the note, and remarks.
py::tuple export_to(const StoredModel& stored, const std::string& path, const std::map<std::string, std::string>& at,
                    const std::optional<RecordingPointer>& motion, const py::dict& values) {
  const Options options(values);
  ExportRequest request;
  request.to = options.get<std::string>("to");
  if (options.given("out")) request.out = options.get<std::string>("out");
  request.name = options.get<std::string>("name");
  request.tolerance = options.get<double>("tolerance");
  request.most_substeps = options.get<int>("most_substeps");
  request.substeps = options.get<int>("substeps");
  ModelExport result;
  Remarks remarks;
  std::vector<std::string> paths;
  {
    const py::gil_scoped_release released;
    result =
        export_model(stored, path, numbers_of(at), motion ? std::optional(**motion) : std::nullopt, request, remarks);
    if (!request.out.empty()) paths = write_export(result);
  }
  return py::make_tuple(bytes_of(result.files), paths, result.note, remarks);
}

}  // namespace

void add_use(py::module_& module) {
  py::class_<StoredModel>(module, "StoredModel");
  module.attr("default_most_substeps") = default_most_substeps;
  module.attr("farthest_motion") = farthest_motion;
  module.def("parse_model",
             [](const py::bytes& text, const std::string& path) { return parse_model(std::string(text), path); });
  module.def("refuse_unfollowed",
             [](const std::vector<const StoredModel*>& models, const std::map<std::string, std::string>& at) {
               refuse_unfollowed(models, numbers_of(at));
             });
  module.def("simulate", &simulate);
  module.def("simulate_preset", &simulate_preset);
  module.def("score", &score);
  module.def("compare", &compare);
  module.def("respond", &respond);
  module.def("export_to", &export_to);
  module.def("check_table", &check_table);
  module.def("table_bytes", [](const std::string& out, const py::bytes& csv) {
    return py::bytes(table_bytes(out, std::string(csv)));
  });
}

}  // namespace hysteron::python
