// A scene and its picture by the reference renderer: what every strategy's runs are held to.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>

#include "apps/lab/bench/stability/cells.h"
#include "core/database/database.h"
#include "core/picture/camera/background.h"
#include "core/picture/render.h"
#include "core/scene/scene.h"
#include "core/trace/operations.h"
#include "tests/support/film_of.h"

namespace dmpc::tests {

/// What no strategy, bound or schedule may change: the film, the rays of each kind, and what they hit. That each hit was claimed
/// once follows: there are as many hits and shadings as the reference renderer, alone, has.
struct Outcome {
  std::uint64_t film_hash = 0;
  std::array<std::uint64_t, core::ray_kind_count> rays{};
  std::uint64_t primary_hits = 0, secondary_hits = 0, shadow_blocked = 0, total_internal_reflections = 0, shadings = 0;

  bool operator==(const Outcome&) const = default;

  friend std::ostream& operator<<(std::ostream& out, const Outcome& outcome) {
    out << "film " << std::hex << outcome.film_hash << std::dec << ", rays";
    for (const std::uint64_t of_kind : outcome.rays) {
      out << ' ' << of_kind;
    }
    return out << ", hits " << outcome.primary_hits << ' ' << outcome.secondary_hits << ' ' << outcome.shadow_blocked
               << ", total internal reflections " << outcome.total_internal_reflections << ", shadings " << outcome.shadings;
  }
};

inline Outcome outcome_of(const core::Film& film, const core::Operations& operations) {
  return {film.hash(),
          operations.rays,
          operations.primary_hits,
          operations.secondary_hits,
          operations.shadow_blocked,
          operations.total_internal_reflections,
          operations.shadings};
}
/// What any strategy's report has.
template <class Report>
Outcome outcome_of(const Report& report) {
  return outcome_of(report.film, report.operations());
}

/// Immutable once made.
class Subject {
 public:
  /// In pixels, and samples of each.
  struct Size {
    int width = 1, height = 1, samples = 1;
    core::RefinementOptions refinement = {};
    double cutoff = 0;
    bool knows_background = false;  ///< all but the reference renderer may leave it out
    core::Transport transport = {};
    int depth_max = 5;
  };

  Subject(const core::Scene& scene, const Size& size, const core::BuildOptions& options = {})
      : database_(core::build_database(scene, options)),
        settings_{database_.header(),
                  core::Camera(scene.view, database_.header().frame, size.width, size.height, size.samples),
                  {.depth_max = size.depth_max,
                   .cutoff = size.cutoff,
                   .radiance_bound = 10,
                   .pixel_share = 1,
                   .first_samples = static_cast<std::uint32_t>(size.samples),
                   .transport = size.transport},
                  size.refinement} {
    core::Operations operations;
    const core::FineDetail detail = settings_.fine_detail(database_);
    outcome_ = outcome_of(film_of(database_, settings_, operations, &detail), operations);
    if (size.knows_background) {
      settings_.background = core::find_background(database_, settings_.camera);
    }
  }

  const core::Database& database() const { return database_; }
  const core::RenderSettings& settings() const { return settings_; }
  /// Settings of this picture with other work left out on the way.
  core::RenderSettings settings(const core::Skips& skips) const {
    core::RenderSettings settings = settings_;
    settings.skips = skips;
    return settings;
  }
  /// The reference renderer's.
  const Outcome& outcome() const { return outcome_; }

 private:
  core::Database database_;
  core::RenderSettings settings_;
  Outcome outcome_;
};

/// The subjects of one scene in coarse cells and in fine ones: two grids, two films.
inline std::array<Subject, 2> on_two_grids(const core::Scene& scene, const Subject::Size& size) {
  core::BuildOptions coarse = apps::several_macro_cells(scene), fine = coarse;
  fine.cells_per_primitive *= 3;
  return {Subject(scene, size, coarse), Subject(scene, size, fine)};
}

}  // namespace dmpc::tests
