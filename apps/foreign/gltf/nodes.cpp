#include "apps/foreign/gltf/nodes.h"

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/gltf/skins.h"

namespace dmpc::apps::gltf {
namespace {

aiVector3D vector_of(const std::vector<double>& v) {
  return {static_cast<ai_real>(v[0]), static_cast<ai_real>(v[1]), static_cast<ai_real>(v[2])};
}

/// Translation after rotation after scale, as Assimp multiplies them.
aiMatrix4x4 composed(const aiVector3D& translation, const aiQuaternion& rotation, const aiVector3D& scale) {
  aiMatrix4x4 moved, scaled;
  aiMatrix4x4::Translation(translation, moved);
  aiMatrix4x4::Scaling(scale, scaled);
  return moved * aiMatrix4x4(rotation.GetMatrix()) * scaled;
}

/// `where` names it. One that is rounded to bytes is of length 1 but for this.
aiQuaternion quaternion_of(const std::vector<double>& q, const Part& where) {
  constexpr double rounding = 0.02;
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(length - 1) <= rounding)) {
    where.fail("a rotation is a quaternion of length " + rounded(length) + ", expected one of length 1");
  }
  return {static_cast<ai_real>(q[3]), static_cast<ai_real>(q[0]), static_cast<ai_real>(q[1]), static_cast<ai_real>(q[2])};
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

aiMatrix4x4 transform_of(const Part& node, const NodePose& pose) {
  aiMatrix4x4 result;
  if (!node.find("matrix")) {
    const auto or_own = [&](const std::optional<std::vector<double>>& posed, const char* name, std::vector<double> plain) {
      return posed ? *posed : node.numbers(name, std::move(plain));
    };
    return composed(vector_of(or_own(pose.translation, "translation", {0, 0, 0})),
                    quaternion_of(or_own(pose.rotation, "rotation", {0, 0, 0, 1}), node),
                    vector_of(or_own(pose.scale, "scale", {1, 1, 1})));
  }
  const std::vector<double> columns = node.numbers("matrix", std::vector<double>(16));
  check_matrix(node, columns);
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      result[row][column] = static_cast<ai_real>(columns[4 * column + row]);
    }
  }
  return result;
}

bool is_hidden(const Part& node) {
  const auto visibility = node.extension("KHR_node_visibility");
  return visibility && visibility->find("visible") && !visibility->flag("visible");
}

using Nodes = std::vector<std::unique_ptr<aiNode>>;

void give_children(aiNode& parent, Nodes& children) {
  parent.mChildren = children.empty() ? nullptr : new aiNode*[children.size()];
  for (auto& child : children) {
    child->mParent = &parent;
    parent.mChildren[parent.mNumChildren] = child.release();
    ++parent.mNumChildren;
  }
}

class Tree {
 public:
  Tree(const Document& document, Accessors& accessors, const Meshes& meshes, const Pose& pose)
      : nodes_(document.root().list("nodes")), accessors_(accessors), meshes_(meshes), pose_(pose) {}

  std::size_t count() const { return nodes_.size(); }
  /// The node that `where` names, with all below it. A hidden one has nothing to show, and is there for the joints among them.
  std::unique_ptr<aiNode> node(const Part& where, int level, bool is_below_hidden);

  /// The names of the nodes that have them, in the document's order of cameras and lights.
  std::multimap<std::size_t, std::string> cameras, lights;
  std::map<std::size_t, std::string> names;  ///< of all nodes, by their places in the document
  std::vector<MeshUse> uses;
  NodeInstances instances;

 private:
  std::string unique_name(const Part& node);
  void add_shown(const Part& source, aiNode& node, Nodes& children);
  void add_instances(const Part& instancing, std::size_t mesh, Nodes& children);

  std::vector<Part> nodes_;
  Accessors& accessors_;
  const Meshes& meshes_;
  const Pose& pose_;
  std::set<std::size_t> seen_;
  std::set<std::string> taken_;
};

/// Cameras and lights find their nodes by name.
std::string Tree::unique_name(const Part& node) {
  const std::string name = node.text("name", node.where());
  return taken_.insert(name).second ? name : name + " (" + node.where() + ")";
}

/// The numbers of one instance of many; a plain one where the attribute is not there.
std::vector<double> instance(const Values& values, std::size_t i, std::vector<double> plain) {
  for (std::size_t k = 0; k < values.width; ++k) {
    plain[k] = double{values[i][k]};
  }
  return plain;
}

void Tree::add_instances(const Part& instancing, std::size_t mesh, Nodes& children) {
  const Part attributes = instancing.get("attributes");
  Values moves, turns, scales;
  std::size_t count = 0;
  const auto read = [&](const char* name, std::size_t width, Values& values) {
    const auto found = attributes.find(name);
    values = found ? accessors_.values(*found, width) : Values{};
    if (found && count > 0 && values.count() != count) {
      found->fail("has another count than the other attributes of the instances");
    }
    count = found ? values.count() : count;
  };
  read("TRANSLATION", 3, moves);
  read("ROTATION", 4, turns);
  read("SCALE", 3, scales);
  children.push_back(std::make_unique<aiNode>(instancing.where()));
  uses.push_back({children.back().get(), mesh, std::nullopt});
  std::vector<aiMatrix4x4>& places = instances[children.back().get()];
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back(composed(vector_of(instance(moves, i, {0, 0, 0})),
                              quaternion_of(instance(turns, i, {0, 0, 0, 1}), attributes),
                              vector_of(instance(scales, i, {1, 1, 1}))));
  }
}

/// The mesh, the camera and the light of a node.
void Tree::add_shown(const Part& source, aiNode& node, Nodes& children) {
  if (const auto mesh = source.index("mesh", meshes_.ranges.size(), "meshes")) {
    const auto instancing = source.extension("EXT_mesh_gpu_instancing");
    const auto skin = source.find("skin");
    if (instancing && skin) {
      source.fail("has instances of a mesh with a skin, of which EXT_mesh_gpu_instancing does not say where they stand");
    }
    if (instancing) {
      add_instances(*instancing, *mesh, children);
    } else {
      uses.push_back({&node, *mesh, skin});
    }
  }
  if (const auto camera = source.find("camera")) {
    cameras.emplace(camera->as_whole(), node.mName.C_Str());
  }
  if (const auto light = source.extension("KHR_lights_punctual")) {
    lights.emplace(light->get("light").as_whole(), node.mName.C_Str());
  }
}

std::unique_ptr<aiNode> Tree::node(const Part& where, int level, bool is_below_hidden) {
  constexpr int levels_max = 2000;
  const std::size_t index = where.as_index(count(), "nodes");
  const Part& source = nodes_[index];
  if (!seen_.insert(index).second || level > levels_max) {
    where.fail(level > levels_max ? "nodes below each other more than 2000 deep"
                                  : "nodes that are recursive or shared: nodes[" + std::to_string(index) +
                                        "] hangs below two nodes, or below itself, and nodes must be a tree");
  }
  const bool hides = is_below_hidden || is_hidden(source);
  auto result = std::make_unique<aiNode>(unique_name(source));
  names.emplace(index, result->mName.C_Str());
  const auto posed = pose_.find(index);
  result->mTransformation = transform_of(source, posed == pose_.end() ? NodePose{} : posed->second);
  Nodes children;
  if (!hides) {
    add_shown(source, *result, children);
  }
  for (const Part& child : source.list("children")) {
    children.push_back(node(child, level + 1, hides));
  }
  give_children(*result, children);
  return result;
}

/// What apps/foreign/mesh/lights.h makes the angle from: the vertical one times the aspect.
void fill(const Part& source, aiCamera& camera) {
  camera.mLookAt = {0, 0, -1};
  const auto perspective = source.find("perspective");
  if (source.get("type").as_text() != "perspective" || !perspective) {
    camera.mHorizontalFOV = 0;
    return;
  }
  camera.mAspect = static_cast<float>(perspective->number("aspectRatio", 0));
  camera.mHorizontalFOV =
      static_cast<float>(perspective->get("yfov").as_number()) * (camera.mAspect == 0 ? 1.0F : camera.mAspect);
}

aiLightSourceType type_of(const Part& source) {
  const Part type = source.get("type");
  const std::string text = type.as_text();
  if (text != "directional" && text != "point" && text != "spot") {
    type.fail("is '" + text + "', expected directional, point or spot");
  }
  return text == "point" ? aiLightSource_POINT : text == "spot" ? aiLightSource_SPOT : aiLightSource_DIRECTIONAL;
}

void fill(const Part& source, aiLight& light) {
  light.mType = type_of(source);
  light.mDirection = {0, 0, -1};
  light.mUp = {0, 1, 0};
  const std::vector<double> color = source.numbers("color", {1, 1, 1});
  const auto intensity = static_cast<float>(source.number("intensity", 1));
  light.mColorDiffuse = {static_cast<float>(color[0]) * intensity, static_cast<float>(color[1]) * intensity,
                         static_cast<float>(color[2]) * intensity};
}

/// One of each of `names`, of what the document lists as `sources`.
template <class T>
void add_named(const std::multimap<std::size_t, std::string>& names, const std::vector<Part>& sources, const Part& root,
               T**& list, unsigned& count, const std::string& what) {
  list = names.empty() ? nullptr : new T*[names.size()];
  for (const auto& [index, name] : names) {
    if (index >= sources.size()) {
      root.fail("a node refers to " + what + "[" + std::to_string(index) + "], which does not exist: there are " +
                std::to_string(sources.size()));
    }
    list[count] = new T;
    ++count;
    list[count - 1]->mName = name;
    fill(sources[index], *list[count - 1]);
  }
}

/// The root of several, which stand beside each other, is a node of ours.
aiNode* root_of(Nodes& roots) {
  if (roots.size() == 1) {
    return roots.front().release();
  }
  auto root = std::make_unique<aiNode>("the scene");
  give_children(*root, roots);
  return root.release();
}

}  // namespace

void add_nodes(const Document& document, Accessors& accessors, const Meshes& meshes, const Pose& pose, ImportedFile& file) {
  aiScene& scene = *file.scene;
  const Part root = document.root();
  const std::vector<Part> scenes = root.list("scenes");
  if (scenes.empty()) {
    root.fail("has no scene, so that nothing says what is to be shown");
  }
  const Part& shown = scenes[root.index("scene", scenes.size(), "scenes").value_or(0)];
  Tree tree(document, accessors, meshes, pose);
  Nodes roots;
  scene.mName = shown.text("name", "");
  for (const Part& where : shown.list("nodes")) {
    roots.push_back(tree.node(where, 0, false));
  }
  scene.mRootNode = root_of(roots);
  give_meshes(document, accessors, meshes, tree.uses, tree.names, file);
  file.instances = std::move(tree.instances);
  const auto punctual = root.extension("KHR_lights_punctual");
  add_named(tree.cameras, root.list("cameras"), root, scene.mCameras, scene.mNumCameras, "cameras");
  add_named(tree.lights, punctual ? punctual->list("lights") : std::vector<Part>(), root, scene.mLights, scene.mNumLights,
            "lights");
}

}  // namespace dmpc::apps::gltf
