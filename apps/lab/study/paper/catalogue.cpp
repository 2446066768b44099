#include "apps/lab/study/paper/catalogue.h"

#include <algorithm>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/machine/voxel_prices.h"
#include "core/base/expect.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

/// Memory of the iPSC/2 in the article.
constexpr std::size_t node_memory_bytes = std::size_t{4} << 20U;

const nodes::Machine& preset(const char* name) {
  const MachineDescription* description = find_machine_preset(name);
  core::expect(description != nullptr, "the machine of the study has a preset");
  return description->machine;
}

/// One node has the whole scene, however large: the article prints no time of one whose memory does not hold it.
PaperRun run_of_article(const PaperRun& like, const char* scene, std::uint32_t node_count) {
  PaperRun run = like;
  run.scene = scene;
  run.node_count = node_count;
  if (node_count > 1) {
    run.shared_pages = shared_pages;
    run.node_memory_bytes = node_memory_bytes;
  }
  return run;
}

/// The grid's databases are smaller than the article's, so the same memory would hold more of them: caches have the article's
/// share of the database instead of its bytes.
PaperRun run_on_grid(const PaperRun& like, const PaperScene& scene, std::uint32_t node_count) {
  PaperRun run = like;
  run.scene = scene.scene;
  run.node_count = node_count;
  if (node_count > 1) {
    run.cache_share = scene.cache_share(node_count);
  }
  return run;
}

template <class RunOf>
void add_table_3(Catalogue& catalogue, TimedRuns& runs, const RunOf& run_of) {
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const std::size_t base = paper_scenes[scene].base();
    for (std::size_t column = base; column < paper_node_counts.size(); ++column) {
      runs.timed[scene][column] = catalogue.add(run_of(paper_scenes[scene], paper_node_counts[column]));
    }
    PaperRun alone = catalogue.runs[runs.timed[scene][base]];
    alone.pages.worker_count = 1;
    runs.one_worker[scene] = base == 0 ? runs.timed[scene][0] : catalogue.add(alone);
  }
}

void add_table_2(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    PaperRun run = run_of_article(like, paper_scenes[scene].scene, 1);
    run.pages.count_pages = true;
    catalogue.counted[scene] = catalogue.add(run);
    run.structure = core::Structure::extents;
    run.lacks_later_skips = true;
    run.pages.count_pages = false;
    catalogue.extents[scene] = catalogue.add(run);
  }
}

dataflow::RayOptions rays_of_1994() {
  dataflow::RayOptions rays;
  rays.balance.balance = dataflow::Balance::subsampled;
  rays.balance.bsp.order = dataflow::CutOrder::alternating;
  rays.without_backpressure = true;
  return rays;
}

dataflow::RayOptions rays_by(RayWay way) {
  dataflow::RayOptions rays = rays_of_1994();
  if (way == RayWay::longer_side) {
    rays.balance.bsp.order = dataflow::CutOrder::longer_axis;
  } else if (way == RayWay::equal_size) {
    rays.balance.balance = dataflow::Balance::equal_size;
  } else if (way == RayWay::long_queue) {
    rays.queue_packets = long_queue_packets;
  }
  return rays;
}

void add_rings(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto run_of = [&](std::uint32_t node_count) { return run_of_article(like, rings[scene], node_count); };
    const bool is_in_table_3 = rings[scene] == std::string(paper_scenes[rings_row].scene);
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      PaperRun run = run_of(paper_node_counts[column]);
      catalogue.rings_by_pages[scene][column] = is_in_table_3 && column >= paper_scenes[rings_row].base()
                                                    ? catalogue.article.timed[rings_row][column]
                                                    : catalogue.add(run);
      run.strategy = Strategy::dataflow;
      run.rays = rays_of_1994();
      catalogue.rings_by_rays[scene][column] = catalogue.add(run);
    }
    for (std::size_t way = 0; way < ray_way_names.size(); ++way) {
      PaperRun run = catalogue.runs[catalogue.rings_by_rays[scene].back()];
      run.rays = rays_by(static_cast<RayWay>(way));
      catalogue.by_ray_way[scene][way] = way == 0 ? catalogue.rings_by_rays[scene].back() : catalogue.add(run);
    }
  }
  for (std::size_t i = 0; i < loaded_node_counts.size(); ++i) {
    PaperRun run = catalogue.runs[catalogue.rings_by_rays[0][loaded_column + i]];
    run.rays = rays_by(RayWay::equal_size);
    catalogue.equal_sizes[i] =
        run.node_count == paper_node_counts.back() ? catalogue.by_way(0, RayWay::equal_size) : catalogue.add(run);
  }
}

/// Runs at half the resolution a side: small caches miss so often that a whole picture takes minutes.
void add_caches(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    PaperRun run = like;
    run.scene = cache_scenes[scene].row().scene;
    run.resolution = std::max(1U, like.resolution / 2);
    catalogue.cache_base[scene] = catalogue.add(run);
    run.node_count = cache_node_count;
    for (std::size_t size = 0; size < cache_size_count; ++size) {
      run.cache_pages = cache_scenes[scene].pages[size];
      catalogue.cached[scene][size] = catalogue.add(run);
    }
  }
}

/// Adds the runs for claims of the text: sizes of work items, a light inside the scene, copies of the database on every node, and
/// a faster machine.
void add_foils(Catalogue& catalogue) {
  const auto& of_rings = catalogue.article.timed[rings_row];
  for (std::size_t size = 0; size < item_sides.size(); ++size) {
    PaperRun run = catalogue.runs[of_rings.back()];
    run.pages.work_item_side = item_sides[size];
    catalogue.items[size] = size == article_item ? of_rings.back() : catalogue.add(run);
  }
  PaperRun assigned = catalogue.runs[of_rings.back()];
  assigned.pages.work_donor = svm::WorkDonor::host;
  assigned.pages.work_item_side = item_sides[article_item];
  catalogue.assigned_items = catalogue.add(assigned);
  assigned.pages.work_item_side = 1;
  catalogue.assigned_pixels = catalogue.add(assigned);
  PaperRun by_rays = catalogue.runs[catalogue.rings_by_rays[1].back()], by_pages = catalogue.runs[of_rings.back()];
  by_rays.has_inner_light = by_pages.has_inner_light = true;
  catalogue.lit_by_rays = catalogue.add(by_rays);
  catalogue.lit_by_pages = catalogue.add(by_pages);
  PaperRun copies = catalogue.runs[catalogue.article.timed[small_row].back()];
  copies.strategy = Strategy::replicated;
  copies.shared_pages.reset();
  catalogue.copies = catalogue.add(copies);
  PaperRun faster = catalogue.runs[of_rings[cache_column]];
  constexpr double times = 7;  // the article's figure for the processor
  faster.machine = preset("ipsc860");
  set_prices(faster.machine, {.walk = fitted_voxel_prices.walk / times,
                              .rays = fitted_voxel_prices.rays / times,
                              .cached_lookup = fitted_voxel_prices.cached_lookup / times});
  catalogue.faster_machine = catalogue.add(faster);
}

void add_grid(Catalogue& catalogue) {
  const PaperRun like{.machine = preset("ipsc2"), .resolution = catalogue.resolution};
  add_table_3(catalogue, catalogue.grid,
              [&](const PaperScene& scene, std::uint32_t node_count) { return run_on_grid(like, scene, node_count); });
  const PaperPlace last = calibrated_places.back();
  PaperRun dearer = catalogue.runs[catalogue.grid.timed[last.scene][last.column]];
  dearer.machine.cost_ps[static_cast<std::size_t>(core::Charge::cached_lookup)] *= 2;
  catalogue.dearer_cache = catalogue.add(dearer);
}

}  // namespace

Catalogue catalogue_of(std::uint32_t resolution) {
  Catalogue catalogue;
  catalogue.resolution = resolution;
  const PaperRun like{.machine = preset("ipsc2-1994"), .structure = core::Structure::voxels, .resolution = resolution};
  add_table_3(catalogue, catalogue.article,
              [&](const PaperScene& scene, std::uint32_t node_count) { return run_of_article(like, scene.scene, node_count); });
  add_table_2(catalogue, like);
  add_rings(catalogue, like);
  add_caches(catalogue, like);
  add_foils(catalogue);
  add_grid(catalogue);
  catalogue.run_count_without_variations = catalogue.runs.size();
  return catalogue;
}

}  // namespace dmpc::apps
