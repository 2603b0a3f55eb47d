// FMI 2.0 co-simulation: the C sources with the interface around them, modelDescription.xml, and a binary where the
// machine has a C compiler.
#include <fmt/format.h>

#include "export/archive.hpp"
#include "export/compiler.hpp"
#include "export/runtime.hpp"
#include "export/targets.hpp"
#include "export/writer.hpp"
#include "io/sha256.hpp"

namespace hysteron {
namespace {

std::string xml_quoted(std::string text) {
  text = replaced(std::move(text), "&", "&amp;");
  text = replaced(std::move(text), "<", "&lt;");
  return replaced(std::move(text), "\"", "&quot;");
}

// In the form of a GUID, told by the contents.
std::string guid_of(const std::string& text) {
  const std::string digits = sha256_hex(text);
  return fmt::format("{{{}-{}-{}-{}-{}}}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(12, 4),
                     digits.substr(16, 4), digits.substr(20, 12));
}

// Variables stand in the order of their value references in runtime/fmu.c.
std::string model_description(const ExportedModel& exported, const TestVector& vector, const std::string& guid) {
  const double interval =
      vector.samples.size() < 2 ? 1e-3 : vector.samples.back().time / static_cast<double>(vector.samples.size() - 1);
  const auto input = [](int reference, const char* name, const char* unit, const std::string& description) {
    const std::string with_unit = *unit == '\0' ? "" : fmt::format(" unit=\"{}\"", unit);
    return fmt::format(
        "    <ScalarVariable name=\"{}\" valueReference=\"{}\" causality=\"input\" variability=\"continuous\" "
        "description=\"{}\">\n      <Real start=\"0\"{}/>\n    </ScalarVariable>\n",
        name, reference, description, with_unit);
  };
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{0}\" guid=\"{1}\" description=\"{2}\" "
      "generationTool=\"hysteron\" variableNamingConvention=\"flat\">\n"
      "  <CoSimulation modelIdentifier=\"{0}\" canHandleVariableCommunicationStepSize=\"true\" "
      "canGetAndSetFMUstate=\"true\">\n"
      "    <SourceFiles>\n      <File name=\"{0}.c\"/>\n      <File name=\"fmu.c\"/>\n    </SourceFiles>\n"
      "  </CoSimulation>\n",
      exported.name, guid, xml_quoted(exported.title()));
  text +=
      "  <UnitDefinitions>\n"
      "    <Unit name=\"m\"><BaseUnit m=\"1\"/></Unit>\n"
      "    <Unit name=\"m/s\"><BaseUnit m=\"1\" s=\"-1\"/></Unit>\n"
      "    <Unit name=\"m/s2\"><BaseUnit m=\"1\" s=\"-2\"/></Unit>\n"
      "    <Unit name=\"m/s3\"><BaseUnit m=\"1\" s=\"-3\"/></Unit>\n"
      "    <Unit name=\"N\"><BaseUnit kg=\"1\" m=\"1\" s=\"-2\"/></Unit>\n"
      "    <Unit name=\"Hz\"><BaseUnit s=\"-1\"/></Unit>\n"
      "    <Unit name=\"A\"><BaseUnit A=\"1\"/></Unit>\n"
      "    <Unit name=\"V\"><BaseUnit kg=\"1\" m=\"2\" s=\"-3\" A=\"-1\"/></Unit>\n"
      "  </UnitDefinitions>\n";
  text += fmt::format("  <DefaultExperiment startTime=\"0\" stepSize=\"{}\"/>\n  <ModelVariables>\n", interval);
  text += input(1, "displacement", "m", "displacement of the damper");
  text += input(2, "velocity", "m/s", "its velocity");
  const char* const drive = exported.drive == DriveKind::none      ? "current or voltage"
                            : exported.drive == DriveKind::voltage ? "voltage"
                                                                   : "current";
  const char* const drive_unit = exported.drive == DriveKind::none      ? ""
                                 : exported.drive == DriveKind::voltage ? "V"
                                                                        : "A";
  text += input(3, "drive", drive_unit, std::string(drive) + " of the damper, " + exported.about_drive());
  text += input(4, "slope", "m/s2", "slope of the velocity between communication points, unless derived");
  text += input(5, "acceleration", "m/s2", "acceleration that the equations see, unless derived");
  text += input(6, "jerk", "m/s3", "slope of the acceleration, unless derived");
  text +=
      "    <ScalarVariable name=\"force\" valueReference=\"7\" causality=\"output\" variability=\"continuous\" "
      "initial=\"calculated\" description=\"force of the damper\">\n      <Real unit=\"N\"/>\n    </ScalarVariable>\n";
  text += fmt::format(
      "    <ScalarVariable name=\"frequency\" valueReference=\"8\" causality=\"parameter\" variability=\"fixed\" "
      "description=\"frequency of the motion, where parameters follow it\">\n"
      "      <Real start=\"{}\" unit=\"Hz\"/>\n    </ScalarVariable>\n",
      literal(vector.frequency));
  text +=
      "    <ScalarVariable name=\"derive\" valueReference=\"1\" causality=\"parameter\" variability=\"fixed\" "
      "description=\"slope, acceleration and jerk from the velocity\">\n      <Boolean start=\"true\"/>\n"
      "    </ScalarVariable>\n"
      "  </ModelVariables>\n"
      "  <ModelStructure>\n"
      "    <Outputs>\n      <Unknown index=\"7\" dependencies=\"1 2 3 4 5 6\"/>\n    </Outputs>\n"
      "    <InitialUnknowns>\n      <Unknown index=\"7\" dependencies=\"1 2 3 4 5 6 8 9\"/>\n    </InitialUnknowns>\n"
      "  </ModelStructure>\n"
      "</fmiModelDescription>\n";
  return text;
}

std::string csv_of(const TestVector& vector) {
  std::string text =
      "segment,time [s],displacement [m],velocity [m/s],slope [m/s^2],acceleration [m/s^2],jerk [m/s^3],drive,force "
      "[N]\n";
  const auto add = [&](const char* segment, const TestSample& s, const std::string& force) {
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", segment, s.time, s.displacement, s.velocity, s.slope,
                        s.acceleration, s.jerk, s.drive, force);
  };
  for (const TestSample& sample : vector.lead_in) {
    add("lead-in", sample, "");
  }
  for (std::size_t n = 0; n < vector.samples.size(); ++n) {
    add("motion", vector.samples[n], fmt::format("{}", vector.force[n]));
  }
  return text;
}

}  // namespace

Export export_fmu(const ExportedModel& exported, const TestVector& vector) {
  const CSource source = c_source(exported, vector);
  std::string wrapper = with_name(runtime::fmu_c(), exported.name);
  wrapper = replaced(wrapper, "@title@", replaced(exported.title(), "*/", "* /"));
  wrapper = replaced(wrapper, "@frequency@", literal(vector.frequency));
  const std::string guid = guid_of(source.header + source.source + wrapper);
  wrapper = replaced(wrapper, "@guid@", guid);
  const ExportedFiles sources = {{exported.name + ".h", source.header},
                                 {exported.name + ".c", source.source},
                                 {"fmi2.h", std::string(runtime::fmi2_h())},
                                 {"fmu.c", wrapper}};
  ExportedFiles files = {{"modelDescription.xml", model_description(exported, vector, guid)},
                         {"resources/test_vector.csv", csv_of(vector)}};
  for (const auto& [name, text] : sources) {
    files["sources/" + name] = text;
  }
  std::string note = "FMI 2.0 for co-simulation, sources only: no C compiler for a binary was found";
  if (const std::string platform = fmi_platform(); !platform.empty()) {
    if (const auto library = shared_library(sources, {exported.name + ".c", "fmu.c"})) {
      files["binaries/" + platform + "/" + exported.name + ".so"] = *library;
      note = "FMI 2.0 for co-simulation, sources and a binary for " + platform;
    }
  }
  return {{{exported.name + ".fmu", zip_of(files)}}, note};
}

}  // namespace hysteron
