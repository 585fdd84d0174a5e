
#include "weft/files.h"
#include "weft/mesh.h"

namespace weft {
namespace {

bool is_obj(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".obj";
}

/// Texture coordinates in order of first occurrence, without repetition at a vertex.
class TexturePool {
 public:
  TexturePool(std::size_t vertices, std::vector<Vec2f>& texture)
      : first_(vertices, -1), texture_(texture) {}

  int index_of(int vertex, Vec2f uv) {
    int* link = &first_[static_cast<std::size_t>(vertex)];
    while (*link >= 0) {
      if (texture_[static_cast<std::size_t>(*link)] == uv) return *link;
      link = &next_[static_cast<std::size_t>(*link)];
    }
    const int added = static_cast<int>(texture_.size());
    *link = added;  // before next_ may reallocate
    next_.push_back(-1);
    texture_.push_back(uv);
    return added;
  }

 private:
  std::vector<int> first_, next_;  // linked lists of each vertex's texture indices
  std::vector<Vec2f>& texture_;
};

}  // namespace

MeshFaces faces_of(const TriangleMesh& mesh) {
  MeshFaces faces;
  faces.sizes.assign(mesh.triangles.size(), 3);
  faces.corners.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    faces.corners.insert(faces.corners.end(), t.begin(), t.end());
  TexturePool pool(mesh.positions.size(), faces.texture);
  for (std::size_t t = 0; t < mesh.corner_uv.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      faces.texture_corners.push_back(pool.index_of(mesh.triangles[t][k], mesh.corner_uv[t][k]));
  return faces;
}

FanCorners fans_of(const MeshFaces& faces) {
  FanCorners fans;
  int first = 0;
  const auto add = [&](int a, int b, int c) {
    const Triangle places{first + a, first + b, first + c};
    fans.places.push_back(places);
    fans.triangles.push_back({faces.corners[static_cast<std::size_t>(places[0])],
                              faces.corners[static_cast<std::size_t>(places[1])],
                              faces.corners[static_cast<std::size_t>(places[2])]});
  };
  for (std::size_t p = 0; p < faces.sizes.size(); ++p) {
    const auto ears = faces.ears.find(static_cast<int>(p));
    if (ears != faces.ears.end())
      for (const auto& [a, b, c] : ears->second) add(a, b, c);
    else
      for (int k = 2; k < faces.sizes[p]; ++k) add(0, k - 1, k);
    first += faces.sizes[p];
  }
  return fans;
}

MeshFile read_mesh_file(const std::filesystem::path& path) {
  if (is_obj(path)) return parse_obj_file(read_file(path), path.string());
  MeshFile file{read_mesh(path), {}};
  file.faces = faces_of(file.mesh);
  return file;
}

}  // namespace weft
