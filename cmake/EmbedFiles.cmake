# Makes a C++ source of text files: cmake -D OUTPUT=FILE -D NAME=VARIABLE -D FILES=A:B:C -P EmbedFiles.cmake
# The variable is a list of wend::ServedFile in namespace wend; the first file is the page itself.

cmake_minimum_required(VERSION 3.18)

string(REPLACE ":" ";" files "${FILES}")
set(entries "")
set(name_of_first TRUE)
foreach(file IN LISTS files)
  file(READ "${file}" text)
  get_filename_component(name "${file}" NAME)
  get_filename_component(extension "${file}" LAST_EXT)
  if(extension STREQUAL ".html")
    set(type "text/html")
  elseif(extension STREQUAL ".css")
    set(type "text/css")
  else()
    set(type "text/javascript")
  endif()
  if(name_of_first)
    set(name "")
    set(name_of_first FALSE)
  endif()
  string(APPEND entries "    {\"${name}\", \"${type}; charset=utf-8\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#include <wend/view/page.h>

namespace wend {

static const ServedFile files[] = {
@entries@};

const std::span<const ServedFile> ${NAME} = files;

}  // namespace wend
" @ONLY)
