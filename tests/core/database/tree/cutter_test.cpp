#include "core/database/tree/cutter.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "apps/lab/bench/stability/random.h"
#include "tests/support/ids.h"

namespace cutter_test {

using namespace dmpc::core;
using dmpc::tests::are_all;

namespace {

/// Primitives 0, 1, .. in boxes of edge 1 at these places along x.
Cutter in_a_row(const std::vector<double>& places) {
  Cutter cutter(places.size());
  for (std::uint32_t id = 0; id < places.size(); ++id) {
    cutter.add(id, Bounds::around({{places[id], 0, 0}, {places[id] + 1, 1, 1}}));
  }
  return cutter;
}

std::vector<std::uint32_t> ids_of(const Cutter& cutter, const Group& group) {
  std::vector<std::uint32_t> ids(group.count());
  cutter.copy_ids(group, ids);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The primitives of all groups that come of cutting until none has more than 8; their numbers must fall.
std::vector<std::uint32_t> cut_up(Cutter& cutter, const Group& group, bool balanced) {
  if (group.count() <= 8) {
    return ids_of(cutter, group);
  }
  const auto [first, second] = cutter.cut(group, balanced);
  REQUIRE(first.count() > 0);
  REQUIRE(second.count() > 0);
  REQUIRE(first.count() + second.count() == group.count());
  auto ids = cut_up(cutter, first, balanced);
  const auto more = cut_up(cutter, second, balanced);
  ids.insert(ids.end(), more.begin(), more.end());
  return ids;
}

/// Boxes of several sizes here and there, at multiples of `step` if that is not 0.
std::vector<Bounds> scattered(std::size_t count, double step) {
  dmpc::apps::Random random(3);
  std::vector<Bounds> boxes;
  while (boxes.size() < count) {
    Vec3d at = random.in_box(-1, 1), half = random.in_box(0.05, 0.2);
    for (std::size_t axis = 0; axis < 3 && step > 0; ++axis) {
      at[axis] = std::round(at[axis] / step) * step;
      half[axis] = step;
    }
    boxes.push_back(Bounds::around({at - half, at + half}));
  }
  return boxes;
}

Cutter cutter_of(const std::vector<Bounds>& boxes, VectorWidth width = vector_width()) {
  Cutter cutter(boxes.size(), {}, width);
  for (std::uint32_t id = 0; id < boxes.size(); ++id) {
    cutter.add(id, boxes[id]);
  }
  return cutter;
}

/// The widths that this processor has.
std::vector<VectorWidth> widths_here() {
  std::vector<VectorWidth> widths;
  for (const VectorWidth width : {VectorWidth::any, VectorWidth::bits_256, VectorWidth::bits_512}) {
    if (width <= vector_width()) {
      widths.push_back(width);
    }
  }
  return widths;
}

using Ids = std::vector<std::uint32_t>;

/// The ids of both parts, ascending, by looking at every place along every axis.
std::pair<Ids, Ids> best_of_all_cuts(const std::vector<Bounds>& boxes) {
  std::pair<Ids, Ids> best;
  float least = Bounds::infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Ids order(boxes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return boxes[a].middle(axis) < boxes[b].middle(axis); });
    for (std::size_t place = 1; place < order.size(); ++place) {
      const auto cost_of = [&](std::span<const std::uint32_t> part) {
        Bounds all;
        for (const std::uint32_t id : part) {
          all.include(boxes[id]);
        }
        return all.area() * static_cast<float>((part.size() + 7) / 8);
      };
      const float cost = cost_of(std::span(order).first(place)) + cost_of(std::span(order).subspan(place));
      if (cost < least) {
        least = cost;
        best = {{order.begin(), order.begin() + static_cast<std::ptrdiff_t>(place)},
                {order.begin() + static_cast<std::ptrdiff_t>(place), order.end()}};
      }
    }
  }
  std::sort(best.first.begin(), best.first.end());
  std::sort(best.second.begin(), best.second.end());
  return best;
}

}  // namespace

TEST_CASE("of places that cost a ray the same the first is taken") {
  Cutter cutter = in_a_row({0, 1, 2, 3, 4, 5, 6, 7, 8});  // n cubes have 4 n + 2 faces, both parts 40
  CHECK(cutter.cut(cutter.group(PrimitiveKind::triangle, 0, 9), false).first.count() == 1);
}

TEST_CASE("a small group is cut where both parts cost a ray the least, by what comes first of equal middles") {
  for (const std::size_t count : {std::size_t{9}, std::size_t{17}, std::size_t{33}, std::size_t{64}}) {
    for (const double step : {0.0, 0.25}) {  // places as they come, and such that many middles and costs are equal
      const std::vector<Bounds> boxes = scattered(count, step);
      Cutter cutter = cutter_of(boxes);
      const auto [first, second] = cutter.cut(cutter.group(PrimitiveKind::triangle, 0, count), false);
      const auto [best_first, best_second] = best_of_all_cuts(boxes);
      CHECK(ids_of(cutter, first) == best_first);
      CHECK(ids_of(cutter, second) == best_second);
    }
  }
}

TEST_CASE("groups are cut alike whatever the width of vectors") {
  for (const std::size_t count : {std::size_t{9}, std::size_t{50}, std::size_t{64}, std::size_t{65}, std::size_t{1001}}) {
    for (const double step : {0.0, 0.25}) {
      std::vector<Ids> cuts;
      for (const VectorWidth width : widths_here()) {
        Cutter cutter = cutter_of(scattered(count, step), width);
        cuts.push_back(cut_up(cutter, cutter.group(PrimitiveKind::triangle, 0, count), false));
        CHECK(cuts.back() == cuts.front());
      }
    }
  }
}

TEST_CASE("a cut goes through the gap, whatever the order") {
  for (const std::vector<double>& places : {std::vector<double>{0, 1, 100, 101}, {100, 0, 101, 1}}) {
    Cutter cutter = in_a_row(places);
    const auto [first, second] = cutter.cut(cutter.group(PrimitiveKind::triangle, 0, 4), false);
    for (const std::uint32_t id : ids_of(cutter, first)) {
      CHECK(places[id] < 50);
    }
    CHECK(first.count() == 2);
    CHECK(first.bounds.high[0] == 2.0F);
    CHECK(second.bounds.low[0] == 100.0F);
  }
}

TEST_CASE("two cuts one after the other go through the gaps of two axes") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Cutter cutter(4);
    for (const std::uint32_t id : {0U, 1U, 2U, 3U}) {
      Box box;
      Vec3d at;
      at[axis] = id % 2 == 0 ? 0 : 100;
      at[(axis + 1) % 3] = id < 2 ? 0 : 10;
      box.include(at);
      cutter.add(id, Bounds::around(box.padded({1, 1, 1})));
    }
    const auto [first, second] = cutter.cut(cutter.group(PrimitiveKind::triangle, 0, 4), false);
    CHECK(ids_of(cutter, first) == std::vector<std::uint32_t>{0, 2});
    CHECK(ids_of(cutter, second) == std::vector<std::uint32_t>{1, 3});
    CHECK(ids_of(cutter, cutter.cut(second, false).first) == std::vector<std::uint32_t>{1});
  }
}

TEST_CASE("a large group is cut at its gap between bins") {
  std::vector<double> places;
  for (int i = 0; i < 300; ++i) {
    places.push_back(i % 3 == 0 ? 1000 + i : i);
  }
  Cutter cutter = in_a_row(places);
  const auto [first, second] = cutter.cut(cutter.group(PrimitiveKind::triangle, 0, 300), false);
  CHECK(first.count() == 200);
  CHECK(second.count() == 100);
}

TEST_CASE("a balanced cut makes halves") {
  for (const std::size_t count : {std::size_t{2}, std::size_t{9}, std::size_t{64}, std::size_t{65}, std::size_t{1000}}) {
    std::vector<double> places(count, 0.0);
    places.back() = 5;
    Cutter cutter = in_a_row(places);
    const auto [first, second] = cutter.cut(cutter.group(PrimitiveKind::cone, 0, count), true);
    CHECK(first.count() == count / 2);
    CHECK(second.kind == PrimitiveKind::cone);
  }
}

TEST_CASE("cutting up neither loses nor doubles a primitive") {
  dmpc::apps::Random random(1);
  for (const std::size_t count : {std::size_t{1}, std::size_t{9}, std::size_t{64}, std::size_t{65}, std::size_t{2000}}) {
    for (const bool balanced : {false, true}) {
      Cutter cutter(count);
      for (std::uint32_t id = 0; id < count; ++id) {
        Box box;
        box.include(random.in_box(-1, 1));
        cutter.add(id, Bounds::around(box.padded({0.1, 0.1, 0.1})));
      }
      CHECK(are_all(cut_up(cutter, cutter.group(PrimitiveKind::sphere, 0, count), balanced), count));
    }
  }
}

TEST_CASE("a part that was cut up is cut as if it was not, once it is sorted again") {
  Cutter fresh(64);
  for (std::uint32_t id = 0; id < 64; ++id) {  // two rows, longer than they are apart
    const double x = id, y = id % 2 == 0 ? 0 : 20;
    fresh.add(id, Bounds::around({{x, y, 0}, {x + 1, y + 1, 1}}));
  }
  const Group part = fresh.cut(fresh.group(PrimitiveKind::sphere, 0, 64), true).second;
  Cutter used = fresh;
  cut_up(used, part, false);
  used.sort_again(part);
  CHECK(ids_of(used, used.cut(part, true).first) == ids_of(fresh, fresh.cut(part, true).first));
}

TEST_CASE("primitives in one place are cut all the same") {
  Cutter cutter = in_a_row(std::vector<double>(500, 0.0));
  CHECK(are_all(cut_up(cutter, cutter.group(PrimitiveKind::sphere, 0, 500), false), 500));
}

}  // namespace cutter_test
