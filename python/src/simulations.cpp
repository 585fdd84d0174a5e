// Simulations: scenes as JSON, with the surfaces and motions that are in memory put into them.
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "python/src/arrays.h"
#include "python/src/calls.h"
#include "python/src/identity.h"
#include "python/src/images.h"
#include "weft/error.h"
#include "weft/run.h"
#include "weft/scene_file.h"
#include "weft/simulation.h"
#include "weft/state_bytes.h"

namespace weft::python {
namespace {

namespace py = pybind11;

/// A state that knows of which simulation it is.
struct State {
  SimulationState state;
  std::string identity;
};

/// The simulation, and what hands on its progress: each call has a listener of its own.
class Stepper {
 public:
  Stepper(const Scene& scene, const std::string& name, int threads, Progress& loading)
      : relay_(loading), simulation(scene, name, threads, {&relay_}) {}

  /// A frame more. Where it fails, the simulation is put back to where it was before it.
  FrameReport advance(Progress& listener) {
    relay_.listener = &listener;
    simulation.save(before_);
    try {
      const FrameReport report = simulation.advance();
      frame = simulation.frame();
      return report;
    } catch (...) {
      simulation.restore(before_);
      throw;
    }
  }

 private:
  struct Relay : Progress {
    explicit Relay(Progress& first) : listener(&first) {}
    void update(std::string_view stage, double fraction) override {
      listener->update(stage, fraction);
    }
    Progress* listener;
  };
  Relay relay_;
  SimulationState before_;

 public:
  Simulation simulation;
  std::vector<std::string> notes;  // of loading and of how it begins
  std::string identity;            // of the scene and where it begins
  std::atomic<bool> busy = false;
  std::atomic<int> frame = 0;  // done, which may be asked for while another call is at work
  /// Whether the call at work was told to stop and its caller has gone on without waiting.
  std::atomic<bool> stopping = false;
};

/// Waits a little without the interpreter's lock. @throws py::error_already_set on a signal
void wait_a_little() {
  {
    const Released released;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Claims a stepper for one call, after one that is stopping.
/// @throws RuntimeError while another thread's call goes on
class Claim {
 public:
  explicit Claim(std::shared_ptr<Stepper> stepper) {
    while (stepper->busy.exchange(true)) {
      if (!stepper->stopping)
        throw std::runtime_error("this simulation is at work in another call");
      wait_a_little();
    }
    stepper->stopping = false;
    stepper_ = std::move(stepper);
  }
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  ~Claim() {
    if (stepper_) stepper_->busy = false;
  }
  Stepper* operator->() const { return stepper_.get(); }

 private:
  std::shared_ptr<Stepper> stepper_;
};

class Simulated {
 public:
  Simulated(std::shared_ptr<Stepper> stepper, const std::vector<SceneCloth>& cloths)
      : stepper_(std::move(stepper)), carried_(cloths.size()) {
    for (const SceneCloth& cloth : cloths) placements_.push_back(cloth.placement);
  }

  py::dict advance(const py::object& progress) {
    const auto claim = std::make_shared<Claim>(stepper_);
    const auto report = std::make_shared<FrameReport>();
    try {
      run_released(progress,
                   [claim, report](Progress& told) { *report = (*claim)->advance(told); });
    } catch (...) {
      stepper_->stopping = true;
      throw;
    }
    return told_of(*report);
  }
  /// (self, cloths, bodies, ground)
  std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t> intersections() {
    const Claim claim(stepper_);
    const Released released;
    const IntersectionCounts counts = claim->simulation.intersections();
    return {counts.self, counts.cloths, counts.bodies, counts.ground};
  }
  py::array_t<float> cloth_samples(std::size_t index) {
    const Claim claim(stepper_);
    return samples(claim->simulation.cloths().at(index).state.position);
  }
  py::array_t<float> velocities(std::size_t index) {
    const Claim claim(stepper_);
    return samples(claim->simulation.cloths().at(index).state.velocity);
  }
  py::array_t<float> body_samples(std::size_t index) {
    const Claim claim(stepper_);
    return samples(claim->simulation.bodies().at(index).positions);
  }
  py::array_t<float> strains(std::size_t index) {
    const Claim claim(stepper_);
    const int n = claim->simulation.cloths().at(index).image.size();
    Grid<float> strains(n, n);
    claim->simulation.strain_at_samples(index, strains);
    std::vector<float> values;
    for (int row = 0; row < n; ++row)
      values.insert(values.end(), strains.row(row), strains.row(row) + n);
    return array_of<float>(std::move(values), {n, n});
  }
  Image cloth_image(std::size_t index) {
    return {std::make_shared<const GeometryImage>(stepper_->simulation.cloths().at(index).image)};
  }
  Image body_image(std::size_t index) {
    return {std::make_shared<const GeometryImage>(stepper_->simulation.bodies().at(index).image)};
  }
  /// The vertices of the mesh of a cloth where its samples (n, n, 3) are so. (V, 3)
  py::array_t<float> carry(std::size_t index, const Floats& samples) {
    const SimulatedCloth& cloth = stepper_->simulation.cloths().at(index);
    const int n = cloth.image.size();
    if (samples.ndim() != 3 || samples.shape(0) != n || samples.shape(1) != n ||
        samples.shape(2) != 3)
      throw py::value_error("the cloth's samples (n, n, 3) are wanted");
    std::unique_ptr<CarriedVertices>& carried = carried_.at(index);
    if (!carried)
      carried = std::make_unique<CarriedVertices>(stepper_->simulation, index, placements_[index]);
    Planes3 planes(n);
    const float* p = samples.data();
    for (int sample = 0; sample < n * n; ++sample, p += 3) planes.set(sample, {p[0], p[1], p[2]});
    std::vector<Vec3f> positions = carried->positions(planes);
    const auto vertices = static_cast<py::ssize_t>(positions.size());
    return array_of<float>(std::move(positions), {vertices, 3});
  }
  std::string hash() {
    const Claim claim(stepper_);
    return claim->simulation.state_hash();
  }
  std::shared_ptr<State> save() {
    const Claim claim(stepper_);
    auto kept = std::make_shared<State>();
    claim->simulation.save(kept->state);
    kept->identity = claim->identity;
    return kept;
  }
  void restore(const State& kept) {
    const Claim claim(stepper_);
    if (kept.identity != claim->identity)
      throw py::value_error("state: one of this simulation, or of one made alike, is wanted");
    claim->simulation.restore(kept.state);
    claim->frame = kept.state.frame;
  }
  [[nodiscard]] std::vector<std::string> names(bool cloths) const {
    std::vector<std::string> found;
    if (cloths)
      for (const SimulatedCloth& cloth : stepper_->simulation.cloths()) found.push_back(cloth.name);
    else
      for (const PlacedBody& body : stepper_->simulation.bodies()) found.push_back(body.name);
    return found;
  }
  [[nodiscard]] int frame() const { return stepper_->frame; }
  [[nodiscard]] const Simulation& simulation() const { return stepper_->simulation; }
  [[nodiscard]] const std::vector<std::string>& notes() const { return stepper_->notes; }

 private:
  static py::array_t<float> samples(const Planes3& planes) {
    const py::ssize_t n = planes.size();
    return array_of<float>(samples_of(planes), {n, n, 3});
  }
  static py::dict told_of(const FrameReport& report) {
    py::dict told;
    told["milliseconds"] = report.milliseconds;
    told["iterations"] = report.iterations;
    told["residual"] = report.residual;
    told["strain"] = py::make_tuple(report.strain.mean, report.strain.p99, report.strain.max);
    told["kinetic_energy"] = report.kinetic_energy;
    told["potential_energy"] = report.potential_energy;
    told["work"] = report.work;
    told["contacts"] = report.contacts;
    told["self_contacts"] = report.self_contacts;
    told["stopped"] = report.stopped;
    told["fell_back"] = report.fell_back;
    told["buried"] = report.buried;
    told["lost_time"] = report.lost_time;
    told["smallest_gap"] = report.smallest_gap;
    const Vec3d& c = report.centre_of_mass;
    told["centre_of_mass"] = py::make_tuple(c.x, c.y, c.z);
    return told;
  }

  std::shared_ptr<Stepper> stepper_;
  std::vector<Placement> placements_;                      // of cloths
  std::vector<std::unique_ptr<CarriedVertices>> carried_;  // of cloths, made when asked for
};

/// A surface in memory: None, an Image, or a mesh as (V, F, texture coordinates or None, name).
void put_surface(const py::handle& given, Surface& surface, const std::string& name) {
  if (given.is_none()) return;
  if (py::isinstance<Image>(given)) {
    surface.name = name;
    surface.image = given.cast<const Image&>().image;
    surface.mesh = nullptr;
    return;
  }
  const auto [vertices, faces, uv, called] =
      given.cast<std::tuple<Doubles, Ints, std::optional<Floats>, std::string>>();
  TriangleMesh mesh = mesh_of(vertices, faces);
  if (uv) set_texture(mesh, *uv);
  surface = Surface(std::move(mesh), called);
}

/// A motion in memory: None, or (positions (T, n, 3), frames a second, seconds of wait, of
/// lead-in).
void put_motion(const py::handle& given, SceneBody& body) {
  if (given.is_none()) return;
  const auto [positions, rate, wait, lead_in] =
      given.cast<std::tuple<Floats, double, double, double>>();
  body.wait = wait;
  body.lead_in = lead_in;
  if (positions.ndim() != 3 || positions.shape(2) != 3)
    throw py::value_error("an array (T, n, 3) of positions is wanted");
  PointCache cache;
  cache.points = static_cast<int>(positions.shape(1));
  for (py::ssize_t k = 0; k < positions.shape(0); ++k)
    cache.times.push_back(static_cast<double>(k) / rate);
  const auto p = positions.unchecked<3>();
  for (py::ssize_t k = 0; k < p.shape(0); ++k)
    for (py::ssize_t i = 0; i < p.shape(1); ++i)
      cache.positions.push_back({p(k, i, 0), p(k, i, 1), p(k, i, 2)});
  body.animation = Animation(std::move(cache), "motion of " + body.name);
}

/// Puts what is in memory of each surface or motion into a scene's cloths or bodies.
template <class Items, class Put>
void put_all(const py::handle& given, Items& items, const Put& put) {
  const auto list = given.cast<py::list>();
  for (std::size_t i = 0; i < list.size() && i < items.size(); ++i) put(list[i], items[i]);
}

/// @param given  the scene's `json`, `name` and `folder`; of what is in memory `cloths` and
/// `bodies`,
///               as put_surface takes each, and `motions` of bodies, as put_motion takes each
Scene scene_of(const py::dict& given) {
  const auto name = given["name"].cast<std::string>();
  Scene scene =
      parse_scene(given["json"].cast<std::string>(), name, given["folder"].cast<std::string>());
  const auto put = [](const py::handle& surface, auto& made) {
    put_surface(surface, made.surface, made.name);
  };
  put_all(given["cloths"], scene.cloths, put);
  put_all(given["bodies"], scene.bodies, put);
  put_all(given["motions"], scene.bodies, put_motion);
  if (const std::optional<std::uint64_t> available = available_memory())
    check_memory(estimate_memory(scene), *available, name);
  return scene;
}

std::unique_ptr<Simulated> simulate(const py::dict& given, int threads,
                                    const py::object& progress) {
  const Scene scene = scene_of(given);
  const auto name = given["name"].cast<std::string>();
  const auto made = std::make_shared<std::shared_ptr<Stepper>>();
  const auto json = given["json"].cast<std::string>();
  run_released(progress, [scene, name, threads, json, made](Progress& told) {
    auto stepper = std::make_shared<Stepper>(scene, name, threads, told);
    const Simulation& simulation = stepper->simulation;
    stepper->notes = simulation.notes();
    for (std::string& note : begin_notes(simulation, scene, simulation.intersections()))
      stepper->notes.push_back(std::move(note));
    stepper->identity = identity_of(json, scene, simulation);
    *made = std::move(stepper);
  });
  return std::make_unique<Simulated>(*made, scene.cloths);
}

/// A state as it travels between processes.
std::shared_ptr<State> state_from_bytes(const py::bytes& bytes, const std::string& identity) {
  return std::make_shared<State>(
      State{decode_state(std::string_view(bytes), "a saved state"), identity});
}

void write_cache(const std::string& path, const Floats& positions) {
  if (positions.ndim() != 3 || positions.shape(2) != 3)
    throw py::value_error("an array (T, n, 3) of positions is wanted");
  PointCache cache;
  cache.points = static_cast<int>(positions.shape(1));
  for (py::ssize_t k = 0; k < positions.shape(0); ++k)
    cache.times.push_back(static_cast<double>(k));
  const float* p = positions.data();
  for (py::ssize_t i = 0; i < positions.size(); i += 3)
    cache.positions.push_back({p[i], p[i + 1], p[i + 2]});
  const Released released;
  write_pc2(path, cache);
}

/// (positions (T, n, 3), times (T) in seconds or frames, whether they are frames)
py::tuple read_cache(const std::string& path, double frame_rate, const std::string& clip) {
  PointCache cache = made_released([path, frame_rate, clip] {
    return read_point_cache(path, {clip, frame_rate});
  });
  const py::ssize_t samples = cache.samples(), points = cache.points;
  return py::make_tuple(array_of<float>(std::move(cache.positions), {samples, points, 3}),
                        array_of<double>(std::move(cache.times), {samples}), cache.times_in_frames);
}

}  // namespace

void add_simulations(py::module_& module) {
  module.def("simulate", &simulate);
  module.def("write_pc2", &write_cache);
  module.def("read_point_cache", &read_cache);
  py::class_<State, std::shared_ptr<State>>(module, "State")
      .def_property_readonly("frame", [](const State& kept) { return kept.state.frame; })
      .def(py::pickle(
          [](const State& kept) {
            return py::make_tuple(py::bytes(encode_state(kept.state)), kept.identity);
          },
          [](const py::tuple& parts) {
            return state_from_bytes(parts[0].cast<py::bytes>(), parts[1].cast<std::string>());
          }));
  py::class_<Simulated>(module, "Simulated")
      .def("advance", &Simulated::advance)
      .def("intersections", &Simulated::intersections)
      .def("cloth_samples", &Simulated::cloth_samples)
      .def("body_samples", &Simulated::body_samples)
      .def("velocities", &Simulated::velocities)
      .def("strains", &Simulated::strains)
      .def("cloth_image", &Simulated::cloth_image)
      .def("body_image", &Simulated::body_image)
      .def("carry", &Simulated::carry)
      .def("state_hash", &Simulated::hash)
      .def("save", &Simulated::save)
      .def("restore", &Simulated::restore)
      .def("names", &Simulated::names)
      .def_property_readonly("frame", &Simulated::frame)
      .def_property_readonly("particles",
                             [](const Simulated& s) { return s.simulation().particles(); })
      .def_property_readonly("mass", [](const Simulated& s) { return s.simulation().mass(); })
      .def_property_readonly("notes", &Simulated::notes);
}

}  // namespace weft::python
