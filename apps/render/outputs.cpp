#include "apps/render/outputs.h"

#include <iostream>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/references/reference_file.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/picture/image_file.h"
#include "apps/scene/load_scene.h"
#include "apps/show/heat/picture.h"
#include "apps/show/page/render_page.h"
#include "apps/show/stats/stats.h"
#include "apps/show/trace/file.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

std::vector<NamedFile> inputs_of(const RenderOptions& options) {
  std::vector<NamedFile> inputs;
  add_scene_file(options.picture, inputs);
  if (options.frames.camera_path) {
    inputs.push_back({"--camera-path", *options.frames.camera_path});
  }
  if (options.runner.kind == RunnerKind::virtual_time && find_machine_preset(options.runner.machine_name) == nullptr) {
    inputs.push_back({"--machine", options.runner.machine_name});
  }
  return inputs;
}

}  // namespace

OutputSet<RenderRecord> outputs_of(const RenderOptions& options) {
  using Record = const RenderRecord&;
  OutputSet<RenderRecord> outputs;
  outputs.add("-o", options.image, check_image_path, nullptr);
  if (options.stats) {
    const auto write = [](Record record, std::ostream& stream) { stream << stats_json(record); };
    outputs.add("--stats", *options.stats, check_output_path,
                has_counters_on_standard_output(options) ? OutputSet<RenderRecord>::Write() : write);
  }
  if (options.trace.path) {
    outputs.add("--trace", *options.trace.path, check_output_path, write_trace);
  }
  if (options.references) {
    outputs.add("--references", *options.references, check_output_path, [](Record record, std::ostream& stream) {
      core::expect(record.references != nullptr, "references that are written were recorded");
      write_references(stream, *record.references, record.database.page_size());
    });
  }
  if (options.report) {
    outputs.add("--report", *options.report, check_output_path, [](Record record, std::ostream& stream) {
      stream << html::render_page(record, this_origin(record.scene_digest));
    });
  }
  for (const HeatRequest& request : options.heat_maps) {
    outputs.add("--heatmap", request.path, check_image_path,
                [request](Record record, std::ostream& stream) { stream << heat_file(request, record); });
  }
  for (const LayerRequest& request : options.layers) {
    if (request.path) {
      outputs.add("--aov", *request.path, check_image_path, [request](Record record, std::ostream& stream) {
        stream << layer_file(*request.path, *core::find_in(*record.layers, request.layer, &LayerImage::layer));
      });
    }
  }
  if (options.checkpoint.file) {
    outputs.add("--checkpoint", *options.checkpoint.file, check_output_path, nullptr);
  }
  return outputs;
}

void check_outputs(const RenderOptions& options, const OutputSet<RenderRecord>& outputs) {
  check_outputs(inputs_of(options), outputs.names());
  check_open_files();
  if (options.report) {
    const ScratchFolder probe;
  }
  if (!options.quiet || has_counters_on_standard_output(options)) {
    check_standard_output("what follows the picture", "--quiet says nothing there");
  }
}

bool has_counters_on_standard_output(const RenderOptions& options) { return options.stats && is_standard_output(*options.stats); }

}  // namespace dmpc::apps
