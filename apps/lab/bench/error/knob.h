// What `bench error` turns: the knobs of a render that trade time for error.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace dmpc::apps {

/// The last two turn two knobs together. By paths there are samples, adaptive, and the three before those, which are paths'
/// alone.
enum class Knob : std::uint8_t {
  samples,
  adaptive,
  cutoff,
  depth,
  tessellation,
  arithmetic,
  quality,
  bounces,
  roulette,
  emitters,
  adaptive_and_cutoff,
  adaptive_and_depth
};

/// As the command line and the table call it; those of two knobs have spaces.
const char* name_of(Knob knob);

/// "samples,depth"; two knobs that are turned together, too, follow from both being there. Throws core::UsageError for anything
/// that is none, listing those that there are.
std::set<Knob> parse_knobs(const std::string& text);

/// All that the scene and its family allow, of pictures by paths or of others.
std::set<Knob> all_knobs(bool are_by_paths = false);
/// Throws core::UsageError, listing those that there are, for knobs that such pictures do not have.
void check_knobs(const std::set<Knob>& knobs, bool are_by_paths);

}  // namespace dmpc::apps
