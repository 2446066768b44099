// The nearest intersection found so far, and the order that makes it unique.
#pragma once

#include <cstdint>
#include <limits>

#include "core/record/ray.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A candidate or final hit. `leaf` and `lane` say where the primitive's record was read; a primitive in several leaves has equal
/// copies there, so they do not affect the picture.
struct Hit {
  float t = std::numeric_limits<float>::infinity();
  std::uint32_t primitive = no_primitive;
  Address leaf = no_address;
  std::uint32_t lane = 0;

  constexpr bool found() const { return primitive != no_primitive; }
};

/// The least (t, primitive) wins, in any order of candidates.
constexpr bool nearer(float t, std::uint32_t primitive, const Hit& than) {
  return t < than.t || (t == than.t && primitive < than.primitive);
}

/// Whether a candidate whose record is present replaces `than`: it is nearer, or it is the same and this node does not know the
/// record's address of `than`.
constexpr bool replaces(float t, std::uint32_t primitive, const Hit& than) {
  return nearer(t, primitive, than) || (than.leaf == no_address && t == than.t && primitive == than.primitive);
}

}  // namespace dmpc::core
