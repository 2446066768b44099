#include "apps/foreign/gltf/places.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps::gltf {
namespace {

using core::Vec3d;

void add(Transform& sum, const Transform& term, double weight) {
  for (std::size_t row = 0; row < 3; ++row) {
    sum.rows[row] = sum.rows[row] + term.rows[row] * weight;
  }
  sum.shift = sum.shift + term.shift * weight;
}

constexpr Transform nothing{{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, {0, 0, 0}};

/// Columns follow each other.
Transform matrix_of(const Values& values, std::size_t i) {
  Transform matrix;
  const auto column = [&](std::size_t row, std::size_t index) { return double{values[i][4 * index + row]}; };
  for (std::size_t row = 0; row < 3; ++row) {
    matrix.rows[row] = {column(row, 0), column(row, 1), column(row, 2)};
  }
  matrix.shift = {column(0, 3), column(1, 3), column(2, 3)};
  return matrix;
}

/// By how much a joint holds a vertex. One with a weight of 0 holds nothing, and may be any.
struct Hold {
  std::size_t joint;
  double weight;
};

std::vector<Hold> holds_of(const Influences& influences, std::size_t vertex, std::size_t joint_count, const Part& skin) {
  std::vector<Hold> holds;
  for (std::size_t set = 0; set < influences.joints.size(); ++set) {
    for (std::size_t i = 0; i < influences.joints[set].width; ++i) {
      const double joint{influences.joints[set][vertex][i]}, weight{influences.weights[set][vertex][i]};
      if (weight == 0) {
        continue;
      }
      if (!(joint >= 0 && joint < static_cast<double>(joint_count) && joint == std::floor(joint))) {
        skin.fail("vertex " + std::to_string(vertex) + " is held by joint " + std::to_string(static_cast<std::int64_t>(joint)) +
                  ", which does not exist: there are " + std::to_string(joint_count));
      }
      if (!(weight >= 0 && std::isfinite(weight))) {
        skin.fail("vertex " + std::to_string(vertex) + " is held with a weight that is below 0 or not finite");
      }
      holds.push_back({static_cast<std::size_t>(joint), weight});
    }
  }
  return holds;
}

class Skins {
 public:
  Skins(const Document& document, Accessors& accessors, const Nodes& nodes)
      : skins_(document.root().list("skins")),
        node_count_(document.root().list("nodes").size()),
        accessors_(accessors),
        nodes_(nodes) {}

  /// Moves the vertices and normals of a mesh, which is used so, into the world.
  void pose(PolygonMesh& mesh, const Influences& influences, const MeshUse& use) const {
    const std::vector<Transform> transforms = transforms_of(mesh, influences, use);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
      mesh.vertices[i] = transforms[i].point(mesh.vertices[i]);
      if (!mesh.normals.empty()) {
        const Vec3d normal = transforms[i].of_normals().direction(mesh.normals[i]);
        const double size = length(normal);
        mesh.normals[i] = size > 0 ? normal * (1 / size) : normal;
      }
    }
    std::size_t first = 0;
    for (const std::uint32_t end : mesh.faces.ends) {
      if (transforms[mesh.faces.corners[first]].determinant() < 0) {
        mesh.turn(first, end);  // what is mirrored looks to its old side again
      }
      first = end;
    }
  }

 private:
  /// What each joint moves vertices by.
  std::vector<Transform> joints_of(const Part& skin) const {
    std::vector<Transform> joints;
    for (const Part& part : skin.list("joints")) {
      const std::size_t node = part.as_index(node_count_, "nodes");
      const auto world = nodes_.worlds.find(node);
      if (world == nodes_.worlds.end()) {
        part.fail("is of nodes[" + std::to_string(node) + "], which does not stand in the scene that is shown");
      }
      joints.push_back(world->second);
    }
    if (const auto where = skin.find("inverseBindMatrices")) {
      const Values binds = accessors_.values(*where, 16);
      if (binds.count() < joints.size()) {
        where->fail("has " + std::to_string(binds.count()) + " matrices, expected one for each of " +
                    std::to_string(joints.size()) + " joints");
      }
      for (std::size_t i = 0; i < joints.size(); ++i) {
        joints[i] = composed(joints[i], matrix_of(binds, i));
      }
    }
    return joints;
  }

  /// The skin's transform for each vertex.
  std::vector<Transform> transforms_of(const PolygonMesh& mesh, const Influences& influences, const MeshUse& use) const {
    const Part& skin = skins_[use.skin->as_index(skins_.size(), "skins")];
    const std::vector<Transform> joints = joints_of(skin);
    std::vector<Transform> transforms;
    transforms.reserve(mesh.vertices.size());
    for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
      const std::vector<Hold> holds = holds_of(influences, vertex, joints.size(), skin);
      const double all = core::sum_over<double>(holds, &Hold::weight);
      Transform share = holds.empty() ? use.places.front() : nothing;
      for (const Hold& hold : holds) {
        add(share, joints[hold.joint], hold.weight / all);
      }
      transforms.push_back(share);
    }
    return transforms;
  }

  std::vector<Part> skins_;
  std::size_t node_count_;
  Accessors& accessors_;
  const Nodes& nodes_;
};

/// Onto a line or a point, where no face has an area: so exporters hide what a node places.
bool leaves_no_area(const Transform& world) {
  const Transform areas = world.of_normals();
  return std::all_of(areas.rows.begin(), areas.rows.end(), [](const Vec3d& row) { return row == Vec3d{}; });
}

void check(const MeshUse& use, const Transform& world) {
  if (!std::isfinite(world.determinant()) || !is_finite(world.shift)) {
    throw core::InputError("the transform of the node '" + use.node + "' is not finite; correct it");
  }
}

/// Puts meshes in their places, one use after the other.
class Placing {
 public:
  Placing(const Skins& skins, Meshes& meshes, SceneTotals& totals, PlacedFile& file)
      : skins_(skins), meshes_(meshes), totals_(totals), file_(file), left_(meshes.list.size()), is_placed_(meshes.list.size()) {
    for (PrimitiveMesh& primitive : meshes.list) {
      file_.shapes.push_back({.mesh = std::move(primitive.mesh), .round = {}, .back = {}});
    }
  }

  void expect(const MeshUse& use) {
    for_each(use, [&](std::size_t i) { ++left_[i]; });
  }
  void place(const MeshUse& use) {
    for (const Transform& world : use.places) {
      check(use, world);
      for_each(use, [&](std::size_t i) { place(use, i, world); });
    }
    for_each(use, [&](std::size_t i) { --left_[i]; });
  }

  /// Notes what is not shown of what was placed, and forgets what was not.
  void finish(const std::vector<MaterialTraits>& materials) {
    std::vector<bool> used(materials.size());
    std::uint64_t thin = 0, several = 0, targets = 0;
    for (std::size_t i = 0; i < is_placed_.size(); ++i) {
      const PrimitiveMesh& primitive = meshes_.list[i];
      PlacedShape& shape = file_.shapes[i];
      if (is_placed_[i]) {
        used[shape.mesh.material] = true;
        thin += primitive.thin_faces;
        several += primitive.has_several_places ? 1 : 0;
        targets += primitive.has_targets ? 1 : 0;
      }
      if (shape.uses == 0) {
        shape.mesh = {.name = {}, .material = shape.mesh.material};
      }
    }
    note_losses(materials, used, file_);
    std::vector<std::string>& notes = file_.notes;
    note_count(notes, "points and lines left out", thin);
    note_count(notes, "meshes with several sets of texture coordinates, of which colours use one", several);
    note_count(notes, "meshes with a skin, shown in the pose in which their joints stand", posed_);
    note_count(notes, "meshes with a skin and without joints and weights, shown where their node stands", loose_);
    note_count(notes, "meshes with morph targets, shown without them", targets);
    note_count(notes, "corners left over at the ends of lists of triangles, left out", meshes_.corners_left_over);
  }

 private:
  template <class Take>
  void for_each(const MeshUse& use, const Take& take) const {
    for (std::size_t i = meshes_.ranges[use.mesh].first; i < meshes_.ranges[use.mesh].second; ++i) {
      take(i);
    }
  }

  void place(const MeshUse& use, std::size_t i, const Transform& world) {
    const bool has_joints = !meshes_.list[i].influences.joints.empty(), is_posed = use.skin && has_joints;
    loose_ += use.skin && !has_joints ? 1 : 0;
    if (!is_posed && leaves_no_area(world)) {
      return;
    }
    is_placed_[i] = true;
    if (is_posed) {
      place_posed(use, i);
    } else {
      PlacedShape& shape = file_.shapes[i];
      const GeometrySize size = shape.uses == 0 ? GeometrySize{} : totals_.size_of_place(size_of_copy(shape.mesh));
      totals_.add(size, [&use] { return "node '" + use.node + "': "; });
      file_.places.push_back({static_cast<std::uint32_t>(i), world});
      ++shape.uses;
    }
  }

  /// The last user takes the mesh itself, others a copy.
  void place_posed(const MeshUse& use, std::size_t i) {
    PlacedShape& shape = file_.shapes[i];
    const bool is_last = left_[i] == 1 && shape.uses == 0;
    totals_.add(is_last ? GeometrySize{} : size_of(shape.mesh), [&] { return "node '" + use.node + "': "; });
    PolygonMesh mesh = is_last ? std::exchange(shape.mesh, {.name = {}, .material = shape.mesh.material}) : shape.mesh;
    skins_.pose(mesh, meshes_.list[i].influences, use);
    file_.add(std::move(mesh));
    ++posed_;
  }

  const Skins& skins_;
  const Meshes& meshes_;
  SceneTotals& totals_;
  PlacedFile& file_;
  std::vector<std::size_t> left_;  ///< how many uses of each primitive are still to come, with that which is being placed
  std::vector<bool> is_placed_;
  std::uint64_t posed_ = 0, loose_ = 0;
};

}  // namespace

void place_meshes(const Document& document, Accessors& accessors, const Nodes& nodes, Meshes meshes,
                  const std::vector<MaterialTraits>& materials, SceneTotals& totals, PlacedFile& file) {
  const Skins skins(document, accessors, nodes);
  Placing placing(skins, meshes, totals, file);
  for (const MeshUse& use : nodes.uses) {
    placing.expect(use);
  }
  for (const MeshUse& use : nodes.uses) {
    placing.place(use);
  }
  placing.finish(materials);
}

}  // namespace dmpc::apps::gltf
