#include "apps/help/choices.h"

#include <array>

#include "apps/formats/mesh_file.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machines.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
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
  all.entries.push_back({"landscape-10", "a million triangles and a texture; as files: dmpc scene landscape-10 -o land.gltf"});
  all.entries.push_back({"grove-5", "500 trees of 2,048 triangles on a landscape; as files: dmpc scene grove-5 -o grove.gltf"});
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
    all.entries.push_back({description.name, std::string(description.meaning) + ": " + options_of(description.system)});
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

ChoiceList skips() {
  ChoiceList all{"skips", "--no-skip=", {}};
  for (const core::Skip& skip : core::all_skips) {
    all.entries.push_back({skip.name, skip.what});
  }
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
