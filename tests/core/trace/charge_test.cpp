#include "core/trace/charge.h"

#include <doctest/doctest.h>

#include <set>
#include <string_view>

namespace dmpc::core::charge_test {

namespace {

std::uint64_t of(const ChargeCounts& counts, Charge charge) { return counts[static_cast<std::size_t>(charge)]; }

}  // namespace

TEST_CASE("each class of operations has a name of its own") {
  const std::set<std::string_view> names(charge_names.begin(), charge_names.end());
  CHECK(names.size() == charge_names.size());
  CHECK(names.count("") == 0);
  CHECK(charge_names[static_cast<std::size_t>(Charge::question_setup)] == "question_setup");
}

TEST_CASE("operations are charged by class, and what strategies count is left to them") {
  CHECK(charges_of({}) == ChargeCounts{});
  Operations operations;
  operations.cell_steps = 7;
  operations.primitive_tests[1] = 3;
  operations.rays[0] = 10;
  operations.skipped.background = 4;
  operations.bvh_node_reads = 100;
  operations.primitive_tests[0] = 1000;
  CHECK(of(charges_of(operations), Charge::bvh_node_read) == 100);
  CHECK(of(charges_of(operations), Charge::triangle_test) == 1000);
  operations.instance_entries = 2;
  operations.placed_triangles = 3;
  const ChargeCounts counts = charges_of(operations);
  CHECK(of(counts, Charge::bvh_node_read) == 100 + 2 * bvh_nodes_an_entry);
  CHECK(of(counts, Charge::triangle_test) == 1000 + 3 * tests_a_placing);
  CHECK(of(counts, Charge::cell_step) == 7);
  CHECK(of(counts, Charge::sphere_test) == 3);
  CHECK(of(counts, Charge::ray_setup) == 6);
  CHECK(of(counts, Charge::page_install) == 0);
}

}  // namespace dmpc::core::charge_test
