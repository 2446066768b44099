#include "apps/foreign/pbrt/loop.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;
using Indices = std::vector<std::uint32_t>;

constexpr std::uint32_t none = 0xffffffff;

std::uint64_t key_of(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32U | to; }

/// Maps each directed edge of a face to the face's third corner.
class Edges {
 public:
  explicit Edges(const Indices& corners) {
    third_.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = corners[i + k], to = corners[i + (k + 1) % 3], third = corners[i + (k + 2) % 3];
        if (from == to || !third_.try_emplace(key_of(from, to), third).second) {
          throw core::InputError("is no surface that can be subdivided: the edge from point " + std::to_string(from) + " to " +
                                 std::to_string(to) +
                                 " is there twice, in faces that are not turned alike, or of a face that "
                                 "has a point twice");
        }
      }
    }
  }

  std::uint32_t third(std::uint32_t from, std::uint32_t to) const {
    const auto found = third_.find(key_of(from, to));
    return found == third_.end() ? none : found->second;
  }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> third_;
};

/// The vertices around a vertex, in order; on a boundary from one end to the other.
struct Ring {
  Indices around;
  bool is_closed = true;
};

class Net {
 public:
  Net(std::size_t vertices, const Indices& corners) : edges_(corners), first_(vertices, none), faces_(vertices) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t vertex = corners[i], next = corners[i - i % 3 + (i + 1) % 3];
      ++faces_[vertex];
      const bool begins = edges_.third(next, vertex) == none;  // no face precedes it
      first_[vertex] = first_[vertex] == none || begins ? next : first_[vertex];
    }
  }

  const Edges& edges() const { return edges_; }

  /// Empty for a vertex of no face.
  Ring ring(std::uint32_t vertex) const {
    Ring ring;
    for (std::uint32_t at = first_[vertex]; at != none && (ring.around.empty() || at != ring.around[0]);) {
      ring.around.push_back(at);
      at = edges_.third(vertex, at);
      if (at == none) {
        ring.is_closed = false;
        break;
      }
    }
    if (ring.around.size() != faces_[vertex] + (ring.is_closed ? 0U : 1U)) {
      throw core::InputError("is no surface that can be subdivided: at point " + std::to_string(vertex) + " two surfaces touch");
    }
    return ring;
  }

 private:
  Edges edges_;
  Indices first_, faces_;
};

Vec3d sum_of(const std::vector<Vec3d>& points, const Indices& some) {
  Vec3d sum;
  for (const std::uint32_t one : some) {
    sum = sum + points[one];
  }
  return sum;
}

double inner_weight(std::size_t valence) { return valence == 3 ? 3.0 / 16 : 3.0 / (8 * static_cast<double>(valence)); }

Vec3d weighted(const std::vector<Vec3d>& points, std::uint32_t vertex, const Ring& ring, double inner, double at_edge) {
  if (ring.around.empty()) {
    return points[vertex];
  }
  const double count = ring.is_closed ? static_cast<double>(ring.around.size()) : 2, weight = ring.is_closed ? inner : at_edge;
  const Vec3d others = ring.is_closed ? sum_of(points, ring.around) : points[ring.around.front()] + points[ring.around.back()];
  return points[vertex] * (1 - count * weight) + others * weight;
}

struct Mesh {
  std::vector<Vec3d> points;
  Indices corners;
};

Mesh divided(const Mesh& mesh) {
  const Net surface(mesh.points.size(), mesh.corners);
  Mesh result;
  result.points.reserve(mesh.points.size() + mesh.corners.size() / 2);
  for (std::uint32_t vertex = 0; vertex < mesh.points.size(); ++vertex) {
    const Ring ring = surface.ring(vertex);
    result.points.push_back(
        weighted(mesh.points, vertex, ring, inner_weight(std::max<std::size_t>(ring.around.size(), 1)), 1.0 / 8));
  }
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  middles.reserve(mesh.corners.size() / 2);
  const auto middle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t own) {
    const auto [found, is_new] =
        middles.try_emplace(key_of(std::min(a, b), std::max(a, b)), static_cast<std::uint32_t>(result.points.size()));
    if (is_new) {
      const std::uint32_t other = surface.edges().third(b, a);
      const Vec3d ends = mesh.points[a] + mesh.points[b];
      result.points.push_back(other == none ? ends * 0.5
                                            : ends * (3.0 / 8) + (mesh.points[own] + mesh.points[other]) * (1.0 / 8));
    }
    return found->second;
  };
  result.corners.reserve(4 * mesh.corners.size());
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const std::uint32_t a = mesh.corners[i], b = mesh.corners[i + 1], c = mesh.corners[i + 2];
    const std::uint32_t ab = middle(a, b, c), bc = middle(b, c, a), ca = middle(c, a, b);
    result.corners.insert(result.corners.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return result;
}

/// Returns the cross product of the surface's two tangents at an interior vertex.
Vec3d normal_at(const std::vector<Vec3d>& points, const Ring& ring) {
  const double step = 2 * std::numbers::pi / static_cast<double>(ring.around.size());
  Vec3d s, t;
  for (std::size_t i = 0; i < ring.around.size(); ++i) {
    const double angle = step * static_cast<double>(i);
    s = s + points[ring.around[i]] * core::cos_radians(angle);
    t = t + points[ring.around[i]] * core::sin_radians(angle);
  }
  return cross(s, t);
}

Vec3d mean_normal(const std::vector<Vec3d>& points, std::uint32_t vertex, const Ring& ring) {
  Vec3d sum;
  for (std::size_t i = 1; i < ring.around.size(); ++i) {
    sum = sum + cross(points[ring.around[i - 1]] - points[vertex], points[ring.around[i]] - points[vertex]);
  }
  return sum;
}

PolygonMesh at_the_limit(Mesh mesh) {
  const Net surface(mesh.points.size(), mesh.corners);
  std::vector<Vec3d> limit, normals;
  for (std::uint32_t vertex = 0; vertex < mesh.points.size(); ++vertex) {
    const Ring ring = surface.ring(vertex);
    const std::size_t valence = std::max<std::size_t>(ring.around.size(), 1);
    const double inner = 1 / (static_cast<double>(valence) + 3 / (8 * inner_weight(valence)));
    limit.push_back(weighted(mesh.points, vertex, ring, inner, 1.0 / 5));
  }
  for (std::uint32_t vertex = 0; vertex < mesh.points.size(); ++vertex) {
    const Ring ring = surface.ring(vertex);
    normals.push_back(ring.around.empty() ? Vec3d{} : ring.is_closed ? normal_at(limit, ring) : mean_normal(limit, vertex, ring));
  }
  PolygonMesh result{.name = {},
                     .vertices = std::move(limit),
                     .faces = triangle_list(std::move(mesh.corners)),
                     .is_by_vertex = true,
                     .normals = std::move(normals)};
  return result;
}

}  // namespace

PolygonMesh subdivided(std::vector<Vec3d> vertices, Indices corners, int levels) {
  const std::uint64_t triangles = corners.size() / 3;
  if (levels > 12 || (triangles << (2U * static_cast<unsigned>(levels))) > subdivided_max) {
    throw core::InputError(grouped(triangles) + " triangles that are subdivided " + std::to_string(levels) +
                           " times become more than " + grouped(subdivided_max) + "; say fewer \"integer levels\"");
  }
  Mesh mesh{std::move(vertices), std::move(corners)};
  for (int level = 0; level < levels; ++level) {
    mesh = divided(mesh);
  }
  return at_the_limit(std::move(mesh));
}

}  // namespace dmpc::apps::pbrt
