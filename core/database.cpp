#include "core/database.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "core/box.h"
#include "core/brick_builder.h"
#include "core/directory.h"
#include "core/expect.h"
#include "core/frame.h"
#include "core/morton.h"
#include "core/overlap.h"
#include "core/record_writer.h"
#include "core/triangulate.h"
#include "core/units.h"

namespace dmpc::core {
namespace {

/// A coordinate beyond this share of float's range cannot be brought into a grid.
constexpr double coordinate_max = 1e30;
/// Top cells that list a primitive, on average. The SPD's scenes need 1 to 2.3, nested shells up to 5.
constexpr std::size_t top_cells_max = 4;

bool usable(const Vec3d& v) {
  return std::fabs(v.x) < coordinate_max && std::fabs(v.y) < coordinate_max && std::fabs(v.z) < coordinate_max;
}

void put(PrimitiveValues& primitive, std::size_t row, const Vec3d& v) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    primitive.value[row + axis] = static_cast<float>(v[axis]);
  }
}

Vec3d get(const PrimitiveValues& primitive, std::size_t row) {
  return {double{primitive.value[row]}, double{primitive.value[row + 1]}, double{primitive.value[row + 2]}};
}

/// Decided on the floats that are stored: equal vertices first, then area (a difference of exact products could be hidden by
/// fusing).
bool degenerate_triangle(const PrimitiveValues& triangle) {
  const Vec3d a = get(triangle, 0), b = get(triangle, 3), c = get(triangle, 6);
  const Vec3d area = cross(b - a, c - a);
  return a == b || b == c || c == a || !(dot(area, area) > 0);
}

bool degenerate_cone(const PrimitiveValues& cone) {
  return get(cone, 0) == get(cone, 4) || (cone.value[3] == 0.0F && cone.value[7] == 0.0F);
}

void include_cube(Box& box, const Vec3d& center, double half) {
  box.include(center - Vec3d{half, half, half});
  box.include(center + Vec3d{half, half, half});
}

Vec3f unit_normal(const Vec3d& normal) {
  const double size = length(normal);
  return size > 0 && std::isfinite(size) ? Vec3f(normal * (1.0 / size)) : Vec3f{};
}

}  // namespace

/// Builds in order: frame, primitives, then the records.
class DatabaseBuilder {
 public:
  /// `places`: where the records go that it writes; by default in order.
  DatabaseBuilder(const Scene& scene, const BuildOptions& options, std::vector<Address> places = {})
      : scene_(scene), options_(options), writer_(options.page_size_bytes, std::move(places)) {
    expect(options.page_size_bytes >= 512 && options.page_size_bytes <= 65536 &&
               (options.page_size_bytes & (options.page_size_bytes - 1)) == 0,
           "a page is a power of two from 512 B to 64 KiB");
    result_.page_size_ = options.page_size_bytes;
  }

  Database build() {
    fit();
    for (std::uint32_t object = 0; object < scene_.objects.size(); ++object) {
      add_object(object);
    }
    const TopLists lists = sort_into_top_cells();
    write_tables();
    write_normals();
    write_grid(lists);
    header().primitive_count = static_cast<std::uint32_t>(result_.primitives_.size());
    result_.bytes_ = std::move(writer_).finish();
    return std::move(result_);
  }

  /// For the records that build() has written, which the next builder writes in the same sequence.
  std::vector<Address> scattered() const {
    return scattered_places(writer_.sizes(), writer_.front_bytes(), options_.page_size_bytes);
  }

 private:
  /// Vertex normals of a smooth triangle until their record is written.
  struct Smooth {
    std::uint32_t primitive;
    PatchNormals normals;
  };

  DatabaseHeader& header() { return result_.header_; }

  /// In the directions of the grid's axes.
  Box bounds_of_scene() const {
    Box box;
    for (const Vec3d& vertex : scene_.vertices) {
      if (usable(vertex)) {
        box.include(turned(options_.axes, vertex));
      }
    }
    for (const Sphere& sphere : scene_.spheres) {
      const double r = std::fabs(sphere.radius);
      if (usable(sphere.center) && r < coordinate_max) {
        include_cube(box, turned(options_.axes, sphere.center), r);
      }
    }
    for (const Cone& cone : scene_.cones) {
      const double r = std::max(std::fabs(cone.base_radius), std::fabs(cone.apex_radius));
      for (const Vec3d& end : {cone.base, cone.apex}) {
        if (usable(end) && r < coordinate_max) {
          include_cube(box, turned(options_.axes, end), r);
        }
      }
    }
    return box;
  }

  void fit() {
    const Box bounds = bounds_of_scene();
    header().frame = fit_frame(bounds, scene_.objects.size(), options_.cells_per_primitive, options_.axes);
    header().background = Color(scene_.background);
    if (!bounds.empty()) {
      const Vec3d extent = bounds.high - bounds.low;
      const double size = std::max({extent.x, extent.y, extent.z, 1e-30});
      view_distance_ = length(turned(options_.axes, scene_.view.from) - bounds.center()) / size;
    }
    set_pad();
  }

  void set_pad() { result_.pad_ = options_.pad_share * insertion_pad(header().frame, view_distance_); }

  Vec3d local(const Vec3d& point) const { return to_local(result_.header_.frame, point); }

  void add(const PrimitiveValues& primitive, std::uint32_t object, bool degenerate, ShadingReference shading) {
    if (degenerate) {
      ++result_.dropped_;
      return;
    }
    result_.primitives_.push_back(primitive);
    result_.sources_.push_back({object});
    shading_.push_back(shading);
  }

  void add_object(std::uint32_t index) {
    const Object& object = scene_.objects[index];
    switch (object.kind) {
      case ObjectKind::polygon:
      case ObjectKind::patch:
        add_polygon(index, object);
        break;
      case ObjectKind::sphere:
        add_sphere(index, object, scene_.spheres[object.first]);
        break;
      case ObjectKind::cone:
        add_cone(index, object, scene_.cones[object.first]);
        break;
    }
  }

  void add_polygon(std::uint32_t index, const Object& object) {
    const auto vertices = std::span(scene_.vertices).subspan(object.first, object.vertex_count);
    if (!std::all_of(vertices.begin(), vertices.end(), usable)) {
      ++result_.dropped_;
      return;
    }
    const auto triangles = triangulate(vertices);
    result_.dropped_ += triangles.empty() ? 1 : 0;
    for (const auto& corners : triangles) {
      PrimitiveValues triangle{.kind = PrimitiveKind::triangle};
      PatchNormals normals{.normal = {}, .material = object.material};
      for (std::size_t i = 0; i < 3; ++i) {
        put(triangle, 3 * i, local(vertices[corners[i]]));
        if (object.kind == ObjectKind::patch) {
          normals.normal[i] = unit_normal(turned(options_.axes, scene_.normals[object.first_normal + corners[i]]));
        }
      }
      const bool degenerate = degenerate_triangle(triangle);
      if (object.kind == ObjectKind::patch && !degenerate) {
        smooth_.push_back({static_cast<std::uint32_t>(result_.primitives_.size()), normals});
      }
      add(triangle, index, degenerate, ShadingReference::flat(object.material));
    }
  }

  void add_sphere(std::uint32_t index, const Object& object, const Sphere& sphere) {
    PrimitiveValues values{.kind = PrimitiveKind::sphere};
    put(values, 0, local(sphere.center));
    values.value[3] = static_cast<float>(sphere.radius * header().frame.scale);
    const bool usable_radius = values.value[3] != 0.0F && std::fabs(sphere.radius) < coordinate_max;
    add(values, index, !usable(sphere.center) || !usable_radius, ShadingReference::flat(object.material));
  }

  void add_cone(std::uint32_t index, const Object& object, const Cone& cone) {
    PrimitiveValues values{.kind = PrimitiveKind::cone};
    put(values, 0, local(cone.base));
    put(values, 4, local(cone.apex));
    values.value[3] = static_cast<float>(cone.base_radius * header().frame.scale);
    values.value[7] = static_cast<float>(cone.apex_radius * header().frame.scale);
    const bool finite = usable(cone.base) && usable(cone.apex) && std::fabs(cone.base_radius) < coordinate_max &&
                        std::fabs(cone.apex_radius) < coordinate_max;
    add(values, index, !finite || degenerate_cone(values), ShadingReference::flat(object.material));
  }

  void write_tables() {
    header().region.high = grid_size(header().frame);
    header().directory_size = top_cells(header().frame);
    header().directory = writer_.allocate_array<DirectoryEntry>(directory_entry_count(header().directory_size));
    header().light_count = static_cast<std::uint32_t>(scene_.lights.size());
    header().lights = writer_.allocate_array<LightRecord>(scene_.lights.size());
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const PointLight& light = scene_.lights[i];
      writer_.write(header().lights, i * sizeof(LightRecord),
                    LightRecord{.position = Vec3f(local(light.position)), .intensity = Color(intensity_of(light, scene_))});
    }
    header().material_count = static_cast<std::uint32_t>(scene_.materials.size());
    header().materials = writer_.allocate_array<MaterialRecord>(scene_.materials.size());
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      const Material& from = scene_.materials[i];
      writer_.write(header().materials, i * sizeof(MaterialRecord),
                    MaterialRecord{Color(from.color), static_cast<float>(from.diffuse), static_cast<float>(from.specular),
                                   static_cast<float>(from.shine), static_cast<float>(from.transmittance),
                                   static_cast<float>(from.refraction_index)});
    }
  }

  void write_normals() {
    for (const Smooth& smooth : smooth_) {
      const Address address = writer_.allocate(sizeof(PatchNormals));
      writer_.write(address, 0, smooth.normals);
      shading_[smooth.primitive] = ShadingReference::smooth(address);
    }
  }

  using TopLists = std::vector<std::pair<std::uint64_t, std::uint32_t>>;  ///< (Morton code of a top cell, primitive)

  /// Lists the primitives of every top cell. Where they are so large, so long, so far from the view or so much in one place that
  /// the lists would be long, cells of twice the size are tried, at last a single one.
  TopLists sort_into_top_cells() {
    TopLists lists;
    while (!fill_top_cells(lists)) {
      coarsen();
    }
    std::sort(lists.begin(), lists.end());
    return lists;
  }

  void coarsen() {
    GridFrame& frame = header().frame;
    for (std::int32_t& cells : frame.resolution) {
      cells = ceil_divide(cells, 2);
    }
    frame.finest_cell *= 2;
    set_pad();
  }

  /// Gives up, with false, where a primitive lies in more than top_cells_max cells on average; never with a single cell.
  bool fill_top_cells(TopLists& lists) const {
    const std::size_t bound = top_cells_max * (result_.primitives_.size() + 8);
    lists.clear();
    for (std::uint32_t id = 0; id < result_.primitives_.size(); ++id) {
      list_top_cells(id, lists);
      if (lists.size() > bound) {
        return false;
      }
    }
    return true;
  }

  /// Appends the top cells that primitive `id` touches.
  void list_top_cells(std::uint32_t id, TopLists& lists) const {
    const GridFrame& frame = result_.header_.frame;
    const double cell = double{frame.finest_cell} * finest_per_top, pad = result_.pad_;
    const Vec3d half{cell / 2 + pad, cell / 2 + pad, cell / 2 + pad};
    const auto size = top_cells(frame);
    const Overlap overlap(result_.primitives_[id]);
    const Box box = bounds_of(result_.primitives_[id]).padded({pad, pad, pad});
    Corner first, last;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto clamped = [&](double at) {
        return static_cast<std::int32_t>(std::clamp(std::floor(at / cell), 0.0, size[axis] - 1.0));
      };
      first[axis] = clamped(box.low[axis]);
      last[axis] = clamped(box.high[axis]);
    }
    for (std::int32_t z = first[2]; z <= last[2]; ++z) {
      for (std::int32_t y = first[1]; y <= last[1]; ++y) {
        for (std::int32_t x = first[0]; x <= last[0]; ++x) {
          if (overlap.touches(Vec3d{x + 0.5, y + 0.5, z + 0.5} * cell, half)) {
            lists.emplace_back(
                morton_code(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(z)), id);
          }
        }
      }
    }
  }

  void write_grid(const TopLists& lists) {
    const GridFrame& frame = header().frame;
    BrickBuilder builder(result_.primitives_, shading_, result_.pad_, frame.finest_cell, writer_);
    std::vector<DirectoryEntry> directory(directory_entry_count(header().directory_size));
    std::vector<std::uint32_t> ids;
    for (std::size_t first = 0; first < lists.size();) {
      std::size_t last = first;
      ids.clear();
      while (last < lists.size() && lists[last].first == lists[first].first) {
        ids.push_back(lists[last++].second);
      }
      const Corner corner = corner_of(lists[first].first);
      directory[directory_index(header().directory_size, corner)].bits = static_cast<std::uint32_t>(builder.build(corner, ids));
      first = last;
    }
    measure_empty_space(directory);
    writer_.write(header().directory, 0, std::as_bytes(std::span(directory)));
    result_.places_.assign(builder.places().begin(), builder.places().end());
    result_.references_ = builder.references();
  }

  static Corner corner_of(std::uint64_t code) {
    Corner corner{};
    for (unsigned bit = 0; bit < 21; ++bit) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        corner[axis] |= static_cast<std::int32_t>(code >> (3 * bit + axis) & 1U) << bit;
      }
    }
    for (std::int32_t& at : corner) {
      at *= finest_per_top;
    }
    return corner;
  }

  /// Chebyshev distance of every empty top cell to the nearest occupied one, breadth first over 26 neighbours, capped.
  void measure_empty_space(std::vector<DirectoryEntry>& directory) const {
    const auto& size = result_.header_.directory_size;
    const auto entry = [&](const Corner& top) -> DirectoryEntry& {
      return directory[directory_index(size, {top[0] * finest_per_top, top[1] * finest_per_top, top[2] * finest_per_top})];
    };
    std::deque<Corner> queue;
    for (Corner top{}; top[2] < size[2]; ++top[2]) {
      for (top[1] = 0; top[1] < size[1]; ++top[1]) {
        for (top[0] = 0; top[0] < size[0]; ++top[0]) {
          if (entry(top).empty()) {
            entry(top).bits = DirectoryEntry::empty_flag | radius_max;
          } else {
            queue.push_back(top);
          }
        }
      }
    }
    while (!queue.empty()) {
      const Corner from = queue.front();
      queue.pop_front();
      const int radius = entry(from).empty() ? entry(from).radius() + 1 : 1;
      Corner to;
      for (to[2] = std::max(0, from[2] - 1); to[2] <= std::min(size[2] - 1, from[2] + 1); ++to[2]) {
        for (to[1] = std::max(0, from[1] - 1); to[1] <= std::min(size[1] - 1, from[1] + 1); ++to[1]) {
          for (to[0] = std::max(0, from[0] - 1); to[0] <= std::min(size[0] - 1, from[0] + 1); ++to[0]) {
            if (entry(to).empty() && entry(to).radius() > radius) {
              entry(to).bits = DirectoryEntry::empty_flag | static_cast<std::uint32_t>(radius);
              queue.push_back(to);
            }
          }
        }
      }
    }
  }

  const Scene& scene_;
  BuildOptions options_;
  RecordWriter writer_;
  Database result_;
  double view_distance_ = 0;  ///< from the scene's middle, in extents
  std::vector<ShadingReference> shading_;
  std::vector<Smooth> smooth_;
};

Database build_database(const Scene& scene, const BuildOptions& options) {
  DatabaseBuilder builder(scene, options);
  Database database = builder.build();
  return options.record_order == RecordOrder::spatial ? std::move(database)
                                                      : DatabaseBuilder(scene, options, builder.scattered()).build();
}

}  // namespace dmpc::core
