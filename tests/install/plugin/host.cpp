// Knows nothing of Wend but what the plugin shows.
#include <dlfcn.h>

#include <cstdio>

int main() {
    void* plugin = dlopen(PLUGIN, RTLD_NOW | RTLD_LOCAL);
    if (!plugin) {
        std::fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    const auto ask = reinterpret_cast<float (*)()>(dlsym(plugin, "learn_and_ask"));
    const float density = ask ? ask() : 0;
    std::printf("%g times the uniform density\n", static_cast<double>(density));
    if (dlsym(plugin, "wend_version") || dlsym(plugin, "wend_field_create")) {
        std::fprintf(stderr, "the plugin shows what it is made of\n");
        return 1;
    }
    return density > 5 && density < 100 ? 0 : 1;
}
