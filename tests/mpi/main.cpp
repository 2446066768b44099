// Tests that run on several ranks at a time: to be started by mpirun, or alone as one rank.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <exception>
#include <iostream>

#include "apps/frontend/ranks/rank_group.h"
#include "apps/render/self_test.h"
#include "tests/mpi/here.h"

namespace {

/// Longer than those that fit the least frame.
constexpr std::size_t payload_bytes_max = 40'000;

int run_tests(doctest::Context& context) {
  using namespace dmpc;
  return apps::run_as_rank({.own = apps::renderer_compatibility()}, [&](apps::RankGroup& group) {
    const tests::Here here{group, group.connect(payload_bytes_max)};
    tests::here_now = &here;
    const int status = context.run();
    if (tests::is_lost) {
      std::rethrow_exception(tests::is_lost);
    }
    return status;
  });
}

}  // namespace

int main(int count, char** values) {
  doctest::Context context(count, values);
  int status = 1;
  try {
    status = run_tests(context);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
  }
  dmpc::apps::end_ranks(status);
  return status;
}
