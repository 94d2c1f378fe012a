# Pages of the promised headers by Doxygen: the target docs, and the Doxyfile that the test layers.api_pages runs as well.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/public-headers.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/public-headers.txt wend_documented)
list(TRANSFORM wend_documented REPLACE "(.+)" "\"${PROJECT_SOURCE_DIR}/src/\\1\"")
list(JOIN wend_documented " " wend_documented)
configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/docs/Doxyfile @ONLY)

find_package(Doxygen QUIET)
if(DOXYGEN_FOUND AND PROJECT_IS_TOP_LEVEL)
  add_custom_target(docs
    COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/docs/Doxyfile
    COMMENT "API pages: ${PROJECT_BINARY_DIR}/docs/html/index.html"
    VERBATIM)
endif()
