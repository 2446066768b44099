// A subject's film, held against what strategies make of it: however small their memories, whatever they leave out, after a stop.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <utility>

#include "core/picture/film/partial_picture.h"
#include "nodes/chaos.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests {

/// Replicated, by svm with room for much and for one page, by dataflow with much and with the least, and on a pool.
inline void check_strategies(const Subject& subject, const std::optional<nodes::Chaos>& chaos = {}) {
  for (const std::uint32_t nodes : {1U, 3U, 16U}) {
    CAPTURE(nodes);
    const nodes::ComputerRequest computer{.node_count = nodes, .chaos = chaos};
    CHECK(outcome_of(run_replicated(subject, {.computer = computer})) == subject.outcome());
    CHECK(outcome_of(run_svm(subject, {.computer = computer})) == subject.outcome());
    CHECK(outcome_of(run_svm(subject, {.computer = computer, .pages = {.cache_pages = 1, .in_flight = 1}})) == subject.outcome());
    CHECK(outcome_of(run_svm(subject, {.computer = computer, .pages = {.cache_pages = 1, .in_flight = 40}})) ==
          subject.outcome());
    CHECK(outcome_of(run_dataflow(subject, {.computer = computer})) == subject.outcome());
    const dataflow::RayOptions least{.ray_batch = 1, .ray_credits = nodes % 2, .queue_packets = 0};
    CHECK(outcome_of(run_dataflow(subject, {.computer = computer, .rays = least})) == subject.outcome());
    const nodes::ComputerRequest pool{.node_count = nodes, .chaos = chaos, .pool_threads = 1 + nodes % 4};
    CHECK(outcome_of(run_svm(subject, {.computer = pool})) == subject.outcome());
    CHECK(outcome_of(run_dataflow(subject, {.computer = pool})) == subject.outcome());
  }
}

/// Without each of the skips there is more to do for the same film.
inline void check_skips(const Subject& subject) {
  for (const core::Skip& skip : core::all_skips) {
    CAPTURE(skip.name);
    CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 3}}, without(skip))).film_hash == subject.outcome().film_hash);
    CHECK(outcome_of(run_dataflow(subject, {.computer = {.node_count = 3}}, without(skip))).film_hash ==
          subject.outcome().film_hash);
  }
}

/// By svm it is stopped soon, and by svm and dataflow it goes on from there.
inline void check_going_on(const Subject& subject) {
  std::optional<core::PartialPicture> kept;
  std::stop_source stop;
  bool asked = false;  // with the first light: of small pictures little comes
  const core::Continuation continuation{nullptr, [&] { return !std::exchange(asked, true); },
                                        [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
                                          kept.emplace(core::partial_picture(film, pass, done));
                                          stop.request_stop();
                                        }};
  svm::run_svm(subject.database(), subject.settings(), {.computer = {.node_count = 3}, .continuation = continuation},
               stop.get_token());
  REQUIRE(kept);
  REQUIRE(kept->done.count() > 0);
  const core::Continuation rest{&*kept, [] { return false; }, {}};
  CHECK(run_svm(subject, {.computer = {.node_count = 2}, .continuation = rest}).film.hash() == subject.outcome().film_hash);
  CHECK(run_dataflow(subject, {.computer = {.node_count = 2}, .continuation = rest}).film.hash() == subject.outcome().film_hash);
}

}  // namespace dmpc::tests
