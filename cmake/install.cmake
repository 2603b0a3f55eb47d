# cmake --install: program, its manual page and completions, library with a package for find_package, headers,
# documentation, datasets that ship.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hysteron RUNTIME)
install(DIRECTORY datasets/ DESTINATION "${CMAKE_INSTALL_DATADIR}/hysteron/datasets"
  PATTERN "*.?pp" EXCLUDE PATTERN support EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
# The pages link to each other.
install(DIRECTORY docs examples results DESTINATION "${CMAKE_INSTALL_DOCDIR}" PATTERN ".ipynb_checkpoints" EXCLUDE)

# The program writes its own manual page and completions.
if(NOT CMAKE_CROSSCOMPILING)
  set(words "${PROJECT_BINARY_DIR}/words")
  file(MAKE_DIRECTORY "${words}")
  add_custom_command(OUTPUT "${words}/hysteron.1" "${words}/hysteron" "${words}/_hysteron" "${words}/hysteron.fish"
    COMMAND hysteron man > "${words}/hysteron.1"
    COMMAND hysteron completion bash > "${words}/hysteron"
    COMMAND hysteron completion zsh > "${words}/_hysteron"
    COMMAND hysteron completion fish > "${words}/hysteron.fish"
    DEPENDS hysteron VERBATIM)
  add_custom_target(hysteron_words ALL DEPENDS "${words}/hysteron.1")
  install(FILES "${words}/hysteron.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${words}/hysteron" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${words}/_hysteron" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  install(FILES "${words}/hysteron.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()

# Every box but those of the program alone.
set(boxes core io simulate fit check judge diagnose report presets datasets challenge export compare respond external
  plugin study task)
add_library(hysteron_library INTERFACE)
set_target_properties(hysteron_library PROPERTIES EXPORT_NAME hysteron)
foreach(box IN LISTS boxes)
  set_target_properties(hysteron_${box} PROPERTIES EXPORT_NAME ${box})
  target_link_libraries(hysteron_library INTERFACE hysteron_${box})
  install(TARGETS hysteron_${box} EXPORT hysteron ARCHIVE)
endforeach()
foreach(words options pack_code reads_nothing)
  set_target_properties(hysteron_${words} PROPERTIES EXPORT_NAME ${words})
endforeach()
install(TARGETS hysteron_library hysteron_options hysteron_pack_code hysteron_reads_nothing EXPORT hysteron)
install(DIRECTORY src/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hysteron" FILES_MATCHING PATTERN "*.hpp"
  PATTERN app EXCLUDE PATTERN mpi EXCLUDE PATTERN "export/runtime" EXCLUDE)
install(FILES presets/preset.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hysteron/presets")
install(FILES datasets/dataset.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hysteron/datasets")
install(FILES datasets/support/shipped.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hysteron/datasets/support")

set(hysteron_with_pagmo OFF)
if(HYSTERON_PAGMO AND Pagmo_FOUND)
  set(hysteron_with_pagmo ON)
endif()
set(hysteron_with_minpack OFF)
if(HYSTERON_MINPACK AND cminpack_FOUND)
  set(hysteron_with_minpack ON)
endif()
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hysteron")
install(EXPORT hysteron NAMESPACE hysteron:: FILE hysteronTargets.cmake DESTINATION "${package_dir}")
configure_package_config_file(cmake/hysteronConfig.cmake.in "${PROJECT_BINARY_DIR}/hysteronConfig.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/hysteronConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/hysteronConfig.cmake" "${PROJECT_BINARY_DIR}/hysteronConfigVersion.cmake"
  DESTINATION "${package_dir}")
