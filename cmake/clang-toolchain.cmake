# The clang of the presets `clang` and `fuzz`, under whatever name the system has it. 14 first, as in debian-packages.txt.
find_program(WEND_CLANG NAMES clang++-14 clang++-19 clang++-18 clang++-17 clang++-16 clang++-15 clang++ REQUIRED)
mark_as_advanced(WEND_CLANG)
set(CMAKE_CXX_COMPILER ${WEND_CLANG})
