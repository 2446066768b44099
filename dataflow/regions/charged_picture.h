// Renders pixels without a film, to find where in space the work is: every step of every ray is charged to the finest cell in
// which it is done.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <type_traits>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/picture/shade.h"
#include "core/trace/traversal.h"
#include "core/trace/work.h"

namespace dmpc::dataflow {

/// Called for each piece of work: its finest cell, and its amount, in picoseconds (not 0).
template <class T>
concept Charge = std::invocable<T&, const core::Corner&, std::uint64_t>;

/// The finest cell in which the ray is at `t`, or the nearest one in `within` (not empty).
inline core::Corner finest_cell_at(const core::Ray& ray, double t, const core::Region& within, const core::GridFrame& frame) {
  core::Corner finest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = double{ray.origin[axis]} + t * double{ray.direction[axis]};
    const double along = (at - core::plane_at(frame, axis, 0)) / double{frame.finest_cell};
    const double low = within.low[axis], high = within.high[axis] - 1;
    finest[axis] = static_cast<std::int32_t>(std::clamp(along, low, high));
  }
  return finest;
}

/// A one-thread renderer of single pixels over the whole database, which outlives it.
template <Charge C>
class ChargedPicture {
 public:
  ChargedPicture(const core::Database& database, const core::RenderSettings& settings, C charge)
      : records_(database.bytes()), settings_(settings), charge_(std::move(charge)) {}

  /// Traces the pixel's first sample with all descendants. A primary ray that misses the grid or shows the background costs
  /// nothing here: it is in no region.
  void render(std::uint32_t pixel) {
    if (!settings_.shows_background(pixel)) {
      shoot(settings_.camera.primary_ray(pixel, 0));
    }
  }

  const core::Operations& operations() const { return operations_; }

 private:
  /// The whole database as records; each look-up ends the step before, which is charged to its place.
  template <class RayCursor>
  struct Watch {
    ChargedPicture& picture;
    const core::Ray& ray;
    const RayCursor& cursor;

    const std::byte* find(core::Address address) {
      picture.settle();
      const core::GridFrame& frame = picture.settings_.header.frame;
      const core::Corner size = core::grid_size(frame);
      core::Region cell{cursor.cell, cursor.cell};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        cell.high[axis] = std::min(cell.low[axis] + core::finest_per_macro, size[axis]);
      }
      const bool in_cell = cursor.stage == core::Cursor::Stage::child;
      const double t = in_cell ? std::max(cursor.t_enter, double{t_taken()}) : cursor.t_enter;
      picture.place_ = finest_cell_at(ray, t, cell, frame);
      return picture.records_.find(address);
    }

    /// Where the ray enters the box of the current child.
    float t_taken() const {
      if constexpr (std::is_same_v<RayCursor, core::InstanceCursor>) {
        return cursor.is_inside ? cursor.waiting_in_mesh.t_taken : cursor.waiting.t_taken;
      } else {
        return cursor.waiting.t_taken;
      }
    }
  };

  /// Charges the work since the last call to its place.
  void settle() {
    const std::uint64_t now = work_of(operations_);
    if (now > settled_) {
      charge_(place_, now - settled_);
      settled_ = now;
    }
  }

  /// At most as deep as core::ray_depth_max(), which is at most 255.
  void shoot(const core::Ray& ray) {
    const auto start = core::first_passage(ray, settings_.header.frame);
    if (!start) {
      return;
    }
    settle();
    place_ = start->cell;
    ++operations_.rays[static_cast<std::size_t>(ray.kind)];
    const core::Hit hit = settings_.header.has_instances != 0 ? trace<core::InstanceCursor>(ray) : trace<core::Cursor>(ray);
    if (hit.found() && ray.kind != core::RayKind::shadow) {
      const core::GridFrame& frame = settings_.header.frame;
      const core::Region grid{{}, core::grid_size(frame)};
      shade(core::begin_shading(ray, hit), finest_cell_at(ray, double{hit.t}, grid, frame));
    }
  }

  template <class RayCursor>
  core::Hit trace(const core::Ray& ray) {
    RayCursor cursor;
    Watch<RayCursor> watch{*this, ray, cursor};
    core::trace(ray, cursor, watch, settings_.header, settings_.skips, operations_);
    settle();
    return cursor.best;
  }

  /// Shading and making the children is charged to the hit's place.
  void shade(core::HitState state, const core::Corner& place) {
    while (state.stage != core::HitState::Stage::finished) {
      place_ = place;
      const core::Address address = core::record_needed(state, settings_.header);
      const std::byte* record = address == core::no_address ? nullptr : records_.find(address);
      core::Ray child;
      const bool has_child = core::Shader(settings_.header, settings_.shade, settings_.skips, operations_, &settings_.camera)
                                 .step(state, record, child);
      settle();
      if (has_child) {
        shoot(child);
      }
    }
  }

  core::LocalRecords records_;
  core::RenderSettings settings_;
  C charge_;
  core::Operations operations_;
  std::uint64_t settled_ = 0;
  core::Corner place_{};
};

}  // namespace dmpc::dataflow
