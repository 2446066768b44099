#include "apps/lab/study/paper/catalogue.h"

#include <algorithm>

#include "apps/frontend/machine/machines.h"
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

/// Our databases are smaller than the article's (Table 2), so the same memory would hold more of them: caches have the article's
/// share of the database instead of its bytes.
PaperRun run_of_table_3(const PaperRun& like, std::size_t scene, std::size_t column) {
  PaperRun run = like;
  run.scene = paper_scenes[scene].scene;
  run.node_count = paper_node_counts[column];
  if (run.node_count > 1) {
    run.cache_share = paper_scenes[scene].cache_share(run.node_count);
  }
  return run;
}

void add_tables(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      catalogue.timed[scene][column] = catalogue.add(run_of_table_3(like, scene, column));
    }
    const std::size_t base = paper_scenes[scene].base();
    PaperRun alone = catalogue.runs[catalogue.timed[scene][base]];
    alone.pages.worker_count = 1;
    catalogue.one_worker[scene] = base == 0 ? catalogue.timed[scene][0] : catalogue.add(alone);
    PaperRun run = like;
    run.scene = paper_scenes[scene].scene;
    run.structure = core::Structure::extents;
    catalogue.extents[scene] = catalogue.add(run);
    run.structure = core::Structure::grid;
    run.pages.count_pages = true;
    catalogue.counted[scene] = catalogue.add(run);
  }
}

void add_rings(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    PaperRun run = like;
    run.scene = rings[scene];
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      run.node_count = paper_node_counts[column];
      run.node_memory_bytes = run.node_count > 1 ? std::optional(node_memory_bytes) : std::nullopt;
      run.strategy = Strategy::dataflow;
      catalogue.rings_by_rays[scene][column] = catalogue.add(run);
      run.strategy = Strategy::svm;
      const bool is_in_table_3 = run.scene == paper_scenes[rings_row].scene && column >= paper_scenes[rings_row].base();
      catalogue.rings_by_pages[scene][column] = is_in_table_3 ? catalogue.timed[rings_row][column] : catalogue.add(run);
    }
  }
}

/// Adds runs with records without an order in space, and with other memories than those of the article's text.
void add_memories(Catalogue& catalogue) {
  for (std::size_t row = 0; row < missing_rows.size(); ++row) {
    const std::size_t scene = missing_rows[row];
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      PaperRun run = catalogue.runs[catalogue.timed[scene][column]];
      run.record_order = core::RecordOrder::scattered;
      catalogue.scattered[row][column] = catalogue.add(run);
      run.record_order = core::RecordOrder::spatial;
      if (run.node_count > 1) {
        run.cache_share = paper_scenes[scene].cache_share(run.node_count, cache_scenes[row].shared_kilobytes());
      }
      catalogue.figures_memory[row][column] = catalogue.add(run);
      run.cache_share.reset();
      run.node_memory_bytes = node_memory_bytes;
      catalogue.whole_memory[row][column] = catalogue.add(run);
    }
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
      run.cache_share = cache_scenes[scene].share(size);
      catalogue.cached[scene][size] = catalogue.add(run);
    }
  }
}

/// Returns the options of one variant of travelling rays.
dataflow::RayOptions rays_by(RayWay way) {
  dataflow::RayOptions rays;
  switch (way) {
    case RayWay::standard:
      break;
    case RayWay::alternating:
      rays.balance.bsp.order = dataflow::CutOrder::alternating;
      break;
    case RayWay::equal_size:
      rays.balance.balance = dataflow::Balance::equal_size;
      break;
    case RayWay::unchecked:
      rays.without_backpressure = true;
      break;
    case RayWay::unchecked_long:
      rays.without_backpressure = true;
      rays.queue_packets = long_queue_packets;
      break;
  }
  return rays;
}

void add_ray_ways(Catalogue& catalogue) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const std::size_t standard = catalogue.rings_by_rays[scene].back();
    for (std::size_t way = 0; way < ray_way_names.size(); ++way) {
      PaperRun run = catalogue.runs[standard];
      run.rays = rays_by(static_cast<RayWay>(way));
      catalogue.rings_by_way[scene][way] = way == 0 ? standard : catalogue.add(run);
    }
  }
}

/// Returns a machine whose hardware finds cached pages as fast as those at home, and puts them into frames.
nodes::Machine with_shared_memory(nodes::Machine machine) {
  const auto price = [&](core::Charge charge) -> auto& { return machine.cost_ps[static_cast<std::size_t>(charge)]; };
  price(core::Charge::cached_lookup) = price(core::Charge::home_lookup);
  price(core::Charge::page_install) = 0;
  return machine;
}

void add_page_sizes(Catalogue& catalogue) {
  const std::size_t timed = catalogue.timed[rings_row].back();
  for (std::size_t size = 0; size < page_sizes_bytes.size(); ++size) {
    PaperRun run = catalogue.runs[timed];
    run.page_size_bytes = page_sizes_bytes[size];
    catalogue.paged[size] = size == article_page ? timed : catalogue.add(run);
    run.machine = with_shared_memory(run.machine);
    catalogue.paged_by_hardware[size] = catalogue.add(run);
  }
}

/// Adds the runs for claims of the text: sizes of work items, a light inside the scene, and copies of the database on every node.
void add_foils(Catalogue& catalogue) {
  const std::size_t last = paper_node_counts.size() - 1;
  for (std::size_t size = 0; size < item_sides.size(); ++size) {
    const std::size_t timed = catalogue.timed[rings_row][last];
    PaperRun run = catalogue.runs[timed];
    run.pages.work_item_side = item_sides[size];
    catalogue.items[size] = size == article_item ? timed : catalogue.add(run);
    if (item_sides[size] > 0) {
      run.pages.work_donor = svm::WorkDonor::host;
      catalogue.items_assigned[size] = catalogue.add(run);
    }
  }
  PaperRun by_rays = catalogue.runs[catalogue.rings_by_rays[1][last]],
           by_pages = catalogue.runs[catalogue.timed[rings_row][last]];
  by_rays.has_inner_light = by_pages.has_inner_light = true;
  catalogue.lit_by_rays = catalogue.add(by_rays);
  catalogue.lit_by_pages = catalogue.add(by_pages);
  PaperRun copies = catalogue.runs[catalogue.timed[small_row][last]];
  copies.strategy = Strategy::replicated;
  copies.cache_share.reset();
  catalogue.copies = catalogue.add(copies);
}

}  // namespace

Catalogue catalogue_of(std::uint32_t resolution) {
  Catalogue catalogue;
  catalogue.resolution = resolution;
  const PaperRun like{.machine = preset("ipsc2"), .resolution = resolution};
  add_tables(catalogue, like);
  add_rings(catalogue, like);
  add_memories(catalogue);
  add_caches(catalogue, like);
  add_ray_ways(catalogue);
  add_foils(catalogue);
  add_page_sizes(catalogue);
  PaperRun faster = catalogue.runs[catalogue.timed[rings_row][faster_column]];
  faster.machine = preset("ipsc860");
  catalogue.faster_machine = catalogue.add(faster);
  PaperRun dearer = catalogue.runs[catalogue.timed[calibration_row][1]];
  dearer.machine.cost_ps[static_cast<std::size_t>(core::Charge::cached_lookup)] *= 2;
  catalogue.dearer_cache = catalogue.add(dearer);
  add_voxel_runs(catalogue);
  catalogue.run_count_without_variations = catalogue.runs.size();
  return catalogue;
}

}  // namespace dmpc::apps
