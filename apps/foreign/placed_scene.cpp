#include "apps/foreign/placed_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/geometry.h"
#include "apps/foreign/mesh/lights.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/mesh/textures.h"
#include "apps/formats/view_faults.h"
#include "apps/formats/whole_view.h"
#include "apps/frontend/line/number_text.h"
#include "core/base/box.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double pi = std::numbers::pi;

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

/// Whether it presses what is thick so flat that floats, beside the scene, hardly tell its front from its back.
bool presses_thin(const Transform& world, const PlacedShape& shape) {
  constexpr double share_least = 0x1p-14;
  const auto& [a, b, c] = world.rows;
  const double size = std::sqrt((dot(a, a) + dot(b, b) + dot(c, c)) / 3), volume = std::abs(world.determinant());
  if (!(volume > 0 && volume < share_least * size * size * size) || (!shape.round && shape.mesh.vertices.empty())) {
    return false;
  }
  if (shape.round) {
    return shape.round->kind != RoundKind::ring;
  }
  const Vec3d half = core::Box::around(shape.mesh.vertices).half();
  return half.x > 0 && half.y > 0 && half.z > 0;
}

/// So that all faces look to the other side.
void turn_faces(PolygonMesh& mesh) {
  std::size_t first = 0;
  for (const std::uint32_t end : mesh.faces.ends) {
    mesh.turn(first, end);
    first = end;
  }
}

/// Most files' meshes stand where they are.
bool stands_still(const Transform& world) { return world.rows == Transform{}.rows && world.shift == Vec3d{}; }

void move(PolygonMesh& mesh, const Transform& world, bool is_turned) {
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
}

/// `scale`: of the coordinates of the world.
void put_in_place(PolygonMesh& mesh, const Transform& world, double scale, bool is_turned, const FileMaterial& material) {
  if (is_turned || !stands_still(world)) {
    move(mesh, scaled(world, scale), is_turned);
  } else {
    for (Vec3d& vertex : mesh.vertices) {
      vertex = vertex * scale;
    }
  }
  if (!material.place.is_plain()) {
    for (auto& [s, t] : mesh.places) {
      const auto moved = material.place(double{s}, double{t});
      s = static_cast<float>(moved[0]);
      t = static_cast<float>(moved[1]);
    }
  }
}

/// What is known of files that cannot be had: an error, unless the options allow that; then notes. A picture without them would
/// be another, so that has to be asked for.
void judge_missing(const std::vector<std::string>& missing, const MeshOptions& options, std::vector<std::string>& notes) {
  std::string list;
  for (const std::string& one : missing) {
    list += "\n  " + one;
    notes.push_back(one + "; what it covers has its plain colour");
  }
  if (!missing.empty() && !options.allows_missing) {
    throw core::InputError("what it refers to cannot be had:" + list +
                           "\nPut these files where they are looked for, or show what they cover in its plain colour by " +
                           "--missing=plain");
  }
}

/// One line for all textures that are not where the file says.
void note_other_names(const std::vector<std::string>& names, std::vector<std::string>& notes) {
  if (!names.empty()) {
    notes.push_back(grouped(names.size()) + (names.size() == 1 ? " texture was" : " textures were") +
                    " found under other names: " + first_of(names));
  }
}

/// The error about a file of which nothing is seen, with what was said of it, which may say why.
[[noreturn]] void refuse_without_area(const PlacedFile& file, const std::vector<std::string>& notes) {
  std::string text = file.shapes.empty() ? "there is no mesh in it, and so no triangle that has an area"
                                         : "there is no triangle in it that has an area";
  text += "; expected a mesh of triangles or polygons";
  for (const std::string& note : notes) {
    text += "\n  " + note;
  }
  throw core::InputError(text);
}

std::string text_of(const Vec3d& point) { return shortest(point.x) + "," + shortest(point.y) + "," + shortest(point.z); }

class PlacedScene {
 public:
  PlacedScene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files)
      : file_(std::move(file)), options_(options), files_(files), scale_(options.scale.value_or(1)) {
    result_.scene.name = path;
    result_.scene.coordinate_rounding = file_.coordinate_rounding;
    result_.scene.bounces = file_.bounces;
    result_.notes = std::move(file_.notes);
  }

  MeshScene make() {
    measure();
    make_materials();
    add_shapes();
    set_view();
    add_lights();
    note_count(result_.notes, "skies of pictures, which are shown by paths below the file's own sky alone",
               options_.is_below_own_sky ? 0 : file_.skies.size());
    for (FileSky& sky : file_.skies) {
      result_.skies.push_back(std::move(sky));
    }
    return std::move(result_);
  }

 private:
  /// What meshes become, each of them once, and as often as the scene has it; says what copies cost.
  void measure() {
    GeometrySize once, all;
    std::uint64_t meshes = 0, places = 0, thin = 0;
    std::vector<bool> is_placed(file_.shapes.size());
    for (const ShapePlace& place : file_.places) {
      const PlacedShape& shape = file_.shapes[place.shape];
      const GeometrySize size = shape.size_of_copy();
      const bool is_first = !is_placed[place.shape], is_mesh = !shape.is_ball();
      thin += presses_thin(place.world, shape) ? 1 : 0;
      is_placed[place.shape] = true;
      ask_for_more(shape, place.world);
      meshes += is_mesh && is_first ? 1 : 0;
      places += is_mesh ? 1 : 0;
      all += size;
      once += is_first ? size : GeometrySize{};
    }
    note_count(result_.notes, "shapes pressed so flat that floats may not tell front from back, where the wrong one may show",
               thin);
    result_.scene.objects.reserve(options_.smooth_degrees ? all.faces : once.faces);
    if (meshes < places && options_.copies == core::Copies::put) {
      result_.notes.push_back(grouped(meshes) + (meshes == 1 ? " mesh stands in " : " meshes stand in ") + grouped(places) +
                              " places: " + grouped(once.triangles) + " triangles become " + grouped(all.triangles));
    }
  }

  /// Accounts for geometry that is made here: meshes that replace balls, and backs.
  void ask_for_more(const PlacedShape& shape, const Transform& world) const {
    const auto where = [&shape] { return shape.mesh.name + ": "; };
    if (shape.is_ball() && (!even_stretch(world) || file_.materials[shape.mesh.material].texture)) {
      files_.totals().add(size_of_copy(*shape.round), where);
    }
    if (shape.back) {
      files_.totals().add(shape.round ? size_of_copy(*shape.round) : size_of(shape.mesh), where);
    }
  }

  /// Which materials some shape in its place has.
  std::vector<bool> used_materials() const {
    std::vector<bool> used(file_.materials.size());
    for (const ShapePlace& place : file_.places) {
      const PlacedShape& shape = file_.shapes[place.shape];
      used[shape.mesh.material] = true;
      for (const FaceRun& run : shape.mesh.runs) {
        used[run.material] = true;
      }
      used[shape.back.value_or(shape.mesh.material)] = true;
    }
    return used;
  }

  void make_materials() {
    TextureReader textures(file_.pictures, result_.scene.name, files_, result_.scene.textures);
    const std::vector<bool> used = used_materials();
    weigh_textures(used, textures);
    std::uint64_t black = 0, means = 0, too_bright = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const FileMaterial& known = file_.materials[i];
      core::Material& material = file_.materials[i].material;
      if (!used[i] || known.is_cut_away) {
        continue;
      }
      too_bright += dim(material.emission) ? 1 : 0;
      if (known.texture) {
        material.texture = textures.find(*known.texture).value_or(core::Material::no_texture);
        black += material.texture != core::Material::no_texture && material.color == Vec3d{} ? 1 : 0;
      }
      means += add_facets(known, textures, material) ? 1 : 0;
    }
    std::vector<std::string> missing = std::move(file_.missing);
    const std::vector<std::string> more = textures.missing();
    missing.insert(missing.end(), more.begin(), more.end());
    note_other_names(textures.other_names(), result_.notes);
    note_count(result_.notes, "materials that are black, so that nothing of their texture shows", black);
    note_count(
        result_.notes,
        "materials whose texture of metal and roughness is shown by its mean, as it does not lie where that of their colour does",
        means);
    note_count(result_.notes, "materials that shine with more than 1e12, the brightest light there is, brought down to it",
               too_bright);
    judge_missing(missing, options_, result_.notes);
  }

  void weigh_textures(const std::vector<bool>& used, TextureReader& textures) const {
    for (std::size_t i = 0; i < used.size(); ++i) {
      const FileMaterial& material = file_.materials[i];
      if (used[i] && !material.is_cut_away) {
        textures.weigh(material.texture, shows_facets(material) ? material.facets : std::nullopt);
      }
    }
  }

  bool shows_facets(const FileMaterial& material) const {
    return options_.is_by_paths && material.facets && material.material.microfacets.are_there();
  }

  /// Keeps its colour. Returns whether it was too bright.
  static bool dim(Vec3d& emission) {
    if (!(largest_component(emission) > light_max)) {
      return false;
    }
    const auto finite = [](double channel) { return std::min(channel, std::numeric_limits<double>::max()); };
    const Vec3d light{finite(emission.x), finite(emission.y), finite(emission.z)};
    emission = light * (1 / largest_component(light)) * light_max;
    return true;
  }

  /// Gives a material its texture of metal and roughness, if somebody shows it; returns whether that is shown by its mean, as it
  /// lies elsewhere than that of the colour, or there is none.
  bool add_facets(const FileMaterial& known, TextureReader& textures, core::Material& material) const {
    const auto texture = shows_facets(known) ? textures.find_numbers(*known.facets) : std::nullopt;
    if (!texture) {
      return false;
    }
    const bool lies_there = material.texture != core::Material::no_texture && known.lie_facets_there;
    material.microfacets.texture = *texture;
    material.microfacets.use = lies_there ? core::FacetTexture::placed : core::FacetTexture::mean;
    return !lies_there;
  }

  void add_shapes() {
    GeometryWriter writer(result_.scene, result_.vertices, options_.smooth_degrees);
    for (const ShapePlace& place : file_.places) {
      add_shape(place, writer);
    }
    result_.instances = writer.instances();
    result_.bounds = sphere_around(result_.vertices, result_.scene.objects, result_.instances, result_.scene.spheres);
    for (const PolygonMesh& back : backs_) {
      writer.add(behind(back), file_.materials);
    }
    settle_empty(writer.has_area());
    note_count(result_.notes, "meshes whose texture is not shown, since no corner has a place on it", writer.unplaced());
    note_count(result_.notes, "spheres that are turned inside out, shown as if they were not", inside_out_);
    note_count(result_.notes, "meshes that let all light through, so that nothing of them is seen", writer.unseen());
    note_count(result_.notes, "meshes whose vertex colours are not used, since there is a texture",
               writer.meshes_without_colors());
    note_count(
        result_.notes,
        "vertices that are no numbers or beyond 1e30, left out as no face has them (the first: " + writer.first_stray() + ")",
        writer.strays());
  }

  /// A frame of an animation may show nothing, and a sky may be all there is; the view of a whole that is but a point is one of
  /// unit size.
  void settle_empty(bool has_area) {
    const bool is_sky_alone = file_.places.empty() && (file_.background != Vec3d{} || !file_.skies.empty());
    if (!has_area && !is_sky_alone && (file_.shapes.empty() || !options_.animation)) {
      refuse_without_area(file_, result_.notes);
    }
    result_.bounds.radius = result_.bounds.radius > 0 ? result_.bounds.radius : 1;
  }

  void add_shape(const ShapePlace& place, GeometryWriter& writer) {
    PlacedShape& shape = file_.shapes[place.shape];
    const FileMaterial& material = file_.materials[shape.mesh.material];
    if (material.is_cut_away) {
      writer.leave_out();
      return;
    }
    const Transform world = scaled(place.world, scale_);
    note_places(shape.mesh.vertices, world);
    if (shape.uses > 1 && !shape.is_ball() && !shape.back && !options_.smooth_degrees && !shared_.contains(place.shape)) {
      PolygonMesh mesh = mesh_of(shape, true);
      put_in_place(mesh, {}, 1, shape.is_turned, material);
      shared_.emplace(place.shape, writer.add_shared(std::move(mesh), file_.materials));
    }
    if (const auto shared = shared_.find(place.shape); shared != shared_.end()) {
      if (shared->second) {
        writer.place(*shared->second, world);
      }
      return;
    }
    const auto stretch = shape.is_ball() ? even_stretch(world) : std::nullopt;
    if (stretch && material.material.texture == core::Material::no_texture) {
      inside_out_ += shape.is_turned ? 1 : 0;
      writer.add(core::Sphere{world.point({}), shape.round->radius * *stretch}, material.material);
      return;
    }
    PolygonMesh mesh = mesh_of(shape, --shape.uses == 0);
    put_in_place(mesh, place.world, scale_, shape.is_turned, material);
    if (shape.back) {
      backs_.push_back(mesh);
      backs_.back().material = *shape.back;
    }
    writer.add(std::move(mesh), file_.materials);
  }

  /// A few of each mesh where it comes first.
  void note_places(const std::vector<Vec3d>& vertices, const Transform& world) {
    constexpr std::size_t of_each = 8, most = 4096;
    for (std::size_t i = 0; i < vertices.size() && lit_places_.size() < most; i += vertices.size() / of_each + 1) {
      const Vec3d place = world.point(vertices[i]);
      if (is_in_reach(place)) {
        lit_places_.push_back(place);
      }
    }
  }

  /// In its own coordinates; where nobody else wants it nothing is left behind.
  static PolygonMesh mesh_of(PlacedShape& shape, bool is_last) {
    if (!shape.round) {
      return is_last ? std::exchange(shape.mesh, {.name = {}, .material = shape.mesh.material}) : shape.mesh;
    }
    PolygonMesh mesh = apps::mesh_of(*shape.round);
    mesh.name = shape.mesh.name;
    mesh.material = shape.mesh.material;
    return mesh;
  }

  /// Emitters of ours emit to both sides: an emitter to the front alone gets a back of its material without emission, slightly
  /// behind it.
  PolygonMesh behind(const PolygonMesh& front) const {
    PolygonMesh back{.name = front.name, .material = front.material};
    const double size = front.vertices.empty() ? 0 : length(core::Box::around(front.vertices).half());
    const double away = std::max(size * 0x1p-11, result_.bounds.radius * 0x1p-17);
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
        if (!front.normals.empty()) {
          back.normals.push_back(front.normals[front.of_corner(i)]);
        }
        if (!front.places.empty()) {
          back.places.push_back(front.places[front.of_corner(i)]);
        }
      }
      back.faces.ends.push_back(static_cast<std::uint32_t>(back.faces.corners.size()));
      first = end;
    }
    return back;
  }

  /// Where an animation is asked for, what is not the file's stays as it was in the still scene.
  const StillScene* still() const {
    return options_.animation && options_.animation->still ? &*options_.animation->still : nullptr;
  }
  BoundingSphere still_bounds() const { return still() == nullptr ? result_.bounds : still()->bounds; }

  void set_view() {
    core::Scene& scene = result_.scene;
    const UpAxis up = options_.up.value_or(UpAxis{});
    const auto own = options_.is_seen_otherwise ? std::nullopt : view_of(file_.views, scale_, result_.notes);
    const core::View whole = whole_view(still_bounds(), up);
    // A film goes on as it began: whoever was seen by the file's camera at first is not to be seen by another one later on.
    if (still() != nullptr && !options_.is_seen_otherwise && !own && still()->view.from != whole.from) {
      throw core::InputError(
          "the animation takes the camera beyond 1e30, or presses it flat, so that it sees nothing: show other frames, or give a "
          "camera by --camera or --camera-path");
    }
    scene.view = own.value_or(whole);
    has_own_view_ = own.has_value();
    if (!own && !options_.is_seen_otherwise) {  // to the last bit, as a start for a camera of one's own
      result_.notes.push_back("the whole is in view, as by --camera=" + text_of(whole.from) + "/" + text_of(whole.at) + "/" +
                              text_of(whole.up));
    }
    scene.zenith = file_.is_lit_whole ? Vec3d{} : axes_of(up).up;
  }

  void add_lights() {
    const bool is_by_paths = options_.is_by_paths || options_.is_below_sky || options_.is_below_own_sky;
    const auto shining = std::ranges::count_if(file_.materials, [](const FileMaterial& each) { return each.material.shines(); });
    note_count(result_.notes, "materials that shine, which light other things by paths alone",
               is_by_paths ? 0 : static_cast<std::uint64_t>(shining));
    if (file_.is_lit_whole) {
      add_physical_lights();
    } else {
      add_other_lights();
    }
    constexpr double most = 1e29;
    for (const core::PointLight& light : result_.scene.lights) {
      if (!(largest_component(light.color) < most) || !is_in_reach(light.position)) {
        throw core::InputError("a light is too strong, or too far away; correct the file");
      }
    }
  }

  void add_other_lights() {
    core::Scene& scene = result_.scene;
    scene.background = plain_background;
    // Lit by a sky or, with path tracing, by emitters: other transports show emitters, but no light from them.
    const bool is_lit_else =
        options_.is_below_sky || (options_.is_by_paths && std::ranges::any_of(scene.materials, &core::Material::shines));
    std::vector<std::string> unsaid;  // lights that were replaced
    std::vector<std::string>& notes = options_.is_lit_otherwise ? unsaid : result_.notes;
    scene.lights = lights_of(file_.lights, still_bounds(), scale_, options_.is_by_paths, is_lit_else, notes);
    if (options_.is_by_paths) {
      weaken_lights(notes);
    }
    if (scene.lights.empty() && !is_lit_else) {
      scene.lights = plain_lights(still_bounds(), still() != nullptr && has_own_view_ ? still()->view : scene.view);
    }
  }

  /// Nobody says how long a file's lights expose a picture: what would be white all over is shown darker.
  void weaken_lights(std::vector<std::string>& notes) {
    std::vector<core::PointLight>& lights = result_.scene.lights;
    result_.light_share = still() != nullptr ? still()->light_share : share_for(lights, lit_places_);
    if (result_.light_share < 1) {
      std::ranges::for_each(lights, [&](core::PointLight& light) { light.color = light.color * result_.light_share; });
      notes.push_back("the file's lights are too bright for a picture, and are shown by " + rounded(result_.light_share) +
                      " of what they are");
    }
  }

  void add_physical_lights() {
    result_.scene.background = file_.background;
    if (options_.is_lit_otherwise) {
      return;
    }
    const bool is_by_paths = options_.is_below_sky || options_.is_below_own_sky;
    std::vector<core::PointLight> points;
    std::uint64_t unfallen = 0;
    for (const FileLight& light : file_.lights) {
      if (!(largest_component(light.intensity) > 0)) {
        continue;
      }
      if (light.kind == FileLightKind::distant) {
        points.push_back({far_position(light, result_.bounds), light.intensity * (1 / pi), true});
        continue;
      }
      core::PointLight& point = points.emplace_back(falling(light, result_.bounds, scale_));
      if (!is_by_paths) {
        const double way = std::max(length(point.position - result_.bounds.center), std::exchange(point.falls_off_from, 0));
        point.color = point.color * (1 / (way * way));
        ++unfallen;
      }
    }
    if (!is_by_paths) {
      scale_down(points);
    }
    result_.scene.lights = std::move(points);
    note_count(result_.notes, "point lights whose fall-off with distance is ignored", unfallen);
  }

  PlacedFile file_;
  const MeshOptions& options_;
  SceneFiles& files_;
  double scale_;
  MeshScene result_;
  std::map<std::uint32_t, std::optional<std::uint32_t>> shared_;  ///< by shape; nothing of one without faces
  std::uint64_t inside_out_ = 0;                                  ///< spheres
  bool has_own_view_ = false;
  std::vector<PolygonMesh> backs_;  ///< where their fronts are
  std::vector<Vec3d> lit_places_;   ///< some vertices, by which the strength of lights is judged
};

}  // namespace

MeshScene placed_scene(PlacedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files) {
  return PlacedScene(std::move(file), path, options, files).make();
}

}  // namespace dmpc::apps
