#include "apps/foreign/placed_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/geometry.h"
#include "apps/foreign/mesh/lights.h"
#include "apps/foreign/mesh/round_mesh.h"
#include "apps/foreign/mesh/textures.h"
#include "apps/foreign/mesh/without_area.h"
#include "apps/formats/view_faults.h"
#include "apps/formats/whole_view.h"
#include "core/base/box.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double pi = std::numbers::pi;
constexpr double far_radii = 1000, light_share = 1.0 / 1000;

Transform scaled(const Transform& world, double scale) {
  return {{{world.rows[0] * scale, world.rows[1] * scale, world.rows[2] * scale}}, world.shift * scale};
}

/// By which it stretches all directions alike; nothing if it does not.
std::optional<double> even_stretch(const Transform& world) {
  constexpr double rounding = 1e-6;
  const auto& [a, b, c] = world.rows;
  const double square = dot(a, a), slack = rounding * square;
  const bool is_even = std::abs(dot(b, b) - square) <= slack && std::abs(dot(c, c) - square) <= slack &&
                       std::abs(dot(a, b)) <= slack && std::abs(dot(a, c)) <= slack && std::abs(dot(b, c)) <= slack;
  return is_even && square > 0 ? std::optional(std::sqrt(square)) : std::nullopt;
}

/// So that all faces look to the other side, with what their corners have.
void turn_faces(PolygonMesh& mesh) {
  const auto reverse = [](auto& list, std::size_t first, std::size_t end) {
    if (!list.empty()) {
      std::reverse(list.begin() + static_cast<std::ptrdiff_t>(first), list.begin() + static_cast<std::ptrdiff_t>(end));
    }
  };
  std::size_t first = 0;
  for (const std::uint32_t end : mesh.faces.ends) {
    reverse(mesh.faces.corners, first, end);
    reverse(mesh.normals, first, end);
    reverse(mesh.places, first, end);
    first = end;
  }
}

void put_in_place(PolygonMesh& mesh, const Transform& world, bool is_turned, const PlacedMaterial& material) {
  if (material.surface.material.texture == core::Material::no_texture) {
    mesh.places.clear();
  }
  for (Vec3d& vertex : mesh.vertices) {
    vertex = world.point(vertex);
  }
  const double determinant = world.determinant();
  if (determinant == 0) {
    mesh.normals.clear();  // what is pressed flat has the normals of its plane
  }
  const Transform of_normals = world.of_normals();
  for (Vec3d& normal : mesh.normals) {
    normal = of_normals.direction(normal) * (is_turned ? -1.0 : 1.0);
  }
  if ((determinant < 0) != is_turned) {
    turn_faces(mesh);
  }
  if (!material.place.is_plain()) {
    for (auto& [s, t] : mesh.places) {
      const auto moved = material.place(double{s}, double{t});
      s = static_cast<float>(moved[0]);
      t = static_cast<float>(moved[1]);
    }
  }
}

class PlacedScene {
 public:
  PlacedScene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files)
      : file_(std::move(file)), options_(options), files_(files), scale_(options.scale.value_or(1)) {
    result_.scene.name = path;
    result_.scene.coordinate_rounding = file_.coordinate_rounding;
    result_.notes = std::move(file_.notes);
  }

  MeshScene make() {
    note_instances();
    make_materials();
    add_shapes();
    set_view();
    result_.scene.background = file_.background;
    add_lights();
    note_count(result_.notes, "skies of pictures, which are shown by paths below the file's own sky alone",
               options_.is_below_own_sky ? 0 : file_.skies.size());
    for (FileSky& sky : file_.skies) {
      result_.skies.push_back(std::move(sky));
    }
    return std::move(result_);
  }

 private:
  void note_instances() {
    std::uint64_t shapes = 0, places = file_.places.size();
    for (const PlacedShape& shape : file_.shapes) {
      shapes += shape.uses > 0 ? 1 : 0;
    }
    if (shapes < places && options_.copies == core::Copies::put) {
      result_.notes.push_back(counted(shapes, "shape") + (shapes == 1 ? " stands in " : " stand in ") + grouped(places) +
                              " places, and is there as often");
    }
  }

  void make_materials() {
    TextureReader textures(file_.pictures, result_.scene.name, files_, result_.scene.textures);
    std::vector<bool> used(file_.materials.size());
    for (const ShapePlace& place : file_.places) {
      const PlacedShape& shape = file_.shapes[place.shape];
      used[shape.mesh.material] = true;
      used[shape.back.value_or(shape.mesh.material)] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      core::Material& material = file_.materials[i].surface.material;
      auto use = file_.materials[i].surface.texture;
      if (use && used[i]) {
        use->edges.alpha = TextureAlpha::said;
        material.texture = textures.find(*use).value_or(core::Material::no_texture);
      }
    }
    std::vector<std::string> missing = std::move(file_.missing);
    const std::vector<std::string> more = textures.missing();
    missing.insert(missing.end(), more.begin(), more.end());
    note_other_names(textures.other_names(), result_.notes);
    judge_missing(missing, options_, result_.notes);
  }

  void add_shapes() {
    GeometryWriter writer(result_.scene, result_.vertices, options_.smooth_degrees);
    for (const ShapePlace& place : file_.places) {
      add_shape(place, writer);
    }
    result_.instances = writer.instances();
    bounds_ = sphere_around(result_.vertices, result_.scene.objects, result_.instances, result_.scene.spheres);
    for (const PolygonMesh& back : backs_) {
      writer.add(behind(back), file_.materials[back.material].surface.material);
    }
    if (!writer.has_area()) {
      refuse_without_area("there is no shape in it that has an area", result_.notes);
    }
    note_count(result_.notes, "shapes whose texture is not shown, since no corner has a place on it", writer.unplaced());
    note_count(result_.notes, "spheres that are turned inside out, shown as if they were not", inside_out_);
    note_count(result_.notes, "shapes that let all light through, so that nothing of them is seen", writer.unseen());
  }

  void add_shape(const ShapePlace& place, GeometryWriter& writer) {
    const Transform world = scaled(place.world, scale_);
    if (const auto shared = shared_.find(place.shape); shared != shared_.end()) {
      put(shared->second, world, writer);
      return;
    }
    PlacedShape& shape = file_.shapes[place.shape];
    const PlacedMaterial& material = file_.materials[shape.mesh.material];
    if (shape.uses > 1 && !shape.sphere && !shape.back && !options_.smooth_degrees) {
      PolygonMesh mesh = std::move(shape.mesh);
      put_in_place(mesh, {}, shape.is_turned, material);
      const auto shared = writer.add_shared(std::move(mesh), material.surface.material);
      shared_.emplace(place.shape, shared);
      put(shared, world, writer);
      return;
    }
    const bool is_last = --shape.uses == 0;
    const auto stretch = even_stretch(world);
    if (shape.sphere && stretch && material.surface.material.texture == core::Material::no_texture) {
      inside_out_ += shape.is_turned ? 1 : 0;
      writer.add(core::Sphere{world.point(shape.sphere->center), shape.sphere->radius * *stretch}, material.surface.material);
      return;
    }
    PolygonMesh mesh;
    if (shape.sphere) {
      const double radius = shape.sphere->radius;
      mesh = sphere_mesh({.radius = radius, .least_z = -radius, .most_z = radius, .degrees = 360});
      mesh.name = shape.mesh.name;
    } else {
      mesh = is_last ? std::move(shape.mesh) : shape.mesh;
    }
    put_in_place(mesh, world, shape.is_turned, material);
    if (shape.back) {
      backs_.push_back(mesh);
      backs_.back().material = *shape.back;
    }
    writer.add(std::move(mesh), material.surface.material);
  }

  static void put(const std::optional<std::uint32_t>& shared, const Transform& world, GeometryWriter& writer) {
    if (shared) {
      writer.place(*shared, world);
    }
  }

  /// What shines here shines to both sides: so what shines to the front alone has a back of its surface, which does not shine, a
  /// little behind.
  PolygonMesh behind(const PolygonMesh& front) const {
    PolygonMesh back{.name = front.name, .material = front.material, .normals = front.normals, .places = front.places};
    const double size = front.vertices.empty() ? 0 : length(core::Box::around(front.vertices).half());
    const double away = std::max(size * 0x1p-11, bounds_.radius * 0x1p-17);
    std::size_t first = 0;
    for (const std::uint32_t end : front.faces.ends) {
      const auto corner = [&](std::size_t i) { return front.vertices[front.faces.corners[i]]; };
      Vec3d area;
      for (std::size_t i = first + 2; i < end; ++i) {
        area = area + cross(corner(i - 1) - corner(first), corner(i) - corner(first));
      }
      const Vec3d shift = length(area) > 0 ? normalize(area) * -away : Vec3d{};
      for (std::size_t i = first; i < end; ++i) {
        back.faces.corners.push_back(static_cast<std::uint32_t>(back.vertices.size()));
        back.vertices.push_back(corner(i) + shift);
      }
      back.faces.ends.push_back(static_cast<std::uint32_t>(back.faces.corners.size()));
      first = end;
    }
    return back;
  }

  void set_view() {
    core::View& view = result_.scene.view;
    view = whole_view(bounds_, options_.up.value_or(UpAxis{}));
    if (!file_.view || options_.is_seen_otherwise) {
      return;
    }
    core::View own = *file_.view;
    const Vec3d ahead = own.at - own.from;
    own.from = own.from * scale_;
    own.at = own.from + ahead;
    if (fault_of(own)) {
      result_.notes.emplace_back("the file's camera is not taken, since it sees nothing");
      return;
    }
    view = own;
  }

  void add_lights() {
    if (options_.is_lit_otherwise) {
      return;
    }
    const bool is_by_paths = options_.is_below_sky || options_.is_below_own_sky;
    const auto shines = [](const PlacedMaterial& material) { return material.surface.material.shines(); };
    const auto shining = std::count_if(file_.materials.begin(), file_.materials.end(), shines);
    note_count(result_.notes, "materials that shine, which light other things by paths alone",
               is_by_paths ? 0 : static_cast<std::uint64_t>(shining));
    core::SceneBuilder builder(result_.scene);
    std::vector<core::PointLight> points;
    std::uint64_t spheres = 0, unfallen = 0;
    for (const FileLight& light : file_.lights) {
      if (!(largest_component(light.intensity) > 0)) {
        continue;
      }
      if (light.kind == FileLightKind::distant) {
        points.push_back({bounds_.center - light.position * (far_radii * bounds_.radius), light.intensity * (1 / pi), true});
      } else if (is_by_paths) {
        add_sphere(light, builder);
        ++spheres;
      } else {
        const Vec3d position = light.position * scale_;
        const double way = std::max(length(position - bounds_.center), light_share * bounds_.radius);
        points.push_back({position, light.intensity * (scale_ * scale_ / (pi * way * way)), true});
        ++unfallen;
      }
    }
    if (!is_by_paths) {
      scale_down(points);
    }
    result_.scene.lights = std::move(points);
    note_count(result_.notes, "point lights, shown as spheres of a thousandth of the scene", spheres);
    note_count(result_.notes, "point lights whose fall-off with distance is ignored", unfallen);
  }

  /// One shines as brightly as its point: its radiance times the area that is seen of it is the intensity.
  void add_sphere(const FileLight& light, core::SceneBuilder& builder) {
    const double radius = light_share * bounds_.radius, area = pi * radius * radius;
    const double most = 1e29;
    const Vec3d radiance = light.intensity * (scale_ * scale_ / area);
    const Vec3d position = light.position * scale_;
    if (!(largest_component(radiance) < most) || !is_in_reach(position)) {
      throw core::InputError("a point light is too strong, or too far away, beside a scene so small or large; correct the file");
    }
    builder.material({.color = {0, 0, 0}, .diffuse = 0, .emission = radiance});
    builder.sphere(position, radius);
  }

  PlacedFile file_;
  const MeshOptions& options_;
  SceneFiles& files_;
  double scale_;
  MeshScene result_;
  BoundingSphere bounds_;
  std::map<std::uint32_t, std::optional<std::uint32_t>> shared_;  ///< by shape; nothing of one without faces
  std::uint64_t inside_out_ = 0;                                  ///< spheres
  std::vector<PolygonMesh> backs_;                                ///< where their fronts are
};

}  // namespace

MeshScene placed_scene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files) {
  return PlacedScene(std::move(file), path, options, files).make();
}

}  // namespace dmpc::apps
