#include "apps/frontend/machine/machines.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t article_memory_bytes = std::size_t{4} << 20U;

/// One node has the whole scene, however large: the article prints no time of one whose memory does not hold it.
PaperRun timed_voxel_run(const PaperRun& like, std::size_t scene, std::size_t column) {
  PaperRun run = like;
  run.scene = paper_scenes[scene].scene;
  run.node_count = paper_node_counts[column];
  if (run.node_count > 1) {
    run.shared_pages = shared_pages;
    run.node_memory_bytes = article_memory_bytes;
  }
  return run;
}

/// One node has all pages at home, whatever its cache.
void add_voxel_caches(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t i = 0; i < voxel_caches_tried.size(); ++i) {
    PaperRun run = like;
    run.scene = paper_scenes[voxel_caches_tried[i].scene].scene;
    run.node_count = cache_node_count;
    for (std::size_t size = 0; size < voxel_caches_tried[i].pages.size(); ++size) {
      run.cache_pages = voxel_caches_tried[i].pages[size];
      catalogue.voxels.cached[i][size] = catalogue.add(run);
    }
  }
}

/// Rays travel as in the article: without backpressure, with cuts in alternating directions.
void add_voxel_loads(Catalogue& catalogue, const PaperRun& like) {
  PaperRun run = like;
  run.scene = rings[0];
  run.strategy = Strategy::dataflow;
  run.rays.without_backpressure = true;
  run.rays.balance.bsp.order = dataflow::CutOrder::alternating;
  catalogue.voxels.one_region = catalogue.add(run);
  for (std::size_t i = 0; i < loaded_node_counts.size(); ++i) {
    run.node_count = loaded_node_counts[i];
    run.rays.balance.balance = dataflow::Balance::subsampled;
    catalogue.voxels.subsampled[i] = catalogue.add(run);
    run.rays.balance.balance = dataflow::Balance::equal_size;
    catalogue.voxels.equal_size[i] = catalogue.add(run);
  }
}

}  // namespace

void add_voxel_runs(Catalogue& catalogue) {
  const PaperRun like{.machine = find_machine_preset("ipsc2-1994")->machine,
                      .structure = core::Structure::voxels,
                      .resolution = catalogue.resolution};
  VoxelRuns& voxels = catalogue.voxels;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const std::size_t base = paper_scenes[scene].base();
    for (std::size_t column = base; column < paper_node_counts.size(); ++column) {
      voxels.timed[scene][column] = catalogue.add(timed_voxel_run(like, scene, column));
    }
    PaperRun alone = catalogue.runs[voxels.timed[scene][base]];
    alone.pages.worker_count = 1;
    voxels.one_worker[scene] = base == 0 ? voxels.timed[scene][0] : catalogue.add(alone);
    PaperRun counted = timed_voxel_run(like, scene, 0);
    counted.pages.count_pages = true;
    voxels.counted[scene] = catalogue.add(counted);
    counted.structure = core::Structure::extents;
    counted.lacks_later_skips = true;
    counted.pages.count_pages = false;
    voxels.extents[scene] = catalogue.add(counted);
  }
  add_voxel_caches(catalogue, like);
  add_voxel_loads(catalogue, like);
}

}  // namespace dmpc::apps
