#include "apps/foreign/mesh/geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "apps/foreign/mesh/smooth.h"
#include "apps/formats/nff_reader.h"
#include "apps/formats/view_faults.h"
#include "apps/frontend/line/number_text.h"
#include "core/base/expect.h"
#include "core/scene/face_normals.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

bool spans_an_area(const std::vector<Vec3d>& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (!(cross(corners[i - 1] - corners[0], corners[i] - corners[0]) == Vec3d{})) {
      return true;
    }
  }
  return false;
}

Vec3d clamped(const Vec3d& color) {
  const auto channel = [](double share) { return share > 0 ? std::min(share, 1.0) : 0; };
  return {channel(color.x), channel(color.y), channel(color.z)};
}

void check_faces(const FaceList& faces, const std::string& name) {
  for (std::size_t i = 0; i < faces.ends.size(); ++i) {
    if (faces.ends[i] - faces.begin_of(i) > polygon_vertices_max) {
      throw core::InputError(name + ": face " + std::to_string(i) + " has too many corners, more than 65535; correct the file");
    }
  }
}

bool shows_nothing(const core::Material& material) {
  return material.transmittance >= 1 && material.diffuse <= 0 && material.specular <= 0 && material.tinted_specular <= 0 &&
         material.emission == Vec3d{} && !(material.refraction_index > 1);
}

/// For smooth_normals(): each run is one.
std::vector<std::uint32_t> groups_of(const std::vector<FaceRun>& runs) {
  std::vector<std::uint32_t> groups;
  for (std::size_t i = 0; i < runs.size() && runs.size() > 1; ++i) {
    groups.resize(runs[i].end, static_cast<std::uint32_t>(i + 1));
  }
  return groups;
}

}  // namespace

void GeometryWriter::add(PolygonMesh mesh, std::span<const FileMaterial> materials) {
  is_shared_ = false;
  if (!mesh.faces.ends.empty()) {
    add_objects(std::move(mesh), materials);
  }
}

std::optional<std::uint32_t> GeometryWriter::add_shared(PolygonMesh mesh, std::span<const FileMaterial> materials) {
  core::expect(!smooth_degrees_, "a mesh whose normals are reckoned anew is not shared");
  if (mesh.faces.ends.empty()) {
    return std::nullopt;
  }
  is_shared_ = true;
  const auto first = static_cast<std::uint32_t>(scene_.objects.size());
  const auto taken_since = [](std::uint64_t& count, std::uint64_t before) {
    const std::uint64_t since = count - before;
    count = before;
    return since;
  };
  const std::uint64_t unplaced = unplaced_, unseen = unseen_, without_colors = meshes_without_colors_;
  Shared shared{.name = mesh.name};
  for (const std::uint32_t vertex : mesh.faces.corners) {
    shared.box.include(mesh.vertices[vertex]);
  }
  add_objects(std::move(mesh), materials);
  shared.unplaced = taken_since(unplaced_, unplaced);
  shared.unseen = taken_since(unseen_, unseen);
  shared.without_colors = taken_since(meshes_without_colors_, without_colors);
  shared_.push_back(std::move(shared));
  instances_.meshes.push_back({first, static_cast<std::uint32_t>(scene_.objects.size())});
  return static_cast<std::uint32_t>(shared_.size() - 1);
}

void GeometryWriter::place(std::uint32_t mesh, const core::Transform& world) {
  const Shared& shared = shared_.at(mesh);
  if (!is_in_reach(shared.box, world)) {
    throw core::InputError(shared.name + ": a node takes it beyond 1e30; correct the transforms of the file");
  }
  has_area_ = has_area_ || has_area_in(instances_.meshes[mesh], world);
  unplaced_ += shared.unplaced;
  unseen_ += shared.unseen;
  meshes_without_colors_ += shared.without_colors;
  instances_.places.push_back({world, mesh, static_cast<std::uint32_t>(scene_.objects.size())});
}

bool GeometryWriter::has_area_in(const core::SharedMesh& mesh, const core::Transform& world) const {
  std::vector<Vec3d> corners;
  for (std::uint32_t i = mesh.first; i < mesh.end; ++i) {
    const core::Object& object = scene_.objects[i];
    corners.clear();
    for (std::uint32_t vertex = object.first; vertex < object.first + object.vertex_count; ++vertex) {
      corners.push_back(world.point(vertices_.points[vertices_.indices[vertex]]));
    }
    if (spans_an_area(corners)) {
      return true;
    }
  }
  return false;
}

/// Vertices may be anything where no face has them: they become one that a face has.
void GeometryWriter::settle_vertices(PolygonMesh& mesh) {
  if (std::ranges::all_of(mesh.vertices, [](const Vec3d& vertex) { return is_in_reach(vertex); })) {
    return;
  }
  std::vector<bool> is_seen(mesh.vertices.size());
  for (const std::uint32_t corner : mesh.faces.corners) {
    is_seen[corner] = true;
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (is_in_reach(mesh.vertices[i])) {
      continue;
    }
    const std::string name = mesh.name + ": vertex " + std::to_string(i);
    if (is_seen[i]) {
      throw core::InputError(name + " has a coordinate that is not a number, infinite or beyond 1e30; correct the file");
    }
    first_stray_ = strays_++ == 0 ? name : first_stray_;
    mesh.vertices[i] = mesh.vertices[mesh.faces.corners.front()];
  }
}

/// A mesh that has faces.
void GeometryWriter::add_objects(PolygonMesh mesh, std::span<const FileMaterial> materials) {
  check_faces(mesh.faces, mesh.name);
  settle_vertices(mesh);
  if (mesh.runs.empty()) {
    mesh.runs = {{.end = mesh.faces.ends.size(), .material = mesh.material}};
  }
  if (smooth_degrees_) {
    smooth_ = smooth_normals(mesh.vertices, mesh.faces, *smooth_degrees_, groups_of(mesh.runs));
    mesh.normals.clear();
  }
  std::size_t first = 0;
  for (const FaceRun& run : mesh.runs) {
    add_run(mesh, run, std::exchange(first, run.end), materials[run.material].material);
  }
  keep_vertices(std::move(mesh.vertices), std::move(mesh.faces.corners));
}

void GeometryWriter::add_run(const PolygonMesh& mesh, const FaceRun& run, std::size_t first_face, core::Material material) {
  const bool has_texture = material.texture != core::Material::no_texture, has_places = run.has_places && !mesh.places.empty();
  has_places_ = has_texture && has_places;
  unplaced_ += has_texture && !has_places ? 1 : 0;
  material.texture = has_places_ ? material.texture : core::Material::no_texture;
  if (!has_places_ && material.microfacets.have_texture()) {
    material.microfacets.use = core::FacetTexture::mean;
  }
  if (!has_places_ && mesh.alphas.empty()) {
    material.alpha = core::AlphaUse::none;
    material.alpha_cutoff = 0;
  }
  hides_colors_ = false;
  unseen_ += shows_nothing(material) ? 1 : 0;
  builder_.material(material);
  const bool is_plain = !smooth_degrees_ && mesh.normals.empty() && !has_places_ && mesh.colors.empty();
  std::size_t first = mesh.faces.begin_of(first_face);
  for (std::size_t face = first_face; face < run.end; ++face) {
    const std::size_t end = mesh.faces.ends[face];
    if (is_plain && (has_area_ || is_shared_)) {
      builder_.polygon(end - first);
    } else {
      add_face(mesh, material, first, end);
    }
    first = end;
  }
  meshes_without_colors_ += hides_colors_ ? 1 : 0;
}

void GeometryWriter::add(const core::Sphere& sphere, core::Material material) {
  if (!is_in_reach(sphere.center) || !(std::abs(sphere.radius) <= view_coordinate_max && sphere.radius != 0)) {
    throw core::InputError("a sphere has a centre or a radius that is not a number, infinite or beyond 1e30; correct the file");
  }
  material.texture = core::Material::no_texture;
  material.alpha = core::AlphaUse::none;
  material.alpha_cutoff = 0;
  unseen_ += shows_nothing(material) ? 1 : 0;
  has_area_ = true;
  builder_.material(material);
  builder_.sphere(sphere.center, sphere.radius);
}

/// If a mesh has far fewer vertices than it names, each corner gets its own, since others may name them, too.
void GeometryWriter::keep_vertices(std::vector<Vec3d> points, std::vector<std::uint32_t> indices) {
  if (points.size() > indices.size()) {
    points = expanded({std::move(points), indices});
    std::iota(indices.begin(), indices.end(), 0U);
  }
  if (vertices_.indices.empty()) {
    vertices_ = {std::move(points), std::move(indices)};
    return;
  }
  const auto first = static_cast<std::uint32_t>(vertices_.points.size());
  vertices_.points.insert(vertices_.points.end(), points.begin(), points.end());
  for (const std::uint32_t index : indices) {
    vertices_.indices.push_back(first + index);
  }
}

/// Gives a face the material of its colour, if that is one, and so few have others that each may have its own; else the mesh's.
bool GeometryWriter::set_one_color(const PolygonMesh& mesh, const core::Material& material, std::size_t first, std::size_t end) {
  const bool is_opaque = mesh.alphas.empty() || material.alpha == core::AlphaUse::none;
  const Vec3d& one = mesh.colors[mesh.of_corner(first)];
  for (std::size_t i = first; i < end; ++i) {
    if (!(mesh.colors[mesh.of_corner(i)] == one) || !(is_opaque || mesh.alphas[mesh.of_corner(i)] >= 1)) {
      builder_.material(material);
      return false;
    }
  }
  core::Material face = material;
  const std::array<double, 3> color{one.x, one.y, one.z};
  const bool is_one =
      face_colors_.contains(color) || (face_colors_.size() < face_colors_max && face_colors_.insert(color).second);
  if (is_one) {
    face.color = face.color * clamped(one);
    face.alpha = has_places_ ? face.alpha : core::AlphaUse::none;
    face.alpha_cutoff = has_places_ ? face.alpha_cutoff : 0;
  }
  builder_.material(face);
  return is_one;
}

void GeometryWriter::add_face(const PolygonMesh& mesh, const core::Material& material, std::size_t first, std::size_t end) {
  face_vertices_.clear();
  for (std::size_t i = first; i < end; ++i) {
    face_vertices_.push_back(mesh.vertices[mesh.faces.corners[i]]);
  }
  has_area_ = has_area_ || (!is_shared_ && spans_an_area(face_vertices_));
  face_normals_.clear();
  if (smooth_degrees_ || !mesh.normals.empty()) {
    for (std::size_t i = first; i < end; ++i) {
      face_normals_.push_back(smooth_degrees_ ? smooth_[i] : mesh.normals[mesh.of_corner(i)]);
    }
    if (!is_shared_ && core::are_the_faces_own(face_normals_, face_vertices_)) {  // what the shared ones say the place decides
      face_normals_.clear();
    }
  }
  const bool has_colors = !mesh.colors.empty() && !set_one_color(mesh, material, first, end);
  hides_colors_ = hides_colors_ || (has_colors && has_places_);
  if (has_places_ || has_colors) {
    add_corners(mesh, material, first, end);
  } else {
    add_flat_or_smooth(end - first);
  }
}

void GeometryWriter::add_flat_or_smooth(std::size_t corners) {
  if (face_normals_.empty()) {
    builder_.polygon(corners);
  } else {
    builder_.patch(corners, face_normals_);
  }
}

/// With their places on the texture, or their colours; alpha counts where the material says so.
void GeometryWriter::add_corners(const PolygonMesh& mesh, const core::Material& material, std::size_t first, std::size_t end) {
  face_corners_.clear();
  for (std::size_t i = first; i < end; ++i) {
    const Vec3d normal = face_normals_.empty() ? Vec3d{} : face_normals_[i - first];
    const std::size_t at = mesh.of_corner(i);
    const double alpha = mesh.alphas.empty() || material.alpha == core::AlphaUse::none ? 1 : mesh.alphas[at];
    face_corners_.push_back(has_places_ ? core::TexturedCorner{normal, mesh.places[at]}
                                        : core::colored_corner(normal, mesh.colors[at], alpha));
  }
  builder_.textured(face_corners_.size(), face_corners_);
}

}  // namespace dmpc::apps
