#include "dataflow/units/unit_pages.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests::unit_pages_test {
namespace {

using dataflow::UnitPages;

const core::Database& gears() {
  static const Subject subject(built_in("gears-2"), {8, 8});
  return subject.database();
}

/// The grid, or one half of it along x.
core::Region grid() { return {.low = {}, .high = core::grid_size(gears().header().frame)}; }
core::Region half(bool is_high) {
  core::Region region = grid();
  (is_high ? region.low : region.high)[0] = region.high[0] / 2;
  return region;
}

/// A node that begins with these pages, and has room for so many more.
struct UnitPagesBench {
  UnitPagesBench(const std::vector<std::uint32_t>& numbers, std::uint32_t spare)
      : memory(needs(numbers, spare)), pages(memory, capacity(numbers, spare)) {
    std::vector<std::byte> bytes;
    for (const std::uint32_t number : numbers) {
      const auto page = gears().page(number);
      bytes.insert(bytes.end(), page.begin(), page.end());
    }
    pages.begin_with(numbers, std::span<const std::byte>(bytes));
  }

  static UnitPages::Capacity capacity(const std::vector<std::uint32_t>& numbers, std::uint32_t spare) {
    return {.page_bytes = gears().page_size(), .frames = static_cast<std::uint32_t>(numbers.size()) + spare};
  }
  static nodes::MemoryPlan needs(const std::vector<std::uint32_t>& numbers, std::uint32_t spare) {
    return UnitPages::layout(capacity(numbers, spare));
  }

  nodes::LocalMemory memory;
  UnitPages pages;
};

}  // namespace

TEST_CASE("the pages of the whole grid are all that the database has, those of no region the lights' and materials' alone") {
  const std::vector<std::uint32_t> all = dataflow::pages_of(gears(), std::vector{grid()});
  CHECK(all.size() == gears().page_count());
  CHECK(std::is_sorted(all.begin(), all.end()));
  const std::vector<std::uint32_t> none = dataflow::pages_of(gears(), {});
  CHECK(none.size() >= 1);
  CHECK(none.size() <= 2);
}

TEST_CASE("two halves need less than all pages each, and together all of them") {
  const std::vector<std::uint32_t> low = dataflow::pages_of(gears(), std::vector{half(false)}),
                                   high = dataflow::pages_of(gears(), std::vector{half(true)});
  CHECK(low.size() < gears().page_count());
  CHECK(high.size() < gears().page_count());
  std::vector<std::uint32_t> both;
  std::set_union(low.begin(), low.end(), high.begin(), high.end(), std::back_inserter(both));
  CHECK(both == dataflow::pages_of(gears(), std::vector{half(false), half(true)}));
  CHECK(both.size() == gears().page_count());
}

TEST_CASE("a page is found by its number, whatever its frame, and what is not here is a record that says that nothing is there") {
  UnitPagesBench bench({5, 2}, 1);
  CHECK(bench.memory.used().total() == UnitPagesBench::needs({5, 2}, 1).total());
  const auto is_like = [&](std::uint32_t number) {
    return std::equal(gears().page(number).begin(), gears().page(number).end(), bench.pages.find_page(number));
  };
  CHECK(is_like(5));
  CHECK(is_like(2));
  CHECK(bench.pages.find_page(3) == nullptr);
  const core::Address address = core::advance(core::Address{}, 3 * gears().page_size());
  CHECK(core::read<core::BvhNode>(bench.pages.find(address)).child_count == 0);
  CHECK(bench.pages.add(3, gears().page(3)));
  CHECK(is_like(3));
  CHECK(bench.pages.free_frames() == 0);
  CHECK_FALSE(bench.pages.add(3, gears().page(3)));  // it is here
  CHECK_THROWS_AS(static_cast<void>(bench.pages.add(4, gears().page(4))), core::InternalError);
}

TEST_CASE("the pages of a unit are marked, each once, and are those that its rays need but for lights and materials") {
  std::vector<std::uint32_t> all(gears().page_count());
  std::iota(all.begin(), all.end(), 0U);
  UnitPagesBench bench(all, 0);
  const std::uint32_t count = bench.pages.mark(gears().header(), half(true)).pages;
  std::vector<std::uint32_t> marked;
  for (std::uint32_t frame = 0; marked.size() < count; ++frame) {
    frame = bench.pages.next_marked(frame);
    marked.push_back(bench.pages.page_at(frame));
  }
  const std::vector<std::uint32_t> needed = dataflow::pages_of(gears(), std::vector{half(true)});
  CHECK(std::includes(needed.begin(), needed.end(), marked.begin(), marked.end()));
  CHECK(needed.size() <= marked.size() + 2);
  CHECK(count == bench.pages.mark(gears().header(), half(true)).pages);
}

TEST_CASE("a node without units has no pages, and takes no memory for them") {
  CHECK(nodes::MemoryPlan(UnitPages::layout({})).total() == 0);
}

}  // namespace dmpc::tests::unit_pages_test
