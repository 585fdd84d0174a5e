// The module weft._weft: its parts, and errors of the library as exceptions of weft.errors.
#include <exception>

#include <pybind11/pybind11.h>

#include "python/src/images.h"
#include "weft/error.h"

namespace weft::python {
namespace {

namespace py = pybind11;

const char* class_of(const Error& error) {
  if (dynamic_cast<const Unstable*>(&error) != nullptr) return "Unstable";
  if (dynamic_cast<const SceneError*>(&error) != nullptr) return "SceneError";
  if (dynamic_cast<const TopologyError*>(&error) != nullptr) return "TopologyError";
  if (dynamic_cast<const InputError*>(&error) != nullptr) return "InputError";
  if (dynamic_cast<const OutputError*>(&error) != nullptr) return "OutputError";
  if (dynamic_cast<const UsageError*>(&error) != nullptr) return "UsageError";
  return "Error";
}

void raise(const Error& error) {
  if (error.code() == ExitCode::interrupted) return PyErr_SetNone(PyExc_KeyboardInterrupt);
  py::dict fields;
  fields["where"] = error.where();
  fields["found"] = error.found();
  fields["wanted"] = error.wanted();
  if (const auto* unstable = dynamic_cast<const Unstable*>(&error)) {
    const Unstable::Place& place = unstable->place();
    fields["frame"] = place.frame;
    fields["cloth"] = place.cloth;
    if (place.row >= 0) fields["sample"] = py::make_tuple(place.row, place.col);
  }
  const py::object raised = py::module_::import("weft.errors").attr(class_of(error));
  PyErr_SetObject(raised.ptr(), raised(error.what(), **fields).ptr());
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 asks for this signature
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    raise(error);
  }
}

}  // namespace
}  // namespace weft::python

PYBIND11_MODULE(_weft, module) {
  pybind11::register_exception_translator(weft::python::translate);
  module.attr("version") = WEFT_VERSION;
  weft::python::add_images(module);
  weft::python::add_garments(module);
  weft::python::add_simulations(module);
}
