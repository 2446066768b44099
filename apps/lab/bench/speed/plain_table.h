// What part plain of `bench speed` comes to.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/edge/table/table.h"
#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// A row for each renderer: geometric means over the scenes of its time for a picture and for a ray, and how many times the plain
/// renderer's on 2 threads that is, with the outermost scenes. Comparisons of other parts and without a round are left out.
Table plain_table(std::span<const Comparison> comparisons, const std::string& title);

/// Sentences on the same scenes' rays, pictures and trees.
std::vector<std::string> plain_notes(std::span<const Comparison> comparisons);

}  // namespace dmpc::apps
