// The printed figures of the 1994 article: D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and Control for Ray Tracing in
// Parallel", IEEE CG&A 14(4), Tables 2 and 3.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace dmpc::apps {

/// According to the text, about this many KB of the 4 MB of a node's memory are shared memory: its own pages and its cache.
inline constexpr double shared_kilobytes = 3.2 * 1024;

/// Pixels a side of its pictures.
inline constexpr std::uint32_t paper_resolution = 512;

inline constexpr std::array<std::uint32_t, 7> paper_node_counts = {1, 2, 4, 8, 16, 32, 64};

struct PaperPlace {
  std::size_t scene = 0, column = 0;  ///< indices in paper_scenes and paper_node_counts

  bool operator==(const PaperPlace&) const = default;
};

/// A scene of the article, and our corresponding scene.
struct PaperScene {
  const char* title;
  const char* scene;  ///< a built-in scene's name
  const char* remark;
  std::uint64_t polygons, rays, database_kilobytes;  ///< Table 2
  double pages_a_pixel;                              ///< Table 2
  std::array<std::uint32_t, 7> seconds;              ///< Table 3, by paper_node_counts; 0: not printed

  /// Returns the first column with a time, the base of its efficiencies.
  std::size_t base() const {
    std::size_t column = 0;
    while (seconds[column] == 0) {
      ++column;
    }
    return column;
  }
  /// Returns the size of the cache of one of `node_count` nodes as a share of the database: the rest of the shared memory, of
  /// `shared` KB, beside the node's own pages, at most all others.
  constexpr double cache_share(std::uint32_t node_count, double shared = shared_kilobytes) const {
    const double own = 1.0 / node_count;
    return std::clamp(shared / static_cast<double>(database_kilobytes) - own, 0.0, 1 - own);
  }
};

inline constexpr std::array<PaperScene, 5> paper_scenes = {
    {{"Teapot",
      "teapot-8",
      "another teapot: theirs is not published",
      3'754,
      1'397'473,
      793,
      58.19,
      {11'522, 5'997, 3'092, 1'565, 786, 395, 200}},
     {"Mountain", "mount-6-t6", "7 % fewer rays", 9'920, 1'722'415, 2'031, 61.94, {17'103, 9'038, 4'626, 2'350, 1'185, 600, 307}},
     {"Rings4", "rings-4-t1", "0.4 % more rays", 18'002, 1'872'991, 4'632, 125.91, {0, 17'926, 9'204, 4'655, 2'336, 1'181, 604}},
     {"Tetra9", "tetra-9", "the same", 262'144, 303'239, 36'189, 17.45, {0, 0, 0, 0, 295, 146, 78}},
     {"Tetra10", "tetra-10", "the same", 1'048'576, 300'962, 138'851, 33.00, {0, 0, 0, 0, 0, 0, 226}}}};

}  // namespace dmpc::apps
