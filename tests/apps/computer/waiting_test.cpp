#include "apps/computer/waiting.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::apps::waiting_test {

namespace {

using Awaited = std::vector<std::vector<Unanswered>>;

Unanswered answer_of(std::uint32_t node) { return {node, "yes", 1}; }

}  // namespace

TEST_CASE("what a node waits for and what it owes is said, of many nodes of the first") {
  CHECK(waiting_text({}, {}).empty());
  CHECK(waiting_text({{3, "yes", 2}}, {}) == "; waits for 2 'yes' of node 3");
  CHECK(waiting_text({}, {{1, "no", 1}}) == "; owes 1 'no' to node 1");
  CHECK(waiting_text({answer_of(1), answer_of(2), answer_of(3), answer_of(4), answer_of(5)}, {}) ==
        "; waits for 1 'yes' of node 1, 1 'yes' of node 2, 1 'yes' of node 3 and 2 more");
}

TEST_CASE("a circle is found wherever it begins, and told from its least node on") {
  CHECK(circle_text({}).empty());
  CHECK(circle_text(Awaited{{answer_of(0)}}) == "\nin a circle: node 0 waits for node 0");
  const std::string of_two = "\nin a circle: node 1 waits for node 2, that for node 1";
  CHECK(circle_text(Awaited{{answer_of(2)}, {answer_of(2)}, {answer_of(1)}}) == of_two);
  CHECK(circle_text(Awaited{{answer_of(3)}, {answer_of(3), answer_of(2)}, {answer_of(3), answer_of(1)}, {}}) == of_two);
}

TEST_CASE("who waits in no circle is not said to") {
  CHECK(circle_text(Awaited{{answer_of(1)}, {answer_of(2)}, {}}).empty());
  CHECK(circle_text(Awaited{{answer_of(1), answer_of(2)}, {answer_of(3)}, {answer_of(3)}, {}}).empty());
}

TEST_CASE("of a long circle the beginning is told, and how many there are") {
  Awaited ring(40);
  for (std::uint32_t node = 0; node < 40; ++node) {
    ring[node] = {answer_of((node + 1) % 40)};
  }
  const std::string text = circle_text(ring);
  CHECK(text.starts_with("\nin a circle: node 0 waits for node 1, that for node 2, "));
  CHECK(text.ends_with("that for node 16, and so on, 40 nodes in all"));
}

}  // namespace dmpc::apps::waiting_test
