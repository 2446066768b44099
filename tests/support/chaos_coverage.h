// What chaos has tried: which pictures, computers and bounds seeds stood for, and what happened in their runs.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <string>

#include "dataflow/run.h"
#include "svm/forest/strategy.h"
#include "svm/run.h"
#include "tests/support/chaos_case.h"
#include "tests/support/coverage.h"

namespace dmpc::tests {

/// Stands for dataflow, as its svm::Strategy for each of the others.
struct Rays {};

inline std::string name_of(const svm::Strategy& strategy) { return strategy.name(); }
inline std::string name_of(Rays /*strategy*/) { return "dataflow"; }

/// What all strategies have alike.
inline void cover(Coverage& covered, const ChaosCase& one) {
  for (std::size_t i = 0; i < chaos_subjects().size(); ++i) {
    covered.count("picture of " + chaos_subjects()[i].name, i == one.subject_number());
  }
  const std::uint32_t nodes = one.node_count();
  covered.count("1 node", nodes == 1);
  covered.count("2 to 8 nodes", nodes > 1 && nodes <= 8);
  covered.count("13 to 64 nodes", nodes > 8);
  covered.count("in parts", one.is_in_parts());
}

template <class Options>
void cover_computer(Coverage& covered, const ChaosCase& one, const Options& options) {
  const bool is_modelled = options.computer.machine.has_value();
  covered.count("modelled machine", is_modelled);
  covered.count("threads", !is_modelled && one.rank_count() == 1);
  covered.count("several ranks", !is_modelled && one.rank_count() > 1);
  covered.count("a pool", options.computer.pool_threads && one.rank_count() == 1);
  covered.count("pools on several ranks", options.computer.pool_threads && one.rank_count() > 1);
}

inline void cover(Coverage& covered, const ChaosCase& one, const svm::RunOptions& options, const svm::Strategy& strategy) {
  cover_computer(covered, one, options);
  const svm::PageOptions& pages = options.pages;
  covered.count("one pixel in flight", pages.in_flight == 1);
  covered.count("work items are single pixels", pages.work_item_side == 1);
  covered.count("no work items", pages.work_item_side == 0);
  covered.count("nodes that only serve", pages.worker_count < options.computer.node_count);
  covered.count("the host gives work", pages.work_donor == svm::WorkDonor::host);
  covered.count("pixels shared out interleaved", pages.pixel_shares == svm::PixelShares::interleaved);
  if (!strategy.fetches_pages()) {
    return;
  }
  covered.count("a cache of one page", pages.cache_pages == 1);
  for (const svm::Replacement each :
       {svm::Replacement::lru, svm::Replacement::clock, svm::Replacement::fifo, svm::Replacement::random,
        svm::Replacement::two_queues, svm::Replacement::adaptive, svm::Replacement::small_and_main}) {
    covered.count("replacement " + std::string(svm::name_of(each)), pages.replacement == each);
  }
  for (const svm::PageHomes each : {svm::PageHomes::spread, svm::PageHomes::host, svm::PageHomes::tree}) {
    covered.count("homes " + std::string(svm::name_of(each)), pages.homes == each);
  }
  covered.count("pages resident everywhere", pages.resident_percent > 0);
}

inline void cover(Coverage& covered, const ChaosCase& one, const dataflow::RunOptions& options, Rays /*strategy*/) {
  cover_computer(covered, one, options);
  const dataflow::RayOptions& rays = options.rays;
  covered.count("one ray a packet", rays.ray_batch == 1);
  covered.count("no credits", rays.ray_credits == 0);
  covered.count("one credit", rays.ray_credits == 1);
  covered.count("shared places", rays.ray_slots.has_value());
  covered.count("no queue", rays.queue_packets == 0);
  covered.count("tested objects", rays.tested_objects > 0);
  covered.count("without backpressure", rays.without_backpressure);
  covered.count("mapped to a topology", rays.topology.has_value());
  using dataflow::Balance;
  const std::array<const char*, 4> names{"subsampled", "equal size", "scattered", "moving"};
  for (const Balance each : {Balance::subsampled, Balance::equal_size, Balance::scattered, Balance::moving}) {
    covered.count(std::string("regions ") + names.at(static_cast<std::size_t>(each)), rays.balance.balance == each);
  }
}

/// What the laws of conservation speak of: where none of it was, they held of nothing.
inline void cover(Coverage& covered, const svm::Report& report, const svm::Strategy& strategy) {
  const svm::WorkCounters work = report.work();
  covered.count("there was work taken from another node", work.items_taken > 0);
  covered.count("there was work that the host assigned", report.items_assigned > 0);
  if (strategy.fetches_pages()) {
    const svm::PageCounters pages = report.pages();
    covered.count("there was a page that another node served", pages.served > 0);
    covered.count("there was a page that the host served", report.host_pages_served > 0);
    covered.count("there was an eviction", pages.evictions > 0);
    covered.count("there was a second miss of a page under way", pages.misses > pages.faults);
  }
  if (&strategy == svm::forest_strategy()) {
    const svm::QuestionCounters questions = report.questions();
    covered.count("there was a ray that was asked about", questions.rays_asked > 0);
    covered.count("there was a record that was asked for", questions.records_asked > 0);
  }
}
inline void cover(Coverage& covered, const dataflow::Report& report, Rays /*strategy*/) {
  const dataflow::RayCounters rays = report.rays();
  covered.count("there was a ray that travelled", std::accumulate(rays.in.begin(), rays.in.end(), std::uint64_t{0}) > 0);
  covered.count("there was a ray that overflowed to the host", report.host_rays.rays_in > 0);
  covered.count("there was a hit sent back", rays.hits_sent_back > 0);
  covered.count("there was a test that was avoided", rays.tests_avoided > 0);
  covered.count("there was a unit that moved", report.movement().units_taken > 0);
  covered.count("there was a second round of the token", report.host_rays.token_rounds > 1);
}

}  // namespace dmpc::tests
