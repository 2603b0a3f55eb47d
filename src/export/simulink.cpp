// Simulink: an S-function in C around the same code.
#include "export/runtime.hpp"
#include "export/targets.hpp"

namespace hysteron {

Export export_simulink(const ExportedModel& exported, const TestVector& vector) {
  ExportedFiles files = c_files(exported, vector);
  const std::string code = replaced(with_name(runtime::simulink_c(), exported.name), "@drive@", exported.about_drive());
  files[exported.name + "_sfun.c"] = replaced(code, "@title@", replaced(exported.title(), "*/", "* /"));
  return {files, "in MATLAB: mex " + exported.name + "_sfun.c " + exported.name + ".c"};
}

}  // namespace hysteron
