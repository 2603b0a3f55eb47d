# The toolchain of the page (preset browser): Emscripten with the headers of libc++ 16, since its own have no algorithms
# on ranges, and the packages that are headers alone. Targets of packages that the page does without are empty.

find_path(HYSTERON_LIBCXX NAMES ranges __algorithm/ranges_sort.h PATHS /usr/lib/llvm-16/include/c++/v1
  NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH DOC "headers of libc++ 16 (libc++-16-dev)")
if(NOT HYSTERON_LIBCXX)
  message(FATAL_ERROR "the headers of libc++ 16 were not found, expected the Debian package libc++-16-dev")
endif()
add_compile_options(-nostdinc++ "SHELL:-isystem ${PROJECT_SOURCE_DIR}/browser/standard"
  "SHELL:-isystem ${HYSTERON_LIBCXX}")

# Linked one by one into a folder of their own: beside them stand headers of the machine's C library.
set(headers "${PROJECT_BINARY_DIR}/headers")
file(MAKE_DIRECTORY "${headers}")
foreach(header fmt/core.h nlohmann/json.hpp toml++/toml.h Random123/philox.h boost/version.hpp Eigen/Core
    unsupported/Eigen/FFT)
  string(REGEX REPLACE "/.*" "" folder "${header}")
  find_path(HYSTERON_HEADERS_${folder} NAMES "${header}" PATHS /usr/include /usr/include/eigen3
    NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
  if(NOT HYSTERON_HEADERS_${folder})
    message(FATAL_ERROR "${header} was not found, expected the packages of scripts/setup.sh")
  endif()
  file(CREATE_LINK "${HYSTERON_HEADERS_${folder}}/${folder}" "${headers}/${folder}" SYMBOLIC)
endforeach()
include_directories(SYSTEM "${headers}")

foreach(target fmt::fmt nlohmann_json::nlohmann_json Eigen3::Eigen OpenMP::OpenMP_CXX Threads::Threads NLopt::nlopt
    ZLIB::ZLIB EXPAT::EXPAT SQLite::SQLite3 PkgConfig::hdf5 PkgConfig::libzip CLI11::CLI11)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)

# Stems of the files whose work needs a library or a process that a page has not, and of the solvers that the page does
# not offer: fit and diagnose do with the default one and lm.
set(HYSTERON_LEFT_OUT checkpoint fence mat mat5 mat73 mat_pipe mdf4 xlsx workbook_archive workbook_sheet workbook_styles
  workbook_table xml catalogue study export published
  aco_r adaptive_css cma_es crow_search css de ga ga_pattern_search grasshopper nelder_mead nlopt pattern_search pso
  pso_lm random_search shrinking_box_lm shuffled_frog_leaping spso_2011 ukf)
