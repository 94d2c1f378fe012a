#include <wend/app/program.h>

#include <csignal>
#include <iostream>

int main(int argc, char** argv) {
    // A file beyond the limit of its size (ulimit -f, as batch systems set it) is then an error like a full disk, and
    // not the end of a render that could go on.
    std::signal(SIGXFSZ, SIG_IGN);
    return wend::run_program(argc, argv, std::cout, std::cerr);
}
