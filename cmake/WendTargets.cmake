# How every target of the project is compiled.

function(wend_target_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Pictures are reproducible bit for bit: no fused operations that depend on the compiler's choice. Nobody reads errno or the
  # floating-point exception flags, and loops vectorize only without them; results are the same.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-semantic-interposition
    -ffile-prefix-map=${PROJECT_SOURCE_DIR}/= # the same bytes from every checkout
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # false alarms on std::string in GCC 12 (its bug 105651)
    $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow> # of what is in another source
    $<$<BOOL:${WEND_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# What finds errors of memory and undefined behaviour, for the modules in WEND_SANITIZED_MODULES: those that foreign bytes
# or foreign callers reach. (The preset asan has it for everything, which compiles twice as long.)
set(wend_sanitizers -fsanitize=address,undefined -fno-sanitize-recover=undefined)
if(WEND_SANITIZED_MODULES)
  add_link_options(${wend_sanitizers})
endif()

# A library of all sources of the given modules (folders of src/wend), static unless SHARED is given. TARGET_objects is
# what it is made of, for another library of the same.
function(wend_add_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SHARED" "" "MODULES")
  set(kind STATIC)
  if(arg_SHARED)
    set(kind SHARED)
  endif()
  set(sources)
  set(objects $<TARGET_OBJECTS:${target}>)
  foreach(module IN LISTS arg_MODULES)
    file(GLOB_RECURSE module_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/wend/${module}/*.cpp)
    list(FILTER module_sources EXCLUDE REGEX "/app/main\\.cpp$")
    if(module IN_LIST WEND_SANITIZED_MODULES)
      # A target of its own, so that its sources can be compiled together as well (CMAKE_UNITY_BUILD).
      add_library(${target}_${module} OBJECT ${module_sources})
      wend_target_options(${target}_${module})
      target_compile_options(${target}_${module} PRIVATE ${wend_sanitizers} -fno-omit-frame-pointer -g1)
      # Of what is included there are no warnings here: other presets give them.
      target_include_directories(${target}_${module} SYSTEM PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
      target_compile_definitions(${target}_${module} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
      list(APPEND objects $<TARGET_OBJECTS:${target}_${module}>)
      set(module_sources $<TARGET_OBJECTS:${target}_${module}>)
    endif()
    list(APPEND sources ${module_sources})
  endforeach()
  add_library(${target} ${kind} ${sources})
  wend_target_options(${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>)
  set(${target}_objects ${objects} PARENT_SCOPE)
endfunction()
