#include <array>
#include <iostream>
#include <string>

#include "apps/edge/system/output_file.h"
#include "apps/edge/system/progress.h"
#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/formats/mesh_file.h"
#include "apps/lab/bench/speed/assimp_rival.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/mesh_files.h"
#include "apps/lab/bench/speed/parts.h"
#include "core/base/expect.h"
#include "core/database/database.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, 2> mesh_formats = {"ply", "glb"};

/// By the wall clock: who reads for us is another process.
std::vector<double> wall_figures(Stopwatch& stopwatch) { return figures_of({stopwatch.lap(), 0}); }

/// Both who read a file with so many triangles. Their interrupt outlives the matches.
void add_readers(const std::string& scene, const std::string& format, const std::filesystem::path& path, std::uint64_t triangles,
                 const Interrupt& interrupt, Matches& matches) {
  const std::size_t own = matches.add([&interrupt, path, triangles] {
    interrupt.check();
    Stopwatch stopwatch;
    const core::Scene read = read_mesh_file(path.string()).scene;
    std::vector<double> figures = wall_figures(stopwatch);
    core::expect(read.objects.size() == triangles, "all triangles are read");
    return figures;
  });
  const std::size_t rival = matches.add([&interrupt, path, triangles] {
    interrupt.check();
    Stopwatch stopwatch;
    const std::uint64_t faces = read_by_assimp(path);
    std::vector<double> figures = wall_figures(stopwatch);
    core::expect(faces == triangles, "Assimp reads all triangles");
    return figures;
  });
  matches.compare(own, rival,
                  {.part = SpeedPart::load,
                   .scene = scene,
                   .what = "load " + format,
                   .detail = clock_names.front(),
                   .subject = "dmpc",
                   .rival = "Assimp",
                   .unit = "s"});
}

}  // namespace

void measure_load(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  const ScratchFolder folder;
  Matches matches(results);
  for (const std::string& scene : settings.scenes_of(SpeedPart::load)) {
    interrupt.check();
    const SharedMesh mesh = mesh_of(core::build_database(settings.load(settings.picture_of(SpeedPart::load, scene)), {}));
    if (mesh.triangles.empty()) {
      std::cerr << "dmpc: " << scene << " has no triangles: left out of part load\n";
      continue;
    }
    for (const char* const format : mesh_formats) {
      const std::filesystem::path path = folder / (std::to_string(results.size()) + "." + format);
      write_file(path, std::string(format) == "ply" ? ply_of(mesh) : glb_of(mesh));
      add_readers(scene, format, path, mesh.triangles.size(), interrupt, matches);
    }
  }
  Progress progress(std::cerr, stderr_is_terminal(), "mesh files:", "readings");
  matches.measure(settings.rounds_of(SpeedPart::load), progress);
}

}  // namespace dmpc::apps
