# The HTML report's plot library and page: fetches what web/package-lock.json pins into the build tree (the source
# tree is never written) and turns every file of the page into a C++ source.
#
# Gives: HYSTERON_WEB_SOURCES  generated .cpp files that implement src/report/web_assets.hpp
#        hysteron_web          target that builds them; needed by a library defined in another directory
# Takes: HYSTERON_UPLOT_DIR    an unpacked uplot package, for building without network (then npm is not needed)

get_filename_component(HYSTERON_WEB_DIR "${CMAKE_CURRENT_LIST_DIR}/../web" ABSOLUTE)
set(HYSTERON_WEB_BUILD_DIR "${CMAKE_BINARY_DIR}/web")
set(HYSTERON_UPLOT_DIR "" CACHE PATH "Unpacked uplot package; empty: fetched with npm")

if(HYSTERON_UPLOT_DIR)
  set(_uplot "${HYSTERON_UPLOT_DIR}")
  if(NOT EXISTS "${_uplot}/dist/uPlot.iife.min.js")
    message(FATAL_ERROR "HYSTERON_UPLOT_DIR=${_uplot} holds no dist/uPlot.iife.min.js: expected an unpacked uplot package")
  endif()
else()
  find_program(HYSTERON_NPM NAMES npm)
  if(NOT HYSTERON_NPM)
    message(FATAL_ERROR
      "npm was not found; it fetches the plot library of the HTML report. Install the Debian package `npm` "
      "(apt-get install npm), or set HYSTERON_UPLOT_DIR to an unpacked uplot package.")
  endif()
  set(_uplot "${HYSTERON_WEB_BUILD_DIR}/node_modules/uplot")
  set(_uplot_files "${_uplot}/dist/uPlot.iife.min.js" "${_uplot}/dist/uPlot.min.css" "${_uplot}/LICENSE")
  # npm unpacks files with a fixed old time stamp; without the touch they would count as out of date forever.
  add_custom_command(
    OUTPUT ${_uplot_files}
    COMMAND ${CMAKE_COMMAND} -E make_directory "${HYSTERON_WEB_BUILD_DIR}"
    COMMAND ${CMAKE_COMMAND} -E copy "${HYSTERON_WEB_DIR}/package.json" "${HYSTERON_WEB_DIR}/package-lock.json"
            "${HYSTERON_WEB_BUILD_DIR}"
    COMMAND ${CMAKE_COMMAND} -E chdir "${HYSTERON_WEB_BUILD_DIR}"
            "${HYSTERON_NPM}" ci --ignore-scripts --no-audit --no-fund --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch ${_uplot_files}
    DEPENDS "${HYSTERON_WEB_DIR}/package.json" "${HYSTERON_WEB_DIR}/package-lock.json"
    COMMENT "Fetching the plot library of the report (npm ci)"
    VERBATIM)
endif()

set(_hysteron_embed_script "${CMAKE_CURRENT_LIST_DIR}/embed.cmake")
set(HYSTERON_WEB_SOURCES "")
function(_hysteron_embed name input)
  set(output "${HYSTERON_WEB_BUILD_DIR}/${name}.cpp")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DINPUT=${input}" "-DOUTPUT=${output}" "-DNAME=${name}" -DHEADER=report/web_assets.hpp
            -DNAMESPACE=hysteron::web -P "${_hysteron_embed_script}"
    DEPENDS "${input}" "${_hysteron_embed_script}"
    COMMENT "Embedding ${name}"
    VERBATIM)
  set(HYSTERON_WEB_SOURCES ${HYSTERON_WEB_SOURCES} "${output}" PARENT_SCOPE)
endfunction()

_hysteron_embed(report_html "${HYSTERON_WEB_DIR}/report.html")
_hysteron_embed(report_css "${HYSTERON_WEB_DIR}/report.css")
_hysteron_embed(common_js "${HYSTERON_WEB_DIR}/common.js")
_hysteron_embed(chart_js "${HYSTERON_WEB_DIR}/chart.js")
_hysteron_embed(correlation_js "${HYSTERON_WEB_DIR}/correlation.js")
_hysteron_embed(quality_js "${HYSTERON_WEB_DIR}/quality.js")
_hysteron_embed(ranks_js "${HYSTERON_WEB_DIR}/ranks.js")
_hysteron_embed(report_js "${HYSTERON_WEB_DIR}/report.js")
_hysteron_embed(study_js "${HYSTERON_WEB_DIR}/study.js")
_hysteron_embed(compare_js "${HYSTERON_WEB_DIR}/compare.js")
_hysteron_embed(uplot_js "${_uplot}/dist/uPlot.iife.min.js")
_hysteron_embed(uplot_css "${_uplot}/dist/uPlot.min.css")
_hysteron_embed(uplot_license "${_uplot}/LICENSE")

add_custom_target(hysteron_web DEPENDS ${HYSTERON_WEB_SOURCES})
