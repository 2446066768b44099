#include "apps/run/memory_categories.h"

#include <doctest/doctest.h>

#include <set>
#include <string_view>

namespace dmpc::apps::memory_categories_test {

TEST_CASE("every category of a node's memory is shown once, by a name of its own") {
  std::set<std::size_t> numbers;
  std::set<std::string_view> names;
  for (const NamedCategory& named : memory_categories) {
    numbers.insert(named.category.number());
    names.insert(named.name);
  }
  CHECK(numbers.size() == nodes::category_count);
  CHECK(*numbers.rbegin() == nodes::category_count - 1);
  CHECK(names.size() == nodes::category_count);
  CHECK(std::string_view(memory_categories.front().name) == "home pages");
}

}  // namespace dmpc::apps::memory_categories_test
