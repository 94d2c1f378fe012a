#include <cstdio>

extern "C" float learn_and_ask();

int main() {
    const float density = learn_and_ask();
    std::printf("%g times the uniform density\n", static_cast<double>(density));
    return density > 5 && density < 100 ? 0 : 1;
}
