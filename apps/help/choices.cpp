#include "apps/help/choices.h"

#include <array>

#include "apps/formats/mesh_file.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machines.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "apps/scene/picture_options.h"
#include "core/families/scenes.h"
#include "core/picture/heat_kind.h"
#include "core/trace/skips.h"
#include "nodes/topology.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {
namespace {

ChoiceList scenes() {
  ChoiceList all{"scenes", "SCENE", {}};
  for (const core::SceneName& scene : core::default_scenes()) {
    all.entries.push_back(
        {scene.text(), grouped(core::primitive_count(scene)) + " primitives; other sizes and, with -tN, as triangles"});
  }
  all.entries.push_back({"landscape-10", "a million triangles and a texture"});
  all.entries.push_back({"grove-5", "500 trees of 2,048 triangles on a landscape"});
  return all;
}

ChoiceList machines() {
  ChoiceList all{"machines", "--machine=", {}};
  for (const MachineDescription& preset : machine_presets()) {
    all.entries.push_back({preset.machine.name, preset.title});
  }
  return all;
}

ChoiceList strategies() {
  return {
      "strategies",
      "--strategy=",
      {{name_of(Strategy::svm), "pages travel: the scene is distributed over the nodes, which fetch and cache what they need"},
       {name_of(Strategy::dataflow), "rays travel: each node holds a region of space, and rays go to its owner"},
       {name_of(Strategy::forest), "queries travel: each node holds the top of the tree and subtrees that other nodes query"},
       {name_of(Strategy::replicated), "nothing travels: every node holds the whole scene"}}};
}

ChoiceList named_systems() {
  ChoiceList all{"systems", "--system=", {}};
  for (const SystemDescription& description : systems()) {
    all.entries.push_back({description.name, std::string(description.meaning) + ": " + options_of(description.system) +
                                                 "; it had " + description.had_what + " (" + name_of(description.had) + ")"});
  }
  return all;
}

ChoiceList policies() {
  ChoiceList all{"policies", "--replacement=", {}};
  for (const svm::PolicyKind& kind : svm::policy_kinds()) {
    all.entries.push_back({std::string(kind.name), std::string(kind.meaning)});
  }
  return all;
}

ChoiceList topologies() {
  using nodes::TopologyKind;
  const auto entry = [](TopologyKind kind, const char* meaning) { return Choice{std::string(nodes::name_of(kind)), meaning}; };
  return {"topologies",
          "--topology=",
          {entry(TopologyKind::crossbar, "every two nodes share a link"),
           entry(TopologyKind::hypercube, "neighbours differ in one bit of their numbers"),
           entry(TopologyKind::mesh, "two dimensions, as near to square as the number of nodes allows"),
           entry(TopologyKind::torus, "a mesh closed to rings"),
           entry(TopologyKind::fat_tree, "nodes are the leaves of a tree of switches with four children each")}};
}

ChoiceList heat_maps() {
  constexpr std::array<const char*, core::heat_kind_names.size()> meanings = {"requests for pages that its rays began (svm)",
                                                                              "look-ups of pages (svm)",
                                                                              "different pages looked up (svm)",
                                                                              "rays traced",
                                                                              "computing time",
                                                                              "the node that the pixel belongs to",
                                                                              "how deep its rays go; 1: primary rays alone",
                                                                              "light samples",
                                                                              "when it was done, since the start"};
  ChoiceList all{"heatmaps", "--heatmap=", {}};
  for (std::size_t i = 0; i < meanings.size(); ++i) {
    all.entries.push_back({std::string(core::heat_kind_names[i]), meanings[i]});
  }
  return all;
}

/// Of teapot-12, rings-4-t1, balls-4, mount-6, tree-11, tetra-9, gears-2 and landscape-8 at 128x128 on 4 nodes, by Whitted's
/// transport and with paths of 3 bounces: counters with the skip over those without it.
ChoiceList skips() {
  constexpr std::array leaves = {
      "0.92 (gears-2) to 1.00 of the reads of BVH nodes, among spheres 1.02 (balls-4): gains where much blocks the light",
      "0.81 (gears-2) to 1.00 (landscape-8) of all rays: gains where surfaces face away from lights",
      "0.17 to 0.65 of all rays by Whitted's transport; with paths all, but 0.87 where parts have no light (landscape-8)",
      "0.15 (landscape-8) to 0.80 (mount-6) of the bytes on 8 and 64 nodes, for 0.89 (tree-11) to 1.42 (mount-6) of the reads of "
      "BVH "
      "nodes, 1.08 on average: gains where messages are dear",
      "0.87 (tetra-9) of the reads of BVH nodes where parts of the picture are empty, else all (rings-4-t1)",
      "0.12 to 0.50 of the look-ups with 16 pixels in flight or more, for 0.98 to 1.14 of the faults; on modelled machines with "
      "--bundles alone",
      "0.9 of the requests on 8 nodes, 0.7 on 16, 0.25 on 64, 0.03 on 1,024; of the time all up to 16 nodes, on 64 of ipsc2 0.99 "
      "and "
      "of hdr 0.84, on 1,024 0.42 and 0.60 (rings-4-t1): gains from 16 nodes on"};
  static_assert(leaves.size() == core::all_skips.size());
  ChoiceList all{"skips", "--no-skip=", {}};
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    all.entries.push_back({core::all_skips[i].name, std::string(core::all_skips[i].what) + ". Leaves " + leaves[i]});
  }
  all.entries.push_back({equal_frames.name, std::string(equal_frames.what) + ". Leaves nothing of such a frame"});
  return all;
}

ChoiceList formats() {
  ChoiceList all{"formats", "SCENE", {{"nff", "Neutral File Format of the Standard Procedural Databases"}}};
  for (const std::string& ending : words_between(known_mesh_formats(), ',')) {
    const std::string word = ending.substr(ending.find_first_not_of(' '));
    all.entries.push_back({word, has_own_sky("a." + word) ? "a whole scene of pbrt-v4" : "a mesh file"});
  }
  return all;
}

}  // namespace

std::vector<ChoiceList> all_choices() {
  return {scenes(), machines(), strategies(), named_systems(), policies(), topologies(), heat_maps(), skips(), formats()};
}

}  // namespace dmpc::apps
