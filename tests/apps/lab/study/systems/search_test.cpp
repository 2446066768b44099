#include "apps/lab/study/systems/search.h"

#include <doctest/doctest.h>

#include <functional>

namespace dmpc::tests::search_test {

namespace {

using apps::Search;
using Cost = std::function<std::optional<double>(const Search::Setting&)>;

/// Carries the search out; returns the number of settings tried.
std::size_t carry_out(Search& search, const Cost& cost) {
  std::size_t count = 0;
  while (!search.wanted().empty()) {
    std::vector<std::optional<double>> seconds;
    for (const Search::Setting& setting : search.wanted()) {
      seconds.push_back(cost(setting));
    }
    count += seconds.size();
    search.take(seconds);
  }
  return count;
}

const std::vector<apps::SearchedOption> three = {
    {"page", {"1KiB", "4KiB"}}, {"fixed", {"yes"}}, {"in-flight", {"16", "1", "64"}}};

}  // namespace

TEST_CASE("a search finds the optimum where options do not depend on each other, and prints its steps") {
  Search search(three);
  CHECK(carry_out(search, [](const Search::Setting& at) {
          return 10.0 - (at[0] == 1 ? 4 : 0) - (at[2] == 2 ? 3 : at[2] == 1 ? -2 : 0);
        }) == 4);
  CHECK(search.best() == Search::Setting{1, 0, 2});
  CHECK(*search.seconds() == 3);
  CHECK(search.steps_text() == "defaults 10.0 s, page 4KiB 6.00 s, in-flight 1 8.00 s, in-flight 64 3.00 s");
}

TEST_CASE("each value is tried with the best so far, and only a faster one replaces it") {
  Search search(three);
  std::vector<Search::Setting> tried;
  carry_out(search, [&](const Search::Setting& at) {
    tried.push_back(at);
    return 5.0;
  });
  CHECK(tried == std::vector<Search::Setting>{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 2}});
  CHECK(search.best() == Search::Setting{0, 0, 0});
}

TEST_CASE("without options the defaults are all, and what does not fit is never the best") {
  Search none({});
  CHECK(carry_out(none, [](const Search::Setting&) { return 1.0; }) == 1);
  CHECK(none.steps_text() == "defaults 1.00 s");
  Search tight(three);
  carry_out(tight, [](const Search::Setting& at) { return at[2] == 1 ? std::optional(9.0) : std::nullopt; });
  CHECK(tight.best() == Search::Setting{0, 0, 1});
  CHECK(tight.steps_text().starts_with("defaults no room, page 4KiB no room, in-flight 1 9.00 s"));
  Search full(three);
  carry_out(full, [](const Search::Setting&) { return std::nullopt; });
  CHECK_FALSE(full.seconds());
}

}  // namespace dmpc::tests::search_test
