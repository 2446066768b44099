#include "apps/formats/view_faults.h"

#include <doctest/doctest.h>

#include <limits>

namespace dmpc::apps::view_faults_test {

using core::View;

namespace {

const View good{.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 45};

View changed(void (*change)(View&)) {
  View view = good;
  change(view);
  return view;
}

}  // namespace

TEST_CASE("a view that shows something has no fault") {
  CHECK_FALSE(fault_of(good));
  CHECK_FALSE(fault_of(changed([](View& view) { view.from = {0, 0, 1e30}; })));
  CHECK_FALSE(fault_of(changed([](View& view) { view.up = {0, 1e-200, 0}; })));
}

TEST_CASE("every fault is found") {
  CHECK(fault_of(changed([](View& view) { view.angle_degrees = 0; })) == ViewFault::angle);
  CHECK(fault_of(changed([](View& view) { view.angle_degrees = 180; })) == ViewFault::angle);
  CHECK(fault_of(changed([](View& view) { view.angle_degrees = std::numeric_limits<double>::quiet_NaN(); })) == ViewFault::angle);
  CHECK(fault_of(changed([](View& view) { view.from.x = 1.1e30; })) == ViewFault::far_from);
  CHECK(fault_of(changed([](View& view) { view.at.x = std::numeric_limits<double>::quiet_NaN(); })) == ViewFault::far_at);
  CHECK(fault_of(changed([](View& view) { view.at = view.from; })) == ViewFault::direction);
  CHECK(fault_of(changed([](View& view) { view.up = {}; })) == ViewFault::up);
  CHECK(fault_of(changed([](View& view) { view.up = {0, 0, -3}; })) == ViewFault::up);
}

}  // namespace dmpc::apps::view_faults_test
