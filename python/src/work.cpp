// What the commands do, in the words of C++: Python's side has checked types and ranges, results are texts of files.
#include "work.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/campaign_file.hpp"
#include "io/output.hpp"
#include "options.hpp"
#include "recordings.hpp"
#include "report/html.hpp"
#include "report/study.hpp"
#include "study/gather.hpp"
#include "study/study_file.hpp"
#include "task/catalogue.hpp"
#include "task/command_text.hpp"
#include "task/diagnosis.hpp"
#include "task/diagnosis_text.hpp"
#include "task/excites.hpp"
#include "task/fit.hpp"
#include "task/json_text.hpp"
#include "task/solver_settings.hpp"
#include "task/study.hpp"
#include "watched.hpp"

namespace hysteron::python {
namespace py = pybind11;
namespace {

LayoutOptions laws_of(const Options& options, const Campaign& campaign) {
  LayoutOptions layout;
  layout.by_current = options.given("by_current") ? options.get<LawOrders>("by_current") : campaign.by_current;
  layout.by_frequency = options.given("by_frequency") ? options.get<LawOrders>("by_frequency") : campaign.by_frequency;
  layout.by = options.get<std::map<std::string, LawOrders>>("by");
  return layout;
}

FitRequest fit_request(const Options& options, const Campaign& campaign) {
  FitRequest request;
  request.model = options.get<std::string>("model");
  request.two_stages = options.get<bool>("two_stages");
  if (options.given("response")) {
    const auto rig = options.get<py::dict>("response");
    request.rig = Rig{rig["mass"].cast<double>(), rig["stiffness"].cast<double>(), rig["damping"].cast<double>(),
                      interpolation_of(rig["interpolation"].cast<std::string>())};
    request.excitation = excites_of(rig["excitation"].cast<std::string>());
  }
  IdentifyOptions& identify = request.identify;
  identify.solvers = options.get<std::vector<std::string>>("solver");
  identify.budget = options.get<std::size_t>("budget");
  identify.seed = options.get<std::uint64_t>("seed");
  identify.effects = options.get<std::vector<std::string>>("effects");
  identify.settings = options.get<std::map<std::string, double>>("settings");
  check_settings("settings", identify.solvers, identify.settings);
  identify.objective = objective_of(options);
  identify.layout = laws_of(options, campaign);
  identify.layout.fix = options.get<std::map<std::string, double>>("fix");
  identify.layout.bounds = options.get<std::map<std::string, std::pair<double, double>>>("bounds");
  return request;
}

py::dict fit(const WithRoles& recordings, const std::string& model, const py::dict& values,
             const std::vector<std::string>& remarks, const std::string& command, const py::object& progress) {
  Campaign campaign = campaign_of(recordings);
  campaign.model = model;
  FitRequest request = fit_request(Options(values), campaign);
  std::string model_file;
  std::string fit_file;
  std::string page;
  std::vector<std::string> warnings;
  watch(
      [&](Watched& watched) {
        request.identify.objective.stopped = [&] { return watched.stopped(); };
        const FitData data = fit_data(std::move(campaign), request);
        FitResult result =
            fit_campaign(data, request, remarks, command,
                         [&](const std::string& stage, const std::string& /*of*/, const RunResult& run) {
                           watched.show({stage, static_cast<double>(run.evaluations) / static_cast<double>(run.budget),
                                         run.evaluations, run.budget,
                                         run.cost < diverged_cost ? std::optional(run.cost) : std::nullopt});
                           return !watched.stopped();
                         });
        if (!result.diverged.empty()) throw WorkError(result.diverged);
        model_file = json_text(result.model_file);
        fit_file = json_text(result.fit_file);
        page = fit_report_html(std::move(result.page));
        warnings = std::move(result.warnings);
      },
      progress);
  py::dict files;
  files["model.json"] = py::bytes(model_file);
  files["fit.json"] = py::bytes(fit_file);
  files["report.html"] = py::bytes(page);
  return py::dict(py::arg("files") = files, py::arg("warnings") = warnings);
}

DiagnoseOptions diagnose_options(const Options& options, const Campaign& campaign) {
  DiagnoseOptions result;
  result.model = options.get<std::string>("model");
  result.layout = laws_of(options, campaign);
  result.objective = objective_of(options);
  result.seed = options.get<std::uint64_t>("seed");
  result.most_effects = options.get<int>("most_effects");
  result.candidates = options.get<std::vector<std::string>>("effects");
  if (options.given("laws")) result.laws = options.get<std::vector<std::string>>("laws");
  return result;
}

py::dict diagnose(const WithRoles& recordings, const std::string& model, const py::dict& values,
                  const std::vector<std::string>& remarks, const std::string& command, const py::object& progress) {
  Campaign campaign = campaign_of(recordings);
  campaign.model = model;
  DiagnoseOptions options = diagnose_options(Options(values), campaign);
  std::string diagnosis_file;
  std::string model_file;
  std::string page;
  std::string text;
  watch(
      [&](Watched& watched) {
        check_diagnosis(campaign, options);
        options.stopped = [&] { return watched.stopped(); };
        const std::unique_ptr<Diagnosis> diagnosis =
            hysteron::diagnose(campaign, options, [&](double share, const std::string& stage) {
              if (watched.stopped()) throw Stopped{};
              watched.show({stage, share});
            });
        DiagnosisRecords records = records_of(*diagnosis, campaign, options, remarks, command);
        diagnosis_file = json_text(records.diagnosis_file);
        model_file = json_text(records.model_file);
        page = fit_report_html(std::move(records.page));
        text = diagnosis_text(records.diagnosis_file, "diagnosis.json");
      },
      progress);
  py::dict files;
  files["diagnosis.json"] = py::bytes(diagnosis_file);
  files["model.json"] = py::bytes(model_file);
  files["report.html"] = py::bytes(page);
  return py::dict(py::arg("files") = files, py::arg("text") = text);
}

// Runs done by this call, found in the folder before, planned.
std::tuple<std::size_t, std::size_t, std::size_t> bench(const std::string& study, const std::string& folder,
                                                        int threads, const py::object& progress) {
  RunProgress last;
  watch(
      [&](Watched& watched) {
        RunOptions options;
        options.threads = threads;
        const auto stopped = [&] { return watched.stopped(); };
        const Plan plan = make_plan(read_study_file(study), HYSTERON_VERSION);
        Store store = Store::open(folder, Store::Mode::write);
        absorb_ranks(store, folder);
        begin_study(plan, store);
        last = run_plan(plan, store, options, stopped, [&](const RunProgress& now) {
          watched.show({label_of(plan, now.index),
                        static_cast<double>(now.found + now.done) / static_cast<double>(now.planned),
                        {},
                        {},
                        now.nrmse});
        });
        if (watched.stopped()) return;
        store_identifiability(plan, store, store.records(), threads, stopped, [&] {
          watched.show({"identifiability of the best fits", 1.0});
        });
      },
      progress);
  return {last.done, last.found, last.planned};
}

// The files of `hysteron report`, and what it prints.
std::pair<py::dict, std::string> report(const std::string& folder) {
  std::map<std::string, std::string> files;
  std::string text;
  {
    const py::gil_scoped_release released;
    const Store store = open_gathered(folder);
    const StudyView view = view_of(store, store.records(), folder);
    files = study_report(folder, view, {});
    text = study_terminal(view.analysis, view.times);
  }
  return {bytes_of(files), text};
}

std::string list(const std::string& kind) {
  if (catalogue_rows(kind).empty()) {
    throw InputError("nothing is listed as '" + kind + "', expected models, solvers, effects, datasets or tables");
  }
  return json_text(catalogue_json(kind));
}

}  // namespace

void add_work(py::module_& module) {
  module.attr("highest_order") = highest_order;
  module.def("fit", &fit);
  module.def("diagnose", &diagnose);
  module.def("bench", &bench);
  module.def("report", &report);
  module.def("list", &list);
  module.def("describe", [](const std::string& id) { return json_text(description_json(id)); });
  module.def("command_text", &command_text);
  module.def("write_file", [](const std::string& path, const py::bytes& bytes) {
    const std::string content = bytes;
    const py::gil_scoped_release released;
    write_file_atomically(path, content);
  });
  module.def("make_folder", [](const std::string& path) { make_output_folder(path); });
}

}  // namespace hysteron::python
