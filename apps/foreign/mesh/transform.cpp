#include "apps/foreign/mesh/transform.h"

#include <array>

namespace dmpc::apps {

using core::Vec3d;

Transform scaling(double factor) { return {{{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}}, {}}; }

Transform operator*(const Transform& world, const aiMatrix4x4& local) {
  const std::array<Vec3d, 3> columns = {{{double{local.a1}, double{local.b1}, double{local.c1}},
                                         {double{local.a2}, double{local.b2}, double{local.c2}},
                                         {double{local.a3}, double{local.b3}, double{local.c3}}}};
  Transform product;
  for (std::size_t row = 0; row < 3; ++row) {
    product.rows[row] = {dot(world.rows[row], columns[0]), dot(world.rows[row], columns[1]), dot(world.rows[row], columns[2])};
  }
  product.shift = world.point({double{local.a4}, double{local.b4}, double{local.c4}});
  return product;
}

}  // namespace dmpc::apps
