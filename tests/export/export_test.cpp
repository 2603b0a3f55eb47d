// Exported models against simulate, in every language and for every law and effect of the catalogue; each is built and
// run as a user does.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "export/exported_case.hpp"
#include "export/runtime/fmi2.h"
#include "export/targets.hpp"
#include "fit/objective.hpp"
#include "io/temporary_folder.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

using testing::Case;
using testing::every_entry;
using testing::first_samples;
using testing::model_of;
using testing::Outcome;
using testing::peak;
using testing::shell;
using testing::strict;
using testing::TemporaryFolder;
using testing::write;

// As rows of numbers for the replay programs.
std::string rows_of(const TestVector& vector) {
  std::ostringstream text;
  text.precision(17);
  for (const TestSample& s : vector.samples) {
    text << s.time << ' ' << s.displacement << ' ' << s.velocity << ' ' << s.slope << ' ' << s.acceleration << ' '
         << s.jerk << ' ' << s.drive << '\n';
  }
  return text.str();
}

void expect_force(const std::string& printed, const TestVector& vector) {
  std::istringstream text(printed);
  double worst = 0.0;
  for (const double expected : vector.force) {
    double value = std::nan("");
    ASSERT_TRUE(text >> value);
    worst = std::max(worst, std::fabs(value - expected));
    ASSERT_TRUE(std::isfinite(value));
  }
  EXPECT_LE(worst, 1e-6 * peak(vector.force));
}

class EveryEntry : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEntry, ::testing::ValuesIn(every_entry()),
                         [](const auto& instance) { return instance.param.test_name(); });

// The program checks 1e-6 of the largest force itself; that it can fail is the next test.
TEST_P(EveryEntry, InC) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of(GetParam());
  const TestVector vector = test_vector(exported, motion_for_testing());
  ASSERT_GT(peak(vector.force), 1.0);
  EXPECT_LE(vector.off_simulate, 1e-6);
  write(export_c(exported, vector).files, folder.path());
  const Outcome built = shell(strict + exported.name + "_test.c " + exported.name + ".c -lm -o replay", folder.path());
  ASSERT_EQ(built.status, 0) << built.err;
  const Outcome replayed = shell("./replay", folder.path());
  EXPECT_EQ(replayed.status, 0) << replayed.out;
  EXPECT_NE(replayed.out.find("ns a step"), std::string::npos);
}

TEST_P(EveryEntry, InPython) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of(GetParam());
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 250));
  write(export_python(exported, vector).files, folder.path());
  const Outcome replayed = shell("python3 " + exported.name + "_test.py", folder.path());
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
}

TEST(ExportC, ReplayTellsAWrongForce) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {}});
  TestVector vector = test_vector(exported, motion_for_testing());
  vector.force[300] += 3e-6 * peak(vector.force);
  ExportedFiles files = export_c(exported, vector).files;
  files.merge(ExportedFiles(export_python(exported, vector).files));
  write(files, folder.path());
  ASSERT_EQ(shell(strict + std::string("bouc_wen_test.c bouc_wen.c -lm -o replay"), folder.path()).status, 0);
  EXPECT_EQ(shell("./replay", folder.path()).status, 1);
  EXPECT_EQ(shell("python3 bouc_wen_test.py", folder.path()).status, 1);
}

TEST(ExportC, HasNoHeapAndNoGlobals) {
  const ExportedModel exported = model_of({"modified-bouc-wen", {"clearance", "coil-lag", "sensor-delay"}});
  const CSource source = c_source(exported, test_vector(exported, motion_for_testing()));
  for (const char* word : {"malloc", "calloc", "realloc", "free(", "stdlib.h", "alloca", "printf"}) {
    EXPECT_EQ(source.source.find(word), std::string::npos) << word;
    EXPECT_EQ(source.header.find(word), std::string::npos) << word;
  }
  // Every object of static duration is constant.
  std::istringstream lines(source.source);
  for (std::string line; std::getline(lines, line);) {
    const bool object = line.starts_with("static ") && line.find('(') == std::string::npos;
    EXPECT_TRUE(!object || line.starts_with("static const ")) << line;
  }
}

// As docs/export.md has it: N steps between two samples, and 2 N where the velocity changes sign.
TEST(ExportPython, FixedStepsAreTwiceAsManyAtAReversal) {
  const TemporaryFolder folder;
  ExportedModel exported = model_of({"bouc-wen", {}});
  exported.substeps = 8;
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 50));
  ExportedFiles files = export_python(exported, vector).files;
  files["count.py"] =
      "import math\nimport bouc_wen\ncalls = 0\n"
      "law = bouc_wen.LINKS[0]\nrate = law.rate\n"
      "def counted(*given):\n    global calls\n    calls += 1\n    return rate(*given)\n"
      "law.rate = counted\ndamper = bouc_wen.Damper()\nplain, at_reversal = set(), set()\nlast = 1.0\n"
      "for n in range(200):\n    t = 0.005 * n\n    v = 0.2 * math.cos(20.0 * t + 0.3)\n    before = calls\n"
      "    damper.step(t, 0.01 * math.sin(20.0 * t + 0.3), v, drive=0.3)\n"
      "    if n > 0:\n        (at_reversal if v * last < 0 else plain).add(calls - before)\n    last = v\n"
      "assert plain == {4 * 8}, plain\nassert at_reversal == {2 * 4 * 8}, at_reversal\n";
  write(files, folder.path());
  const Outcome counted = shell("python3 count.py", folder.path());
  EXPECT_EQ(counted.status, 0) << counted.out << counted.err;
}

// A lost measurement is no sample: the state stays, and the force comes back with the next good one.
TEST(ExportC, ANumberThatIsNoneLeavesTheState) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {"compliance"}});
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 250));
  ExportedFiles files = export_c(exported, vector).files;
  files.merge(ExportedFiles(export_python(exported, vector).files));
  files["main.c"] =
      "#include <math.h>\n#include <stdio.h>\n#include \"bouc_wen.h\"\n"
      "int main(void) {\n  bouc_wen_model damper;\n  double held = 0.0;\n"
      "  bouc_wen_start(&damper, 1.0);\n"
      "  for (int n = 0; n < 400; ++n) {\n    bouc_wen_input now = {0};\n    double force;\n"
      "    now.time = 0.002 * n;\n    now.displacement = 0.01 * sin(8.0 * now.time);\n"
      "    now.velocity = 0.08 * cos(8.0 * now.time);\n    now.drive = 0.3;\n"
      "    if (n == 100) now.velocity = NAN;\n    if (n == 101) now.drive = INFINITY;\n"
      "    if (n == 102) now.displacement = NAN;\n    if (n == 103) now.time = NAN;\n"
      "    bouc_wen_derive(&damper, &now);\n    force = bouc_wen_step(&damper, &now);\n"
      "    if (n >= 100 && n < 104 && !(force <= held && force >= held)) return 2;\n    held = force;\n"
      "    if (!isfinite(force)) return 1;\n  }\n  return 0;\n}\n";
  files["lost.py"] =
      "import math\nfrom bouc_wen import Damper\ndamper = Damper()\nheld = 0.0\n"
      "for n in range(60):\n    t = 0.002 * n\n    lost = 20 <= n < 23\n"
      "    force = damper.step(t, 0.01 * math.sin(8 * t), math.nan if lost else 0.08 * math.cos(8 * t), drive=0.3)\n"
      "    assert math.isfinite(force)\n    assert not lost or force == held\n    held = force\n";
  write(files, folder.path());
  const Outcome built = shell(strict + std::string("main.c bouc_wen.c -lm -o lost"), folder.path());
  ASSERT_EQ(built.status, 0) << built.err;
  EXPECT_EQ(shell("./lost", folder.path()).status, 0);
  const Outcome python = shell("python3 lost.py", folder.path());
  EXPECT_EQ(python.status, 0) << python.err;
}

// A recording that begins within its cycle, with a drive that follows no law: one period is marched beforehand.
TEST(ExportC, GoesOnFromAPeriodMarchedBeforehand) {
  Recording recording;
  for (int n = 0; n < 900; ++n) {
    const double t = 10.0 + n / 500.0;
    const double w = 2.0 * std::numbers::pi * 2.0;
    recording.time.push_back(t);
    recording.displacement.push_back(0.01 * std::sin(w * t + 1.0));
    recording.velocity.push_back(0.01 * w * std::cos(w * t + 1.0));
  }
  for (const Case& of : {Case{"bouc-wen", {"force-drift"}}, Case{"guo-hu", {"compliance"}}}) {
    const TemporaryFolder folder;
    const ExportedModel exported = model_of(of);
    const TestVector vector = test_vector(exported, recording);
    ASSERT_GT(vector.lead_in.size(), 200U);
    ExportedFiles files = export_c(exported, vector).files;
    files.merge(ExportedFiles(export_python(exported, vector).files));
    write(files, folder.path());
    const Outcome built =
        shell(strict + exported.name + "_test.c " + exported.name + ".c -lm -o replay", folder.path());
    ASSERT_EQ(built.status, 0) << built.err;
    EXPECT_EQ(shell("./replay", folder.path()).status, 0);
    EXPECT_EQ(shell("python3 " + exported.name + "_test.py", folder.path()).status, 0);
  }
}

// With a fixed number of steps the error falls with its fourth power where the equations are smooth.
TEST(ExportC, FixedStepsConvergeWithTheFourthPower) {
  ExportedModel exported = model_of({"hyperbolic-tangent", {}});
  const std::vector<Parameter> cards = exported.model.parameters();
  for (std::size_t k = 0; k < cards.size(); ++k) {
    exported.held[k] = cards[k].initial;
  }
  exported.terms.clear();
  exported.tolerance = 1e-10;
  Recording motion = every_kth(motion_for_testing(), 5);
  const TestVector vector = test_vector(exported, motion);
  std::vector<double> errors;
  for (const int substeps : {2, 4, 8}) {
    exported.substeps = substeps;
    const TemporaryFolder folder;
    write(export_modelica(exported, vector).files, folder.path());
    std::ofstream(folder.path() / "rows.txt") << rows_of(vector);
    const std::string include = "hyperbolic_tangent/Resources/Include";
    const Outcome built =
        shell(std::string("cc -std=c99 -O1 -I ") + include +
                  " -DWRAPPER='\"hyperbolic_tangent_modelica.h\"' -DNEW=hyperbolic_tangent_external_new "
                  "-DFORCE=hyperbolic_tangent_external_force -DDELETE=hyperbolic_tangent_external_delete " +
                  HYSTERON_SOURCE_DIR + "/tests/export/modelica/replay.c -lm -o replay",
              folder.path());
    ASSERT_EQ(built.status, 0) << built.err;
    std::istringstream printed(shell("./replay < rows.txt", folder.path()).out);
    double worst = 0.0;
    for (const double expected : vector.force) {
      double value = 0.0;
      ASSERT_TRUE(printed >> value);
      worst = std::max(worst, std::fabs(value - expected));
    }
    errors.push_back(worst);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4.0, 0.5);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 4.0, 0.5);
}

TEST(ExportSimulink, SFunctionGivesTheForce) {
  for (const Case& of : {Case{"bouc-wen", {"coil-lag"}}, Case{"modified-bouc-wen", {"clearance"}}}) {
    const TemporaryFolder folder;
    const ExportedModel exported = model_of(of);
    const TestVector vector = test_vector(exported, motion_for_testing());
    write(export_simulink(exported, vector).files, folder.path());
    std::ofstream(folder.path() / "rows.txt") << rows_of(vector);
    const std::string harness = std::string(HYSTERON_SOURCE_DIR) + "/tests/export/simulink";
    const Outcome built =
        shell(std::string("cc -std=c99 -Wall -Wextra -Werror -O1 -I. -I") + harness + " -DSFUNCTION='\"" +
                  exported.name + "_sfun.c\"' " + harness + "/replay.c " + exported.name + ".c -lm -o replay",
              folder.path());
    ASSERT_EQ(built.status, 0) << built.err;
    const Outcome replayed = shell("./replay " + std::to_string(vector.frequency) + " < rows.txt", folder.path());
    ASSERT_EQ(replayed.status, 0);
    expect_force(replayed.out, vector);
  }
}

TEST(ExportModelica, ExternalFunctionsGiveTheForce) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"lugre", {"compliance", "coil-lag"}});
  const TestVector vector = test_vector(exported, motion_for_testing());
  const ExportedFiles files = export_modelica(exported, vector).files;
  write(files, folder.path());
  std::ofstream(folder.path() / "rows.txt") << rows_of(vector);
  const Outcome built = shell(std::string("cc -std=c99 -Wall -Wextra -Werror -O1 -I lugre/Resources/Include "
                                          "-DWRAPPER='\"lugre_modelica.h\"' -DNEW=lugre_external_new "
                                          "-DFORCE=lugre_external_force -DDELETE=lugre_external_delete ") +
                                  HYSTERON_SOURCE_DIR + "/tests/export/modelica/replay.c -lm -o replay",
                              folder.path());
  ASSERT_EQ(built.status, 0) << built.err;
  expect_force(shell("./replay < rows.txt", folder.path()).out, vector);
  // What the package calls is what the wrapper defines.
  const std::string& package = files.at("lugre/package.mo");
  const std::string& wrapper = files.at("lugre/Resources/Include/lugre_modelica.h");
  for (const char* function : {"lugre_external_new(", "lugre_external_delete(", "lugre_external_force("}) {
    EXPECT_NE(package.find(function), std::string::npos) << function;
    EXPECT_NE(wrapper.find(function), std::string::npos) << function;
  }
  EXPECT_EQ(package.find('@'), std::string::npos);
}

// Path in the archive -> bytes.
std::map<std::string, std::string> unzipped(const std::string& bytes) {
  std::map<std::string, std::string> result;
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* memory = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive = zip_open_from_source(memory, ZIP_RDONLY, &error);
  EXPECT_NE(archive, nullptr);
  for (zip_int64_t k = 0; archive != nullptr && k < zip_get_num_entries(archive, 0); ++k) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    zip_stat_index(archive, static_cast<zip_uint64_t>(k), 0, &stat);
    std::string text(stat.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(k), 0);
    EXPECT_EQ(zip_fread(file, text.data(), stat.size), static_cast<zip_int64_t>(stat.size));
    zip_fclose(file);
    result[stat.name] = text;
  }
  if (archive != nullptr) zip_discard(archive);
  return result;
}

// The functions of a loaded FMU.
class Fmu {
 public:
  Fmu(const std::filesystem::path& library) : handle_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {}
  ~Fmu() {
    if (handle_ != nullptr) dlclose(handle_);
  }
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;
  Fmu(Fmu&&) = delete;
  Fmu& operator=(Fmu&&) = delete;
  [[nodiscard]] bool loaded() const { return handle_ != nullptr; }
  template <class Function>
  Function* get(const char* name) const {
    void* found = dlsym(handle_, name);
    EXPECT_NE(found, nullptr) << name;
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* handle_;
};

int allocated = 0;
void* allocate(std::size_t count, std::size_t size) {
  ++allocated;
  return std::calloc(count, size);
}
void release(void* pointer) {
  --allocated;
  std::free(pointer);
}
void keep_log(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...) {}

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const auto from = text.find(before) + before.size();
  return text.substr(from, text.find(after, from) - from);
}

// The standard calls of a co-simulation; inputs of the new point are set after every step.
std::vector<double> co_simulated(const Fmu& fmu, const std::string& guid, const TestVector& vector, bool repeat_steps) {
  const fmi2CallbackFunctions callbacks = {keep_log, allocate, release, nullptr, nullptr};
  using Instantiate = fmi2Component(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*,
                                    fmi2Boolean, fmi2Boolean);
  using Simple = fmi2Status(fmi2Component);
  using Real = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, const fmi2Real*);
  using GetReal = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, fmi2Real*);
  using Boolean = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, const fmi2Boolean*);
  using Setup = fmi2Status(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
  using DoStep = fmi2Status(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
  using State = fmi2Status(fmi2Component, fmi2FMUstate*);
  using SetState = fmi2Status(fmi2Component, fmi2FMUstate);
  EXPECT_STREQ(fmu.get<const char*()>("fmi2GetVersion")(), "2.0");
  EXPECT_STREQ(fmu.get<const char*()>("fmi2GetTypesPlatform")(), "default");
  auto* instantiate = fmu.get<Instantiate>("fmi2Instantiate");
  EXPECT_EQ(instantiate("x", fmi2CoSimulation, "another", "", &callbacks, 0, 0), nullptr);
  fmi2Component c = instantiate("damper", fmi2CoSimulation, guid.c_str(), "file:///tmp", &callbacks, 0, 0);
  EXPECT_NE(c, nullptr);
  auto* set_real = fmu.get<Real>("fmi2SetReal");
  auto* get_real = fmu.get<GetReal>("fmi2GetReal");
  auto* do_step = fmu.get<DoStep>("fmi2DoStep");
  const fmi2ValueReference derive = 1;
  const fmi2Boolean no = 0;
  EXPECT_EQ(fmu.get<Boolean>("fmi2SetBoolean")(c, &derive, 1, &no), fmi2OK);
  const fmi2ValueReference frequency = 8;
  EXPECT_EQ(set_real(c, &frequency, 1, &vector.frequency), fmi2OK);
  EXPECT_EQ(fmu.get<Setup>("fmi2SetupExperiment")(c, 0, 0.0, vector.samples.front().time, 0, 0.0), fmi2OK);
  EXPECT_EQ(fmu.get<Simple>("fmi2EnterInitializationMode")(c), fmi2OK);
  const fmi2ValueReference inputs[] = {1, 2, 3, 4, 5, 6};
  const auto set = [&](const TestSample& s) {
    const double values[] = {s.displacement, s.velocity, s.drive, s.slope, s.acceleration, s.jerk};
    EXPECT_EQ(set_real(c, inputs, 6, values), fmi2OK);
  };
  set(vector.samples.front());
  EXPECT_EQ(fmu.get<Simple>("fmi2ExitInitializationMode")(c), fmi2OK);
  const fmi2ValueReference force = 7;
  std::vector<double> result(1);
  EXPECT_EQ(get_real(c, &force, 1, result.data()), fmi2OK);
  EXPECT_NE(set_real(c, &force, 1, result.data()), fmi2OK);  // an output
  for (std::size_t n = 0; n + 1 < vector.samples.size(); ++n) {
    const double t = vector.samples[n].time;
    const double h = vector.samples[n + 1].time - t;
    if (repeat_steps) {  // a step that is taken back
      fmi2FMUstate kept = nullptr;
      EXPECT_EQ(fmu.get<State>("fmi2GetFMUstate")(c, &kept), fmi2OK);
      EXPECT_EQ(do_step(c, t, 0.5 * h, 0), fmi2OK);
      EXPECT_EQ(fmu.get<SetState>("fmi2SetFMUstate")(c, kept), fmi2OK);
      EXPECT_EQ(fmu.get<State>("fmi2FreeFMUstate")(c, &kept), fmi2OK);
    }
    EXPECT_EQ(do_step(c, t, h, 1), fmi2OK);
    set(vector.samples[n + 1]);
    double value = 0.0;
    EXPECT_EQ(get_real(c, &force, 1, &value), fmi2OK);
    result.push_back(value);
  }
  EXPECT_EQ(fmu.get<Simple>("fmi2Terminate")(c), fmi2OK);
  fmu.get<void(fmi2Component)>("fmi2FreeInstance")(c);
  EXPECT_EQ(allocated, 0);
  return result;
}

const std::string description_check =
    std::string("python3 ") + HYSTERON_SOURCE_DIR + "/tests/export/check_model_description.py ";

TEST_P(EveryEntry, AsFmu) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of(GetParam());
  const TestVector vector = test_vector(exported, motion_for_testing());
  const Export made = export_fmu(exported, vector);
  const auto files = unzipped(made.files.at(exported.name + ".fmu"));
  const std::string library = "binaries/linux64/" + exported.name + ".so";
  ASSERT_TRUE(files.contains(library)) << made.note;
  write(files, folder.path());
  const Outcome checked = shell(description_check + "modelDescription.xml", folder.path());
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  for (const std::string& source : {exported.name + ".c", exported.name + ".h", std::string("fmu.c")}) {
    EXPECT_TRUE(files.contains("sources/" + source)) << source;
  }
  const Fmu fmu(folder.path() / library);
  ASSERT_TRUE(fmu.loaded()) << dlerror();
  const std::string guid = between(files.at("modelDescription.xml"), "guid=\"", "\"");
  const std::vector<double> force = co_simulated(fmu, guid, vector, false);
  ASSERT_EQ(force.size(), vector.force.size());
  double worst = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    ASSERT_TRUE(std::isfinite(force[n]));
    worst = std::max(worst, std::fabs(force[n] - vector.force[n]));
  }
  EXPECT_LE(worst, 1e-6 * peak(vector.force));
}

TEST(ExportFmu, StepsCanBeTakenBack) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {"compliance"}});
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 200));
  const auto files = unzipped(export_fmu(exported, vector).files.at("bouc_wen.fmu"));
  write(files, folder.path());
  const Fmu fmu(folder.path() / "binaries/linux64/bouc_wen.so");
  ASSERT_TRUE(fmu.loaded());
  const std::string guid = between(files.at("modelDescription.xml"), "guid=\"", "\"");
  EXPECT_EQ(co_simulated(fmu, guid, vector, true), co_simulated(fmu, guid, vector, false));
}

TEST(ExportFmu, AnInputThatIsNoNumberIsDiscarded) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {}});
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 200));
  const auto files = unzipped(export_fmu(exported, vector).files.at("bouc_wen.fmu"));
  write(files, folder.path());
  const Fmu fmu(folder.path() / "binaries/linux64/bouc_wen.so");
  ASSERT_TRUE(fmu.loaded());
  const std::string guid = between(files.at("modelDescription.xml"), "guid=\"", "\"");
  const fmi2CallbackFunctions callbacks = {keep_log, allocate, release, nullptr, nullptr};
  using Instantiate = fmi2Component(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*,
                                    fmi2Boolean, fmi2Boolean);
  using Real = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, const fmi2Real*);
  using GetReal = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, fmi2Real*);
  using DoStep = fmi2Status(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
  auto* instantiate = fmu.get<Instantiate>("fmi2Instantiate");
  auto* set_real = fmu.get<Real>("fmi2SetReal");
  auto* get_real = fmu.get<GetReal>("fmi2GetReal");
  auto* do_step = fmu.get<DoStep>("fmi2DoStep");
  fmi2Component c = instantiate("damper", fmi2CoSimulation, guid.c_str(), "", &callbacks, 0, 0);
  ASSERT_NE(c, nullptr);
  const fmi2ValueReference inputs[] = {1, 2, 3};
  const fmi2ValueReference force = 7;
  double value = 0.0;
  for (int n = 0; n < 50; ++n) {
    const double t = 0.002 * n;
    const double lost[] = {0.01 * std::sin(8.0 * t), std::nan(""), 0.3};
    const double good[] = {lost[0], 0.08 * std::cos(8.0 * t), 0.3};
    if (n == 20) {
      EXPECT_EQ(set_real(c, inputs, 3, lost), fmi2OK);
      EXPECT_EQ(get_real(c, &force, 1, &value), fmi2Discard);
      EXPECT_TRUE(std::isfinite(value));
      EXPECT_EQ(do_step(c, t, 0.002, 1), fmi2Discard);
    }
    EXPECT_EQ(set_real(c, inputs, 3, good), fmi2OK);
    EXPECT_EQ(get_real(c, &force, 1, &value), fmi2OK);
    EXPECT_TRUE(std::isfinite(value)) << n;
    EXPECT_EQ(do_step(c, t, 0.002, 1), fmi2OK);
  }
  EXPECT_EQ(do_step(c, std::nan(""), 0.002, 1), fmi2Discard);
  fmu.get<void(fmi2Component)>("fmi2FreeInstance")(c);
}

// As the headers of FMI 2.0 have it: the name of the model in front, unless what builds the sources overrides that.
TEST(ExportFmu, SourcesHonourTheOverrideOfTheirPrefix) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {}});
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 50));
  write(unzipped(export_fmu(exported, vector).files.at("bouc_wen.fmu")), folder.path());
  const auto steps_named = [&](const std::string& defined) {
    const Outcome built = shell(strict + defined + " -c sources/fmu.c -o fmu.o && nm fmu.o", folder.path());
    EXPECT_EQ(built.status, 0) << built.err;
    std::istringstream lines(built.out);
    std::string found;
    for (std::string line; std::getline(lines, line);) {
      const std::string name = line.substr(line.rfind(' ') + 1);
      if (name.ends_with("fmi2DoStep")) found += name + " ";
    }
    return found;
  };
  EXPECT_EQ(steps_named(""), "bouc_wen_fmi2DoStep ");
  EXPECT_EQ(steps_named("-DFMI2_FUNCTION_PREFIX=mine_"), "mine_fmi2DoStep ");
  EXPECT_EQ(steps_named("-DFMI2_OVERRIDE_FUNCTION_PREFIX"), "fmi2DoStep ");
  EXPECT_EQ(steps_named("-DFMI2_OVERRIDE_FUNCTION_PREFIX="), "fmi2DoStep ");
  EXPECT_EQ(steps_named("-DFMI2_OVERRIDE_FUNCTION_PREFIX -DFMI2_ACTUAL_FUNCTION_PREFIX=mine_"), "mine_fmi2DoStep ");
  EXPECT_EQ(steps_named("-DDISABLE_PREFIX"), "fmi2DoStep ");
}

TEST(ExportFmu, DescriptionKeepsTheRulesAndBytesRepeat) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {"compliance", "coil-lag"}});
  const TestVector vector = test_vector(exported, motion_for_testing());
  const std::string bytes = export_fmu(exported, vector).files.at("bouc_wen.fmu");
  EXPECT_EQ(bytes, export_fmu(exported, vector).files.at("bouc_wen.fmu"));
  auto files = unzipped(bytes);
  write(files, folder.path());
  const Outcome checked = shell(description_check + "modelDescription.xml", folder.path());
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  // The check can fail.
  std::ofstream(folder.path() / "wrong.xml")
      << replaced(files.at("modelDescription.xml"), "index=\"7\"", "index=\"6\"");
  EXPECT_EQ(shell(description_check + "wrong.xml", folder.path()).status, 1);
}

// Where an effect leads the drive, a sample brings the drive that acts.
ExportedModel leading(const Case& of) {
  ExportedModel exported = model_of(of);
  const std::vector<std::string> names = exported.model.parameter_names();
  for (Term& term : exported.terms) {
    if (names[term.parameter] == "sensor-delay.lag") term.value = -3.1e-3;
  }
  return exported;
}

TEST(Export, TakesTheDriveAhead) {
  for (const Case& of : {Case{"bouc-wen", {"sensor-delay"}}, Case{"modified-bouc-wen", {"coil-lag", "sensor-delay"}}}) {
    const TemporaryFolder folder;
    const ExportedModel exported = leading(of);
    EXPECT_DOUBLE_EQ(exported.drive_ahead(), 3.1e-3);
    const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 250));
    ExportedFiles files = export_c(exported, vector).files;
    EXPECT_NE(files.at(exported.name + ".h").find("A or V, of 0.0031 s after the sample"), std::string::npos);
    files.merge(ExportedFiles(export_python(exported, vector).files));
    write(files, folder.path());
    const std::string build = strict + exported.name + "_test.c " + exported.name + ".c -lm -o replay";
    ASSERT_EQ(shell(build, folder.path()).status, 0);
    const Outcome replayed = shell("./replay", folder.path());
    EXPECT_EQ(replayed.status, 0) << replayed.out;
    const Outcome in_python = shell("python3 " + exported.name + "_test.py", folder.path());
    EXPECT_EQ(in_python.status, 0) << in_python.out << in_python.err;
  }
}

TEST(Export, RefusesTheDriveAtTwoInstants) {
  EXPECT_THROW(links_of(leading({"preisach", {"sensor-delay"}})), InputError);  // whose equations take the drive
  ExportedModel lag_follows = leading({"bouc-wen", {"coil-lag", "sensor-delay"}});
  lag_follows.terms.push_back({lag_follows.model.law->parameters.size(), 1, 0, 1e-3});
  EXPECT_THROW(links_of(lag_follows), InputError);
  // Without parameters that follow the drive nothing has to be known.
  ExportedModel constant = leading({"preisach", {"sensor-delay"}});
  std::erase_if(constant.terms, [](const Term& term) { return term.drive_power > 0; });
  EXPECT_NO_THROW(links_of(constant));
}

TEST(Export, KnowsItsTargets) {
  EXPECT_EQ(export_targets().size(), 5U);
  EXPECT_THROW(export_target("fortran"), InputError);
}

// Its stiffness computes with the plain number, so that what is recorded would hold at one speed only.
struct Unrecordable {
  static constexpr std::string_view id = "unrecordable";
  static constexpr std::string_view title = "x";
  static constexpr std::string_view reference = "x";
  static constexpr std::string_view equations[] = {"x"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {{.name = "c", .unit = "1", .meaning = "x", .box = {0, 1}, .initial = 0.5}};
  template <class T>
  static std::array<T, 1> rate(const std::array<T, 1>& p, const std::array<T, 1>& s, const Input<T>& in) {
    return {p[0] * (in.v - s[0])};
  }
  template <class T>
  static T stiffness(const std::array<T, 1>& p, double speed) {
    return p[0] * T(2.0 * speed);
  }
  template <class T>
  static T force(const std::array<T, 1>& /*p*/, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& below) {
    return below + s[0];
  }
};
TEST(Export, RefusesEquationsThatComputeWithAPlainNumber) {
  static constexpr Part part = compile<Unrecordable>();
  EXPECT_THROW(equations_of(part), InputError);
}

}  // namespace
}  // namespace hysteron
