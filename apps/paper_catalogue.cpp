#include "apps/paper_catalogue.h"

#include <algorithm>
#include <utility>

#include "apps/machines.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

/// The iPSC/2's, in the article.
constexpr std::size_t node_memory_bytes = std::size_t{4} << 20U;
/// Cache sizes in pages for Rings4, where the network saturates at 204, and for Tetra9.
constexpr std::array<std::uint32_t, cache_size_count> rings_caches = {16, 51, 102, 204, 408, 811, 1621, 2900};
constexpr std::array<std::uint32_t, cache_size_count> tetra_caches = {4, 16, 51, 204, 408, 724, 1448, 2895};

const nodes::Machine& preset(const char* name) {
  const MachineDescription* description = find_machine_preset(name);
  core::expect(description != nullptr, "the machine of the study has a preset");
  return description->machine;
}

void add_tables(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    PaperRun run = like;
    run.scene = paper_scenes[scene].scene;
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      run.node_count = paper_node_counts[column];
      catalogue.timed[scene][column] = catalogue.add(run);
    }
    run.node_count = 1;
    run.node_memory_bytes.reset();
    run.count_pages = true;
    catalogue.counted[scene] = catalogue.add(run);
  }
}

void add_rings(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    PaperRun run = like;
    run.scene = rings[scene];
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      run.node_count = paper_node_counts[column];
      run.rays_travel = true;
      catalogue.rings_by_rays[scene][column] = catalogue.add(run);
      run.rays_travel = false;
      catalogue.rings_by_pages[scene][column] = catalogue.add(run);
    }
  }
}

/// At half the resolution a side: small caches miss so often that a picture of 512x512 takes minutes.
void add_caches(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    PaperRun run = like;
    run.scene = cache_scenes[scene];
    run.resolution = std::max(1U, like.resolution / 2);
    run.node_memory_bytes.reset();
    catalogue.cache_base[scene] = catalogue.add(run);
    run.node_count = cache_node_count;
    for (std::size_t size = 0; size < rings_caches.size(); ++size) {
      run.cache_pages = scene == 0 ? rings_caches[size] : tetra_caches[size];
      catalogue.cached[scene][size] = catalogue.add(run);
    }
  }
}

}  // namespace

Catalogue catalogue_of(std::uint32_t resolution) {
  Catalogue catalogue;
  const PaperRun like{.machine = preset("ipsc2"), .node_memory_bytes = node_memory_bytes, .resolution = resolution};
  add_tables(catalogue, like);
  add_rings(catalogue, like);
  add_caches(catalogue, like);
  PaperRun faster = like;
  faster.scene = "rings-4-t1";
  faster.node_count = 32;
  faster.machine = preset("ipsc860");
  catalogue.faster_machine = catalogue.add(faster);
  PaperRun dearer = like;
  dearer.scene = calibration_scene.scene;
  dearer.node_count = 2;
  dearer.machine.cost_ps[static_cast<std::size_t>(nodes::Charge::cached_lookup)] *= 2;
  catalogue.dearer_cache = catalogue.add(dearer);
  return catalogue;
}

}  // namespace dmpc::apps
