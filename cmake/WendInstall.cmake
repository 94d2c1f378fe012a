# The installed package: find_package(wend) gives the target wend::guide.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wend)

install(TARGETS wend_guide EXPORT wend-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
foreach(module IN LISTS wend_guide_modules)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/wend/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wend COMPONENT library
    FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE)
endforeach()
install(EXPORT wend-targets NAMESPACE wend:: DESTINATION ${package_dir} COMPONENT library)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/wend-config.cmake.in ${PROJECT_BINARY_DIR}/wend-config.cmake
  INSTALL_DESTINATION ${package_dir})
# Before version 1.0 a new minor version may break what its users wrote.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wend-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wend-config.cmake ${PROJECT_BINARY_DIR}/wend-config-version.cmake
  DESTINATION ${package_dir} COMPONENT library)

if(WEND_BUILD_RENDERER)
  install(TARGETS wend RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # What `wend demo` renders; it looks for them beside the installed program.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/wend COMPONENT program)
endif()
