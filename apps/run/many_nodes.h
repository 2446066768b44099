// Options for many nodes of strategy svm that share few processors, in whose caches their pages push each other out.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dmpc::apps {

/// What takes least processor time with 64 nodes on two processors: fewer faults, and more pixels that wait meanwhile.
inline constexpr const char* many_nodes_options = "--structure=extents --page-size=4KiB --in-flight=32";
inline constexpr std::size_t many_nodes_page_bytes = 4096;
inline constexpr std::uint32_t many_nodes_in_flight = 32;

/// From here on they gain.
inline constexpr std::uint32_t many_nodes_min = 32, many_nodes_a_processor = 8;

inline bool are_many(std::uint32_t nodes, std::uint32_t processors) {
  return nodes >= many_nodes_min && nodes >= many_nodes_a_processor * processors;
}

}  // namespace dmpc::apps
