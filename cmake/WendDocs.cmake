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

# The site of docs/site, where there is what it is made with: the target site, and the test docs.site, which builds it as well
# and fails for warnings and for links that lead nowhere.
set(WEND_DOCS_PYTHON "" CACHE FILEPATH "A Python interpreter that has python/requirements-docs.txt")
if(WEND_DOCS_PYTHON AND DOXYGEN_FOUND AND WEND_BUILD_PYTHON AND PROJECT_IS_TOP_LEVEL)
  set(wend_site ${WEND_DOCS_PYTHON} -B ${PROJECT_SOURCE_DIR}/docs/site/build.py
    --wend ${PROJECT_BINARY_DIR}/bin/wend --doxyfile ${PROJECT_BINARY_DIR}/docs/Doxyfile
    --python ${PROJECT_BINARY_DIR}/python --version ${PROJECT_VERSION} --output ${PROJECT_BINARY_DIR}/site)
  add_custom_target(site
    COMMAND ${wend_site}
    COMMENT "The site: ${PROJECT_BINARY_DIR}/site/html/index.html"
    USES_TERMINAL VERBATIM)
  add_dependencies(site wend wend_python)
endif()
