#include <wend/openpgl/boundary.h>

#include <cstdio>
#include <exception>
#include <new>

namespace wend::openpgl {

void report_exception() noexcept {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        std::fputs("openpgl: out of memory\n", stderr);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "openpgl: %s\n", e.what());
    } catch (...) {
        std::fputs("openpgl: an unknown exception\n", stderr);
    }
}

}  // namespace wend::openpgl
