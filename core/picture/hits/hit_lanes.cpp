#include "core/picture/hits/hit_lanes.h"

#include "core/picture/hits/hit_geometry.h"
#include "core/picture/hits/ray_start.h"
#include "core/picture/hits/triangle_hit.h"
#include "core/record/record.h"

namespace dmpc::core {

bool TriangleLanes::take(HitState& state, const std::byte* record) {
  const auto header = read<LeafHeader>(record);
  if (state.stage != HitState::Stage::geometry || header.kind != PrimitiveKind::triangle || header.has_plane() ||
      is_in_instance(state.hit)) {
    return false;
  }
  const LeafLane triangle = lane_of(state, record);
  put(corner_, count_, triangle.vector(0));
  put(second_, count_, triangle.vector(3));
  put(third_, count_, triangle.vector(6));
  put(origin_, count_, state.ray.full_origin());
  put(direction_, count_, state.ray.full_direction());
  t_[count_] = double{state.hit.t};
  record_[count_] = record;
  state_[count_++] = &state;
  return true;
}

[[gnu::always_inline]] inline void TriangleLanes::find_lanes() {
  for (std::size_t first = 0; first < count_; first += group_lanes) {
    for (std::size_t lane = first; lane < first + group_lanes; ++lane) {
      const Vec3d corner = get(corner_, lane), edge1 = get(second_, lane) - corner, edge2 = get(third_, lane) - corner;
      const Vec3d origin = get(origin_, lane), direction = get(direction_, lane), normal = unit_normal_of(edge1, edge2);
      const double t = t_[lane];
      double u = 0, v = 0;
      find_weights(edge1, edge2, origin - corner, direction, place_of(origin, direction, t), [&](double second, double third) {
        u = second;
        v = third;
      });
      put(point_, lane, point_at(corner, edge1, edge2, u, v));
      put(normal_, lane, normal);
      u_[lane] = u;
      v_[lane] = v;
      clearance_[lane] = clearance_of(corner, edge1, edge2, normal, u, v, t);
    }
  }
}

void TriangleLanes::read_all(VectorWidth width) {
  if (count_ == 0) {
    return;
  }
  for (VectorRows* const rows : {&corner_, &second_, &third_, &origin_, &direction_}) {
    fill_up(*rows, count_);
  }
  fill_up(t_, count_);
  run_by(width, [&] { find_lanes(); });
  for (std::size_t lane = 0; lane < count_; ++lane) {
    HitState& state = *state_[lane];
    state.u = u_[lane];
    state.v = v_[lane];
    state.point = get(point_, lane);
    state.geometric_normal = get(normal_, lane);
    state.clearance = Clearance::of_flat(clearance_[lane]);
    read_surface(state, record_[lane]);
  }
  count_ = 0;
}

template <bool is_bent>
[[gnu::always_inline]] inline void ChildLanes::send_lanes() {
  for (std::size_t first = 0; first < count_; first += group_lanes) {
    for (std::size_t lane = first; lane < first + group_lanes; ++lane) {
      const Vec3d direction = get(direction_, lane), normal = get(normal_, lane);
      const Vec3d towards =
          normalize(is_bent ? bent_direction(direction, normal, index_[lane]) : mirrored_direction(direction, normal));
      const Vec3d true_normal = starts_.true_normal(lane);
      Ray ray;
      leave(ray, starts_.point(lane), true_normal, towards, start_towards(towards, true_normal, starts_.clearance(lane)));
      rays_.put(lane, ray);
    }
  }
}

void ChildLanes::fill_up() {
  core::fill_up(direction_, count_);
  core::fill_up(normal_, count_);
  core::fill_up(index_, count_);
  starts_.fill_up(count_);
}

void ChildLanes::mirror(VectorWidth width) {
  fill_up();
  run_by(width, [&] { send_lanes<false>(); });
}

void ChildLanes::bend(VectorWidth width) {
  fill_up();
  run_by(width, [&] { send_lanes<true>(); });
}

}  // namespace dmpc::core
