// What `bench error` turns: the knobs of a render that trade time for error.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace dmpc::apps {

/// The last two turn two knobs together.
enum class Knob : std::uint8_t {
  samples,
  adaptive,
  cutoff,
  depth,
  tessellation,
  arithmetic,
  quality,
  adaptive_and_cutoff,
  adaptive_and_depth
};

/// As the command line and the table call it; those of two knobs have spaces.
const char* name_of(Knob knob);

/// "samples,depth"; two knobs that are turned together, too, follow from both being there. Throws core::UsageError for anything
/// that is none, listing those that there are.
std::set<Knob> parse_knobs(const std::string& text);

/// All that the scene and its family allow.
std::set<Knob> all_knobs();

}  // namespace dmpc::apps
