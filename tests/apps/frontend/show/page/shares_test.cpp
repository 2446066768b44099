#include "apps/frontend/show/page/shares.h"

#include <doctest/doctest.h>

#include <vector>

namespace dmpc::apps::html::shares_test {

TEST_CASE("a node that did more than the mean is named with how much more") {
  CHECK(evenness(std::vector<double>{1, 1, 4, 2}, "did") == "Node 2 did 2.00 times the mean");
  CHECK(evenness(std::vector<double>{3, 3, 3}, "did") == "All nodes did the same");
  CHECK(evenness(std::vector<double>{3}, "did").empty());
  CHECK(evenness(std::vector<double>{0, 0}, "did").empty());
}

TEST_CASE("a share is written as precisely as it deserves, and never rounded to nothing or all") {
  CHECK(share_text(0) == "0 %");
  CHECK(share_text(0.0001) == "less than 0.1 %");
  CHECK(share_text(0.031) == "3.1 %");
  CHECK(share_text(0.412) == "41 %");
  CHECK(share_text(0.9999) == "more than 99.9 %");
  CHECK(share_text(share_of(1, 0)) == "0 %");
}

TEST_CASE("the largest tenth of few values is the largest of them") {
  CHECK(top_tenth_share({1, 3}) == 0.75);
  CHECK(top_tenth_share({0}) == 0);
}

}  // namespace dmpc::apps::html::shares_test
