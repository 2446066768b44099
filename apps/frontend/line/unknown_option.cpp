#include "apps/frontend/line/unknown_option.h"

#include <algorithm>
#include <iterator>

#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/line/words.h"

namespace dmpc::apps {
namespace {

struct Row {
  const char* names;  ///< without dashes
  ForeignOption option;
};

constexpr Row foreign[] = {
    {"fov angle vfov hfov", {"--camera", "which ends with the angle"}},
    {"eye from origin at lookat look-at target", {"--camera", "which has all of it"}},
    {"width height w size res xres yres +w +h", {"--resolution", "the pixels of both sides"}},
    {"spp s pixelsamples samples-per-pixel", {"--samples", "the samples per pixel"}},
    {"n np j jobs t threads nthreads cores", {"--nodes", "each of which is a thread"}},
    {"maxdepth max-depth bounces", {"--depth", "the maximum depth of reflections and refractions"}},
    {"out outfile", {"--output", "the picture"}},
    {"quick", {"--quality", "of which draft is the quick one"}},
};

struct Gone {
  const char* name;
  const char* instead;
};

constexpr Gone gone[] = {
    {"--balance-grid", "loads are counted in 256x256 columns"},
    {"--details", "-o FILE has every comparison"},
    {"--grid-axes", "the grid has the world's axes; --camera turns the picture"},
    {"--idle", "ranks spin where there are more processors than nodes, else sleep"},
    {"--keep-checkpoint", "a checkpoint is removed when the picture is written; without --resume that is rendered again"},
    {"--memory-port", "--machine=FILE.json names a machine whose has_memory_port is true; dmpc machine prints one to begin with"},
    {"--no-contention",
     "--machine=FILE.json names a machine whose has_contention is false; dmpc machine prints one to begin with"},
    {"--no-skip=empty-space", "empty voxels are passed over by all; --structure=voxels --voxels=article visits each"},
    {"--occlusion", "--sky=1 --bounces=0 lights each place by the share of its surroundings that is free"},
    {"--parts=build", "--parts=plain has the build of each scene, on all cores"},
    {"--parts=load", "dmpc render --stats=FILE says what loading and each phase behind it take"},
    {"--parts=memory", "/usr/bin/time -v dmpc render SCENE has the memory of its process"},
    {"--parts=pages", "dmpc study paper has Table 2 of the article beside ours"},
    {"--parts=picture", "--parts=plain has pictures by Embree"},
    {"--patience", "--rank-timeout=SECONDS is its name now"},
    {"--preview", "--serve shows the picture in a browser while it is rendered"},
    {"--ray-places", "--ray-slots=N is its name now"},
    {"--strip", "--heatmap=done:FILE.png shows when each pixel was done, and the page of --report plays it"},
    {"--topology", "the machine's topology is used, on threads a hypercube; dmpc study balance --topology=KIND compares"},
    {"--trace-every", "--trace-window=FROM,TO records all pixels, of a part of the run"},
    {"--trace-events", "a million events are kept, spread over the run; --trace-window=FROM,TO records all of a part of it"},
    {"--trace-keep",
     "a trace too long is kept in parts from all times of the run; --trace-window=FROM,TO records all of one time"},
    {"--trace-nodes", "--trace records all nodes; Perfetto shows those that are pinned on top"},
    {"--tree-arity", "--homes=tree has three children a node"},
    {"--work-giver", "--work-donor=ring or --work-donor=host is its name now"},
    {"bench error --pictures", "dmpc compare --difference=IMAGE shows how far one picture lies from another"},
    {"bench error --references", "each run makes its own references"},
    {"bench speed --plots", "-o FILE.csv --format=csv has all comparisons, to be drawn"},
    {"bench stability --resume", "a long run may be made of several with another --seed each, whose counts add up"},
    {"study balance --report", "-o FILE has its table, --plots=FOLDER its pictures"},
    {"study frames --report", "-o FILE has its table, --plots=FOLDER its pictures"},
    {"study speedup --report", "-o FILE has its table, --plots=FOLDER its pictures"},
    {"study systems --report", "-o FILE has its table, --plots=FOLDER its pictures"},
    {"study scale",
     "examples/scale.py of the Python module has costs and their growth over scenes, dmpc study sweep those of one"},
    {"study traffic --report", "-o FILE has its table, --plots=FOLDER its pictures"},
};

/// "w", of "--w", "-w" and "-W640"; "+w", of "+W640"; names of several letters keep their digits.
std::string bare(const std::string& name) {
  const std::string word = in_small_letters(name.substr(std::min(name.find_first_not_of('-'), name.size())));
  const std::size_t letters = word.starts_with('+') ? 2 : 1;
  return word.find_first_not_of("0123456789", letters) == std::string::npos ? word.substr(0, letters) : word;
}

}  // namespace

std::optional<ForeignOption> foreign_option(const std::string& name) {
  const std::string word = bare(name);
  for (const Row& row : foreign) {
    const std::vector<std::string> names = words_between(row.names, ' ');
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      return row.option;
    }
  }
  return std::nullopt;
}

std::string renamed_value(const std::string& option_and_value) { return option_and_value == "--quality=default" ? "good" : ""; }

std::string said_instead_of(const std::string& name) {
  const auto* const found = std::find_if(std::begin(gone), std::end(gone), [&](const Gone& each) { return name == each.name; });
  return found == std::end(gone) ? "" : found->instead;
}

}  // namespace dmpc::apps
