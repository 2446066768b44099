#include "apps/foreign/polygon/face_looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/geometry.h"
#include "apps/frontend/line/number_text.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"

namespace dmpc::apps {
namespace {

constexpr int byte_max = 255;

constexpr auto light_of_bytes = [] {
  std::array<float, byte_max + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(core::linear_from_srgb(static_cast<double>(i) / byte_max));
  }
  return table;
}();

float light_of(double channel, double most) {
  const double byte = channel / most * byte_max;
  const bool is_byte = byte >= 0 && byte <= byte_max && std::floor(byte) >= byte;
  return is_byte               ? light_of_bytes[static_cast<std::size_t>(byte)]
         : std::isnan(channel) ? 0
                               : static_cast<float>(core::linear_from_srgb(channel / most));
}

/// Returns for each face a material that combines the face's own with its colour, if any; returns nothing, without adding
/// materials, if there would be too many.
std::optional<std::vector<std::uint32_t>> coloured_materials(const FaceLooks& looks, PlacedFile& file) {
  if (looks.colors.empty()) {
    return looks.materials;
  }
  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> known;
  std::vector<std::uint32_t> materials;
  const std::size_t first = file.materials.size();
  materials.reserve(looks.colors.size());
  for (std::size_t i = 0; i < looks.colors.size(); ++i) {
    const auto& [red, green, blue] = looks.colors[i];
    const std::uint32_t own = looks.materials.empty() ? 0 : looks.materials[i];
    const auto next = static_cast<std::uint32_t>(first + known.size());
    materials.push_back(known.try_emplace({own, red, green, blue}, next).first->second);
    if (known.size() > face_colors_max) {
      return std::nullopt;
    }
  }
  file.materials.resize(first + known.size());
  for (const auto& [kind, number] : known) {
    const auto& [own, red, green, blue] = kind;
    FileMaterial& material = file.materials[number] = file.materials[own];
    material.material.color = material.material.color * core::Vec3d{red, green, blue};
  }
  return materials;
}

/// Reorders the faces.
void sort_faces(std::span<const std::uint32_t> order, PolygonMesh& mesh) {
  const FaceList faces = std::move(mesh.faces);
  const auto sort = [&]<class T>(const std::vector<T>& old, std::vector<T>& list) {
    std::vector<T> sorted;
    sorted.reserve(old.size());
    for (const std::uint32_t face : order) {
      for (std::size_t i = faces.begin_of(face); i < faces.ends[face] && !old.empty(); ++i) {
        sorted.push_back(old[i]);
      }
    }
    list = std::move(sorted);
  };
  sort(faces.corners, mesh.faces.corners);
  std::uint32_t end = 0;
  mesh.faces.ends.clear();
  for (const std::uint32_t face : order) {
    end += faces.ends[face] - static_cast<std::uint32_t>(faces.begin_of(face));
    mesh.faces.ends.push_back(end);
  }
  if (!mesh.is_by_vertex) {
    sort(mesh.normals, mesh.normals);
    sort(mesh.places, mesh.places);
    sort(mesh.colors, mesh.colors);
  }
}

void set_runs(const std::vector<std::uint32_t>& materials, PolygonMesh& mesh) {
  std::vector<std::uint32_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!std::is_sorted(materials.begin(), materials.end())) {
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return materials[a] < materials[b]; });
    sort_faces(order, mesh);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || materials[order[i]] != materials[order[i - 1]]) {
      mesh.runs.push_back({.material = materials[order[i]]});
    }
    mesh.runs.back().end = i + 1;
  }
  mesh.material = mesh.runs.empty() ? 0 : mesh.runs.front().material;
}

}  // namespace

void set_last(std::vector<Color>& colors, std::size_t count, const Color& color) {
  colors.resize(count, not_yet);
  colors.back() = color;
}

Color linear_color(const Color& color, double most) {
  return {double{light_of(color.x, most)}, double{light_of(color.y, most)}, double{light_of(color.z, most)}};
}

void make_linear(std::vector<Color>& colors, std::size_t count, double most, const Color& plain) {
  colors.resize(colors.empty() ? 0 : count, not_yet);
  for (Color& color : colors) {
    color = color == not_yet ? plain : linear_color(color, most);
  }
}

double full_light(const std::vector<Color>& colors) {
  const auto is_beyond = [](const Color& color) { return largest_component(color) > 1; };
  return std::any_of(colors.begin(), colors.end(), is_beyond) ? byte_max : 1;
}

void FaceLooks::give_way_to(const PolygonMesh& mesh, std::vector<std::string>& notes) {
  if (!mesh.colors.empty()) {
    note_count(notes, "colours of faces, which are not shown beside those of vertices", std::exchange(colors, {}).size());
  }
}

void add_face(std::span<const std::uint32_t> corners, PolygonMesh& mesh) {
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  FaceList& faces = mesh.faces;
  if (corners.size() >= most - faces.corners.size()) {
    throw core::CapacityError(mesh.name + " has more corners than there can be, " + grouped(most) + ": divide it");
  }
  faces.corners.insert(faces.corners.end(), corners.begin(), corners.end());
  faces.ends.push_back(static_cast<std::uint32_t>(faces.corners.size()));
}

void add_mesh(PolygonMesh mesh, FaceLooks looks, PlacedFile& file) {
  if (mesh.faces.ends.empty()) {
    return;
  }
  if (auto materials = coloured_materials(looks, file)) {
    looks.materials = *std::move(materials);
  } else {
    mesh.spread_to_corners();
    mesh.colors.reserve(mesh.faces.corners.size());
    for (std::size_t face = 0; face < looks.colors.size(); ++face) {
      mesh.colors.resize(mesh.faces.ends[face], looks.colors[face]);
    }
  }
  set_runs(looks.materials, mesh);
  file.add(std::move(mesh));
}

}  // namespace dmpc::apps
