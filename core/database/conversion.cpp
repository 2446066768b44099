#include "core/database/conversion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "core/base/box.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/base/vec.h"
#include "core/database/meshes/copies_bounds.h"
#include "core/database/tree/overlap.h"
#include "core/record/coordinate.h"
#include "core/record/curved_values.h"
#include "core/scene/base_meshes.h"
#include "core/scene/frame.h"
#include "core/scene/placing.h"
#include "core/scene/stored_objects.h"
#include "core/scene/triangulate.h"

namespace dmpc::core {
namespace {

/// The number of objects or vertices in one thread's chunk, and of chunks processed together.
constexpr std::size_t chunk_size = 4096;
constexpr std::size_t chunks_together = 16;

void put(PrimitiveValues& primitive, std::size_t row, const Vec3d& v) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    primitive.value[row + axis] = coordinate_of(v[axis]);
  }
}

/// Stores values from `first` on, each in its row, with their rests.
void put_values(PrimitiveValues& primitive, std::size_t first, const std::array<double, 4>& values) {
  std::uint32_t rests = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    float& rounded = primitive.value[first + i] = static_cast<float>(values[i]);
    rests |= std::uint32_t{static_cast<std::uint8_t>(rest_of(values[i], rounded))} << (8 * i);
  }
  primitive.value[rest_row(primitive.kind) + first / 4] = std::bit_cast<float>(rests);
}

void put_four(PrimitiveValues& primitive, std::size_t first, const Vec3d& v, double radius) {
  put_values(primitive, first, {on_lattice(v.x), on_lattice(v.y), on_lattice(v.z), on_lattice(radius)});
}

/// Stores a flat cone's axis in place of its apex. It is not a coordinate and therefore not on a lattice.
void put_axis(PrimitiveValues& primitive, const Vec3d& axis, double apex_radius) {
  put_values(primitive, 4, {axis.x, axis.y, axis.z, on_lattice(apex_radius)});
}

LeafLane lane_of(const PrimitiveValues& primitive) { return {primitive.value.data(), 1, 0}; }

/// The rests of four values from `first` on whose floats pass by local zero. The radius keeps its sign and may become another
/// one.
void put_passing(PrimitiveValues& primitive, std::size_t first, const Vec3d& place, double radius) {
  primitive.value[first + 3] = static_cast<float>(radius);
  const std::uint32_t rests =
      passing_rests_of({on_lattice(place.x), on_lattice(place.y), on_lattice(place.z), radius}, &primitive.value[first]);
  primitive.value[rest_row(primitive.kind) + first / 4] = std::bit_cast<float>(rests);
}

double grown(double radius, double by) { return std::copysign(std::max(std::fabs(radius) + by, 0.0), radius); }

/// A sphere passes by local zero (core/record/curved_values.h) if it did so before its centre was rounded.
void settle_passing_sphere(PrimitiveValues& sphere, const Vec3d& center, double radius) {
  put_passing(sphere, 0, center, radius);
  const Vec3d rounded = sphere.curved().vector(0);
  put_passing(sphere, 0, center, grown(radius, dot(rounded - center, rounded + center) / (length(rounded) + length(center))));
  if (!passes_by_zero(sphere.kind, lane_of(sphere))) {
    put_passing(sphere, 0, center, radius);  // on the border between passing by and not passing by
  }
}

/// The distance of a cone's surface from local zero, negative inside.
double gap_at_zero(const Vec3d& base, const Vec3d& axis, double base_radius, double apex_radius) {
  const double height = -dot(base, axis) / dot(axis, axis);
  return length(base + axis * height) - (base_radius + (apex_radius - base_radius) * height);
}

/// Settles the values of a cone or cylinder.
void settle_passing_cone(PrimitiveValues& values, const Vec3d& base, const Vec3d& apex, double base_radius, double apex_radius) {
  const double low = std::fabs(base_radius), high = std::fabs(apex_radius);
  const auto put = [&](double by) {
    put_passing(values, 0, base, grown(base_radius, by));
    put_passing(values, 4, apex, grown(apex_radius, by));
  };
  put(0.0);
  const CurvedValues rounded = values.curved();
  put(gap_at_zero(rounded.vector(0), rounded.axis(), low, high) - gap_at_zero(base, apex - base, low, high));
  if (!passes_by_zero(values.kind, lane_of(values))) {
    put(0.0);
  }
}

bool is_point(const PrimitiveValues& primitive) {
  const Box box = bounds_of(primitive);
  return largest_component(box.high - box.low) < size_least;
}

/// Corners nearer to a line than this share of their coordinates lie on it as far as doubles can tell.
constexpr double line_share = 0x1p-48;

/// The height of a triangle, 0 if it is degenerate; `coordinate` is its largest coordinate before any subtraction.
double height_of(const std::array<Vec3d, 3>& corner, double coordinate) {
  const Vec3d a = corner[1] - corner[0], b = corner[2] - corner[0];
  const double height = least_altitude(a, b, b - a, length(cross(a, b)));
  return height > line_share * coordinate ? height : 0.0;
}

/// To doubles a flat cone thinner than this share of its coordinates is only a point.
constexpr double axis_share = 0x1p-46;

bool degenerate_cone(const PrimitiveValues& values) {
  const ConeFloats cone(lane_of(values));
  const double least = cone.is_flat ? axis_share * (largest_component(cone.base) + cone.widest()) : 0.0;
  return cone.widest() == 0.0 || !(largest_component(cone.axis) > least);
}

void include_cube(Box& box, const Vec3d& center, double half) {
  box.include(center - Vec3d{half, half, half});
  box.include(center + Vec3d{half, half, half});
}

/// Appends a range of a scene's objects to a conversion.
class Converter {
 public:
  Converter(const Scene& scene, const GridFrame& frame, bool keeps_corners, Conversion& result)
      : scene_(scene), frame_(frame), keeps_corners_(keeps_corners), result_(result) {}

  void add_object(std::uint32_t index) {
    const Object& object = scene_.objects[index];
    switch (object.kind) {
      case ObjectKind::polygon:
      case ObjectKind::patch:
      case ObjectKind::textured:
        return add_polygon(index, object);
      case ObjectKind::sphere:
        return add_sphere(index, object, scene_.spheres[object.first]);
      case ObjectKind::cone:
        return add_cone(index, object, scene_.cones[object.first]);
    }
  }
  /// A triangle of a mesh's copy. `plane`: see PrimitiveValues::plane().
  void add_copy(const MeshTriangle& triangle, std::uint32_t first, bool is_mirrored, std::uint32_t plane) {
    const std::uint32_t index = first + triangle.object;
    const Object& object = scene_.objects[index];
    const auto vertices = std::span(scene_.vertices).subspan(object.first, object.vertex_count);
    const auto corners = placed_triangle(is_mirrored, object.vertex_count, triangle.corner);
    if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return usable(vertices[i]); })) {
      ++result_.dropped;
      return;
    }
    const std::size_t before = result_.primitives.size();
    add_triangle(index, object, vertices, corners);
    if (result_.primitives.size() > before) {
      result_.primitives.back().lie_in(plane);
    }
  }
  /// A placeholder for an instance whose copy is left out.
  void add_place() {
    result_.primitives.push_back({.kind = PrimitiveKind::instance});
    result_.sources.push_back({source_is_place});
    result_.shading.push_back(ShadingReference::flat(0));
  }

 private:
  [[gnu::always_inline]] Vec3d local(const Vec3d& point) const { return to_local(frame_, point); }

  /// `size` is the extent before rounding, `at` the position; both are called if the object is degenerate.
  template <class Size>
  void add(const PrimitiveValues& primitive, std::uint32_t object, bool degenerate, std::uint32_t material, const Vec3d& at,
           const Size& size) {
    if (degenerate) {
      ++result_.dropped;
      if (const double across = size(); across > 0) {
        result_.collapsed.push_back({Vec3f(local(at)), static_cast<float>(across * frame_.scale)});
      }
      return;
    }
    result_.primitives.push_back(primitive);
    result_.sources.push_back({object});
    result_.shading.push_back(ShadingReference::flat(material));
  }

  void add_polygon(std::uint32_t index, const Object& object) {
    const auto vertices = std::span(scene_.vertices).subspan(object.first, object.vertex_count);
    if (!std::all_of(vertices.begin(), vertices.end(), usable)) {
      ++result_.dropped;
      return;
    }
    if (vertices.size() == 3 && has_area(vertices)) {  // the common case, which needs no list
      return add_triangle(index, object, vertices, {0, 1, 2});
    }
    const auto triangles = triangulate(vertices);
    result_.dropped += triangles.empty() ? 1 : 0;
    for (const auto& corners : triangles) {
      add_triangle(index, object, vertices, corners);
    }
  }

  void add_triangle(std::uint32_t index, const Object& object, std::span<const Vec3d> vertices,
                    const std::array<std::uint32_t, 3>& corners) {
    PrimitiveValues triangle{.kind = PrimitiveKind::triangle};
    for (std::size_t i = 0; i < 3; ++i) {
      put(triangle, 3 * i, local(vertices[corners[i]]));
    }
    const bool degenerate = leaves_nothing({triangle.vector(0), triangle.vector(3), triangle.vector(6)});
    if (object.kind == ObjectKind::patch && !degenerate) {
      add_normals(object, corners);
    }
    if (object.kind == ObjectKind::textured && !degenerate) {
      add_texture(object, corners);
    }
    if (keeps_corners_ && !degenerate) {
      result_.corners.push_back(corners);
    }
    const std::array<Vec3d, 3> corner{vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]};
    add(triangle, index, degenerate, object.material, corner[0], [&] {
      return height_of(corner,
                       std::max({largest_component(corner[0]), largest_component(corner[1]), largest_component(corner[2])}));
    });
  }

  void add_normals(const Object& object, const std::array<std::uint32_t, 3>& corners) {
    PatchNormals normals{.normal = {}, .material_bits = object.material};
    for (std::size_t i = 0; i < 3; ++i) {
      normals.normal[i] = unit_normal(scene_.normals[object.first_normal + corners[i]]);
    }
    result_.smooth.push_back({static_cast<std::uint32_t>(result_.primitives.size()), normals});
  }

  void add_texture(const Object& object, const std::array<std::uint32_t, 3>& corners) {
    const Material& material = scene_.materials[object.material];
    const std::uint32_t index = material.texture;
    TexturedNormals textured;
    textured.normals.material_bits = object.material | PatchNormals::textured_flag;
    for (std::size_t i = 0; i < 3; ++i) {
      const TexturedCorner& corner = scene_.corners[object.first_normal + corners[i]];
      textured.normals.normal[i] = unit_normal(corner.normal);
      textured.place[i] = index == Material::no_texture ? corner.place : usable_place(corner.place);
    }
    result_.textured.push_back(
        {static_cast<std::uint32_t>(result_.primitives.size()), index, material.microfacets.texture, textured});
  }

  void add_sphere(std::uint32_t index, const Object& object, const Sphere& sphere) {
    PrimitiveValues values{.kind = PrimitiveKind::sphere};
    const Vec3d center = local(sphere.center);
    put_four(values, 0, center, sphere.radius * frame_.scale);
    if (passes_by_zero(values.kind, lane_of(values))) {
      settle_passing_sphere(values, center, sphere.radius * frame_.scale);
    }
    const bool finite = usable(sphere.center) && std::fabs(sphere.radius) < coordinate_max;
    add(values, index, !finite || is_point(values), object.material, sphere.center,
        [&] { return finite ? 2 * std::fabs(sphere.radius) : 0.0; });
  }

  void add_cone(std::uint32_t index, const Object& object, const Cone& cone) {
    const PrimitiveValues values = values_of(cone);
    const bool finite = usable(cone.base) && usable(cone.apex) && std::fabs(cone.base_radius) < coordinate_max &&
                        std::fabs(cone.apex_radius) < coordinate_max;
    const bool has_radius = cone.base_radius != 0 || cone.apex_radius != 0;
    add(values, index, !finite || degenerate_cone(values) || is_point(values), object.material, cone.base,
        [&] { return finite && has_radius ? size_across(cone) : 0.0; });
  }

  /// 0 for a cone without length.
  static double size_across(const Cone& cone) {
    const double height = length(cone.apex - cone.base);
    return height > 0 ? std::max(height, 2 * std::max(std::fabs(cone.base_radius), std::fabs(cone.apex_radius))) : 0.0;
  }

  PrimitiveValues values_of(const Cone& cone) const {
    const bool inside_only = cone.base_radius < 0 || cone.apex_radius < 0;
    const double low = std::fabs(cone.base_radius) * frame_.scale, high = std::fabs(cone.apex_radius) * frame_.scale;
    const Vec3d axis = (cone.apex - cone.base) * frame_.scale;
    const bool is_flat = length(axis) <= flat_cone_share * std::max(low, high);
    const auto with_sign = [](double radius, bool negative) { return negative ? -radius : radius; };
    const double base_radius = with_sign(low, inside_only), apex_radius = with_sign(high, inside_only != is_flat);
    PrimitiveValues values{.kind = PrimitiveKind::cone};
    put_four(values, 0, local(cone.base), base_radius);
    is_flat ? put_axis(values, axis, apex_radius) : put_four(values, 4, local(cone.apex), apex_radius);
    values.value[3] = std::copysign(values.value[3], static_cast<float>(base_radius));  // also of 0
    values.value[7] = std::copysign(values.value[7], static_cast<float>(apex_radius));
    if (passes_by_zero(values.kind, lane_of(values))) {
      settle_passing_cone(values, local(cone.base), local(cone.apex), base_radius, apex_radius);
    }
    return values;
  }

  const Scene& scene_;
  const GridFrame& frame_;
  bool keeps_corners_;
  Conversion& result_;
};

/// The items converted one by one: objects, and for each mesh copy its triangles, or one placeholder if it has none.
class Steps {
 public:
  Steps(const Scene& scene, std::span<const MeshFaces> meshes) : meshes_(meshes) {
    if (scene.kept != nullptr) {
      expect(meshes.size() == scene.kept->meshes.size(), "each base mesh has been judged");
      for (const BaseMeshInstance& place : scene.kept->places) {
        add_objects(place.at);
        runs_.push_back({count_, next_, &place, {}});
        count_ += place.has_copy ? meshes[place.mesh].triangles.size() : 1;
        next_ += place.has_copy ? static_cast<std::uint32_t>(scene.kept->meshes[place.mesh].objects.size()) : 0;
      }
    }
    add_objects(static_cast<std::uint32_t>(scene.objects.size()));
  }

  std::size_t size() const { return count_; }

  /// Adds the planes that instances have beside their triangles.
  void add_planes(const GridFrame& frame, Conversion& all) {
    for (Run& run : runs_) {
      if (run.place != nullptr) {
        const MeshFaces& faces = meshes_[run.place->mesh];
        const Placing placing(run.place->world, frame);
        for (const MeshPlane& plane : faces.planes) {
          if (run.place->has_copy) {
            run.planes.push_back(number_of(plane, placing, all.planes));
          } else {
            add_layer(plane, placing, all.place_layers);
          }
        }
        add_reports(faces, placing, all);
      }
    }
  }

  void convert(std::size_t begin, std::size_t end, Converter& converter) const {
    auto run =
        std::upper_bound(runs_.begin(), runs_.end(), begin, [](std::size_t step, const Run& one) { return step < one.begin; });
    for (std::size_t step = begin; step < end; ++step) {
      while (run != runs_.end() && run->begin <= step) {
        ++run;
      }
      add(*(run - 1), step - (run - 1)->begin, converter);
    }
  }

 private:
  /// Steps from `begin` on: objects from `first` on, or the triangles of an instance.
  struct Run {
    std::size_t begin;
    std::uint32_t first;
    const BaseMeshInstance* place;
    std::vector<std::uint32_t> planes;  ///< by the mesh's plane: PrimitiveValues::plane()
  };

  void add_objects(std::uint32_t end) {
    if (next_ < end) {
      runs_.push_back({count_, next_, nullptr, {}});
      count_ += end - next_;
      next_ = end;
    }
  }
  static std::uint32_t number_of(const MeshPlane& plane, const Placing& placing, std::vector<PrimitivePlane>& planes) {
    if (placing.stays_level(plane)) {
      return PrimitiveValues::level_plane;
    }
    const auto placed = placing.plane(plane);
    if (!placed) {
      return 0;
    }
    planes.push_back({*placed, plane.stored_as});
    return static_cast<std::uint32_t>(planes.size());
  }
  static void add_layer(const MeshPlane& plane, const Placing& placing, std::int32_t& layers) {
    const std::int32_t layer = plane.stored_as - std::int32_t{LeafHeader::exact_plane};
    if (layer > layers && !placing.stays_level(plane) && placing.plane(plane)) {
      layers = layer;
    }
  }
  static void add_reports(const MeshFaces& faces, const Placing& placing, Conversion& all) {
    const auto unit = static_cast<float>(placing.size_of_unit());
    const auto placed = [&](const Vec3f& place) { return Vec3f(placing.corner(Vec3d(place))); };
    for (const CollapsedPrimitive& one : faces.collapsed) {
      all.collapsed.push_back({placed(one.place), one.size * unit});
    }
    for (const CloseFaces& one : faces.close_faces) {
      all.close_faces.push_back({placed(one.place), one.size * unit, one.least * unit, one.most * unit, one.layers});
    }
    all.dropped += faces.dropped;
    all.duplicates += faces.duplicates;
    all.shared_planes += faces.shared_planes;
  }
  void add(const Run& run, std::size_t step, Converter& converter) const {
    if (run.place == nullptr) {
      return converter.add_object(run.first + static_cast<std::uint32_t>(step));
    }
    if (!run.place->has_copy) {
      return converter.add_place();
    }
    const MeshTriangle& triangle = meshes_[run.place->mesh].triangles[step];
    converter.add_copy(triangle, run.first, run.place->world.determinant() < 0,
                       triangle.plane == 0 ? 0 : run.planes[triangle.plane - 1]);
  }

  std::span<const MeshFaces> meshes_;
  std::vector<Run> runs_;
  std::size_t count_ = 0;
  std::uint32_t next_ = 0;  ///< index into Scene::objects
};

Box bounds_of_points(std::span<const Vec3d> points) {
  Box box;
  for (const Vec3d& point : points) {
    if (usable(point)) {
      box.include(point);
    }
  }
  return box;
}

Box bounds_of_vertices(const std::vector<Vec3d>& vertices, const Parallel& parallel) {
  std::vector<Box> boxes(ceil_divide(vertices.size(), chunk_size));
  parallel.for_each_run(vertices.size(), chunk_size, [&](std::size_t first, std::size_t end) {
    boxes[first / chunk_size] = bounds_of_points(std::span(vertices).subspan(first, end - first));
  });
  Box all;
  for (const Box& box : boxes) {
    all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y), std::min(all.low.z, box.low.z)};
    all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y), std::max(all.high.z, box.high.z)};
  }
  return all;
}

/// An upper bound: polygons may turn out to be degenerate.
std::size_t primitive_count_max(const Scene& scene) {
  std::size_t count = 0;
  for (const Object& object : scene.objects) {
    count += object.vertex_count > 3 ? object.vertex_count - 2 : 1;
  }
  return count;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void append(Conversion& all, const Conversion& more) {
  const auto before = static_cast<std::uint32_t>(all.primitives.size());
  append(all.primitives, more.primitives);
  append(all.sources, more.sources);
  append(all.collapsed, more.collapsed);
  append(all.shading, more.shading);
  append(all.corners, more.corners);
  for (const Conversion::Smooth& smooth : more.smooth) {
    all.smooth.push_back({before + smooth.primitive, smooth.normals});
  }
  for (const Conversion::Textured& textured : more.textured) {
    all.textured.push_back({before + textured.primitive, textured.texture, textured.facets, textured.normals});
  }
  all.dropped += more.dropped;
}

/// Clears the lists but keeps their memory.
void clear(Conversion& conversion) {
  conversion.primitives.clear();
  conversion.sources.clear();
  conversion.shading.clear();
  conversion.corners.clear();
  conversion.smooth.clear();
  conversion.textured.clear();
  conversion.collapsed.clear();
  conversion.dropped = 0;
}

}  // namespace

Box bounds_of(const Scene& scene, const Parallel& parallel) {
  if (scene.stored != nullptr) {
    return scene.stored->bounds;
  }
  Box box = bounds_of_vertices(scene.vertices, parallel);
  include_copies(box, scene, coordinate_max, parallel);
  for (const Sphere& sphere : scene.spheres) {
    const double r = std::fabs(sphere.radius);
    if (usable(sphere.center) && r < coordinate_max) {
      include_cube(box, sphere.center, r);
    }
  }
  for (const Cone& cone : scene.cones) {
    const double r = std::max(std::fabs(cone.base_radius), std::fabs(cone.apex_radius));
    for (const Vec3d& end : {cone.base, cone.apex}) {
      if (usable(end) && r < coordinate_max) {
        include_cube(box, end, r);
      }
    }
  }
  return box;
}

Conversion convert(const Scene& scene, const GridFrame& frame, const Parallel& parallel, const ConversionWishes& wishes) {
  Conversion all;
  Steps steps(scene, wishes.meshes);
  steps.add_planes(frame, all);
  const std::size_t count = primitive_count_max(scene);
  all.primitives.reserve(count);
  all.sources.reserve(count);
  all.shading.reserve(count);
  if (parallel.threads() == 1) {
    Converter converter(scene, frame, wishes.keeps_corners, all);
    steps.convert(0, steps.size(), converter);
    return all;
  }
  std::vector<Conversion> chunks(chunks_together);
  for (std::size_t first = 0; first < steps.size(); first += chunk_size * chunks_together) {
    parallel.for_each(chunks.size(), [&](std::size_t chunk) {
      clear(chunks[chunk]);
      Converter converter(scene, frame, wishes.keeps_corners, chunks[chunk]);
      const std::size_t begin = first + chunk * chunk_size;
      steps.convert(begin, std::min(begin + chunk_size, steps.size()), converter);
    });
    for (const Conversion& chunk : chunks) {
      append(all, chunk);
    }
  }
  return all;
}

void rearrange(Conversion& conversion, const std::vector<std::uint32_t>& from) {
  const auto taken = [&](auto& list) {
    auto before = list;
    list.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      list[i] = before[from[i]];
    }
  };
  constexpr std::uint32_t nowhere = 0xffffffffU;
  std::vector<std::uint32_t> to(conversion.primitives.size(), nowhere);
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    to[from[i]] = i;
  }
  taken(conversion.primitives);
  taken(conversion.sources);
  taken(conversion.shading);
  if (!conversion.corners.empty()) {
    taken(conversion.corners);
  }
  const auto follow = [&](auto& list) {
    for (auto& item : list) {
      item.primitive = to[item.primitive];
    }
    std::erase_if(list, [](const auto& item) { return item.primitive == nowhere; });
  };
  follow(conversion.smooth);
  follow(conversion.textured);
  follow(conversion.whole_lamps);
}

}  // namespace dmpc::core
