#include "apps/foreign/polygon/ply.h"

#include <algorithm>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/polygon/face_looks.h"
#include "apps/foreign/polygon/ply_header.h"
#include "apps/foreign/polygon/ply_row.h"
#include "apps/foreign/polygon/ply_surfaces.h"
#include "apps/foreign/polygon/ply_values.h"
#include "apps/foreign/polygon/reading_progress.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/system/byte_order_mark.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using enum PlyRole;

/// Counters for the final notes.
struct PlyCounts {
  std::uint64_t thin = 0, see_through = 0, materials_of_none = 0, textures_of_none = 0, of_other_names = 0;
};

Color row_color(const PlyRow& row) {
  const auto channel = [&row](PlyRole role) { return double{static_cast<float>(row[role])}; };
  return {channel(red), channel(green), channel(blue)};
}

/// Returns the maximum of a channel; 0 if the type does not imply it.
double full_light_of(PlyType type) {
  constexpr double byte_max = 255;
  return !is_whole(type) ? 0 : type == PlyType::uint16 ? most_of(type) : byte_max;
}

bool is_see_through(const PlyRow& row) {
  const double full = row.has(alpha) ? full_light_of(row.type_of(alpha)) : 0;
  return row.has(alpha) && row[alpha] < (full > 0 ? full : 1);
}

std::uint64_t count_beyond(const std::vector<Color>& colors, double full) {
  return static_cast<std::uint64_t>(std::count_if(colors.begin(), colors.end(), [full](const Color& color) {
    const auto is_within = [full](double channel) { return channel >= 0 && channel <= full; };
    return color != not_yet && !(is_within(color.x) && is_within(color.y) && is_within(color.z));
  }));
}

class PlyReader {
 public:
  PlyReader(std::string_view file, ReadingProgress& progress)
      : progress_(progress), header_(read_ply_header(file)), values_(ply_values(header_, file)), surfaces_(header_.textures) {}

  PlacedFile read() {
    read_elements();
    note_all();
    extension_colors();
    PlacedFile file{.materials = surfaces_.materials(!mesh_.colors.empty() || !looks_.colors.empty()),
                    .notes = std::move(header_.notes),
                    .coordinate_rounding = coordinate_rounding_};
    file.notes.insert(file.notes.end(), notes_.begin(), notes_.end());
    for (FileMaterial& material : file.materials) {
      material.texture = is_textured() ? material.texture : std::nullopt;  // textures that are not shown are not loaded
    }
    add_to(file);
    return file;
  }

  /// The caller provides the surface.
  PolygonMesh read_shape(std::vector<std::string>& notes) {
    read_elements();
    note_count(notes, "points and lines left out", counts_.thin);
    mesh_.colors = {};
    looks_ = {};
    PlacedFile file;
    add_to(file);
    return file.shapes.empty() ? PolygonMesh{} : std::move(file.shapes.front().mesh);
  }

 private:
  template <class Take>
  void for_each(const PlyElement& element, PlyRow& row, const Take& take) {
    std::uint64_t number = 0;
    try {
      for (; number < element.count && !element.properties.empty(); ++number) {
        row.read();
        take(number);
        progress_.show(values_->position());
      }
    } catch (const PlyIsShort&) {
      throw core::InputError("the file is cut short: it ends within element '" + clipped(element.name, 40) + "' " +
                             std::to_string(number + 1) + " of " + std::to_string(element.count) + values_->doubt());
    }
  }

  void read_elements() {
    bool has_vertices = false;
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" && std::exchange(has_vertices, true)) {
        throw core::InputError("the header has the element 'vertex' twice; expected it once");
      }
      vertex_count_ += element.name == "vertex" ? element.count : 0;
      has_materials_ = has_materials_ || (element.name == "material" && element.count > 0);
    }
    for (const PlyElement& element : header_.elements) {
      read_element(element);
    }
  }

  void read_element(const PlyElement& element) {
    if (element.name == "vertex") {
      read_vertices(element);
    } else if (element.name == "face") {
      read_faces(element);
    } else if (element.name == "tristrips") {
      read_strips(element);
    } else if (element.name == "material") {
      read_materials(element);
    } else {
      skip(element);
    }
  }

  void read_vertices(const PlyElement& element) {
    PlyRow row(element, *values_, {x, y, z, normal_x, normal_y, normal_z, s, t, red, green, blue, alpha});
    note_left_out(element, row);
    note_incomplete(element, row);
    if (!row.has_all({x, y, z})) {
      throw core::InputError("the element 'vertex' has no properties x, y and z; expected all three");
    }
    set_precision(row);
    const bool has_normals = row.has_all({normal_x, normal_y, normal_z}), has_places = row.has_all({s, t}),
               has_colors = row.has_all({red, green, blue});
    vertex_light_ = has_colors ? full_light_of(row.type_of(red)) : 0;
    const std::uint64_t room = std::min(element.count, values_->room_for(element));
    mesh_.vertices.reserve(room);
    mesh_.normals.reserve(has_normals ? room : 0);
    mesh_.places.reserve(has_places ? room : 0);
    mesh_.colors.reserve(has_colors ? room : 0);
    for_each(element, row, [&](std::uint64_t /*number*/) {
      take_vertex(row, has_normals, has_places);
      if (has_colors) {
        mesh_.colors.push_back(row_color(row));
        counts_.see_through += is_see_through(row) ? 1 : 0;
      }
    });
  }

  void note_left_out(const PlyElement& element, const PlyRow& row) {
    const std::vector<std::string> names = row.left_out();
    note_count(notes_,
               "properties of the element '" + std::string(element.name) + "' that are not shown (" + name_list(names) + ")",
               element.count > 0 ? names.size() : 0);
  }

  /// Notes incomplete groups of properties, which have a meaning only together.
  void note_incomplete(const PlyElement& element, const PlyRow& row) {
    const auto note = [&](const char* what, std::initializer_list<PlyRole> roles) {
      const bool has_some = std::any_of(roles.begin(), roles.end(), [&](PlyRole role) { return row.has(role); });
      note_count(notes_, what + (" of the element '" + clipped(element.name, 40) + "', which are not shown"),
                 has_some && !row.has_all(roles) ? element.count : 0);
    };
    note("colours without all of red, green and blue", {red, green, blue});
    note("normals without all of nx, ny and nz", {normal_x, normal_y, normal_z});
    note("texture coordinates without both of s and t", {s, t});
  }

  void set_precision(const PlyRow& row) {
    const auto is_float = [&row](PlyRole role) { return row.type_of(role) == PlyType::float32; };
    const bool is_rounded = header_.format != PlyFormat::text && (is_float(x) || is_float(y) || is_float(z));
    coordinate_rounding_ = is_rounded ? 0x1p-25 : 0;
  }

  void take_vertex(const PlyRow& row, bool has_normals, bool has_places) {
    mesh_.vertices.push_back({row[x], row[y], row[z]});
    if (has_normals) {
      mesh_.normals.push_back({row[normal_x], row[normal_y], row[normal_z]});
    }
    if (has_places) {
      mesh_.places.push_back({static_cast<float>(row[s]), 1 - static_cast<float>(row[t])});
    }
  }

  void read_faces(const PlyElement& element) {
    PlyRow row(element, *values_, {corners, corner_places, texture, material, red, green, blue, alpha});
    note_left_out(element, row);
    note_incomplete(element, row);
    if (!row.has(corners) && element.count > 0) {
      throw core::InputError("the element 'face' has no list vertex_indices or vertex_index; expected one");
    }
    face_light_ = row.has_all({red, green, blue}) ? full_light_of(row.type_of(red)) : 0;
    const std::uint64_t room = std::min(element.count, values_->room_for(element));
    progress_.ask_for_triangles(room);
    mesh_.faces.ends.reserve(room);
    mesh_.faces.corners.reserve(3 * room);
    looks_.materials.reserve(room);
    for_each(element, row, [&](std::uint64_t number) { take_face(row, number); });
  }

  void take_face(const PlyRow& row, std::uint64_t number) {
    if (row.corners().size() < 3) {
      ++counts_.thin;
      return;
    }
    corners_.clear();
    for (const double index : row.corners()) {
      corners_.push_back(vertex_of(index, "face", number));
    }
    add_face(corners_, mesh_);
    progress_.ask(size_of(mesh_));
    looks_.materials.push_back(surface_of(row, number));
    if (row.has(corner_places)) {
      take_corner_places(row, number);
    }
    if (row.has_all({red, green, blue})) {
      set_last(looks_.colors, mesh_.faces.ends.size(), row_color(row));
      counts_.see_through += is_see_through(row) ? 1 : 0;
    }
  }

  /// Faces without texture coordinates are plain.
  void take_corner_places(const PlyRow& row, std::uint64_t number) {
    const std::vector<double>& places = row.corner_places();
    const std::size_t corners = row.corners().size();
    if (!places.empty() && places.size() != 2 * corners) {
      fail("face " + std::to_string(number) + " has " + std::to_string(places.size()) + " numbers of texcoord, expected " +
           std::to_string(2 * corners) + ", two for each corner");
    }
    corner_places_.resize(mesh_.faces.corners.size() - (places.empty() ? 0 : corners));
    for (std::size_t i = 0; i < places.size(); i += 2) {
      corner_places_.push_back({static_cast<float>(places[i]), 1 - static_cast<float>(places[i + 1])});
    }
  }

  std::uint32_t surface_of(const PlyRow& row, std::uint64_t number) {
    const double of_material = row.has(material) && has_materials_ ? row[material] : 0,
                 of_texture = row.has(texture) ? row[texture] : 0;
    const auto textures = static_cast<double>(surfaces_.texture_count());
    counts_.materials_of_none += row.has(material) && !has_materials_ ? 1 : 0;
    counts_.textures_of_none += row.has(texture) && of_texture >= 0 && textures == 0 ? 1 : 0;
    const bool is_textured = textures > 0 && of_texture >= 0 && !(row.has(corner_places) && row.corner_places().empty());
    if (is_textured && !(of_texture < textures)) {
      fail("face " + std::to_string(number) + " has texture " + rounded(of_texture) + ", which does not exist: there are " +
           rounded(textures));
    }
    if (!(of_material >= 0 && of_material < 0x1p32)) {
      fail("face " + std::to_string(number) + " has material " + rounded(of_material) + "; expected a number from 0");
    }
    const auto chosen = is_textured ? std::optional(static_cast<std::uint32_t>(of_texture)) : std::nullopt;
    return surfaces_.find(static_cast<std::uint32_t>(of_material), chosen);
  }

  void read_strips(const PlyElement& element) {
    PlyRow row(element, *values_, {corners});
    note_left_out(element, row);
    if (!row.has(corners) && element.count > 0) {
      throw core::InputError("the element 'tristrips' has no list vertex_indices or vertex_index; expected one");
    }
    for_each(element, row, [&](std::uint64_t number) { take_strip(row, number); });
  }

  /// Stanford's strips: each further vertex adds a triangle, every second one reversed; -1 restarts. Degenerate ones only join
  /// strips.
  void take_strip(const PlyRow& row, std::uint64_t number) {
    const bool has_texture = surfaces_.texture_count() > 0 && !mesh_.places.empty();
    const std::uint32_t surface = surfaces_.find(0, has_texture ? std::optional(0U) : std::nullopt);
    corners_.clear();
    for (const double index : row.corners()) {
      if (index == -1) {
        corners_.clear();
        continue;
      }
      corners_.push_back(vertex_of(index, "strip", number));
      const std::size_t count = corners_.size();
      if (count < 3) {
        continue;
      }
      const std::uint32_t c = corners_[count - 1], b = corners_[count - 2], a = corners_[count - 3];
      if (a != b && b != c && c != a) {
        add_face(count % 2 == 1 ? std::array{a, b, c} : std::array{b, a, c}, mesh_);
        progress_.ask(size_of(mesh_));
        looks_.materials.push_back(surface);
      }
    }
  }

  void read_materials(const PlyElement& element) {
    PlyRow row(element, *values_, {red, green, blue, specular_red, specular_green, specular_blue, shine, opacity});
    note_left_out(element, row);
    for_each(element, row, [&](std::uint64_t /*number*/) { surfaces_.add_material(row); });
  }

  void skip(const PlyElement& element) {
    PlyRow row(element, *values_, {});
    for_each(element, row, [](std::uint64_t /*number*/) {});
    constexpr std::size_t names_max = 8;
    if (element.properties.empty() || element.count == 0) {
      return;
    }
    if (++skipped_names_ <= names_max) {
      note_count(notes_, "elements '" + clipped(element.name, 40) + "', which are not shown", element.count);
    } else {
      counts_.of_other_names += element.count;
    }
  }

  /// Converts index number `number` of a list; error messages call the list `what`.
  std::uint32_t vertex_of(double index, const char* what, std::uint64_t number) const {
    const bool is_within = index >= 0 && index < static_cast<double>(vertex_count_);
    if (!is_within || static_cast<double>(static_cast<std::uint64_t>(index)) < index) {
      fail(what + (" " + std::to_string(number)) + " has a vertex that does not exist, " + rounded(index) + ": there are " +
           std::to_string(vertex_count_) + "; correct the file");
    }
    return static_cast<std::uint32_t>(index);
  }

  /// Only one kind of colours is shown: the texture's, else the vertices', else the faces'.
  void extension_colors() {
    if (!looks_.colors.empty()) {
      looks_.colors.resize(mesh_.faces.ends.size(), not_yet);
    }
    looks_.give_way_to(mesh_, notes_);
    if (is_textured()) {
      const std::size_t colors = std::exchange(mesh_.colors, {}).size() + std::exchange(looks_.colors, {}).size();
      note_count(notes_, "colours that are not shown beside textures", colors);
    }
    const auto light = [](double full, const std::vector<Color>& colors) { return full > 0 ? full : apps::full_light(colors); };
    const double vertex_full = light(vertex_light_, mesh_.colors), full = light(face_light_, looks_.colors);
    const auto note_beyond = [this](const std::vector<Color>& colors, double most) {
      note_count(notes_, "colours outside 0 to " + rounded(most) + ", brought into it", count_beyond(colors, most));
    };
    note_beyond(mesh_.colors, vertex_full);
    note_beyond(looks_.colors, full);
    make_linear(mesh_.colors, mesh_.vertices.size(), vertex_full);
    make_linear(looks_.colors, mesh_.faces.ends.size(), full);
  }

  void add_to(PlacedFile& file) {
    if (!corner_places_.empty()) {
      corner_places_.resize(mesh_.faces.corners.size());
      mesh_.places = {};
      mesh_.spread_to_corners();
      mesh_.places = std::move(corner_places_);
    }
    add_mesh(std::move(mesh_), std::move(looks_), file);
  }

  bool is_textured() const { return surfaces_.texture_count() > 0 && !(mesh_.places.empty() && corner_places_.empty()); }

  void note_all() {
    note_count(notes_, "elements of more names, which are not shown", counts_.of_other_names);
    note_count(notes_, "points and lines left out", counts_.thin);
    note_count(notes_, "colours whose alpha is not shown", counts_.see_through);
    note_count(notes_, "faces with a material, of which the file has none", counts_.materials_of_none);
    note_count(notes_, "faces with the number of a texture, of which the file names none", counts_.textures_of_none);
    note_count(notes_, "textures that are not shown, since the mesh has no texture coordinates",
               is_textured() ? 0 : surfaces_.texture_count());
    note_count(notes_, "bytes behind the last element, which are not looked at", values_->count_rest());
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError(values_->place() + ": " + what + values_->doubt());
  }

  ReadingProgress& progress_;
  PlyHeader header_;
  std::unique_ptr<PlyValues> values_;
  PlySurfaces surfaces_;
  PolygonMesh mesh_{.name = "the mesh", .is_by_vertex = true};
  FaceLooks looks_;
  std::vector<std::array<float, 2>> corner_places_;  ///< one per corner, or none; take precedence over those of vertices
  PlyCounts counts_;
  std::vector<std::string> notes_;
  std::vector<std::uint32_t> corners_;
  std::uint64_t vertex_count_ = 0;
  std::size_t skipped_names_ = 0;
  bool has_materials_ = false;
  double coordinate_rounding_ = 0, vertex_light_ = 0, face_light_ = 0;
};

}  // namespace

PlacedFile read_ply(const std::string& path, SceneFiles& files) {
  return read_whole(path, files, [](std::string_view file, ReadingProgress& progress) {
    return PlyReader(without_mark(file), progress).read();
  });
}

PolygonMesh read_ply_shape(std::string_view file, SceneFiles& files, std::vector<std::string>& notes) {
  ReadingProgress progress(files, file.size());
  return PlyReader(without_mark(file), progress).read_shape(notes);
}

}  // namespace dmpc::apps
