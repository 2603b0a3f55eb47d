# Takes the files of HYSTERON_LEFT_OUT off a list, by their stems.
function(hysteron_leave_out list)
  foreach(stem IN LISTS HYSTERON_LEFT_OUT)
    list(FILTER ${list} EXCLUDE REGEX "/${stem}\\.cpp$")
  endforeach()
  set(${list} "${${list}}" PARENT_SCOPE)
endfunction()

# The file is the registration: collects FOLDER/*.cpp and writes a source with the catalogue of the symbols
# PREFIX_<stem> they define. A file whose symbol does not match its name fails to link, naming the symbol.
# Further arguments are folders whose files belong to the catalogue too (optional components).
function(hysteron_catalogue folder prefix type header accessor out_sources)
  set(patterns "${PROJECT_SOURCE_DIR}/${folder}/*.cpp")
  foreach(more IN LISTS ARGN)
    list(APPEND patterns "${PROJECT_SOURCE_DIR}/${more}/*.cpp")
  endforeach()
  file(GLOB files CONFIGURE_DEPENDS ${patterns})
  hysteron_leave_out(files)
  list(SORT files)
  set(declarations "")
  set(rows "")
  foreach(path IN LISTS files)
    get_filename_component(stem "${path}" NAME_WE)
    string(APPEND declarations "extern const ${type} ${prefix}_${stem};\n")
    string(APPEND rows "    &${prefix}_${stem},\n")
  endforeach()
  set(generated "${PROJECT_BINARY_DIR}/generated/${prefix}_catalogue.cpp")
  file(CONFIGURE OUTPUT "${generated}" CONTENT
"#include <vector>

#include \"@header@\"

namespace hysteron {
@declarations@
namespace {
std::vector<const @type@*>& rows() {
  static std::vector<const @type@*> all = {
@rows@};
  return all;
}
}  // namespace

std::span<const @type@* const> @accessor@() { return rows(); }
void add_to_@accessor@(const @type@* row);
void add_to_@accessor@(const @type@* row) { rows().push_back(row); }
}  // namespace hysteron
" @ONLY)
  set(${out_sources} ${files} "${generated}" PARENT_SCOPE)
endfunction()
