#include "apps/foreign/pbrt/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/foreign/pbrt/loop.h"
#include "apps/foreign/polygon/ply.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;
using enum ParameterType;
using PlaceOnPicture = std::array<float, 2>;

constexpr double coordinate_max = 1e30;

/// Vertices of a mesh that is being read, with their attributes.
struct Corners {
  std::vector<Vec3d> points, normals;
  std::vector<PlaceOnPicture> places;  ///< v increases upwards
  std::vector<std::uint32_t> indices;
};

std::vector<PlaceOnPicture> places_of(const Parameters& parameters) {
  const Parameter* found = parameters.find("uv", {point2, vector2, number});
  found = found == nullptr ? parameters.find("st", {point2, vector2, number}) : found;
  std::vector<PlaceOnPicture> places;
  for (std::size_t i = 0; found != nullptr && i + 1 < found->numbers.size(); i += 2) {
    places.push_back({static_cast<float>(found->numbers[i]), static_cast<float>(found->numbers[i + 1])});
  }
  return places;
}

void check_count(const Parameters& parameters, const char* name, std::size_t count, std::size_t points) {
  if (count != 0 && count != points) {
    parameters.fail("has " + grouped(count) + " values of \"" + name + "\", expected one for each of its " + grouped(points) +
                    " points");
  }
}

std::vector<std::uint32_t> indices_of(const Parameters& parameters, std::size_t points, std::size_t of_a_face) {
  const Parameter* const found = parameters.find("indices", {integer});
  std::vector<std::uint32_t> indices;
  if (found == nullptr) {
    if (points != of_a_face) {
      parameters.fail("has no \"integer indices\", and so " + std::to_string(of_a_face) + " points, but there are " +
                      grouped(points));
    }
    for (std::uint32_t i = 0; i < of_a_face; ++i) {
      indices.push_back(i);
    }
    return indices;
  }
  if (found->numbers.size() % of_a_face != 0) {
    parameters.fail(found->place, "has " + grouped(found->numbers.size()) + " indices, expected " + std::to_string(of_a_face) +
                                      " for each face");
  }
  indices.reserve(found->numbers.size());
  for (std::size_t i = 0; i < found->numbers.size(); ++i) {
    const double index = found->numbers[i];
    if (!(index >= 0 && index < static_cast<double>(points))) {
      parameters.fail(found->place, "index " + std::to_string(i) + " is of point " + rounded(index) +
                                        ", which does not exist: there are " + grouped(points));
    }
    indices.push_back(static_cast<std::uint32_t>(index));
  }
  return indices;
}

Corners corners_of(const Parameters& parameters, std::size_t of_a_face) {
  Corners corners{.points = parameters.points("P", {point3}),
                  .normals = parameters.points("N", {normal, vector3}),
                  .places = places_of(parameters),
                  .indices = {}};
  if (corners.points.empty()) {
    parameters.fail("has no \"point3 P\"");
  }
  check_count(parameters, "N", corners.normals.size(), corners.points.size());
  check_count(parameters, "uv", corners.places.size(), corners.points.size());
  corners.indices = indices_of(parameters, corners.points.size(), of_a_face);
  return corners;
}

/// Orients faces by their normals, whatever the order of their corners.
void turn_to_normals(PolygonMesh& mesh) {
  std::size_t first = 0;
  for (const std::uint32_t end : mesh.faces.ends) {
    if (!mesh.normals.empty()) {
      const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.faces.corners[first + i]]; };
      const auto normal_of = [&](std::size_t i) { return mesh.normals[mesh.of_corner(first + i)]; };
      const Vec3d normal = normal_of(0) + normal_of(1) + normal_of(2);
      if (dot(cross(corner(1) - corner(0), corner(2) - corner(0)), normal) < 0) {
        mesh.turn(first, end);
      }
    }
    first = end;
  }
}

void add_corner(const Corners& corners, std::uint32_t vertex, PolygonMesh& mesh) {
  mesh.faces.corners.push_back(vertex);
  if (!corners.normals.empty()) {
    mesh.normals.push_back(corners.normals[vertex]);
  }
  if (!corners.places.empty()) {
    mesh.places.push_back({corners.places[vertex][0], 1 - corners.places[vertex][1]});
  }
}

/// Triangles and quads without texture coordinates get pbrt's defaults, each separately.
void place_faces(PolygonMesh& mesh) {
  constexpr std::array<PlaceOnPicture, 4> corners{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};  // with v upwards: 0, 0, 1, 1
  const auto spread = [&mesh](auto& list) {
    auto of_corners = list;
    of_corners.clear();
    for (std::size_t i = 0; i < mesh.faces.corners.size() && !list.empty(); ++i) {
      of_corners.push_back(list[mesh.of_corner(i)]);
    }
    list = std::move(of_corners);
  };
  spread(mesh.normals);
  spread(mesh.colors);
  spread(mesh.alphas);
  mesh.is_by_vertex = false;
  std::size_t first = 0;
  for (const std::uint32_t end : mesh.faces.ends) {
    for (std::size_t i = first; i < end; ++i) {
      mesh.places.push_back(corners[(i - first) % corners.size()]);
    }
    first = end;
  }
}

PolygonMesh triangle_mesh(const Parameters& parameters, bool has_pictures) {
  Corners corners = corners_of(parameters, 3);
  PolygonMesh mesh{.name = {},
                   .vertices = std::move(corners.points),
                   .faces = triangle_list(std::move(corners.indices)),
                   .is_by_vertex = true,
                   .normals = std::move(corners.normals),
                   .places = std::move(corners.places)};
  for (PlaceOnPicture& place : mesh.places) {
    place[1] = 1 - place[1];
  }
  if (has_pictures && mesh.places.empty()) {
    place_faces(mesh);
  }
  turn_to_normals(mesh);
  return mesh;
}

template <class T>
T between(const T& p00, const T& p10, const T& p01, const T& p11, double u, double v) {
  return (p00 * (1 - u) + p10 * u) * (1 - v) + (p01 * (1 - u) + p11 * u) * v;
}

/// A patch between four straight edges, flat or bent.
class Patch {
 public:
  static constexpr int side = 8;  ///< faces along a side of a bent patch

  Patch(const Corners& corners, std::size_t first) : corners_(corners), first_(first) {}

  bool is_flat() const {
    const Vec3d a = point(1) - point(0), b = point(2) - point(0), c = point(3) - point(0), across = cross(a, b);
    constexpr double rounding = 1e-6;
    return std::abs(dot(across, c)) <= rounding * length(across) * (length(a) + length(b) + length(c));
  }

  void add_flat(PolygonMesh& mesh) const {
    for (const std::size_t corner : {0U, 1U, 3U, 2U}) {
      add_corner(corners_, index(corner), mesh);
      if (corners_.places.empty()) {
        mesh.places.push_back(place_at(static_cast<double>(corner % 2), static_cast<double>(corner / 2)));
      }
    }
    mesh.faces.ends.push_back(static_cast<std::uint32_t>(mesh.faces.corners.size()));
  }

  /// Appends 8x8 quads to the mesh.
  void add_bent(PolygonMesh& mesh) const {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int row = 0; row <= side; ++row) {
      for (int column = 0; column <= side; ++column) {
        mesh.vertices.push_back(at(static_cast<double>(column) / side, static_cast<double>(row) / side));
      }
    }
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        for (const auto& [across, up] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          const double u = static_cast<double>(column + across) / side, v = static_cast<double>(row + up) / side;
          mesh.faces.corners.push_back(first + static_cast<std::uint32_t>((row + up) * (side + 1) + column + across));
          mesh.normals.push_back(normal_at(u, v));
          mesh.places.push_back(place_at(u, v));
        }
        mesh.faces.ends.push_back(static_cast<std::uint32_t>(mesh.faces.corners.size()));
      }
    }
  }

 private:
  std::uint32_t index(std::size_t corner) const { return corners_.indices[first_ + corner]; }
  const Vec3d& point(std::size_t corner) const { return corners_.points[index(corner)]; }
  Vec3d at(double u, double v) const { return between(point(0), point(1), point(2), point(3), u, v); }
  Vec3d normal_at(double u, double v) const {
    if (!corners_.normals.empty()) {
      const auto& n = corners_.normals;
      return between(n[index(0)], n[index(1)], n[index(2)], n[index(3)], u, v);
    }
    return cross(at(1, v) - at(0, v), at(u, 1) - at(u, 0));
  }
  PlaceOnPicture place_at(double u, double v) const {
    Vec3d place{u, v, 0};
    if (!corners_.places.empty()) {
      const auto corner = [&](std::size_t i) {
        const PlaceOnPicture& p = corners_.places[index(i)];
        return Vec3d{double{p[0]}, double{p[1]}, 0};
      };
      place = between(corner(0), corner(1), corner(2), corner(3), u, v);
    }
    return {static_cast<float>(place.x), 1 - static_cast<float>(place.y)};
  }

  const Corners& corners_;
  std::size_t first_;
};

/// Checks capacity before memory is allocated for geometry that a few numbers generate.
void ask(const GeometrySize& size, const Parameters& parameters, const Tokens& tokens, SceneFiles& files) {
  files.totals().ask(size, [&] { return tokens.text_of(parameters.place()) + ": "; });
}

/// Patches are all flat, or all bent, so that all corners have the same attributes.
PolygonMesh patch_mesh(const Parameters& parameters, const Tokens& tokens, SceneFiles& files) {
  Corners corners = corners_of(parameters, 4);
  PolygonMesh mesh;
  bool are_flat = true;
  for (std::size_t i = 0; i < corners.indices.size(); i += 4) {
    are_flat = are_flat && Patch(corners, i).is_flat();
  }
  if (are_flat) {
    mesh.vertices = corners.points;
  } else {
    constexpr std::uint64_t bent_faces = Patch::side * Patch::side, corner_bytes = 2 * sizeof(Vec3d) + sizeof(PlaceOnPicture);
    const std::uint64_t faces = corners.indices.size() / 4 * bent_faces;
    ask(size_of_faces(faces, 4 * faces, corner_bytes), parameters, tokens, files);
  }
  for (std::size_t i = 0; i < corners.indices.size(); i += 4) {
    const Patch patch(corners, i);
    if (are_flat) {
      patch.add_flat(mesh);
    } else {
      patch.add_bent(mesh);
    }
  }
  turn_to_normals(mesh);
  return mesh;
}

PolygonMesh loop_mesh(const Parameters& parameters, const Tokens& tokens, SceneFiles& files) {
  constexpr std::uint64_t edge_bytes = 40;  // per entry of a table during subdivision
  const std::vector<Vec3d> points = parameters.points("P", {point3});
  if (points.empty()) {
    parameters.fail("has no \"point3 P\"");
  }
  const std::int64_t levels = parameters.integer("levels", 3);
  if (levels < 0 || levels > 100) {
    parameters.fail("has " + std::to_string(levels) + " levels, expected 0 to 100");
  }
  const std::vector<std::uint32_t> indices = indices_of(parameters, points.size(), 3);
  const std::uint64_t faces = indices.size() / 3 << 2U * static_cast<unsigned>(std::min<std::int64_t>(levels, 12));
  if (faces <= subdivided_max) {  // otherwise it is refused
    ask(size_of_faces(faces, 3 * faces, sizeof(Vec3d) + edge_bytes), parameters, tokens, files);
  }
  try {
    return subdivided(points, indices, static_cast<int>(levels));
  } catch (const core::InputError& error) {
    parameters.fail(error.what());
  }
}

PolygonMesh file_mesh(const Parameters& parameters, const Tokens& tokens, SceneFiles& files, Notes& notes, bool has_pictures) {
  const std::string name = parameters.text("filename", "");
  if (name.empty()) {
    parameters.fail("has no \"string filename\"");
  }
  notes.count("meshes with displacement, shown without", parameters.find("displacement", {texture, text}) != nullptr ? 1 : 0);
  std::vector<std::string> found;
  PolygonMesh mesh;
  try {
    const SourceText source(tokens.path_of(name), files);
    mesh = read_ply_shape(source.text(), files, found);
  } catch (const core::CapacityError& error) {
    throw core::CapacityError(tokens.text_of(parameters.place()) + ": " + name + ": " + error.what());
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    parameters.fail(text.starts_with(tokens.path_of(name)) ? text : name + ": " + text);
  }
  for (const std::string& note : found) {
    notes.count("meshes' files of which is said: " + note);
  }
  if (has_pictures && mesh.places.empty()) {
    place_faces(mesh);
  }
  turn_to_normals(mesh);
  return mesh;
}

double length_of(const Parameters& parameters, const char* name, double fallback) {
  const double value = parameters.number(name, fallback);
  if (!(value > 0 && value < coordinate_max)) {
    parameters.fail(std::string("its ") + name + " is " + rounded(value) + ", expected a length above 0 and below 1e30");
  }
  return value;
}

double angle_of(const Parameters& parameters) {
  const double degrees = std::min(parameters.number("phimax", 360), 360.0);
  if (!(degrees > 0)) {
    parameters.fail("its phimax is " + rounded(degrees) + ", expected degrees above 0");
  }
  return degrees;
}

RoundShape sphere(const Parameters& parameters) {
  const double radius = length_of(parameters, "radius", 1);
  const double first = parameters.number("zmin", -radius), second = parameters.number("zmax", radius);
  return {.kind = RoundKind::sphere,
          .radius = radius,
          .least_z = std::clamp(std::min(first, second), -radius, radius),
          .most_z = std::clamp(std::max(first, second), -radius, radius),
          .degrees = angle_of(parameters)};
}

RoundShape cylinder(const Parameters& parameters) {
  const double low = parameters.number("zmin", -1), high = parameters.number("zmax", 1);
  return {.kind = RoundKind::cylinder,
          .radius = length_of(parameters, "radius", 1),
          .least_z = std::min(low, high),
          .most_z = std::max(low, high),
          .degrees = angle_of(parameters)};
}

RoundShape disk(const Parameters& parameters) {
  RoundShape ring{.kind = RoundKind::ring, .radius = length_of(parameters, "radius", 1), .degrees = angle_of(parameters)};
  ring.least_z = parameters.number("height", 0);
  ring.inner = std::clamp(parameters.number("innerradius", 0), 0.0, ring.radius);
  return ring;
}

}  // namespace

std::optional<PlacedShape> shape_of(const std::string& kind, const Parameters& parameters, const Tokens& tokens,
                                    SceneFiles& files, Notes& notes, bool has_pictures) {
  PlacedShape shape;
  if (kind == "trianglemesh") {
    shape.mesh = triangle_mesh(parameters, has_pictures);
  } else if (kind == "plymesh") {
    shape.mesh = file_mesh(parameters, tokens, files, notes, has_pictures);
  } else if (kind == "bilinearmesh") {
    shape.mesh = patch_mesh(parameters, tokens, files);
  } else if (kind == "loopsubdiv") {
    shape.mesh = loop_mesh(parameters, tokens, files);
  } else if (kind == "sphere") {
    shape.round = sphere(parameters);
  } else if (kind == "disk" || kind == "cylinder") {
    shape.round = kind == "disk" ? disk(parameters) : cylinder(parameters);
    notes.count("disks and cylinders, shown as meshes of 64 sides");
  } else if (kind == "curve") {
    notes.count("curves left out");
    return std::nullopt;
  } else {
    parameters.fail("there is no shape of kind '" + clipped(kind, 40) + "' in pbrt-v4");
  }
  return shape;
}

}  // namespace dmpc::apps::pbrt
