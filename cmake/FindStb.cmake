# The stb headers: stb_image reads and stb_image_write writes the 8-bit picture formats.
find_path(Stb_INCLUDE stb_image.h PATH_SUFFIXES stb)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Stb REQUIRED_VARS Stb_INCLUDE)
if(Stb_FOUND AND NOT TARGET Stb::Stb)
  add_library(Stb::Stb INTERFACE IMPORTED)
  target_include_directories(Stb::Stb SYSTEM INTERFACE ${Stb_INCLUDE})
endif()
mark_as_advanced(Stb_INCLUDE)
