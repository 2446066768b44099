#include "core/picture/child_lanes.h"

namespace dmpc::core {

template <bool is_bent>
[[gnu::always_inline]] inline void ChildLanes::send_lanes() {
  for (std::size_t lane = 0; lane < whole_groups(count_); ++lane) {
    const Vec3d direction = get(direction_, lane), normal = get(normal_, lane);
    const Vec3d towards =
        normalize(is_bent ? bent_direction(direction, normal, index_[lane]) : mirrored_direction(direction, normal));
    const RayStart start = start_towards(towards, get(true_normal_, lane), {along_[lane], across_[lane], radius_[lane]});
    put(towards_, lane, towards);
    start_along_[lane] = start.along;
    start_across_[lane] = start.across;
  }
}

template <bool is_bent>
[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void ChildLanes::send_by_512() {
  send_lanes<is_bent>();
}

template <bool is_bent>
[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void ChildLanes::send_by_256() {
  send_lanes<is_bent>();
}

template <bool is_bent>
void ChildLanes::send(VectorWidth width) {
  switch (width) {
    case VectorWidth::bits_512:
      return send_by_512<is_bent>();
    case VectorWidth::bits_256:
      return send_by_256<is_bent>();
    case VectorWidth::any:
      return send_lanes<is_bent>();
  }
}

void ChildLanes::mirror(VectorWidth width) { send<false>(width); }

void ChildLanes::bend(VectorWidth width) { send<true>(width); }

}  // namespace dmpc::core
