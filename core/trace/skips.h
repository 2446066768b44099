// Work that is left out where a scene does not need it: switches, and how much was left out.
#pragma once

#include <array>
#include <cstdint>

namespace dmpc::core {

/// What is left out unless it is switched off. Every switch is exact: it changes no bit of the film. See `all_skips`.
struct Skips {
  bool any_hit = true;
  bool unlit = true;
  bool zero_terms = true;
  bool empty_regions = true;
  bool background = true;
  bool bundles = true;
  bool idle_nodes = true;

  bool operator==(const Skips&) const = default;
};

/// What was left out, in the units of `all_skips`; 0 where a skip is off.
struct SkippedWork {
  std::uint64_t any_hit = 0;
  std::uint64_t unlit = 0;
  std::uint64_t zero_terms = 0;
  std::uint64_t empty_regions = 0;
  std::uint64_t background = 0;
  std::uint64_t bundles = 0;
  std::uint64_t idle_nodes = 0;
};

struct Skip {
  const char* name;  ///< option's value
  const char* what;  ///< what is left out, in a few words
  const char* unit;  ///< unit of the work left out
  bool Skips::*is_on;
  std::uint64_t SkippedWork::*avoided;
};

/// Every skip, in the order of reports.
inline constexpr std::array all_skips{
    // A ray by itself counts the children whose boxes it enters before that hit, a ray of a bundle all children that wait.
    Skip{"any-hit", "a shadow ray ends at the first hit it finds, not at the nearest", "children of BVH nodes that still waited",
         &Skips::any_hit, &SkippedWork::any_hit},
    Skip{"unlit", "no shadow ray to a light behind the surface (the paper's convention traces it)", "shadow rays", &Skips::unlit,
         &SkippedWork::unlit},
    // Does not count what those rays would have spawned.
    Skip{"zero-terms",
         "no ray whose contribution would be zero: reflected by a surface that does not mirror, transmitted by an opaque "
         "surface, to a light that is black or contributes nothing (the paper's convention traces the last), with paths where "
         "there is no light",
         "rays", &Skips::zero_terms, &SkippedWork::zero_terms},
    // Those behind the last thing that a ray may meet are not counted.
    Skip{"empty-regions", "rays do not visit the owners of regions in which they hit nothing (dataflow)", "regions passed by",
         &Skips::empty_regions, &SkippedWork::empty_regions},
    Skip{"background", "no primary ray is traced in parts of the picture that are found empty before the render", "primary rays",
         &Skips::background, &SkippedWork::background},
    // References and these are what the rays would look up one by one.
    Skip{"bundles", "rays of neighbouring pixels are traced together, and look up once what all of them read", "look-ups",
         &Skips::bundles, &SkippedWork::bundles},
    Skip{"idle-nodes",
         "a node that requests pixels does not ask nodes that are known to have none left (svm, replicated, forest)",
         "nodes passed over", &Skips::idle_nodes, &SkippedWork::idle_nodes},
};

/// All on except this one.
constexpr Skips without(const Skip& skip) {
  Skips skips;
  skips.*skip.is_on = false;
  return skips;
}

/// All off.
constexpr Skips no_skips() {
  Skips skips;
  for (const Skip& skip : all_skips) {
    skips.*skip.is_on = false;
  }
  return skips;
}

}  // namespace dmpc::core
