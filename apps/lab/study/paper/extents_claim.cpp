// What the article says of trees of extents beside subdivisions of space.
#include <algorithm>
#include <string>

#include "apps/edge/line/number_text.h"
#include "apps/lab/study/paper/claim_rows.h"

namespace dmpc::apps {
namespace {

/// A tree's figures over those of the same scene in space.
struct Ratios {
  double memory = 0, time = 0;
};

Ratios ratios_of(const PaperResult& in_space, const PaperResult& in_extents) {
  return {static_cast<double>(in_extents.database_bytes) / static_cast<double>(in_space.database_bytes),
          in_extents.seconds() / in_space.seconds()};
}

/// As a whole: what it says must be so in each scene, and a tie is none that it says.
const char* verdict_of(bool is_smaller, double least_time) {
  return !is_smaller || least_time < 1 - tie_share ? not_held : least_time > 1 + tie_share ? held : tie;
}

}  // namespace

void claim_extents(Claims& rows, const PaperResults& results, const RunsByScene& in_space, const RunsByScene& in_extents,
                   const std::string& remark) {
  bool is_smaller = true;
  double least_time = 0;
  std::string found;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const auto &space = results[in_space[scene]], &extents = results[in_extents[scene]];
    if (!space || !extents || space->database_bytes == 0) {
      return;
    }
    const Ratios ratios = ratios_of(*space, *extents);
    is_smaller = is_smaller && ratios.memory < 1;
    least_time = scene == 0 ? ratios.time : std::min(least_time, ratios.time);
    found += (scene == 0 ? "" : ", ") + std::string(paper_scenes[scene].title) + " " + fixed(ratios.memory, 2) + " and " +
             fixed(ratios.time, 2);
  }
  rows.add("A tree of extents needs less memory than a subdivision of space, but more time", verdict_of(is_smaller, least_time),
           "memory and time of a tree over those in space, on one node: " + found + remark);
}

}  // namespace dmpc::apps
