#include "svm/run.h"

#include <utility>

#include "core/base/refusal.h"
#include "core/picture/heat_kind.h"
#include "svm/frames.h"

namespace dmpc::svm {
namespace {

/// A heat map of pages needs their counts.
PageOptions pages_of(const RunOptions& options) {
  const nodes::HeatMap* const heat = options.watching.heat;
  PageOptions pages = options.pages;
  pages.count_pages = pages.count_pages || (heat != nullptr && heat->has(core::HeatKind::pages));
  return pages;
}

/// Counts for single pixels, and references in the order of single rays, need single rays.
bool may_walk_in_bundles(const RunOptions& options) {
  return !options.tracer_is_own && !options.watching.is_metered() && !pages_of(options).count_pages &&
         !options.pages.record_references && options.pages.reference_logs == nullptr;
}

/// The nodes of a modelled machine compute as those of the article did, unless the options say otherwise.
bool walks_in_bundles(const RunOptions& options) {
  return may_walk_in_bundles(options) && (!options.computer.machine || options.pages.bundles_on_machines);
}

/// A request for bundles is granted or raises an error, at the latest in check_bundles_of().
void check_bundles(const core::RenderSettings& settings, const RunOptions& options) {
  constexpr core::Field bundles = core::field_of<&PageOptions::bundles_on_machines>();
  core::check_use(options.computer.machine.has_value(), bundles,
                  " is for a modelled machine: on threads rays are traced in bundles without it");
  core::check_use(settings.skips.bundles && may_walk_in_bundles(options), bundles,
                  " does not go with the skip bundles switched off, nor with what observes single pixels (heat maps, traces, "
                  "reports, references, served pages, counted pages): rays are then traced one by one");
  core::check_use(options.pages.in_flight.value_or(bundle_pixels) >= bundle_pixels, core::field_of<&PageOptions::in_flight>(),
                  "=", options.pages.in_flight.value_or(bundle_pixels), " does not go with ", bundles,
                  ": a bundle has the rays of ", bundle_pixels, " pixels");
}

void check_bundles_of(const Plan& plan) {
  core::check_use(plan.pixels_a_task > 1, core::field_of<&PageOptions::bundles_on_machines>(), " takes ", bundle_pixels,
                  " pixels together, and a node works on ", plan.in_flight,
                  " at once: give more memory, larger work items, a larger picture or fewer nodes");
}

PlanRequest request_of(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
                       const RunOptions& options) {
  if (options.pages.bundles_on_machines) {
    check_bundles(settings, options);
  }
  return {.strategy = &strategy,
          .page_count = static_cast<std::uint32_t>(database.page_count()),
          .forest_page_count = static_cast<std::uint32_t>(database.forest_page_count()),
          .open_page_count = static_cast<std::uint32_t>(database.open_page_count()),
          .page_size_bytes = database.page_size(),
          .computer = options.computer,
          .pages = pages_of(options),
          .waiting_hits_max = core::waiting_hits_max(settings.shade, settings.skips),
          .width = static_cast<std::uint32_t>(settings.camera.width()),
          .height = static_cast<std::uint32_t>(settings.camera.height()),
          .first_samples = settings.first_samples().count,
          .refinement = settings.refinement,
          .film_scale = settings.shade.film_scale,
          .start = options.continuation.start,
          .bundles =
              settings.skips.bundles && strategy.takes_bundles(settings.header.has_instances != 0) && walks_in_bundles(options),
          .has_instances = settings.header.has_instances != 0};
}

}  // namespace

Plan plan_of(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
             const RunOptions& options) {
  Plan plan = make_plan(request_of(strategy, database, settings, options));
  if (options.pages.bundles_on_machines) {
    check_bundles_of(plan);
  }
  return plan;
}

Report run_programs(const Plan& plan, const MakeProgram& make_program, const RunOptions& options, std::stop_token stop) {
  return PictureComputer(plan, make_program, options).render(std::move(stop));
}

Report run_by(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
              const RunOptions& options, std::stop_token stop) {
  constexpr bool are_several = false;
  return Frames(strategy, database, settings, options, stop, are_several).render(settings, stop);
}

Report run_svm(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
               std::stop_token stop) {
  return run_by(*svm_strategy(), database, settings, options, std::move(stop));
}

Report run_replicated(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                      std::stop_token stop) {
  return run_by(*replicated_strategy(), database, settings, options, std::move(stop));
}

}  // namespace dmpc::svm
