// The article's claim on trees of extents and subdivisions of space.
#include <algorithm>
#include <limits>
#include <string>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/claim_rows.h"

namespace dmpc::apps {
namespace {

/// A tree's figures over those of the same scene with a subdivision of space.
struct Ratios {
  double memory = 0, time = 0;
};

Ratios ratios_of(const PaperResult& in_space, const PaperResult& in_extents) {
  return {static_cast<double>(in_extents.database_bytes) / static_cast<double>(in_space.database_bytes),
          in_extents.seconds() / in_space.seconds()};
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = 0;

  void include(double ratio) {
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  std::string text() const { return fixed(least, 2) + " to " + fixed(most, 2); }
};

/// Judges the claim as a whole: it must hold in each scene, and a tie does not count.
const char* verdict_of(bool is_smaller, double least_time) {
  return !is_smaller || least_time < 1 - tie_share ? not_held : least_time > 1 + tie_share ? held : tie;
}

}  // namespace

void claim_extents(Claims& rows, const PaperResults& results, const RunsByScene& in_space, const RunsByScene& in_extents) {
  Range memory, time;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const auto &space = results[in_space[scene]], &extents = results[in_extents[scene]];
    if (!space || !extents || space->database_bytes == 0) {
      return;
    }
    const Ratios ratios = ratios_of(*space, *extents);
    memory.include(ratios.memory);
    time.include(ratios.time);
  }
  rows.add("A tree of extents needs less memory than a subdivision of space, but more time",
           verdict_of(memory.most < 1, time.least),
           "memory " + memory.text() + ", time " + time.text() + " of those in space, on one node",
           "our tree looks at eight boxes for the price of one record, and ipsc2-1994 has no prices for it");
}

}  // namespace dmpc::apps
