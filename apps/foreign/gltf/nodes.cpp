#include "apps/foreign/gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "core/base/elementary.h"

namespace dmpc::apps::gltf {
namespace {

using core::Vec3d;

constexpr int shorter_side = 512;
constexpr double aspect_max = 16;
constexpr double pi = std::numbers::pi, degrees_of_radian = 57.295779513082320877;

/// Translation after rotation after scale. `where` names it. A quaternion rounded to bytes has length 1 within this tolerance.
Transform transform_of(const std::vector<double>& translation, const std::vector<double>& q, const std::vector<double>& scale,
                       const Part& where) {
  constexpr double rounding = 0.02;
  const double x = q[0], y = q[1], z = q[2], w = q[3], length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(std::abs(length - 1) <= rounding)) {
    where.fail("a rotation is a quaternion of length " + rounded(length) + ", expected one of length 1");
  }
  const Vec3d scales{scale[0], scale[1], scale[2]};
  return {{{Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)} * scales,
            Vec3d{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)} * scales,
            Vec3d{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)} * scales}},
          {translation[0], translation[1], translation[2]}};
}

/// Throws for a matrix that does more than move what is straight to what is straight.
void check_matrix(const Part& node, const std::vector<double>& columns) {
  constexpr double rounding = 1e-6;
  if (node.find("translation") || node.find("rotation") || node.find("scale")) {
    node.fail("has a matrix beside a translation, rotation or scale, expected either");
  }
  if (!(std::abs(columns[3]) + std::abs(columns[7]) + std::abs(columns[11]) + std::abs(columns[15] - 1) <= rounding)) {
    node.get("matrix").fail("expected 0, 0, 0 and 1 for its last row, the numbers 4, 8, 12 and 16");
  }
}

Transform transform_of(const Part& node, const NodePose& pose) {
  if (!node.find("matrix")) {
    const auto or_own = [&](const std::optional<std::vector<double>>& posed, const char* name, std::vector<double> plain) {
      return posed ? *posed : node.numbers(name, std::move(plain));
    };
    return transform_of(or_own(pose.translation, "translation", {0, 0, 0}), or_own(pose.rotation, "rotation", {0, 0, 0, 1}),
                        or_own(pose.scale, "scale", {1, 1, 1}), node);
  }
  const std::vector<double> m = node.numbers("matrix", std::vector<double>(16));
  check_matrix(node, m);
  return {{{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}}, {m[12], m[13], m[14]}};
}

bool is_hidden(const Part& node) {
  const auto visibility = node.extension("KHR_node_visibility");
  return visibility && visibility->find("visible") && !visibility->flag("visible");
}

/// A camera or a light, where its node stands.
struct Standing {
  std::string node;  ///< its name
  Transform world;
};

/// The numbers of one instance of many; a plain one where the attribute is not there.
std::vector<double> instance(const Values& values, std::size_t i, std::vector<double> plain) {
  for (std::size_t k = 0; k < values.width; ++k) {
    plain[k] = double{values[i][k]};
  }
  return plain;
}

class Tree {
 public:
  Tree(const Document& document, Accessors& accessors, const Meshes& meshes, const Pose& pose, SceneTotals& totals)
      : nodes_(document.root().list("nodes")), accessors_(accessors), meshes_(meshes), pose_(pose), totals_(totals) {}

  /// The node that `where` names, with all below it. A hidden one has nothing to show, and is there for the joints among them.
  void add(const Part& where, const Transform& parent, int level, bool is_below_hidden) {
    constexpr int levels_max = 2000;
    const std::size_t index = where.as_index(nodes_.size(), "nodes");
    const Part& source = nodes_[index];
    const auto posed = pose_.find(index);
    const Transform world = composed(parent, transform_of(source, posed == pose_.end() ? NodePose{} : posed->second));
    if (!found.worlds.emplace(index, world).second || level > levels_max) {
      where.fail(level > levels_max ? "nodes below each other more than 2000 deep"
                                    : "nodes that are recursive or shared: nodes[" + std::to_string(index) +
                                          "] hangs below two nodes, or below itself, and nodes must be a tree");
    }
    const std::string name = source.text("name", source.where());
    const bool hides = is_below_hidden || is_hidden(source);
    if (!hides) {
      add_shown(source, name, world);
    }
    for (const Part& child : source.list("children")) {
      add(child, world, level + 1, hides);
    }
  }

  Nodes found;
  std::multimap<std::size_t, Standing> cameras, lights;  ///< by their places in the document

 private:
  /// The mesh, the camera and the light of a node.
  void add_shown(const Part& source, const std::string& name, const Transform& world) {
    if (const auto mesh = source.index("mesh", meshes_.ranges.size(), "meshes")) {
      const auto instancing = source.extension("EXT_mesh_gpu_instancing");
      const auto skin = source.find("skin");
      if (instancing && skin) {
        source.fail("has instances of a mesh with a skin, of which EXT_mesh_gpu_instancing does not say where they stand");
      }
      found.uses.push_back({name, *mesh, instancing ? instances(*instancing, world) : std::vector{world}, skin});
    }
    if (const auto camera = source.find("camera")) {
      cameras.emplace(camera->as_whole(), Standing{name, world});
    }
    if (const auto light = source.extension("KHR_lights_punctual")) {
      lights.emplace(light->get("light").as_whole(), Standing{name, world});
    }
  }

  /// Below the node.
  std::vector<Transform> instances(const Part& instancing, const Transform& world) {
    const Part attributes = instancing.get("attributes");
    Values moves, turns, scales;
    std::size_t count = 0;
    const auto read = [&](const char* name, std::size_t width, Values& values) {
      const auto attribute = attributes.find(name);
      values = attribute ? accessors_.values(*attribute, width) : Values{};
      if (attribute && count > 0 && values.count() != count) {
        attribute->fail("has another count than the other attributes of the instances");
      }
      count = attribute ? values.count() : count;
    };
    read("TRANSLATION", 3, moves);
    read("ROTATION", 4, turns);
    read("SCALE", 3, scales);
    const auto where = [&instancing] { return instancing.where() + ": "; };
    totals_.add({.bytes = count * sizeof(Transform)}, where);
    totals_.ask(size_of_places(count), where);  // a mesh has at least one primitive
    std::vector<Transform> places;
    places.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      places.push_back(composed(world, transform_of(instance(moves, i, {0, 0, 0}), instance(turns, i, {0, 0, 0, 1}),
                                                    instance(scales, i, {1, 1, 1}), attributes)));
    }
    return places;
  }

  std::vector<Part> nodes_;
  Accessors& accessors_;
  const Meshes& meshes_;
  const Pose& pose_;
  SceneTotals& totals_;
};

/// The angle whose tangent is that of `angle` (radians) times `share`, at most 1: Newton's method from the right, where the
/// tangent is convex. A right angle and more stays what it is, to be refused.
double with_tangent_times(double angle, double share) {
  constexpr double nearly_right = 1.5707963;
  if (!(angle < nearly_right)) {
    return angle;
  }
  const double tangent = core::tan_radians(angle) * share;
  double result = angle;
  for (int i = 0; i < 200; ++i) {
    const double here = core::tan_radians(result);
    result -= (here - tangent) / (1 + here * here);
  }
  return result;
}

FileView view_of(const Part& source, const Standing& at, const std::optional<Resolution>& size) {
  FileView result{.name = at.node, .view = {}};
  const auto perspective = source.find("perspective");
  if (source.get("type").as_text() != "perspective" || !perspective) {
    return result;
  }
  const double angle = perspective->get("yfov").as_number(), given = perspective->number("aspectRatio", 0);
  const double aspect = given > 0 ? std::clamp(given, 1 / aspect_max, aspect_max) : 1;
  if (!(angle > 0)) {
    return result;
  }
  core::View view;
  view.from = at.world.shift;
  view.at = view.from + at.world.direction({0, 0, -1});
  view.up = at.world.direction({0, 1, 0});
  view.width = static_cast<int>(std::lround(shorter_side * std::max(aspect, 1.0)));
  view.height = static_cast<int>(std::lround(shorter_side * std::max(1 / aspect, 1.0)));
  const Resolution picture = size.value_or(Resolution{view.width, view.height});
  const double steps = std::max(1, std::min(picture.width, picture.height) - 1);
  view.angle_degrees = 2 * degrees_of_radian * with_tangent_times(angle / 2, steps / picture.height);
  result.view = view;
  return result;
}

FileLightKind kind_of(const Part& source) {
  const std::string text = source.choice("type", {"directional", "point", "spot"});
  return text == "point" ? FileLightKind::point : text == "spot" ? FileLightKind::spot : FileLightKind::distant;
}

/// Its strength is the square of t (KHR_lights_punctual, "Inner and Outer Cone Angles"). What is out of range is brought into it.
core::LightCone cone_of(const Part& source, const Vec3d& ahead) {
  const auto spot = source.find("spot");
  const double outer = spot ? spot->number("outerConeAngle", pi / 4) : pi / 4,
               inner = spot ? spot->number("innerConeAngle", 0) : 0;
  const double none = std::clamp(outer * degrees_of_radian, 0.0, 180.0);
  return {.ahead = ahead,
          .full_degrees = std::clamp(inner * degrees_of_radian, 0.0, none),
          .none_degrees = none,
          .edge = core::ConeEdge::square};
}

FileLight light_of(const Part& source, const Standing& at) {
  const std::vector<double> color = source.numbers("color", {1, 1, 1});
  FileLight light{.kind = kind_of(source),
                  .position = at.world.shift,
                  .intensity = Vec3d{color[0], color[1], color[2]} * source.number("intensity", 1)};
  const Vec3d way = at.world.direction({0, 0, -1}), ahead = way * (1 / length(way));
  if (light.kind == FileLightKind::distant) {
    light.position = ahead;
    return light;
  }
  light.has_range = source.find("range").has_value();
  if (light.kind == FileLightKind::spot) {
    light.cone = cone_of(source, ahead);
    light.intensity = light.cone.none_degrees > 0 ? light.intensity : Vec3d{};
  }
  return light;
}

/// Calls take(source, standing) for all of `standings`, of what the document lists as `sources`.
template <class Take>
void for_each_standing(const std::multimap<std::size_t, Standing>& standings, const std::vector<Part>& sources, const Part& root,
                       const std::string& what, const Take& take) {
  for (const auto& [index, standing] : standings) {
    if (index >= sources.size()) {
      root.fail("a node refers to " + what + "[" + std::to_string(index) + "], which does not exist: there are " +
                std::to_string(sources.size()));
    }
    take(sources[index], standing);
  }
}

}  // namespace

Nodes read_nodes(const Document& document, Accessors& accessors, const Meshes& meshes, const Pose& pose,
                 const std::optional<Resolution>& size, SceneTotals& totals) {
  const Part root = document.root();
  const std::vector<Part> scenes = root.list("scenes");
  if (scenes.empty()) {
    root.fail("has no scene, so that nothing says what is to be shown");
  }
  const Part& shown = scenes[root.index("scene", scenes.size(), "scenes").value_or(0)];
  shown.text("name", "");  // which nobody shows, and which is no name if it is no text
  Tree tree(document, accessors, meshes, pose, totals);
  for (const Part& where : shown.list("nodes")) {
    tree.add(where, {}, 0, false);
  }
  const auto punctual = root.extension("KHR_lights_punctual");
  for_each_standing(tree.cameras, root.list("cameras"), root, "cameras",
                    [&](const Part& source, const Standing& at) { tree.found.views.push_back(view_of(source, at, size)); });
  for_each_standing(tree.lights, punctual ? punctual->list("lights") : std::vector<Part>(), root, "lights",
                    [&](const Part& source, const Standing& at) { tree.found.lights.push_back(light_of(source, at)); });
  return std::move(tree.found);
}

}  // namespace dmpc::apps::gltf
