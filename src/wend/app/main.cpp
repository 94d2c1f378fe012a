#include <wend/app/program.h>

#include <iostream>

int main(int argc, char** argv) {
    return wend::run_program(argc, argv, std::cout, std::cerr);
}
