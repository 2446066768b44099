// What a run counts, by name: a row for each counter, from which --stats, its schema, closing lines and tables of nodes follow.
//
// A new counter is a field where it is counted and a row here. Sums follow from the fields alone (core/base/counts.h), figures of
// comparisons and sweeps from what --stats writes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/trace/operations.h"
#include "dataflow/movement.h"
#include "nodes/counters.h"
#include "svm/node_program.h"

namespace dmpc::apps {

/// What there is to say of a counter.
struct CounterText {
  const char* key = "";     ///< in --stats
  const char* help = "";    ///< what stats.schema.json says of it, where the key does not say it all
  const char* column = "";  ///< of a table with a row for each node; empty: there it is not
};

/// A figure of a T: a counter, or what follows from some.
template <class T>
struct Counter : CounterText {
  std::uint64_t (*value)(const T& counters);
};

/// A member of a T or, if that is an array, an element of it.
template <auto member, std::size_t index>
struct CounterPlace;
template <class T, class Member, Member T::*member, std::size_t index>
struct CounterPlace<member, index> {
  using Owner = T;
  static std::uint64_t value(const T& counters) {
    if constexpr (std::is_integral_v<Member>) {
      return counters.*member;
    } else {
      return (counters.*member)[index];
    }
  }
};

/// Its row.
template <auto member, std::size_t index = 0>
constexpr auto counter(const CounterText& text) {
  using Place = CounterPlace<member, index>;
  return Counter<typename Place::Owner>{text, Place::value};
}

/// The rows of a T, in the order of files.
template <class T>
inline constexpr std::array<Counter<T>, 0> counters_of{};

// clang-format off
template <>
inline constexpr auto counters_of<svm::PageCounters> = std::array{
    counter<&svm::PageCounters::references>({"references", "look-ups", "look-ups"}),
    Counter<svm::PageCounters>{{"hits"}, [](const svm::PageCounters& all) { return all.home_hits + all.cache_hits; }},
    counter<&svm::PageCounters::home_hits>({"home_hits", "", "at home"}),
    counter<&svm::PageCounters::cache_hits>({"cache_hits", "", "cache hits"}),
    counter<&svm::PageCounters::misses>({"misses", "", "misses"}),
    counter<&svm::PageCounters::faults>({"faults", "misses that began a request", "faults"}),
    counter<&svm::PageCounters::evictions>({"evictions", "", "evictions"}),
    counter<&svm::PageCounters::served>({"served", "to other nodes", "pages served"}),
    counter<&svm::PageCounters::distinct_pages>(
        {"distinct", "pages of each pixel, summed; null unless counted (option count_pages)"}),
};

template <>
inline constexpr auto counters_of<svm::WorkCounters> = std::array{
    counter<&svm::WorkCounters::pixels_rendered>({"pixels", "over all passes", "pixels"}),
    counter<&svm::WorkCounters::items_asked>({"items_asked"}),
    counter<&svm::WorkCounters::items_taken>({"items_taken"}),
    counter<&svm::WorkCounters::items_given>({"items_given"}),
};

template <>
inline constexpr auto counters_of<svm::QuestionCounters> = std::array{
    counter<&svm::QuestionCounters::rays_asked>({"rays_asked", "what does a ray meet below a child", "rays asked about"}),
    counter<&svm::QuestionCounters::records_asked>(
        {"records_asked", "what is in a record, for shading", "records asked for"}),
    counter<&svm::QuestionCounters::rays_answered>({"rays_answered", "", "rays answered"}),
    counter<&svm::QuestionCounters::records_answered>({"records_answered", "", "records answered"}),
    counter<&svm::QuestionCounters::answers>({"answers", "packets received", "answers"}),
};

template <>
inline constexpr auto counters_of<dataflow::MovementCounters> = std::array{
    counter<&dataflow::MovementCounters::units>({"units", "answered for in the end"}),
    counter<&dataflow::MovementCounters::units_given>({"units_given"}),
    counter<&dataflow::MovementCounters::units_taken>({"units_taken"}),
    counter<&dataflow::MovementCounters::asks>({"asks", "for a unit"}),
    counter<&dataflow::MovementCounters::refusals>({"refusals", "in answer to them"}),
    counter<&dataflow::MovementCounters::pages_sent>({"pages_sent", "with units"}),
    counter<&dataflow::MovementCounters::pages_installed>(
        {"pages_installed", "of those that came, as they had not been there"}),
    counter<&dataflow::MovementCounters::records_walked>(
        {"records_walked", "to find the pages of units that were asked for"}),
    counter<&dataflow::MovementCounters::primaries_given>({"primary_rays_given", "with units, before they started"}),
    counter<&dataflow::MovementCounters::primaries_taken>({"primary_rays_taken"}),
    counter<&dataflow::MovementCounters::rays_sent_on>(
        {"rays_sent_on", "that came for a unit which was another's by then"}),
};

/// What of a node's counters is no traffic.
template <>
inline constexpr auto counters_of<nodes::NodeCounters> = std::array{
    counter<&nodes::NodeCounters::refused>({"refused", "tried without credit", "refused"}),
    counter<&nodes::NodeCounters::quanta>({"quanta", "", "calls of work"}),
};

/// What rays met.
inline constexpr std::array hit_counters = {
    counter<&core::Operations::primary_hits>({"primary"}),
    counter<&core::Operations::secondary_hits>({"secondary", "of reflected and refracted rays"}),
    counter<&core::Operations::shadow_blocked>({"shadow_blocked", "shadow rays that met something"}),
    counter<&core::Operations::total_internal_reflections>({"total_internal_reflections"}),
};

template <>
inline constexpr auto counters_of<core::Operations> = std::array{
    counter<&core::Operations::cell_steps>({"cell_steps"}),
    counter<&core::Operations::brick_reads>({"brick_reads"}),
    counter<&core::Operations::primitive_tests, 0>({"triangle_tests"}),
    counter<&core::Operations::primitive_tests, 1>({"sphere_tests"}),
    counter<&core::Operations::primitive_tests, 2>({"cone_tests"}),
    counter<&core::Operations::shadings>({"shadings", "", "shadings"}),
    counter<&core::Operations::normal_reads>({"normal_reads", "vertex normals of smooth triangles"}),
    counter<&core::Operations::texture_lookups>({"texture_lookups", "hits on textured triangles"}),
    counter<&core::Operations::tile_reads>({"tile_reads", "of their textures' tiles"}),
    counter<&core::Operations::bundles>({"bundles", "of rays that walked together"}),
    counter<&core::Operations::rays_in_bundles>({"rays_in_bundles"}),
    counter<&core::Operations::deposits_saturated>(
        {"deposits_saturated", "null where earlier samples came from a checkpoint"}),
};
// clang-format on

}  // namespace dmpc::apps
