#include "svm/pages/request_tree.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace request_tree_test {

using namespace dmpc;
using svm::RequestTree;

TEST_CASE("the host has the first nodes for children, these the next, and so on") {
  const RequestTree tree(14, 3);
  CHECK(tree.host() == 14);
  const std::vector<std::uint32_t> parents = {14, 14, 14, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3};
  for (std::uint32_t node = 0; node < 14; ++node) {
    CHECK(tree.parent_of(node) == parents[node]);
  }
  CHECK(tree.count_below(0) == 5);
  CHECK(tree.count_below(1) == 3);
  CHECK(tree.count_below(3) == 2);
  CHECK(tree.count_below(4) == 0);
  CHECK(tree.count_below(13) == 0);
}

TEST_CASE("a tree of arity 1 is a chain, and one of as many children as there are nodes a star") {
  const RequestTree chain(5, 1), star(5, 5);
  for (std::uint32_t node = 0; node < 5; ++node) {
    CHECK(chain.parent_of(node) == (node == 0 ? 5 : node - 1));
    CHECK(chain.count_below(node) == 4 - node);
    CHECK(star.parent_of(node) == 5);
    CHECK(star.count_below(node) == 0);
  }
  CHECK(RequestTree(1, 1).parent_of(0) == 1);
  CHECK(RequestTree(1, 1).count_below(0) == 0);
}

TEST_CASE("who is above a node is who its requests pass, and whoever is below a node counts it among those above") {
  for (const std::uint32_t nodes : {1U, 2U, 7U, 64U, 100U}) {
    for (const std::uint32_t arity : {1U, 2U, 3U, 8U, 99U, 4096U}) {
      const RequestTree tree(nodes, arity);
      std::vector<std::uint32_t> below(nodes + 1);
      for (std::uint32_t node = 0; node < nodes; ++node) {
        std::vector<bool> is_passed(nodes + 1);
        for (std::uint32_t at = node; at != tree.host();) {
          at = tree.parent_of(at);
          is_passed[at] = true;
          ++below[at];
        }
        for (std::uint32_t upper = 0; upper <= nodes; ++upper) {
          REQUIRE(tree.is_above(upper, node) == is_passed[upper]);
        }
      }
      for (std::uint32_t node = 0; node < nodes; ++node) {
        REQUIRE(tree.count_below(node) == below[node]);
      }
    }
  }
}

TEST_CASE("a tree without nodes or children is refused") {
  CHECK_THROWS_AS(RequestTree(0, 3), core::InternalError);
  CHECK_THROWS_AS(RequestTree(3, 0), core::InternalError);
}

}  // namespace request_tree_test
