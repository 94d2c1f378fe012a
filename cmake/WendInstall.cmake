# The installed package: find_package(wend) gives the targets wend::guide, wend::guide_shared and, where the renderer is
# built, wend::render.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wend)

install(TARGETS wend_guide wend_guide_shared EXPORT wend-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT library)
# What is promised, and what that includes (tests/layers/check_public.py keeps the list).
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/public-headers.txt wend_public_headers)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/public-headers.txt)
foreach(header IN LISTS wend_public_headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT library)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/include/wend/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wend COMPONENT library)
install(EXPORT wend-targets NAMESPACE wend:: DESTINATION ${package_dir} COMPONENT library)

# For builds that know no CMake: wend-guide is the shared library, wend-guide-static the other one.
file(RELATIVE_PATH wend_include_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
foreach(pc wend-guide wend-guide-static)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${pc}.pc.in ${PROJECT_BINARY_DIR}/${pc}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${pc}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/wend-config.cmake.in ${PROJECT_BINARY_DIR}/wend-config.cmake
  INSTALL_DESTINATION ${package_dir})
# Before version 1.0 a new minor version may break what its users wrote.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wend-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wend-config.cmake ${PROJECT_BINARY_DIR}/wend-config-version.cmake
  DESTINATION ${package_dir} COMPONENT library)

# find_package(openpgl) gives the target openpgl::openpgl, of the version whose interface it has. A component of its own:
# where Open PGL itself is installed there is no room for it. It is there for who asks for it.
if(WEND_OPENPGL)
  set(openpgl_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/openpgl)
  get_target_property(openpgl_version openpgl VERSION)
  install(TARGETS openpgl EXPORT openpgl-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT openpgl EXCLUDE_FROM_ALL)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/openpgl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT openpgl EXCLUDE_FROM_ALL)
  install(EXPORT openpgl-targets NAMESPACE openpgl:: DESTINATION ${openpgl_package_dir} COMPONENT openpgl EXCLUDE_FROM_ALL)
  configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/openpgl-config.cmake.in ${PROJECT_BINARY_DIR}/openpgl-config.cmake
    INSTALL_DESTINATION ${openpgl_package_dir})
  # Renderers ask for the version that they were written for, 0.5 to 0.8.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/openpgl-config-version.cmake VERSION ${openpgl_version}
    COMPATIBILITY SameMajorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/openpgl-config.cmake ${PROJECT_BINARY_DIR}/openpgl-config-version.cmake
    DESTINATION ${openpgl_package_dir} COMPONENT openpgl EXCLUDE_FROM_ALL)
endif()

if(WEND_BUILD_RENDERER)
  install(TARGETS wend_renderer EXPORT wend-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT library)
  install(TARGETS wend RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # What `wend demo` renders; it looks for them beside the installed program.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/wend COMPONENT program)

  # The program itself writes its completions and its manual page, where this machine can run it.
  if(NOT CMAKE_CROSSCOMPILING)
    set(texts ${PROJECT_BINARY_DIR}/install-texts)
    install(CODE "
      file(MAKE_DIRECTORY \"${texts}\")
      function(wend_text file)
        execute_process(COMMAND \"$<TARGET_FILE:wend>\" \${ARGN} OUTPUT_FILE \"${texts}/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
      endfunction()
      wend_text(wend completion bash)
      wend_text(_wend completion zsh)
      wend_text(wend.fish completion fish)
      wend_text(wend.1 man-page)" COMPONENT program)
    install(FILES ${texts}/wend DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
    install(FILES ${texts}/_wend DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
    install(FILES ${texts}/wend.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
    install(FILES ${texts}/wend.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  endif()
endif()
