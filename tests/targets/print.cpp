// Prints the fingerprint of the guide as this program was compiled.
#include <tests/targets/fingerprint.h>

#include <cinttypes>
#include <cstdio>

int main() {
    std::printf("%016" PRIx64 "\n", wend::test::fingerprint());
}
