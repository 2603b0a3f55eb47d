// Modelica: a package whose block Damper holds the equations, for the tool's own solver, and whose block SampledDamper
// calls the C code as an external function, with its steps on reversals and its balance of series elements.
#include "export/modelica_block.hpp"
#include "export/runtime.hpp"
#include "export/targets.hpp"
#include "export/writer.hpp"

namespace hysteron {

Export export_modelica(const ExportedModel& exported, const TestVector& vector) {
  const std::string title = replaced(exported.title(), "\\", "/");
  std::string package = with_name(runtime::modelica_mo(), exported.name);
  package = replaced(package, "@title@", replaced(title, "\"", "'"));
  package = replaced(package, "@frequency@", literal(vector.frequency));
  package = replaced(package, "@drive@", exported.about_drive());
  const ModelicaBlock block = modelica_block(exported, vector);
  package = replaced(package, "@damper@", block.text);
  package = replaced(package, "@test@", modelica_test(vector, block));
  ExportedFiles files = {
      {exported.name + "/package.mo", package},
      {exported.name + "/Resources/Include/" + exported.name + "_modelica.h",
       replaced(with_name(runtime::modelica_h(), exported.name), "@title@", replaced(title, "*/", "* /"))}};
  for (const auto& [name, text] : c_files(exported, vector)) {
    const bool test = name.ends_with("_test.c");
    files[exported.name + (test ? "/Resources/Test/" : "/Resources/Include/") + name] = text;
  }
  return {files, "open " + exported.name + "/package.mo; the block is " + exported.name + ".Damper, its test " +
                     exported.name + ".Test"};
}

}  // namespace hysteron
