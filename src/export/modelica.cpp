// Modelica: a package whose block calls the same C code as an external function. The sampled integration with its steps
// on reversals and its series elements is kept as it is, rather than left to a tool's solver.
#include "export/runtime.hpp"
#include "export/targets.hpp"
#include "export/writer.hpp"

namespace hysteron {

Export export_modelica(const ExportedModel& exported, const TestVector& vector) {
  const std::string title = exported.title();
  std::string package = with_name(runtime::modelica_mo(), exported.name);
  package = replaced(package, "@title@", replaced(title, "\"", "'"));
  package = replaced(package, "@frequency@", literal(vector.frequency));
  ExportedFiles files = {
      {exported.name + "/package.mo", package},
      {exported.name + "/Resources/Include/" + exported.name + "_modelica.h",
       replaced(with_name(runtime::modelica_h(), exported.name), "@title@", replaced(title, "*/", "* /"))}};
  for (const auto& [name, text] : c_files(exported, vector)) {
    const bool test = name.ends_with("_test.c");
    files[exported.name + (test ? "/Resources/Test/" : "/Resources/Include/") + name] = text;
  }
  return {files, "open " + exported.name + "/package.mo; the block is " + exported.name + ".Damper"};
}

}  // namespace hysteron
