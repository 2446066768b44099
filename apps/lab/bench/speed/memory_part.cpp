#include <iostream>
#include <string>

#include "apps/edge/system/output_file.h"
#include "apps/edge/system/progress.h"
#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/system/watched_process.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/scene/subject.h"
#include "svm/run.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t memory_node_count = 8;
constexpr const char* one_triangle =
    "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 512 512\n"
    "l 2 2 5\nf 1 0.5 0.5 1 0 1 0 1\np 3\n-1 -1 0\n1 -1 0\n0 1 0\n";

std::string text_of(const Resolution& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

std::size_t peak_of(const std::string& scene, const SpeedSettings& settings, const ScratchFolder& folder,
                    const Interrupt& interrupt) {
  const PictureOptions picture = settings.picture_of(SpeedPart::memory, scene);
  return peak_anonymous_bytes(settings.program,
                              {"render", scene, "--nodes=" + std::to_string(memory_node_count), "--quiet", "--samples=1",
                               "--resolution=" + text_of(*picture.resolution), "-o", (folder / "picture.exr").string()},
                              interrupt);
}

/// What the nodes of that render have together.
std::size_t local_bytes(const std::string& scene, const SpeedSettings& settings) {
  const Subject subject = settings.subject_of(SpeedPart::memory, scene);
  const svm::Plan plan =
      svm::plan_of(*svm::svm_strategy(), subject.database, subject.settings, {.computer = {.node_count = memory_node_count}});
  std::size_t sum = 0;
  for (std::uint32_t node = 0; node < memory_node_count; ++node) {
    sum += plan.node_memory(node).total();
  }
  return sum;
}

double mebibytes(double bytes) { return bytes / (1 << 20); }

}  // namespace

void measure_memory(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  const ScratchFolder folder;
  const std::filesystem::path triangle = folder / "triangle.nff";
  write_file(triangle, one_triangle);
  const std::size_t empty = peak_of(triangle.string(), settings, folder, interrupt);
  const std::vector<std::string> scenes = settings.scenes_of(SpeedPart::memory);
  Progress progress(std::cerr, stderr_is_terminal(), "memory:", "scenes");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    progress.update(i, scenes.size());
    const double peak = static_cast<double>(peak_of(scenes[i], settings, folder, interrupt)) - static_cast<double>(empty);
    results.push_back({.part = SpeedPart::memory,
                       .scene = scenes[i],
                       .what = "anonymous memory",
                       .threads = memory_node_count,
                       .subject = "process above that of one triangle",
                       .rival = "local memories",
                       .unit = "MiB",
                       .figures = {{mebibytes(peak)}, {mebibytes(static_cast<double>(local_bytes(scenes[i], settings)))}}});
  }
}

}  // namespace dmpc::apps
