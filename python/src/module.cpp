// The module wend._wend: what the package's Python is written on. Arguments are checked and named by the Python above.
#include <wend/core/error.h>
#include <wend/version.h>

#include "bindings.h"

namespace wend::python {
namespace {

/// An InputError as Python's of the same name, with its place.
void translate(const std::exception_ptr& thrown, void*) {
    try {
        std::rethrow_exception(thrown);
    } catch (const InputError& error) {
        const nb::object type = nb::module_::import_("wend._errors").attr("InputError");
        const Place& place = error.place();
        const nb::object value = type(error.what(), place.file, place.line, place.column);
        PyErr_SetObject(type.ptr(), value.ptr());
    }
}

}  // namespace
}  // namespace wend::python

NB_MODULE(_wend, module) {
    using namespace wend::python;
    nb::set_leak_warnings(false);
    nb::register_exception_translator(translate);
    module.attr("version") = WEND_VERSION;
    bind_pictures(module);
    bind_fields(module);
    bind_scenes(module);
    bind_directives(module);
    bind_renders(module);
    bind_comparisons(module);
    bind_laboratory(module);
}
