// How long something will take, and how much memory: said before it begins.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace dmpc::apps {

/// What the real computer will take. It is a guess, good to a factor of two on a computer that does nothing else: so it is told
/// as a range, from half to twice as much.
struct Effort {
  double seconds = 0;     ///< by the wall clock
  std::size_t bytes = 0;  ///< of memory, at most; 0: little, or not known
  bool is_given = false;  ///< the memory is what nodes are given, of which they may touch but a part
};

/// "some seconds", "2 to 8 minutes and up to 1.5 GiB of memory", "2 to 8 minutes; nodes are given up to 4.1 GiB of memory, and
/// may touch less"; memory is left out below 256 MiB.
std::string text_of(const Effort& effort);

/// Whether one would rather know of it before a single render: half a minute or more.
bool is_long(const Effort& effort);

/// Writes "dmpc: WHAT: " and the effort as a line if stderr is a terminal and `quiet` is not set, and the effort is more than
/// some seconds.
void announce(const std::string& what, const Effort& effort, bool quiet, std::ostream& messages);

}  // namespace dmpc::apps
