// Passing a region in which nothing is: in one step or in many, the ray leaves it with the same bits.
#include <doctest/doctest.h>

#include <cstring>
#include <optional>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/trace/traversal.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::pass_test {

using apps::Random;

namespace {

/// A box of 1 to 200 finest cells a side that holds `cell`.
core::Region box_around(const core::Corner& cell, const core::Corner& size, Random& random) {
  core::Region box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::max(0, cell[axis] - static_cast<std::int32_t>(random.below(100)));
    box.high[axis] = std::min(size[axis], cell[axis] + 1 + static_cast<std::int32_t>(random.below(100)));
  }
  return box;
}

/// A part of `box` around `cell`.
core::Region part_around(const core::Corner& cell, const core::Region& box, Random& random) {
  core::Region part = box_around(cell, box.high, random);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part.low[axis] = std::max(part.low[axis], box.low[axis]);
    part.high[axis] = std::min(part.high[axis], cell[axis] + 1 + static_cast<std::int32_t>(random.below(20)));
    part.high[axis] = std::min(part.high[axis], box.high[axis]);
  }
  return part;
}

struct Stepped {
  core::Traced traced;
  core::Passage passage;

  bool operator==(const Stepped& other) const {
    return traced == other.traced && (traced != core::Traced::left || is_same_passage(other.passage));
  }
  bool is_same_passage(const core::Passage& other) const {
    return std::memcmp(&passage.t_enter, &other.t_enter, sizeof(double)) == 0 && passage.cell == other.cell &&
           passage.entry_axis == other.entry_axis;
  }
};

Stepped in_one_step(const core::Ray& ray, const core::GridFrame& frame, core::Passage passage, const core::Region& box) {
  core::Operations operations;
  const core::Traced traced = core::pass(ray, frame, box, passage, operations);
  CHECK(operations.cell_steps == 1);
  return {traced, passage};
}

Stepped in_many_steps(const core::Ray& ray, const core::GridFrame& frame, core::Passage passage, const core::Region& box,
                      Random& random) {
  core::Operations operations;
  core::Traced traced = core::Traced::left;
  while (traced == core::Traced::left && box.contains(passage.cell)) {
    traced = core::pass(ray, frame, part_around(passage.cell, box, random), passage, operations);
  }
  return {traced, passage};
}

/// A ray at the grid; some run along axes, or along borders of cells, or exactly through their edges.
core::Ray random_ray(const core::GridFrame& frame, Random& random) {
  const core::Corner size = core::grid_size(frame);
  core::Ray ray;
  const std::uint32_t kind = random.below(4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto cells = static_cast<std::int32_t>(random.below(static_cast<std::size_t>(size[axis]) + 200)) - 100;
    const double fraction = kind == 0 ? 0.0 : random.unit();
    ray.origin[axis] = static_cast<float>(plane_at(frame, axis, cells) + fraction * double{frame.finest_cell});
    ray.direction[axis] =
        kind < 2 ? static_cast<float>(static_cast<std::int32_t>(random.below(3)) - 1) : static_cast<float>(random.between(-1, 1));
  }
  return ray;
}

}  // namespace

TEST_CASE("a region is passed in one step with the bits of many") {
  const core::Database database = core::build_database(built_in("tetra-4"), {});
  const core::GridFrame& frame = database.header().frame;
  Random random(1'994);
  std::uint32_t left = 0, missed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const core::Ray ray = random_ray(frame, random);
    const std::optional<core::Passage> first = core::first_passage(ray, frame);
    if (first) {
      const core::Region box = box_around(first->cell, core::grid_size(frame), random);
      const Stepped outcome = in_one_step(ray, frame, *first, box);
      CHECK(outcome == in_many_steps(ray, frame, *first, box, random));
      left += outcome.traced == core::Traced::left ? 1 : 0;
      missed += outcome.traced == core::Traced::miss ? 1 : 0;
    }
  }
  CHECK(left > 1000);
  CHECK(missed > 100);
}

TEST_CASE("a ray that passes a region ends there if its candidate or its end lies there") {
  const core::Database database = core::build_database(built_in("tetra-4"), {});
  const core::GridFrame& frame = database.header().frame;
  core::Ray ray;
  ray.origin = core::Vec3f(frame.low + core::Vec3d{-1, 0.3, 0.3});
  ray.direction = {1, 0, 0};
  core::Passage passage = *core::first_passage(ray, frame);
  const core::Region box{{0, 0, 0}, {50, core::grid_size(frame)[1], core::grid_size(frame)[2]}};
  passage.best.primitive = 3;
  passage.best.t = 1.0F + 49.0F * frame.finest_cell;
  CHECK(in_one_step(ray, frame, passage, box).traced == core::Traced::hit);
  passage.best.t = 1.0F + 51.0F * frame.finest_cell;
  CHECK(in_one_step(ray, frame, passage, box).traced == core::Traced::left);
  passage.best = {};
  ray.t_max = 1.0F + 49.0F * frame.finest_cell;
  CHECK(in_one_step(ray, frame, passage, box).traced == core::Traced::miss);
}

}  // namespace dmpc::tests::pass_test
