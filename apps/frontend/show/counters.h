// Counters of programs on the computer, by name: from a row per counter follow --stats, its schema, tables of nodes, and names of
// figures in comparisons and sweeps.
//
// A new counter needs a field where it is counted and a row here, or, for renders, in apps/show/counters.h. Sums follow from the
// fields alone (core/base/counts.h), figures of comparisons and sweeps from --stats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "nodes/counters.h"
#include "svm/pages/node_program.h"

namespace dmpc::apps {

/// A counter's texts.
struct CounterText {
  const char* key = "";      ///< in --stats
  const char* help = "";     ///< its description in stats.schema.json, where the key is not enough
  const char* column = "";   ///< column of a table with a row per node; empty: not in such tables
  bool may_be_null = false;  ///< in --stats, for the reason in its help
};

/// A figure of a T: a counter, or a value derived from some.
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

/// A counter's row.
template <auto member, std::size_t index = 0>
constexpr auto counter(const CounterText& text) {
  using Place = CounterPlace<member, index>;
  return Counter<typename Place::Owner>{text, Place::value};
}

/// The rows of a T, in the order of files: an array, below or in apps/show/counters.h.
template <class T>
inline constexpr std::nullptr_t counters_of = nullptr;

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
        {"distinct", "pages of each pixel, summed; null unless counted (option count_pages)", "", true}),
};

/// A node's counters other than traffic.
template <>
inline constexpr auto counters_of<nodes::NodeCounters> = std::array{
    counter<&nodes::NodeCounters::refused>({"refused", "tried without credit", "refused"}),
    counter<&nodes::NodeCounters::quanta>({"quanta", "", "calls of work"}),
};
// clang-format on

}  // namespace dmpc::apps
