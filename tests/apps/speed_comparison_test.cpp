#include "apps/speed/comparison.h"

#include <doctest/doctest.h>

#include "core/expect.h"

namespace dmpc::tests {

using apps::Comparison;
using apps::ratio_of;

TEST_CASE("a ratio is the middle one of the rounds and not that of middle figures") {
  const Comparison comparison{.subject_figures = {1, 8, 9}, .rival_figures = {2, 2, 18}};
  CHECK(ratio_of(comparison).median == 0.5);
  CHECK(ratio_of(comparison).least == 0.5);
  CHECK(ratio_of(comparison).most == 4);
}

TEST_CASE("a round that only one of two has ended does not count") {
  const Comparison comparison{.subject_figures = {6, 100}, .rival_figures = {3}};
  CHECK(comparison.rounds() == 1);
  CHECK(ratio_of(comparison).median == 2);
  CHECK(ratio_of(comparison).most == 2);
}

TEST_CASE("nothing is compared before a round has ended or with a rival that took nothing") {
  CHECK(Comparison{}.rounds() == 0);
  CHECK_THROWS_AS(ratio_of(Comparison{.subject_figures = {1}}), core::InternalError);
  CHECK_THROWS_AS(ratio_of(Comparison{.subject_figures = {1}, .rival_figures = {0}}), core::InternalError);
}

}  // namespace dmpc::tests
