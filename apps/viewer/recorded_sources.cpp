#include <algorithm>
#include <filesystem>

#include "apps/viewer/colouring.h"
#include "apps/viewer/sources.h"
#include "weft/camera.h"
#include "weft/scene_file.h"

namespace weft::viewer {
namespace {

constexpr int converted_size = 257;

Vec3d middle_of(const Planes3& positions) {
  Vec3d sum;
  const int n = positions.size();
  for (int s = 0; s < n * n; ++s) sum += vec_cast<double>(positions.at(s));
  return (1.0 / (double{1} * n * n)) * sum;
}

}  // namespace

void colour_surface(const Colouring& colouring, const BorderMates& mates, const Planes3& positions,
                    Planes3& colours) {
  switch (colouring.by) {
    case ColourBy::mates:
      return colour_mates(mates, colours);
    case ColourBy::mip:
      return colour_mip(colouring.level, positions.size(), colours);
    case ColourBy::stretch:
      return colour_stretch(positions, colours);
    case ColourBy::positions:
      return colour_positions(positions, colours);
    default:
      if (colours.size() > 0) colours = Planes3();
  }
}

RunSource::RunSource(const std::string& folder, const SourceMaker& maker)
    : run_(open_run_folder(folder)) {
  bodies_.resize(run_.bodies.size());
  show_frame(0);
  Subject subject;
  subject.number = maker.number;
  subject.name = folder;
  subject.ground = run_.ground;
  subject.plays = true;
  for (const RecordedCloth& cloth : run_.cloths) {
    strains_.emplace_back();
    if (cloth.rest.size() > 0) strains_.back().emplace(cloth);
  }
  for (std::size_t i = 0; i < run_.cloths.size(); ++i)
    subject.cloths.push_back({run_.cloths[i].name,
                              run_.cloths[i].image.mates,
                              std::nullopt,
                              cloths_[i],
                              true,
                              run_.cloths[i].image.colours,
                              {},
                              rising_quads(run_.cloths[i].image)});
  for (const RecordedBody& body : run_.bodies)
    subject.bodies.push_back({body.name, body.image.mates, body.normals, body.positions_at(0),
                              body.recorded.has_value(), body.image.colours, body.positions,
                              rising_quads(body.image)});
  subject_ = std::make_shared<Subject>(std::move(subject));
}

void RunSource::show_frame(int frame) {
  cloths_.clear();
  for (const RecordedCloth& cloth : run_.cloths) cloths_.push_back(cloth.recorded.positions(frame));
  for (std::size_t i = 0; i < run_.bodies.size(); ++i)
    if (run_.bodies[i].recorded) bodies_[i] = run_.bodies[i].positions_at(frame);
  frame_ = frame;
}

bool RunSource::advance() {
  show_frame((frame_ + 1) % run_.frames);
  return run_.frames > 1;
}

void RunSource::colour(const Colouring& colouring, std::size_t cloth, Planes3& colours) const {
  const RecordedCloth& shown = run_.cloths[cloth];
  if (colouring.by == ColourBy::strain && strains_[cloth])
    return colour_strain(strains_[cloth]->at_samples(cloths_[cloth]), 0, colours);
  colour_surface(colouring, shown.image.mates, cloths_[cloth], colours);
}

void RunSource::show(const Colouring& colouring, Snapshot& snapshot) const {
  snapshot.cloths = cloths_;
  snapshot.bodies = bodies_;
  carry_normals(*subject_, snapshot);
  snapshot.colours.resize(cloths_.size());
  for (std::size_t i = 0; i < cloths_.size(); ++i) colour(colouring, i, snapshot.colours[i]);
  snapshot.frame = frame_;
  snapshot.report = {};
  snapshot.centre_of_mass = cloths_.empty() ? Vec3d{} : middle_of(cloths_.front());
  snapshot.held = false;
}

StillSource::StillSource(const std::string& name, const SourceMaker& maker) {
  ConvertOptions options;
  options.size = converted_size;
  options.normal_map_size = converted_size;
  options.threads = maker.threads;
  options.progress = maker.progress;
  LoadedSurface loaded = maker.surfaces->load(name, options);
  Subject subject;
  subject.number = maker.number;
  subject.name = name;
  subject.cloths.push_back({name,
                            loaded.image.mates,
                            std::move(loaded.normals),
                            world_positions(loaded.image),
                            false,
                            loaded.image.colours,
                            {},
                            rising_quads(loaded.image)});
  subject.ground = bounds(subject.cloths[0].start).lower.y;
  subject_ = std::make_shared<Subject>(std::move(subject));
}

void StillSource::show(const Colouring& colouring, Snapshot& snapshot) const {
  const SubjectSurface& surface = subject_->cloths[0];
  snapshot.cloths = {surface.start};
  snapshot.bodies.clear();
  snapshot.colours.resize(1);
  colour_surface(colouring, surface.mates, surface.start, snapshot.colours[0]);
  snapshot.frame = 0;
  snapshot.report = {};
  snapshot.centre_of_mass = middle_of(surface.start);
  snapshot.held = false;
}

std::unique_ptr<Source> open_source(const std::string& name, const SourceMaker& maker) {
  const std::filesystem::path path(name);
  if (path.extension() == ".json")
    return std::make_unique<SceneSource>(read_scene(path), name, maker);
  std::error_code ignored;  // reported when it is read
  if (std::filesystem::is_directory(path, ignored)) return std::make_unique<RunSource>(name, maker);
  return std::make_unique<StillSource>(name, maker);
}

}  // namespace weft::viewer
