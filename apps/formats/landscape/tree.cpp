#include "apps/formats/landscape/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "apps/formats/landscape/chance.h"
#include "core/base/expect.h"
#include "core/base/vec.h"

namespace dmpc::apps {

namespace {

using core::Vec3d;

constexpr Vec3d up{0, 1, 0};
constexpr double trunk_radius = 0.03, trunk_height = 0.93, leaf_size = 0.05;

/// Four rings of six squares, thinner towards the top.
LandscapeMesh trunk() {
  constexpr std::uint32_t sides = 6, rings = 4;
  const double half = std::sqrt(3.0) / 2;
  const std::array<Vec3d, sides> around{
      {{1, 0, 0}, {0.5, 0, half}, {-0.5, 0, half}, {-1, 0, 0}, {-0.5, 0, -half}, {0.5, 0, -half}}};
  LandscapeMesh mesh;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const double height = trunk_height * ring / rings, radius = trunk_radius * (1 - height);
    for (const Vec3d& way : around) {
      add_vertex(mesh, way * radius + up * height, way);
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t here = ring * sides + side, beside = ring * sides + (side + 1) % sides;
      const std::uint32_t above = here + sides, over = beside + sides;
      mesh.indices.insert(mesh.indices.end(), {here, above, beside, beside, above, over});
    }
  }
  return mesh;
}

/// Three sides along `path`, as thick as `radius` where it begins, and a point where it ends.
void add_limb(LandscapeMesh& mesh, std::span<const Vec3d> path, double radius) {
  const double half = std::sqrt(3.0) / 2;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto steps = static_cast<std::uint32_t>(path.size() - 1);
  const Vec3d along = normalize(path.back() - path.front());
  const Vec3d left = normalize(cross(std::fabs(along.y) < 0.9 ? up : Vec3d{1, 0, 0}, along)), over = cross(along, left);
  for (std::uint32_t ring = 0; ring <= steps; ++ring) {
    for (const Vec3d& way : {left, over * half - left * 0.5, over * -half - left * 0.5}) {
      add_vertex(mesh, path[ring] + way * (radius * (steps - ring) / steps), way);
    }
  }
  for (std::uint32_t ring = 0; ring < steps; ++ring) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t here = first + 3 * ring + side, beside = first + 3 * ring + (side + 1) % 3;
      mesh.indices.insert(mesh.indices.end(), {here, beside, here + 3});
      if (ring + 1 < steps) {
        mesh.indices.insert(mesh.indices.end(), {beside, beside + 3, here + 3});
      }
    }
  }
}

/// From where it leaves the trunk, or a bough, to its tip.
struct Limb {
  Vec3d root, tip;

  Vec3d at(double share) const { return root + (tip - root) * share; }
  Vec3d way() const { return tip - root; }
};

/// Directions about the trunk, each the golden angle on from the one before: so leaves grow that do not cover each other.
class Spiral {
 public:
  Vec3d next() {
    constexpr double cosine = -0.73736887807831985, sine = 0.67549029426152362;
    way_ = normalize(Vec3d{way_.x * cosine - way_.z * sine, 0, way_.x * sine + way_.z * cosine});
    return way_;
  }

 private:
  Vec3d way_{1, 0, 0};
};

class Growth {
 public:
  explicit Growth(std::size_t kind)
      : chance_(kind),
        is_conifer_(kind % 2 == 0),
        width_(is_conifer_ ? 0.22 + 0.03 * static_cast<double>(kind) : 0.25 + 0.05 * static_cast<double>(kind)) {}

  Tree grow() {
    Tree tree{trunk(), {}};
    std::vector<Limb> twigs;
    Spiral spiral;
    for (std::uint32_t i = 0; i < tree_boughs; ++i) {
      const Limb bough = is_conifer_ ? bough_of_conifer(spiral.next(), i) : bough_of_broad_leaved(spiral.next(), i);
      const Vec3d elbow = bough.at(0.5) + up * (length(bough.way()) * (is_conifer_ ? 0.06 : -0.08));
      add_limb(tree.bark, std::array{bough.root, elbow, bough.tip}, 0.35 * trunk_radius);
      for (std::uint32_t k = 0; k < bough_twigs; ++k) {
        twigs.push_back(is_conifer_ ? twig_of_conifer(bough, k) : twig_of_broad_leaved(bough, k));
        add_limb(tree.bark, std::array{twigs.back().root, twigs.back().tip}, 0.12 * trunk_radius);
      }
    }
    for (std::uint32_t leaf = 0; leaf < leaf_triangles; ++leaf) {
      add_leaf(tree.leaves, twigs[leaf % twigs.size()]);
    }
    return tree;
  }

 private:
  static double share_of(std::uint32_t i, std::uint32_t count) { return (i + 0.5) / count; }
  Vec3d anywhere() {
    Vec3d way;
    do {
      way = {chance_.signed_share(), chance_.signed_share(), chance_.signed_share()};
    } while (dot(way, way) > 1 || dot(way, way) < 0.1);
    return way;
  }

  /// Longer and closer together below, and a little lower outside.
  Limb bough_of_conifer(const Vec3d& outwards, std::uint32_t i) {
    const double step = share_of(i, tree_boughs), share = step * (0.5 + 0.5 * step), height = 0.13 + 0.8 * share;
    const double reach = width_ * (1.02 - share) * (0.85 + 0.3 * chance_.share());
    return {up * height, outwards * reach + up * (height - 0.12 * reach)};
  }
  /// To both sides of it, flat, and forwards.
  Limb twig_of_conifer(const Limb& bough, std::uint32_t k) {
    const double share = 0.15 + 0.85 * share_of(k, bough_twigs), side = k % 2 == 0 ? 1 : -1;
    const Vec3d sidewards = normalize(cross(bough.way(), up)) * (side * length(bough.way()));
    const Vec3d way = (sidewards + bough.way()) * (0.42 * (1.3 - share)) + anywhere() * 0.03;
    return {bough.at(share), bough.at(share) + way};
  }

  /// To the points of a ball that is as wide as the tree, the lowest first.
  Limb bough_of_broad_leaved(const Vec3d& outwards, std::uint32_t i) {
    const double height = -0.75 + 1.7 * share_of(i, tree_boughs);
    const double reach = std::sqrt(std::max(0.05, 1 - height * height)) * (0.6 + 0.25 * chance_.share());
    const Vec3d tip = outwards * (reach * width_) + up * (0.65 + 0.27 * height);
    return {up * std::clamp(tip.y - 0.8 * reach * width_, 0.28, 0.85), tip};
  }
  Limb twig_of_broad_leaved(const Limb& bough, std::uint32_t k) {
    const double share = 0.35 + 0.65 * share_of(k, bough_twigs);
    const Vec3d way = anywhere() * (0.4 * width_) + normalize(bough.way()) * (0.2 * width_);
    return {bough.at(share), bough.at(share) + way};
  }

  /// Away from the twig, and from the trunk; it has the crown's normal, so that this looks round.
  void add_leaf(LandscapeMesh& leaves, const Limb& twig) {
    const Vec3d place = twig.at(0.15 + 0.85 * chance_.share()) + anywhere() * (is_conifer_ ? 0.4 * leaf_size : leaf_size);
    const Vec3d from_trunk = place - up * (is_conifer_ ? place.y - 0.02 : 0.6);
    const Vec3d outwards = normalize(from_trunk), tip = normalize(outwards + normalize(twig.way()) + anywhere());
    const Vec3d side = normalize(cross(tip, anywhere() + up * 0.3)), normal = normalize(outwards + up * 0.7);
    const double width = is_conifer_ ? leaf_size / 2.5 : leaf_size / 2;
    for (const Vec3d& corner : {tip * leaf_size, side * width, side * -width}) {
      leaves.indices.push_back(static_cast<std::uint32_t>(leaves.positions.size()));
      add_vertex(leaves, place + corner, normal);
    }
  }

  Chance chance_;
  bool is_conifer_;
  double width_;
};

}  // namespace

Tree tree(std::size_t kind) {
  core::expect(kind < tree_kinds, "a tree is of one of the kinds that there are");
  return Growth(kind).grow();
}

}  // namespace dmpc::apps
