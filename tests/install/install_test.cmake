function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " words "${ARGN}")
    message(FATAL_ERROR "${words}\n${out}${err}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${prefix}" --config "${CONFIG}")
# Nothing of the installation may lead back to the build: it is tried where it has been moved to.
file(RENAME "${prefix}" "${WORK}/moved")
set(prefix "${WORK}/moved")

# Flags of sanitizers and the like are the build's; the instruction set comes with the package.
string(REGEX REPLACE "-march=[^ ]+" "" FLAGS "${FLAGS}")
run(${CMAKE_COMMAND} -S "${HERE}/consumer" -B "${WORK}/consumer" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${prefix}"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_BUILD_TYPE=${CONFIG}")
run(${CMAKE_COMMAND} --build "${WORK}/consumer")
run("${WORK}/consumer/consumer")
if(NOT out MATCHES "^c0 = 1500\\.0 N s/m\n$")
  message(FATAL_ERROR "the consumer printed '${out}', expected c0 = 1500.0 N s/m")
endif()

# The program finds its datasets from where it stands now.
run("${prefix}/bin/hysteron" generate utfsm-mr-damper --only 10mm2Hz_0.50A --out "${WORK}/press")
foreach(file share/man/man1/hysteron.1 share/bash-completion/completions/hysteron share/zsh/site-functions/_hysteron
  share/fish/vendor_completions.d/hysteron.fish share/doc/hysteron/LICENSE share/doc/hysteron/docs/data-formats.md include/hysteron/task/fit.hpp)
  if(NOT EXISTS "${prefix}/${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
if(PYTHON)
  set(ENV{PYTHONPATH} "${prefix}/${PYTHON_DIR}")
  set(ENV{PYTHONDONTWRITEBYTECODE} 1)
  run("${PYTHON}" -c "import hysteron\nprint(hysteron.__file__, len(hysteron.dataset('utfsm-mr-damper', '10mm2Hz_0.50A')[0]))")
  if(NOT out MATCHES "^${prefix}/${PYTHON_DIR}/hysteron/__init__.py [0-9]+\n$")
    message(FATAL_ERROR "the installed package printed '${out}'")
  endif()
endif()

file(REMOVE_RECURSE "${WORK}")
